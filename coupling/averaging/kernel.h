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
  // Radial, of integral 1 over the plane; w is the standard deviation along each axis, (1/2) integral of r^2 phi.
  //   gauss: exp(-r^2 / 2 w^2) / (2 pi w^2), cut at 4 w, where 3.4e-4 of it are left, and scaled up by as much.
  //   lucy:  5 / (pi R^2) (1 + 3 r/R) (1 - r/R)^3 for r < R (Lucy 1977); (1/2) integral of r^2 phi = 5 R^2 / 56, so that
  //          R = sqrt(56/5) w = 3.347 w.
  class Kernel
  {
  public:
    // Throws std::invalid_argument for a width that is not positive.
    Kernel(KernelShape shape, double standard_deviation);

    double width() const { return deviation; } // w [length]
    double reach() const { return radius; }    // no value beyond it [length]

    // At squared distances [1/length^2].
    Eigen::ArrayXd operator()(const Eigen::ArrayXd &squared_distance) const;
    double         operator()(double squared_distance) const;

  private:
    bool   is_gauss;
    double deviation, radius, peak;
  };

  // Quadrature points of a mesh in bins. Rule: each triangle is divided into n^2 equal ones, n the smallest number for which
  // their longest edge is at most 1.5 w, with the three-point rule of degree 2 in each. Deep inside a mesh the sum over cells
  // is then 1 within 1e-3 before it is scaled.
  class KernelQuadrature
  {
  public:
    KernelQuadrature(const TargetCells &target, const Kernel &kernel);

    // Integrals of the kernel around x over the cells that it reaches; period images of x count.
    struct Weights
    {
      std::vector<unsigned int> cell;  // each once, by first meeting
      std::vector<double>       value; // their sum is `sum`, 1 deep inside a mesh, 0 where no point is in reach
      double                    sum = 0;
    };
    void weights(const Eigen::Vector2d &x, Weights &result);

  private:
    void add_image(const Eigen::Vector2d &x, Weights &result);

    Kernel                    kernel;
    double                    period;
    Eigen::Vector2d           lower, upper;
    BinGrid                   bins;          // of the points
    Eigen::ArrayXd            x_, y_, area_; // of the points, in the order of the bins
    std::vector<unsigned int> cell_;         // likewise
    std::vector<double>       sum_of_cell;   // scratch: zero between calls
  };

  // Points and weights along a segment of which t runs from 0 to 1: parts no longer than w, two Gauss points in each.
  // The weights sum up to one, those times 2 (1 - t) (tapered quantities), too.
  struct SegmentRule
  {
    std::vector<double> t, weight;
  };
  SegmentRule segment_rule(double length, double width);
} // namespace diptych::coupling
