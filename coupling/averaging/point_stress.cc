// diptych: the grains' stress at points, smoothed by a kernel
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/averaging/point_stress.h"

#include <algorithm>
#include <cmath>

#include "coupling/averaging/averaging.h"
#include "coupling/averaging/kernel.h"
#include "coupling/cells/point_bins.h"

namespace diptych::coupling
{
  std::vector<Eigen::Matrix2d> stress_at_points(const TargetCells                  &region,
                                                const Carriers                     &moments,
                                                const std::vector<Eigen::Vector2d> &points,
                                                const KernelShape                   shape,
                                                const double                        width)
  {
    const Kernel              kernel(shape, width);
    KernelQuadrature          quadrature(region, kernel);
    KernelQuadrature::Weights weights;

    // Quadrature points of the half branches, with their part of the moment.
    std::vector<Eigen::Vector2d>    place;
    std::vector<Eigen::RowVector4d> moment;
    for (std::size_t h = 0; h < moments.half.size(); ++h)
      {
        const HalfBranch     &half  = moments.half[h];
        const SegmentRule     rule  = segment_rule(half.vector.norm(), width);
        const Eigen::Vector2d start = region.wrapped(moments.position[half.grain]);
        for (std::size_t q = 0; q < rule.t.size(); ++q)
          {
            place.push_back(start + rule.t[q] * half.vector);
            moment.push_back(rule.weight[q] * moments.uniform.row(Eigen::Index(h)).head<4>());
          }
      }

    const Eigen::Vector2d reach = Eigen::Vector2d::Constant(kernel.reach());
    Eigen::Vector2d       low = region.lower, high = region.upper; // box of the mesh and the places
    for (const Eigen::Vector2d &x : place)
      {
        low  = low.cwiseMin(x);
        high = high.cwiseMax(x);
      }
    const PointBins              bins(place, 0.5 * kernel.reach());
    std::vector<Eigen::Matrix2d> stress;
    for (const Eigen::Vector2d &point : points)
      {
        const Eigen::Vector2d x   = region.wrapped(point);
        Eigen::RowVector4d    sum = Eigen::RowVector4d::Zero();
        for (const Eigen::Vector2d &image : region.period.images_in(x, low - reach, high + reach))
          bins.for_each_near(image, kernel.reach(),
                             [&](const unsigned int k) { sum += kernel((place[k] - image).squaredNorm()) * moment[k]; });
        quadrature.weights(x, weights);
        Eigen::Matrix2d tensor;
        tensor << sum[0], sum[1], sum[2], sum[3];
        stress.push_back(weights.sum > 0 ? Eigen::Matrix2d(tensor / weights.sum) : Eigen::Matrix2d::Constant(NAN));
      }
    return stress;
  }
} // namespace diptych::coupling
