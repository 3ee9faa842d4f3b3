// diptych: smoothing kernels in two dimensions, and their integrals over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/averaging/averaging_options.h"
#include "coupling/averaging/target_cells.h"
#include "coupling/cells/bin_grid.h"

namespace diptych::coupling
{
  // A radial kernel phi whose integral over the plane is 1. w is its standard deviation along each axis: w^2 = (1/2) integral of
  // r^2 phi.
  //   gauss: exp(-r^2 / 2 w^2) / (2 pi w^2), cut at 4 w and scaled up by the share 3.4e-4 that lies beyond.
  //   lucy: 5 / (pi R^2) (1 + 3 r/R) (1 - r/R)^3 for r < R (Lucy 1977). (1/2) integral of r^2 phi = 5 R^2 / 56, so R = sqrt(56/5)
  //          w = 3.347 w.
  class Kernel
  {
  public:
    Kernel(KernelShape shape, double standard_deviation);

    double width() const { return deviation; } // w [length]
    double reach() const { return radius; }    // zero beyond this radius [length]

    // Values at squared distances [1/length^2].
    Eigen::ArrayXd operator()(const Eigen::ArrayXd &squared_distance) const;
    double         operator()(double squared_distance) const;

  private:
    bool   is_gauss;
    double deviation, radius, peak;
  };

  // Quadrature points of a mesh, sorted into bins. A triangle has n^2 equal parts, whose longest edge is at most 1.5 w, with
  // the three-point rule of degree 2. Deep inside a mesh the sum over cells is then 1 within 1e-3, before it is scaled.
  class KernelQuadrature
  {
  public:
    KernelQuadrature(const TargetCells &target, const Kernel &kernel);

    // Integrals of the kernel around x over the cells within its reach. Period images of x count.
    struct Weights
    {
      std::vector<unsigned int> cell;  // each cell once, in the order in which they were met
      std::vector<double>       value; // they add up to `sum`, which is 1 deep inside a mesh and 0 if no point is in reach
      double                    sum = 0;
    };
    void weights(const Eigen::Vector2d &x, Weights &result);

  private:
    void add_image(const Eigen::Vector2d &x, Weights &result);

    Kernel                    kernel;
    Period                    period;
    Eigen::Vector2d           lower, upper;
    BinGrid                   bins;          // sorted points
    Eigen::ArrayXd            x_, y_, area_; // points in the order of the bins
    std::vector<unsigned int> cell_;         // cells in the order of the bins
    std::vector<double>       sum_of_cell;   // scratch space, zero between calls
  };

  // Points and weights along a segment with the parameter t from 0 to 1, in parts no longer than w with two Gauss points each.
  // The weights add up to one, also if multiplied by 2 (1 - t), the density of a quantity that decreases linearly.
  struct SegmentRule
  {
    std::vector<double> t, weight;
  };
  SegmentRule segment_rule(double length, double width);
} // namespace diptych::coupling
