// diptych: how grain quantities go onto cells, as a scene says it
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
      "how grain quantities go onto cells: branches and discs cut by the cells; all to the cell of the grain's centre; by the "
      "grain's power cell; smoothed by a kernel; projected onto linear elements with a smoothing length");
    visitor("averaging_kernel", o.kernel, "-", "of averaging = kernel");
    visitor("averaging_width", o.width, "mean diameters", {0.25, 10.},
            "standard deviation of the smoothing (along each axis) of averaging = kernel and projection; the others have none");
  }
} // namespace diptych::coupling
