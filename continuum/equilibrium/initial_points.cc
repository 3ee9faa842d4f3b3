// diptych: material points before loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/initial_points.h"

#include <cmath>
#include <optional>

namespace diptych::continuum
{
  void set_at_rest(const Discretisation       &mesh,
                   const Options              &options,
                   const Units                &units,
                   const double                pressure,
                   std::vector<MaterialState> &points)
  {
    const Eigen::Vector2d spot = mesh.origin +
                                 Eigen::Vector2d(options.weak_spot_x, options.weak_spot_y).cwiseProduct(mesh.extent);
    const double             radius = options.weak_spot_radius * units.length;
    std::optional<Hardening> hardening;
    if (traits(options.law).is_plastic)
      hardening.emplace(in_units(options.material, units));
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        auto &point          = points[i];
        point.stress[xx]     = -pressure;
        point.stress[yy]     = -pressure;
        point.stress_zz      = -pressure;
        const auto     &cell = mesh.cells[i / mesh.reference.n_points];
        Eigen::Vector2d at   = Eigen::Vector2d::Zero();
        for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
          at += mesh.reference.shape[i % mesh.reference.n_points][node] * mesh.nodes[cell.nodes[node]].initial;
        const double strain             = options.weak_spot_strain * std::exp(-(at - spot).squaredNorm() / (2 * radius * radius));
        point.equivalent_plastic_strain = strain;
        if (hardening)
          hardening->write(hardening->after({}, strain), point);
        if (traits(options.law).is_gradient)
          own_part<NonlocalState>(point).plastic_strain = strain;
      }
  }

  void set_stress(const std::vector<Eigen::Matrix2d> &of_cells, const std::size_t n_points, std::vector<MaterialState> &points)
  {
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const auto &cell  = of_cells[i / n_points];
        auto       &point = points[i];
        point.stress[xx]  = -cell(0, 0);
        point.stress[yy]  = -cell(1, 1);
        point.stress[xy]  = -(cell(0, 1) + cell(1, 0)) / 2;
        point.stress_zz   = -(cell(0, 0) + cell(1, 1)) / 2; // discs have none: mean of the in-plane stresses
      }
  }

  void start_variables(const Law &law, std::vector<MaterialState> &points)
  {
    if (const auto *library = std::get_if<LibraryLaw>(&law))
      for (MaterialState &point : points)
        library->start(point);
  }

  void set_solid_fraction(const std::vector<double>  &of_cells,
                          const std::size_t           n_points,
                          const LawOptions           &law,
                          std::vector<MaterialState> &points)
  {
    const double start = law.start_solid_fraction();
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        auto *critical = std::get_if<CriticalState>(&points[i].own);
        if (!critical)
          critical = std::get_if<KinematicState>(&points[i].own);
        if (critical)
          critical->densification += std::log(of_cells[i / n_points] / start);
      }
  }
} // namespace diptych::continuum
