// diptych: options for the places of probes and for their resampling
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/probe_options.h"

#include <stdexcept>
#include <string>

namespace diptych::coupling
{
  void check_probe_options(const ProbeOptions &options)
  {
    const std::vector<double> &rectangles = options.probe_rectangles, &circle = options.probe_circle;
    if (rectangles.size() % 5 != 0)
      throw std::invalid_argument("probe_rectangles: " + std::to_string(rectangles.size()) +
                                  " numbers; give five per probe: x, y, length, thickness, angle");
    for (std::size_t k = 0; k < rectangles.size(); k += 5)
      if (!(rectangles[k + 2] > 0 && rectangles[k + 3] > 0))
        throw std::invalid_argument("probe_rectangles: length and thickness of probe " + std::to_string(k / 5 + 1) +
                                    " must be above 0");
    if (!circle.empty() && circle.size() != 3)
      throw std::invalid_argument("probe_circle: " + std::to_string(circle.size()) + " numbers; give three: x, y, radius");
    if (!circle.empty() && !(circle[2] > 0))
      throw std::invalid_argument("probe_circle: the radius must be above 0");
  }
} // namespace diptych::coupling
