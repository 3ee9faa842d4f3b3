// diptych: what a comparison asks of a sample, looked at before anything runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/prepared_sample.h"

#include <algorithm>

#include "coupling/comparison/increment.h"
#include "coupling/probes/circular_probe.h"
#include "coupling/probes/probe_regions.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  void require_comparable_sample(const Scene &scene, const discrete::Snapshot &prepared)
  {
    // Before they are loaded the grains of a table carry nothing, and none of them counts yet.
    const std::vector<double> weight   = displacement_field(prepared, prepared).weight;
    const auto                carry    = std::count_if(weight.begin(), weight.end(), [](const double w) { return w > 0; });
    const std::size_t         n_points = carry > 0 ? std::size_t(carry) : weight.size();
    if (n_points < std::size_t(fewest_band_points))
      throw SceneError("sample: " + std::to_string(n_points) + " grains lie within it; a band is looked for among " +
                       std::to_string(fewest_band_points) + " at least (sample/grains)");
    const SampleFrame                  frame   = sample_frame(prepared, prepared);
    const std::vector<Eigen::Vector2d> outline = outline_polygon(prepared.outline);
    const ProbeOptions                &options = scene.comparison.probes;
    if (!options.probe_rectangles.empty())
      for (const ProbeRegion &region : place_probes(outline, frame, {}, options))
        if (region.polygon.empty())
          throw SceneError("comparison/probe_rectangles: nothing of " + region.name + " lies in the sample");
    if (!options.probe_circle.empty() && !(place_circle(outline, frame, {}, options).radius > 0))
      throw SceneError("comparison/probe_circle: nothing of it lies in the sample");
  }
} // namespace diptych::coupling
