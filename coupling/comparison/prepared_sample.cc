// diptych: checks of the prepared sample that a comparison needs, made before anything runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/prepared_sample.h"

#include <algorithm>

#include "coupling/comparison/increment.h"
#include "coupling/probes/circular_probe.h"
#include "coupling/probes/probe_regions.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  void require_comparable_sample(const ProbeOptions &options, const discrete::Snapshot &prepared)
  {
    // Before the loading, grains of an imported table carry no force and would have no weight.
    const std::vector<double> weight   = displacement_field(prepared, prepared).weight;
    const auto                carry    = std::count_if(weight.begin(), weight.end(), [](const double w) { return w > 0; });
    const std::size_t         n_points = carry > 0 ? std::size_t(carry) : weight.size();
    if (n_points < std::size_t(fewest_band_points))
      throw SceneError("sample: only " + std::to_string(n_points) +
                       " grains can be used for the band detection, which needs at least " + std::to_string(fewest_band_points) +
                       "; increase sample/grains");
    const SampleFrame                  frame   = sample_frame(prepared, prepared);
    const std::vector<Eigen::Vector2d> outline = outline_polygon(prepared.outline);
    if (!options.probe_rectangles.empty())
      for (const ProbeRegion &region : place_probes(outline, frame, {}, options))
        if (region.polygon.empty())
          throw SceneError("comparison/probe_rectangles: " + region.name + " lies outside the sample");
    if (!options.probe_circle.empty() && !(place_circle(outline, frame, {}, options).radius > 0))
      throw SceneError("comparison/probe_circle: the circle lies outside the sample");
  }
} // namespace diptych::coupling
