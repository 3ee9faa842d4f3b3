// diptych: options of the averaging of grain quantities over cells
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <utility>

namespace diptych::coupling
{
  enum class AveragingMethod
  {
    segments,
    centroid,
    laguerre,
    kernel,
    projection
  };
  constexpr auto choices(AveragingMethod)
  {
    return std::array{std::pair{AveragingMethod::segments, "segments"}, std::pair{AveragingMethod::centroid, "centroid"},
                      std::pair{AveragingMethod::laguerre, "laguerre"}, std::pair{AveragingMethod::kernel, "kernel"},
                      std::pair{AveragingMethod::projection, "projection"}};
  }

  enum class KernelShape
  {
    gauss,
    lucy
  };
  constexpr auto choices(KernelShape)
  {
    return std::array{std::pair{KernelShape::gauss, "gauss"}, std::pair{KernelShape::lucy, "lucy"}};
  }

  struct AveragingOptions
  {
    AveragingMethod method = AveragingMethod::segments;
    KernelShape     kernel = KernelShape::gauss;
    double          width  = 1.5;
  };

  template <class Visitor> void visit_parameters(AveragingOptions &o, Visitor &&visitor)
  {
    visitor(
      "averaging", o.method, "-",
      "method that distributes grain quantities over cells: cut branches and discs at the cells' edges; give all to the cell of "
      "the grain's centre; share by the grain's power cell; smooth by a kernel; or project onto linear elements with a smoothing "
      "length");
    visitor("averaging_kernel", o.kernel, "-", "shape of the smoothing kernel; only for averaging = kernel");
    visitor("averaging_width", o.width, "mean diameters", {0.25, 10.},
            "standard deviation of the smoothing along each axis; only for averaging = kernel and projection");
  }
} // namespace diptych::coupling
