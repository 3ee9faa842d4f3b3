// diptych: Python binding of the stress maps
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/averaging.h"
#include "coupling/averaging/periodic.h"
#include "coupling/python/bindings.h"
#include "coupling/python/inputs.h"

namespace diptych::python
{
  namespace
  {
    // Stress is moment / area. The error is the relative difference of the sums over cells and over contacts.
    struct Mapped
    {
      std::vector<Eigen::Matrix2d> stress;
      std::vector<Eigen::Vector2d> couple_stress;
      double                       outside_share = 0, total_relative_error = 0;
    };

    Mapped mapped(const coupling::CellSums &sums, const coupling::Carriers &carriers, const std::vector<double> &area)
    {
      Mapped          result;
      Eigen::Vector4d total = Eigen::Vector4d::Zero(), expected = total;
      for (std::size_t k = 0; k < area.size(); ++k)
        {
          const auto            row    = sums.uniform.row(Eigen::Index(k));
          const Eigen::Vector4d moment = row.head<4>();
          Eigen::Matrix2d       stress;
          stress << moment[0], moment[1], moment[2], moment[3];
          result.stress.emplace_back(stress / area[k]);
          result.couple_stress.emplace_back(
            (row.segment<2>(coupling::couple_moment) + sums.tapered.row(Eigen::Index(k))).transpose() / area[k]);
          total += moment;
        }
      for (Eigen::Index k = 0; k < carriers.uniform.rows(); ++k)
        expected += carriers.uniform.row(k).head<4>().transpose();
      result.outside_share        = sums.outside_share;
      result.total_relative_error = expected.norm() > 0 ? (total - expected).norm() / expected.norm() : total.norm();
      return result;
    }

    // keys: those of the section `comparison` that begin with averaging.
    py::dict map_stress(const py::dict &grain_arrays,
                        const py::dict &contacts,
                        const py::dict &mesh_arrays,
                        const Numbers  &period,
                        const py::dict &keys)
    {
      const GrainInput           grains  = grains_of(grain_arrays);
      const auto                 forces  = contacts_of(contacts, grains);
      const coupling::QuadMesh   mesh    = mesh_of(mesh_arrays);
      const coupling::Period     repeats = period_of(period);
      coupling::AveragingOptions options;
      set_options("comparison", keys, options);

      Mapped              result;
      coupling::CellCover cover;
      std::vector<double> area;
      {
        const py::gil_scoped_release release;
        coupling::Carriers           carriers = coupling::moment_carriers(grains.position, grains.radius, forces);
        carriers.mean_diameter                = grains.mean_diameter;
        const coupling::TargetCells target(mesh, repeats);
        area   = target.area;
        result = mapped(coupling::distribute(options, target, carriers), carriers, area);
        cover  = coupling::grain_cover(mesh, repeats, grains.position, grains.radius);
      }
      py::dict map;
      map["stress"]               = own(std::move(result.stress));
      map["couple_stress"]        = own(std::move(result.couple_stress));
      map["area"]                 = own(std::move(area));
      map["solid_fraction"]       = own(std::move(cover.solid_fraction));
      map["covered"]              = own(std::move(cover.covered));
      map["outside_share"]        = result.outside_share;
      map["total_relative_error"] = result.total_relative_error;
      return map;
    }

    py::dict mesh_dict(const coupling::QuadMesh &mesh)
    {
      std::vector<std::array<int, 4>> cells;
      for (const auto &cell : mesh.cell)
        cells.push_back({int(cell[0]), int(cell[1]), int(cell[2]), int(cell[3])});
      py::dict dict;
      dict["nodes"] = own(std::vector<Eigen::Vector2d>(mesh.node));
      dict["cells"] = own(std::move(cells));
      return dict;
    }
  } // namespace

  void bind_averaging(py::module_ &m)
  {
    m.def("map_stress", &map_stress);
    m.def("grid", [](const Numbers &lower, const Numbers &upper, const double size) {
      return mesh_dict(coupling::regular_grid(vector_of(lower, "lower"), vector_of(upper, "upper"), size));
    });
    m.def("mesh_of", [](const continuum::Snapshot &snapshot) { return mesh_dict(coupling::quad_mesh(snapshot)); });
  }
} // namespace diptych::python
