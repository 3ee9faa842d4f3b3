// diptych: the grains' loading as the continuum takes it
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/continuum_loading.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <unistd.h>

#include "continuum/mesh.h"
#include "coupling/continuum_mesh.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::AppliedForce;
    using discrete::PrescribedVelocity;
    using discrete::TimeTable;

    [[noreturn]] void refuse(const std::string &key, const std::string &value, const std::string &why)
    {
      throw SceneError(key + " = " + value + ": the continuum panel has no counterpart: " + why +
                       "; the grains alone run with `diptych discrete`");
    }

    struct DriveKey
    {
      std::string        name;
      const std::string *text;

      bool        is_auto() const { return *text == "auto"; }
      std::string key() const { return "discrete/drive_" + name; }
    };

    // [lower, upper][x, y]
    std::array<std::array<DriveKey, 2>, 2> platen_drives(const discrete::WallDriveOptions &o)
    {
      return {{{{{"lower_x", &o.lower_x}, {"lower_y", &o.lower_y}}}, {{{"upper_x", &o.upper_x}, {"upper_y", &o.upper_y}}}}};
    }

    double rate_of(const Scene &scene)
    {
      return discrete::strain_rate(discrete_loading(scene.loading), scene.sample.mean_diameter, scene.sample.density);
    }

    // int_0^t v: v linear between the table's times and constant before the first and after the last.
    double displacement(const TimeTable &velocity, const double t)
    {
      const auto since_first = [&](const double end) {
        const auto &time = velocity.time, &v = velocity.value;
        if (end <= time.front())
          return v.front() * (end - time.front());
        double sum = 0;
        for (std::size_t k = 1; k < time.size() && time[k - 1] < end; ++k)
          {
            const double to = std::min(end, time[k]);
            sum += 0.5 * (v[k - 1] + velocity.at(to)) * (to - time[k - 1]);
          }
        return sum + v.back() * std::max(0., end - time.back());
      };
      return since_first(t) - since_first(0);
    }

    continuum::Drive drive_of(const DriveKey &key, const double rate)
    {
      const discrete::Drive drive = discrete::read_drive(key.key(), *key.text);
      if (const auto *moved = std::get_if<PrescribedVelocity>(&drive))
        return {false, [table = moved->velocity, rate](const double progress) { return displacement(table, progress / rate); }};
      if (const auto *pushed = std::get_if<AppliedForce>(&drive))
        return {true, [table = pushed->force, rate](const double progress) { return table.at(progress / rate); }};
      return {};
    }

    // The velocity where it is one number, whatever the time.
    std::optional<double> constant_velocity(const DriveKey &key)
    {
      const discrete::Drive drive = discrete::read_drive(key.key(), *key.text);
      const auto           *moved = std::get_if<PrescribedVelocity>(&drive);
      if (moved == nullptr)
        return std::nullopt;
      const auto &values = moved->velocity.value;
      const bool  same   = std::all_of(values.begin(), values.end(), [&](const double v) { return v == values[0]; });
      return same ? std::optional<double>(values[0]) : std::nullopt;
    }

    continuum::LateralCondition lateral_of(const Scene &scene)
    {
      const discrete::LateralOptions &o    = scene.discrete.lateral;
      const double                    rate = rate_of(scene);
      std::optional<double>           widening;
      if (o.side_motion == "velocity")
        widening = o.side_velocity / rate;
      if (o.lateral == "rigid_walls")
        {
          const DriveKey right{"right_x", &scene.discrete.drives.right_x};
          if (!right.is_auto())
            widening = *constant_velocity(right) / rate;
          return continuum::RigidSides{widening};
        }
      if (o.lateral == "periodic")
        return continuum::PeriodicSides{widening};
      if (o.lateral == "none")
        return continuum::FreeSides{};
      return continuum::SidePressure{};
    }

    // What the mode says; drives of the scene come on top.
    void set_mode(const LoadingOptions &o, const ContinuumSample &sample, continuum::Loading &loading)
    {
      const auto travel = [](const double rate) {
        return continuum::Drive{false, [rate](const double progress) { return rate * progress; }};
      };
      auto &[x, y] = loading.platens[1];
      if (o.mode == "descent")
        x = travel(o.horizontal_over_vertical * sample.height), y = travel(-sample.height);
      else if (o.mode != "time")
        x = travel(sample.height);
      if (o.mode == "plane_shear")
        y = {true, [force = -o.normal_pressure * sample.platen_width](double) { return force; }};
    }

    void check_platen_drives(const Scene &scene)
    {
      const auto         drives   = platen_drives(scene.discrete.drives);
      const std::string &mode     = scene.loading.mode;
      const DriveKey    &progress = mode == "descent" ? drives[1][1] : drives[1][0];
      if (mode != "time" && !progress.is_auto())
        refuse(progress.key(), *progress.text, "loading/mode = " + mode + " moves that itself; time is for walls of all kinds");
      const bool smooth = scene.continuum.platens == "smooth";
      for (const auto &platen : drives)
        if (smooth && !platen[0].is_auto())
          refuse(platen[0].key(), *platen[0].text, "continuum/platens = smooth leaves the horizontal motion alone");
      const auto is_force = [&](const DriveKey &key) {
        return std::holds_alternative<AppliedForce>(discrete::read_drive(key.key(), *key.text));
      };
      const bool pressed = mode == "plane_shear" && drives[1][1].is_auto();
      if (is_force(drives[0][1]) && (pressed || is_force(drives[1][1])))
        refuse(drives[0][1].key(), *drives[0][1].text, "the upper platen moves freely in that component, too");
      if (is_force(drives[0][0]) && is_force(drives[1][0]) && scene.discrete.lateral.lateral != "rigid_walls")
        refuse(drives[0][0].key(), *drives[0][0].text, "the upper platen moves freely in that component, too");
    }

    void check_side_drives(const discrete::WallDriveOptions &o)
    {
      for (const DriveKey &key : {DriveKey{"left_x", &o.left_x}, DriveKey{"left_y", &o.left_y}, DriveKey{"right_y", &o.right_y}})
        if (!key.is_auto() && constant_velocity(key) != 0.)
          refuse(key.key(), *key.text, "side walls are smooth, and only the right one moves, to left and right");
      const DriveKey right{"right_x", &o.right_x};
      if (!right.is_auto() && !constant_velocity(right))
        refuse(right.key(), *right.text, "a constant velocity is, or the pressure (discrete/side_motion)");
    }

    void check_sides(const Scene &scene)
    {
      const bool periodic = scene.discrete.lateral.lateral == "periodic";
      if (periodic && scene.discrete.lateral.side_motion == "pressure" && scene.continuum.platens == "rough")
        refuse("continuum/platens", "rough",
               "a period that is free under the pressure (discrete/side_motion = pressure) needs platens that stretch: smooth");
      if (periodic && scene.continuum.refinement == "adaptive")
        refuse("continuum/refinement", "adaptive", "periodic sides (discrete/lateral) must match node by node: uniform");
      if (scene.continuum.platens == "smooth" && (scene.loading.mode == "shear" || scene.loading.mode == "plane_shear"))
        refuse("loading/mode", scene.loading.mode, "continuum/platens = smooth do not shear; rough does");
    }

    void check_rectangle(const Scene &scene)
    {
      const continuum::Options &o    = scene.continuum;
      const double              edge = first_edge(scene, o.element_size);
      if (edge > std::min(o.rectangle_width, o.rectangle_height))
        throw SceneError("continuum/element_size = " + std::to_string(o.element_size) + ": elements of " + std::to_string(edge) +
                         " [length] at first do not fit into continuum/rectangle_width = " + std::to_string(o.rectangle_width) +
                         " and rectangle_height = " + std::to_string(o.rectangle_height));
      if (o.platen_width > o.rectangle_width)
        throw SceneError("continuum/platen_width = " + std::to_string(o.platen_width) +
                         " must not exceed continuum/rectangle_width = " + std::to_string(o.rectangle_width));
    }

    // A mesh of the user's is read whole, before a result folder is opened for it.
    void check_mesh_key(const Scene &scene)
    {
      const std::string &mesh = scene.continuum.mesh;
      if (mesh != "outline" && scene.continuum.initial_stress == "mapped")
        throw SceneError("continuum/initial_stress = mapped with continuum/mesh = " + mesh +
                         ": only outline, the mesh of the grain sample, has its stress");
      if (mesh == "rectangle")
        check_rectangle(scene);
      if (mesh == "outline" || mesh == "rectangle")
        return;
      const std::string ending = std::filesystem::path(mesh).extension();
      if ((ending != ".msh" && ending != ".geo") || !std::filesystem::is_regular_file(mesh))
        throw SceneError("continuum/mesh = '" + mesh +
                         "' is not allowed: outline, rectangle or a .msh or .geo file that can be read is");
      const auto trial = std::filesystem::temp_directory_path() / ("diptych_mesh_" + std::to_string(getpid()) + ".msh");
      try
        {
          continuum::prepare_mesh(mesh, trial);
        }
      catch (const std::exception &error)
        {
          throw SceneError("continuum/mesh = '" + mesh + "': " + error.what());
        }
      std::filesystem::remove(trial);
    }

    [[noreturn]] void refuse_mesh(const std::string &file)
    {
      throw std::runtime_error(file + ": no mesh in MSH 2.2 with an upper platen");
    }
  } // namespace

  void require_continuum(const Scene &scene)
  {
    check_sides(scene);
    check_platen_drives(scene);
    check_side_drives(scene.discrete.drives);
    check_mesh_key(scene);
  }

  ContinuumSample measure_mesh(const std::string &msh_file)
  {
    std::ifstream                   in(msh_file);
    std::map<long, Eigen::Vector2d> nodes;
    double                          low = INFINITY, high = -low, platen_low = low, platen_high = -low;
    std::size_t                     count = 0;
    for (std::string line; std::getline(in, line);)
      if (line == "$Nodes" && in >> count)
        for (std::size_t k = 0; k < count && in; ++k)
          {
            long   number = 0;
            double x = 0, y = 0, z = 0;
            in >> number >> x >> y >> z;
            nodes[number] = {x, y};
            low = std::min(low, y), high = std::max(high, y);
          }
      else if (line == "$Elements" && std::getline(in, line))
        for (count = std::stoul(line); count > 0 && std::getline(in, line); --count)
          {
            // number, type (1: line), number of tags (the first: physical), tags, nodes
            std::istringstream words(line);
            long               number = 0, type = 0, n_tags = 0, physical = 0, other = 0, node = 0;
            words >> number >> type >> n_tags >> physical;
            if (type != 1 || physical != continuum::upper_platen)
              continue;
            for (long tag = 1; tag < n_tags; ++tag)
              words >> other;
            while (words >> node)
              platen_low = std::min(platen_low, nodes.at(node).x()), platen_high = std::max(platen_high, nodes.at(node).x());
          }
    if (!(high > low) || !(platen_high > platen_low))
      refuse_mesh(msh_file);
    return {high - low, platen_high - platen_low, 0};
  }

  continuum::Loading continuum_loading(const Scene &scene, const ContinuumSample &sample)
  {
    continuum::Loading loading;
    loading.pressure   = scene.loading.pressure;
    loading.lateral    = lateral_of(scene);
    loading.body_force = scene.sample.density * sample.solid_fraction *
                         Eigen::Vector2d(scene.discrete.time.gravity_x, scene.discrete.time.gravity_y);
    loading.stages = stages(scene.loading);
    loading.stages.insert(loading.stages.begin(), 0.);
    set_mode(scene.loading, sample, loading);
    const auto drives = platen_drives(scene.discrete.drives);
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t c = 0; c < 2; ++c)
        if (!drives[p][c].is_auto())
          loading.platens[p][c] = drive_of(drives[p][c], rate_of(scene));
    return loading;
  }
} // namespace diptych::coupling
