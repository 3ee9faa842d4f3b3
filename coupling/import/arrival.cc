// diptych: puts another code's sample in order and checks it
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/arrival.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "coupling/scene/scene_error.h"
#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    using Index = std::unordered_map<long, int>;

    std::string at(const std::string &file, const int line)
    {
      return file + (line > 0 ? ", line " + std::to_string(line) : "");
    }

    std::vector<ForeignGrain> sorted(std::vector<ForeignGrain> grains, const ForeignFrame &frame)
    {
      std::sort(grains.begin(), grains.end(), [](const auto &a, const auto &b) { return a.id < b.id; });
      for (std::size_t k = 0; k < grains.size(); ++k)
        {
          const ForeignGrain &g = grains[k];
          if (k > 0 && grains[k - 1].id == g.id)
            throw SceneError(at(frame.grain_file, g.line) + ": frame " + frame.name + ": grain " + std::to_string(g.id) +
                             " occurs twice");
          if (!g.position.allFinite() || !(g.radius > 0) || !std::isfinite(g.radius))
            throw SceneError(at(frame.grain_file, g.line) + ": frame " + frame.name + ": grain " + std::to_string(g.id) +
                             " has no finite position or no positive radius");
        }
      return grains;
    }

    // Masses that the files lack follow from --density, the mass per area; without it they are not told.
    void take_grains(const std::vector<ForeignGrain> &grains,
                     const ForeignOptions            &options,
                     const double                     thickness,
                     ArrivedFrame                    &to)
    {
      const double density = options.density.value_or(not_told);
      for (const ForeignGrain &g : grains)
        {
          to.position.push_back(g.position);
          to.velocity.push_back(g.velocity);
          to.resultant.push_back(g.resultant / thickness);
          to.radius.push_back(g.radius);
          to.mass.push_back(std::isfinite(g.mass) ? g.mass / thickness : M_PI * g.radius * g.radius * density);
          to.rotation.push_back(g.rotation);
          to.spin.push_back(g.spin);
        }
    }

    // Weights of all grains.
    void take_weights(const ForeignFrame &from, const ForeignOptions &options, Arrival &arrival, ArrivedFrame &to)
    {
      to.weight.assign(to.position.size(), Eigen::Vector2d::Zero());
      const Eigen::Vector2d gravity = options.gravity.value_or(from.gravity);
      if (!gravity.allFinite() || gravity == Eigen::Vector2d::Zero())
        return;
      for (std::size_t i = 0; i < to.weight.size(); ++i)
        to.weight[i] = gravity * to.mass[i];
      if (!std::isfinite(to.weight[0].sum()))
        throw SceneError(from.grain_file + ": frame " + from.name +
                         ": gravity acts on the grains, but the files contain no masses; give --density, the mass per area");
      remark_once(arrival, "the grains have weight; the continuum of a run has none");
    }

    void require_same_grains(const std::vector<long> &ids, const std::vector<ForeignGrain> &grains, const ForeignFrame &frame)
    {
      std::set<long> here;
      for (const ForeignGrain &g : grains)
        here.insert(g.id);
      for (const long id : ids)
        if (here.count(id) == 0)
          throw SceneError(frame.grain_file + ": frame " + frame.name + " lacks grain " + std::to_string(id) +
                           " of the first frame; displacements need the same grains in all frames");
      if (here.size() != ids.size())
        throw SceneError(frame.grain_file + ": frame " + frame.name + " has " + std::to_string(here.size()) +
                         " grains, but the first frame has " + std::to_string(ids.size()));
    }

    void require_later_time(const Arrival &arrival, const ArrivedFrame &frame, const std::string &file)
    {
      if (!arrival.frames.empty() && frame.time <= arrival.frames.back().time) // false without a time
        throw SceneError(file + ": frame " + frame.name + " has the time " + discrete::exact_text(frame.time) + ", but frame " +
                         arrival.frames.back().name + " before it has " + discrete::exact_text(arrival.frames.back().time));
    }

    // Spheres lie in one layer, and forces are those of its whole thickness.
    double thickness_of(const ForeignSample &sample, const ForeignOptions &options)
    {
      if (!options.thickness && sample.is_spheres)
        throw SceneError(
          "import " + sample.format +
          ": the grains are spheres; give --thickness T, the thickness over which the forces act (stress = force / (length "
          "x T)), or 1 to keep forces per length");
      return options.thickness.value_or(1.);
    }

    [[noreturn]] void refuse_without_effect(const ForeignSample &sample, const std::string &option, const std::string &why)
    {
      throw SceneError("import " + sample.format + ": " + option + " would have no effect: " + why);
    }

    // An option without effect is refused, because its user believes that it counts.
    void require_effect(const ForeignSample &sample, const ForeignOptions &options)
    {
      if (options.pressure && sample.frames.size() == 1)
        refuse_without_effect(sample, "--pressure", "a single frame has no loading, so there is no scene");
      const auto &grains = sample.frames.front().grains;
      if (options.density && std::all_of(grains.begin(), grains.end(), [](const auto &g) { return std::isfinite(g.mass); }))
        refuse_without_effect(sample, "--density", "the files contain the masses of the grains");
    }

    // Masses that grow as r^3 belong to spheres, even if the run was in the plane.
    bool has_masses_of_spheres(const std::vector<ForeignGrain> &grains)
    {
      double lowest_2 = HUGE_VAL, highest_2 = 0, lowest_3 = HUGE_VAL, highest_3 = 0;
      for (const ForeignGrain &g : grains)
        {
          const double area = g.radius * g.radius, volume = area * g.radius;
          lowest_2  = std::min(lowest_2, g.mass / area);
          highest_2 = std::max(highest_2, g.mass / area);
          lowest_3  = std::min(lowest_3, g.mass / volume);
          highest_3 = std::max(highest_3, g.mass / volume);
        }
      return highest_3 < 1.001 * lowest_3 && highest_2 > 1.01 * lowest_2;
    }

    // Mass per area of the discs, for inertial numbers and weights.
    double density_of(const ArrivedFrame &frame)
    {
      double mass = 0, area = 0;
      for (std::size_t i = 0; i < frame.mass.size(); ++i)
        {
          mass += frame.mass[i];
          area += M_PI * frame.radius[i] * frame.radius[i];
        }
      return mass / area;
    }

    void note_what_is_lacking(const Arrival &arrival, std::vector<std::string> &lacking)
    {
      const ArrivedFrame &last = arrival.frames.back();
      const auto          lack = [&](const bool told, const char *what) {
        if (!told)
          lacking.push_back(what);
      };
      lack(std::isfinite(last.mass[0]), "masses");
      lack(last.velocity[0].allFinite(), "velocities");
      lack(std::isfinite(last.spin[0]), "spins (their term in the internal moment counts as 0)");
      lack(std::isfinite(last.rotation[0]), "rotations");
      lack(std::isfinite(last.time), "times");
      const bool status = std::any_of(last.status.begin(), last.status.end(),
                                      [](const auto s) { return s != discrete::ContactStatus::unknown; });
      lack(status, "which contacts slide");
      const auto on_walls = [&](const ArrivedFrame &frame) {
        return std::any_of(frame.contacts.begin(), frame.contacts.end(),
                           [&](const auto &c) { return std::size_t(c.j) >= frame.position.size(); });
      };
      const bool told_before = std::find(lacking.begin(), lacking.end(), "contacts with walls") != lacking.end();
      lack(told_before || std::any_of(arrival.frames.begin(), arrival.frames.end(), on_walls), "contacts with walls");
      lack(false, "dissipation, energies and means over stages (a frame is one instant)");
      for (std::size_t k = 0; k < arrival.frames.size(); ++k)
        lack(arrival.frames[k].has_contacts, ("contacts of frame " + arrival.frames[k].name).c_str());
    }

    void note_ids(Arrival &arrival)
    {
      const long span = arrival.id.back() - arrival.id.front() + 1, gaps = span - long(arrival.id.size());
      if (gaps > 0)
        arrival.remarks.push_back("ids run from " + std::to_string(arrival.id.front()) + " to " +
                                  std::to_string(arrival.id.back()) + " with " + std::to_string(gaps) +
                                  " missing; grains are counted from 0 in the order of their ids");
    }
  } // namespace

  Arrival arrive(ForeignSample sample, const ForeignOptions &options)
  {
    if (sample.frames.empty())
      throw SceneError("import " + sample.format + ": the files contain no frame");
    require_effect(sample, options);
    std::vector<std::vector<ForeignGrain>> grains;
    for (ForeignFrame &frame : sample.frames)
      grains.push_back(sorted(std::move(frame.grains), frame));
    if (grains.front().size() < 3)
      throw SceneError(sample.frames.front().grain_file + ": " + std::to_string(grains.front().size()) +
                       " grains; at least 3 are needed");
    sample.is_spheres |= has_masses_of_spheres(grains.front());

    Arrival arrival;
    arrival.format    = sample.format;
    arrival.thickness = thickness_of(sample, options);
    arrival.remarks   = sample.remarks;
    for (const ForeignGrain &g : grains.front())
      arrival.id.push_back(g.id);
    double diameter = 0;
    for (const ForeignGrain &g : grains.front())
      diameter += 2 * g.radius / double(grains.front().size());
    arrival.mean_diameter = options.mean_diameter.value_or(diameter);
    note_ids(arrival);
    for (std::size_t k = 0; k < sample.frames.size(); ++k)
      {
        ForeignFrame &from = sample.frames[k];
        require_same_grains(arrival.id, grains[k], from);
        if (k > 0 && from.contacts.empty())
          throw SceneError(from.grain_file + ": frame " + from.name +
                           " has no contacts; every frame after the first needs them for its stresses");
        ArrivedFrame frame;
        frame.name       = from.name;
        frame.grain_file = from.grain_file;
        frame.wall_file  = from.wall_file.empty() ? from.grain_file : from.wall_file;
        frame.time       = from.time.value_or(not_told);
        frame.step       = from.step.value_or(long(k));
        take_grains(grains[k], options, arrival.thickness, frame);
        take_weights(from, options, arrival, frame);
        take_contacts(from, arrival, options, frame);
        require_later_time(arrival, frame, from.grain_file);
        arrival.frames.push_back(std::move(frame));
      }
    if (options.walls_touch &&
        std::none_of(arrival.frames.begin(), arrival.frames.end(), [](const auto &f) { return f.walls_touch; }))
      refuse_without_effect(sample, "--walls-touch", "the files give the place of every wall");
    arrival.density = density_of(arrival.frames.front());
    for (const std::string &text : sample.lacking)
      arrival.lacking.push_back(text);
    note_what_is_lacking(arrival, arrival.lacking);
    check_arrival(arrival);
    return arrival;
  }
} // namespace diptych::coupling
