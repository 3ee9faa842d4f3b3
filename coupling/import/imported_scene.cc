// diptych: writes a scene that runs on another code's sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <sstream>

#include "coupling/import/imported_results.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::exact_text;

    // Mean horizontal stress on the side walls in the first frame with forces.
    double side_pressure(const Arrival &arrival, const DiscreteResults &results)
    {
      for (std::size_t k = 0; k < arrival.frames.size(); ++k)
        {
          const ArrivedFrame &f      = arrival.frames[k];
          const double        height = f.wall[int(Side::upper)] - f.wall[int(Side::lower)];
          const double        push   = -f.wall_force[int(Side::right)].x();
          if (push > 0)
            return push / height;
        }
      for (const discrete::HistoryRow &row : results.rows)
        if (const double sxx = row.stress(0, 0); sxx > 0)
          return sxx;
      throw SceneError(
        arrival.frames.front().wall_file + ": frame " + arrival.frames.front().name +
        ": no lateral pressure was found, because no frame has a force on the right wall or a horizontal stress above 0; give "
        "--pressure P");
    }

    std::vector<double> windows(const std::vector<double> &stages)
    {
      if (stages.size() < 2)
        return {0, stages.back()};
      return {0, stages[(stages.size() - 1) / 2], stages.back()};
    }
  } // namespace

  std::string imported_scene(const Arrival &arrival, const DiscreteResults &results, const std::optional<double> &pressure)
  {
    const bool          axial = results.snapshots.back().loading_variable == discrete::LoadingVariable::axial_strain;
    const bool          sides = std::isfinite(results.snapshots.front().left_x);
    std::vector<double> stages;
    double              shortest = HUGE_VAL;
    for (std::size_t k = 1; k < results.snapshots.size(); ++k)
      {
        stages.push_back(results.snapshots[k].progress);
        shortest = std::min(shortest, results.snapshots[k].progress - results.snapshots[k - 1].progress);
      }
    std::ostringstream out;
    const auto         begin = [&](const char *section) { out << "subsection " << section << '\n'; };
    const auto         set = [&](const char *key, const std::string &value) { out << "  set " << key << " = " << value << '\n'; };
    const auto         end = [&] { out << "end\n"; };
    out << "# A sample of " << arrival.format << ", imported; lengths, forces and masses in the units of its files"
        << (arrival.thickness != 1 ? ", per unit thickness (" + exact_text(arrival.thickness) + ")" : std::string()) << ".\n"
        << "# The continuum is loaded by the motion of its walls. Keys of the continuum and of the comparison may be changed.\n";
    begin("sample");
    set("mean_diameter", exact_text(arrival.mean_diameter));
    if (std::isfinite(arrival.density))
      set("density", exact_text(arrival.density));
    end();
    begin("loading");
    set("pressure", exact_text(pressure ? *pressure : side_pressure(arrival, results)));
    set("mode", axial ? "descent" : "shear");
    set("axial_strain", exact_text(stages.back()));
    set("stages", text_of(stages));
    const discrete::HistoryRow &last = results.rows.back();
    if (std::isfinite(last.time) && last.time > 0)
      set("strain_rate", exact_text(last.progress / last.time));
    end();
    begin("discrete");
    set("method", "imported");
    set("file", "discrete.h5");
    set("lateral", sides ? "rigid_walls" : "end_grains");
    end();
    if (sides && axial) // rough platens would hold the corners that the wall takes along
      {
        begin("continuum");
        set("platens", "smooth");
        end();
      }
    begin("comparison");
    set("window_edges", text_of(windows(stages)));
    set("averaging_strain", exact_text(1e-3 * shortest)); // the continuum is compared at instants, too
    end();
    return out.str();
  }
} // namespace diptych::coupling
