// diptych: the continuum's fields after the averaging that is applied to the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/continuum_averaging.h"

#include <algorithm>
#include <cmath>

namespace diptych::coupling
{
  namespace
  {
    ContinuumFields carried(const CellOverlap &overlap, const ContinuumFields &fields)
    {
      const Eigen::Matrix2d no_tensor = Eigen::Matrix2d::Constant(NAN);
      const Eigen::Vector2d no_vector = Eigen::Vector2d::Constant(NAN);
      return {carried_over<Eigen::Matrix2d>(overlap, fields.stress, no_tensor),
              carried_over<Eigen::Vector2d>(overlap, fields.couple_stress, no_vector),
              carried_over<Eigen::Vector2d>(overlap, fields.displacement_increment, no_vector),
              carried_over<double>(overlap, fields.rotation_increment, NAN),
              carried_over<double>(overlap, fields.dissipation, NAN),
              carried_over<double>(overlap, fields.volume_ratio, NAN)};
    }

    // Points that represent a triangle in the smoothing: the centroids of its parts, none with an edge longer than `spacing`.
    struct AreaPoint
    {
      Eigen::Vector2d position;
      double          area;
      unsigned int    cell;
    };

    std::vector<AreaPoint> area_points(const QuadMesh &mesh, const double spacing)
    {
      std::vector<AreaPoint> points;
      for (unsigned int t = 0; t < mesh.triangle.size(); ++t)
        {
          const auto           &node = mesh.triangle[t].node;
          const Eigen::Vector2d x = mesh.node[node[0]], u = mesh.node[node[1]] - x, v = mesh.node[node[2]] - x;
          const double          edge = std::max({u.norm(), v.norm(), (u - v).norm()});
          const int             n    = std::max(1, int(std::ceil(edge / spacing)));
          const double          area = triangle_area(mesh, t) / (n * n);
          for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j)
              {
                points.push_back({x + (i + 1. / 3) / n * u + (j + 1. / 3) / n * v, area, mesh.triangle[t].cell});
                if (i + j + 1 < n)
                  points.push_back({x + (i + 2. / 3) / n * u + (j + 2. / 3) / n * v, area, mesh.triangle[t].cell});
              }
        }
      return points;
    }

    // Smooths the continuum with the grains' kernel: its densities times area are carriers at points.
    ContinuumFields smoothed(const OwnFields        &own,
                             const QuadMesh         &receiving,
                             const SampleScale      &scale,
                             const AveragingOptions &averaging)
    {
      enum Column
      {
        area,
        stress,
        couple       = 5,
        displacement = 7,
        rotation     = 9,
        dissipation  = 10,
        volume       = 11,
        n_columns    = 12
      };
      Carriers carriers;
      carriers.mean_diameter             = scale.mean_diameter;
      const std::vector<AreaPoint> point = area_points(own.mesh, 0.5 * averaging.width * carriers.mean_diameter);
      carriers.of_grains.resize(Eigen::Index(point.size()), n_columns);
      carriers.radius.assign(point.size(), 0.);
      for (std::size_t k = 0; k < point.size(); ++k)
        {
          const ContinuumFields &f = own.fields;
          const unsigned int     c = point[k].cell;
          carriers.position.push_back(point[k].position);
          carriers.of_grains.row(Eigen::Index(k)) << 1, f.stress[c](0, 0), f.stress[c](0, 1), f.stress[c](1, 0),
            f.stress[c](1, 1), f.couple_stress[c].transpose(), f.displacement_increment[c].transpose(), f.rotation_increment[c],
            f.dissipation[c], f.volume_ratio[c];
          carriers.of_grains.row(Eigen::Index(k)) *= point[k].area;
        }
      const TargetCells target(receiving, scale.period);
      const Columns     sums = distribute(averaging, target, carriers).of_grains;
      ContinuumFields   fields;
      for (unsigned int c = 0; c < target.n_cells(); ++c)
        {
          const auto      sum      = sums.row(c);
          const double    per_area = 1 / target.area[c], per_weight = 1 / sum[area];
          Eigen::Matrix2d tensor;
          tensor << sum[stress], sum[stress + 1], sum[stress + 2], sum[stress + 3];
          fields.stress.push_back(per_area * tensor);
          fields.couple_stress.push_back(per_area * Eigen::Vector2d(sum[couple], sum[couple + 1]));
          fields.displacement_increment.push_back(per_weight * Eigen::Vector2d(sum[displacement], sum[displacement + 1]));
          fields.rotation_increment.push_back(per_weight * sum[rotation]);
          fields.dissipation.push_back(per_area * sum[dissipation]);
          fields.volume_ratio.push_back(per_weight * sum[volume]);
        }
      return fields;
    }
  } // namespace

  ContinuumFields averaged_continuum(const OwnFields        &own,
                                     const QuadMesh         &receiving,
                                     const SampleScale      &scale,
                                     const AveragingOptions &averaging,
                                     const CellOverlap      *known)
  {
    if (averaging.method == AveragingMethod::kernel || averaging.method == AveragingMethod::projection)
      return smoothed(own, receiving, scale, averaging);
    if (&receiving == &own.mesh)
      return own.fields;
    if (known != nullptr)
      return carried(*known, own.fields);
    return carried(cell_overlap(receiving, own.mesh), own.fields);
  }
} // namespace diptych::coupling
