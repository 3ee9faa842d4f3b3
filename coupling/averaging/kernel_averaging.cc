// diptych: averaging by a kernel: coarse graining that conserves totals up to the edge of the sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <numeric>

#include "coupling/averaging/averaging_methods.h"
#include "coupling/averaging/kernel.h"

namespace diptych::coupling
{
  namespace
  {
    // Weights around x that add up to one. Returns false and uses the nearest boundary cell if no cell is within reach.
    bool unit_weights(const TargetCells         &target,
                      const Eigen::Vector2d     &x,
                      KernelQuadrature          &quadrature,
                      KernelQuadrature::Weights &w)
    {
      quadrature.weights(x, w);
      if (!(w.sum > 0))
        {
          w.cell  = {target.cell_of(target.search.locate(x).triangle)};
          w.value = {1};
          return false;
        }
      for (double &value : w.value)
        value /= w.sum;
      return true;
    }
  } // namespace

  CellSums average_by_kernel(const TargetCells &target, const Carriers &carriers, const KernelShape shape, const double width)
  {
    const Kernel              kernel(shape, width);
    KernelQuadrature          quadrature(target, kernel);
    KernelQuadrature::Weights w;
    CellSums                  sums = zero_sums(target, carriers);
    JoinedGrains              joined(target.n_cells());
    if (carriers.of_grains.cols() > 0 || carriers.count_joined)
      for (std::size_t i = 0; i < carriers.position.size(); ++i)
        {
          unit_weights(target, carriers.position[i], quadrature, w);
          for (std::size_t k = 0; k < w.cell.size(); ++k)
            {
              if (carriers.of_grains.cols() > 0)
                sums.of_grains.row(w.cell[k]) += w.value[k] * carriers.of_grains.row(Eigen::Index(i));
              joined.add(w.cell[k], w.value[k]);
            }
        }
    if (carriers.count_joined)
      sums.joined = joined.numbers();

    const bool uniform = carriers.uniform.cols() > 0, tapered = carriers.tapered.cols() > 0;
    double     outside = 0;
    for (std::size_t h = 0; h < carriers.half.size(); ++h)
      {
        const HalfBranch &half = carriers.half[h];
        const SegmentRule rule = segment_rule(half.vector.norm(), width);
        for (std::size_t q = 0; q < rule.t.size(); ++q)
          {
            if (!unit_weights(target, carriers.position[half.grain] + rule.t[q] * half.vector, quadrature, w))
              outside += rule.weight[q] * carriers.half_size[h];
            for (std::size_t k = 0; k < w.cell.size(); ++k)
              {
                const double share = rule.weight[q] * w.value[k];
                if (uniform)
                  sums.uniform.row(w.cell[k]) += share * carriers.uniform.row(Eigen::Index(h));
                if (tapered)
                  sums.tapered.row(w.cell[k]) += 2 * (1 - rule.t[q]) * share * carriers.tapered.row(Eigen::Index(h));
              }
          }
      }
    const double size  = std::accumulate(carriers.half_size.begin(), carriers.half_size.end(), 0.);
    sums.outside_share = size > 0 ? outside / size : 0;
    return sums;
  }
} // namespace diptych::coupling
