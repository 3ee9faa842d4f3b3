// diptych: the continuum's counterpart of the grains' loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/panels/continuum_loading.h"

#include <algorithm>
#include <cmath>
#include <array>

#include "continuum/mesh/mesh.h"
#include "coupling/grains/imported_grains.h"
#include "coupling/panels/continuum_mesh.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_error.h"

namespace diptych::coupling
{
  namespace
  {
    using discrete::AppliedForce;
    using discrete::Lateral;
    using discrete::LoadingMode;
    using discrete::PrescribedVelocity;
    using discrete::SideMotion;
    using discrete::TimeTable;

    [[noreturn]] void refuse(const std::string &key, const std::string &value, const std::string &why)
    {
      throw SceneError(key + " = " + value + " has no counterpart in the continuum panel: " + why +
                       "; `diptych discrete` runs the grains without the continuum");
    }

    struct DriveKey
    {
      std::string           key;
      discrete::DriveOption option;

      bool        is_auto() const { return option.is_auto(); }
      std::string text() const { return text_of(option); }
    };

    // In the order of State::walls: lower and upper platen, left and right wall; [x, y] each.
    using WallDrives = std::array<std::array<DriveKey, 2>, 4>;

    WallDrives drives_of(const discrete::WallDriveOptions &options)
    {
      WallDrives drives;
      for_each_drive(options, [&](const int wall, const int axis, const std::string &key, const discrete::DriveOption &option) {
        drives[std::size_t(wall)][std::size_t(axis)] = {"discrete/" + key, option};
      });
      return drives;
    }

    // int_0^t v, where v is linear between the table's times and constant before the first and after the last.
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
      const discrete::Drive drive = discrete::read_drive(key.key, key.option);
      if (const auto *moved = std::get_if<PrescribedVelocity>(&drive))
        return {false, [table = moved->velocity, rate](const double progress) { return displacement(table, progress / rate); }};
      if (const auto *pushed = std::get_if<AppliedForce>(&drive))
        return {true, [table = pushed->force, rate](const double progress) { return table.at(progress / rate); }};
      return {};
    }

    std::optional<double> constant_velocity(const DriveKey &key)
    {
      const discrete::Drive drive = discrete::read_drive(key.key, key.option);
      const auto           *moved = std::get_if<PrescribedVelocity>(&drive);
      if (moved == nullptr)
        return std::nullopt;
      const auto &values = moved->velocity.value;
      const bool  same   = std::all_of(values.begin(), values.end(), [&](const double v) { return v == values[0]; });
      return same ? std::optional<double>(values[0]) : std::nullopt;
    }

    continuum::LoadingVariable continuum_walk(const LoadingMode mode)
    {
      switch (discrete::loading_variable_of(mode))
        {
        case discrete::LoadingVariable::axial_strain:
          return continuum::LoadingVariable::axial_strain;
        case discrete::LoadingVariable::shear_strain:
          return continuum::LoadingVariable::shear_strain;
        case discrete::LoadingVariable::time:
        case discrete::LoadingVariable::path:
          break;
        }
      return continuum::LoadingVariable::time;
    }

    continuum::LateralCondition lateral_of(const discrete::LateralOptions &o, const DriveKey &right, const double rate)
    {
      std::optional<double> widening;
      if (o.side_motion == SideMotion::velocity)
        widening = o.side_velocity / rate;
      continuum::RigidSides rigid;
      switch (o.lateral)
        {
        case Lateral::rigid_walls:
          if (!right.is_auto())
            widening = *constant_velocity(right) / rate;
          if (widening)
            rigid.widening = [by = *widening](const double progress) { return by * progress; };
          return rigid;
        case Lateral::periodic:
          return continuum::PeriodicSides{widening};
        case Lateral::none:
        case Lateral::cell:
          return continuum::FreeSides{};
        case Lateral::end_grains:
          break;
        }
      return continuum::SidePressure{};
    }

    void set_mode(const LoadingOptions &o, const ContinuumSample &sample, continuum::Loading &loading)
    {
      const auto travel = [](const double rate) {
        return continuum::Drive{false, [rate](const double progress) { return rate * progress; }};
      };
      auto &[x, y] = loading.platens[1];
      if (o.mode == LoadingMode::descent)
        {
          x = travel(o.horizontal_over_vertical * sample.height);
          y = travel(-sample.height);
        }
      else if (o.mode != LoadingMode::time)
        x = travel(sample.height);
      if (o.mode == LoadingMode::plane_shear)
        y = {true, [force = -o.normal_pressure * sample.platen_width](double) { return force; }};
    }

    void check_platen_drives(const WallDrives &drives, const LoadingMode mode, const bool smooth, const Lateral lateral)
    {
      const DriveKey &progress = mode == LoadingMode::descent ? drives[1][1] : drives[1][0];
      if (mode != LoadingMode::time && !progress.is_auto())
        refuse(progress.key, progress.text(),
               "loading/mode = " + discrete::name_of(mode) +
                 " moves the platen in this component; use loading/mode = time for other motions");
      for (const auto *platen : {&drives[0], &drives[1]})
        if (smooth && !(*platen)[0].is_auto())
          refuse((*platen)[0].key, (*platen)[0].text(),
                 "a smooth platen (continuum/platens) does not move the sample horizontally");
      const auto is_force = [&](const DriveKey &key) {
        return std::holds_alternative<AppliedForce>(discrete::read_drive(key.key, key.option));
      };
      const bool pressed = mode == LoadingMode::plane_shear && drives[1][1].is_auto();
      if (is_force(drives[0][1]) && (pressed || is_force(drives[1][1])))
        refuse(drives[0][1].key, drives[0][1].text(),
               "the upper platen moves freely in this component, and one platen must be held");
      if (is_force(drives[0][0]) && is_force(drives[1][0]) && lateral != Lateral::rigid_walls)
        refuse(drives[0][0].key, drives[0][0].text(),
               "the upper platen moves freely in this component, and one platen must be held");
    }

    void check_side_drives(const WallDrives &drives)
    {
      for (const DriveKey &key : {drives[2][0], drives[2][1], drives[3][1]})
        if (!key.is_auto() && constant_velocity(key) != 0.)
          refuse(key.key, key.text(), "only the right side wall moves, and only horizontally");
      const DriveKey &right = drives[3][0];
      if (!right.is_auto() && !constant_velocity(right))
        refuse(right.key, right.text(), "give a constant velocity, or the pressure (discrete/side_motion)");
    }

    void check_sides(const discrete::LateralOptions &lateral, const continuum::Options &o, const LoadingMode mode)
    {
      const bool periodic = lateral.lateral == Lateral::periodic;
      if (periodic && lateral.side_motion == SideMotion::pressure && o.platens != continuum::Platens::smooth)
        refuse("continuum/platens", continuum::name_of(o.platens),
               "a free period under pressure (discrete/side_motion = pressure) needs continuum/platens = smooth (and "
               "discrete/platen_friction = 0)");
      if (periodic && o.refinement == continuum::Refinement::adaptive)
        refuse("continuum/refinement", "adaptive",
               "periodic sides (discrete/lateral) must match node by node; use continuum/refinement = uniform");
      if (o.platens == continuum::Platens::smooth && (mode == LoadingMode::shear || mode == LoadingMode::plane_shear))
        refuse("loading/mode", discrete::name_of(mode), "smooth platens cannot shear the sample; use continuum/platens = rough");
    }

    void check_friction(const continuum::Options &o, const WallDrives &drives, const LoadingMode mode)
    {
      if (o.platens != continuum::Platens::frictional)
        return;
      if (mode == LoadingMode::time && o.platen_slip_length > 0)
        refuse("continuum/platen_slip_length", text_of(o.platen_slip_length),
               "loading/mode = time has no strain to which the slip could refer; use 0 (Coulomb)");
      for (const DriveKey &key : {drives[0][0], drives[1][0]})
        if (!key.is_auto() && std::holds_alternative<AppliedForce>(discrete::read_drive(key.key, key.option)))
          refuse(key.key, key.text(), "the motion of a frictional platen (continuum/platens) must be given");
    }

    // edge: of the elements before refinement [length].
    void check_rectangle(const continuum::Options &o, const double edge)
    {
      if (edge > std::min(o.rectangle_width, o.rectangle_height))
        throw SceneError("continuum/element_size = " + text_of(o.element_size) + ": elements of " + text_of(edge) +
                         " [length] before refinement do not fit into continuum/rectangle_width = " + text_of(o.rectangle_width) +
                         " and rectangle_height = " + text_of(o.rectangle_height));
      if (o.platen_width > 0 && o.platen_width < 1e-3 * edge)
        throw SceneError("continuum/platen_width = " + text_of(o.platen_width) +
                         " is less than a thousandth of an element before refinement: " + text_of(edge) + " [length]");
      if (o.platen_width > o.rectangle_width)
        throw SceneError("continuum/platen_width = " + text_of(o.platen_width) +
                         " must not exceed continuum/rectangle_width = " + text_of(o.rectangle_width));
    }

    // The mesh file is read completely before a result folder is opened for it.
    void check_mesh_key(const Scene &scene)
    {
      const continuum::MeshOption &mesh = scene.continuum.mesh;
      using Kind                        = continuum::MeshOption::Kind;
      const continuum::LawOptions &law  = scene.continuum.material;
      if (mesh.kind != Kind::outline && continuum::follows_solid_fraction(law.hardening) && !law.solid_fraction_start)
        throw SceneError("continuum/solid_fraction_start = auto with continuum/mesh = " + text_of(mesh) +
                         ": only continuum/mesh = outline has grains whose density can be mapped; give a number");
      if (mesh.kind != Kind::outline && scene.continuum.initial_stress == continuum::InitialStress::mapped)
        throw SceneError("continuum/initial_stress = mapped with continuum/mesh = " + text_of(mesh) +
                         ": only continuum/mesh = outline has grains whose stress can be mapped");
      // The size of a generated sample is known to a few percent, that of an imported one exactly.
      if (mesh.kind == Kind::outline && scene.discrete.method.method == discrete::Method::imported)
        require_elements_fit(scene, height_of(load_imported(scene).snapshots.front().outline));
      else if (mesh.kind == Kind::outline && scene.sample.file.empty())
        require_elements_fit(scene, 1.3 * discrete::expected_size(scene.sample).y());
      if (mesh.kind == Kind::rectangle)
        check_rectangle(scene.continuum, first_edge(scene.continuum, scene.continuum.element_size, scene.sample.mean_diameter));
      if (mesh.kind != Kind::file)
        return;
      try
        {
          (void)users_mesh(mesh.file);
        }
      catch (const std::invalid_argument &error)
        {
          throw SceneError("continuum/mesh = '" + mesh.file + "': " + error.what() +
                           " (allowed: outline, rectangle, or a .msh or .geo file that can be read)");
        }
    }

    // The upper platen follows that of the imported sample, scaled to the mesh's height. The right wall has the imported mean
    // pressure frame by frame, or the imported motion if discrete/side_motion = velocity. Between frames all values are linear.
    void follow_walls(const ImportedWalls   &walls,
                      const SideMotion       side_motion,
                      const ContinuumSample &sample,
                      continuum::Loading    &loading)
    {
      const auto follows = [](const TimeTable &table, const double scale) {
        return continuum::Drive{false, [table, scale](const double progress) { return scale * table.at(progress); }};
      };
      const double scale    = sample.height / walls.initial_height;
      loading.platens[1][0] = follows(walls.upper_x, scale);
      loading.platens[1][1] = follows(walls.upper_y, scale);
      auto *rigid           = std::get_if<continuum::RigidSides>(&loading.lateral);
      if (rigid == nullptr)
        return;
      rigid->widening = nullptr;
      if (side_motion == SideMotion::velocity)
        rigid->widening = [table = walls.right_x](const double progress) { return table.at(progress); };
      else if (!walls.right_pressure.time.empty())
        loading.side_pressure = [table = walls.right_pressure](const double progress) { return table.at(progress); };
    }

    void check_load_steps(const LoadingOptions &loading, const double max_step)
    {
      constexpr double most   = 1e7; // more than a day with the smallest mesh
      const double     fewest = stages(loading).back() / max_step;
      if (fewest > most)
        throw SceneError("continuum/max_step = " + text_of(max_step) + ": the loading would take " + text_of(std::ceil(fewest)) +
                         " load steps or more, and at most 1e+07 are allowed; increase it, or reduce loading/" +
                         (loading.mode == LoadingMode::time ? "duration" : "axial_strain"));
    }
  } // namespace

  double height_of(const discrete::Outline &outline)
  {
    return outline.left.back().y() - outline.left.front().y();
  }

  void require_elements_fit(const Scene &scene, const double height)
  {
    if (scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline)
      for (const auto &[key, size] : {std::pair{"continuum/element_size", scene.continuum.element_size},
                                      {"comparison/coarse_element_size", scene.comparison.coarse_element_size}})
        if (const double edge = first_edge(scene.continuum, size, scene.sample.mean_diameter); edge > height)
          {
            char sizes[160];
            std::snprintf(sizes, sizeof sizes, "elements of %.4g before refinement are larger than the sample, at most %.4g high",
                          edge, height);
            Refusal refusal{"", key, text_of(size)};
            refusal.allowed = "a smaller size";
            throw SceneError(refusal, std::string("is too large: ") + sizes + " [length]");
          }
  }

  void require_continuum(const Scene &scene)
  {
    if (scene.discrete.method.method == discrete::Method::imported)
      (void)load_imported(scene);
    if (scene.loading.mode == LoadingMode::path)
      refuse("loading/mode", "path", "a cell follows it, which `diptych element` compares with a point of the law");
    if (scene.continuum.k0 != 1)
      refuse("continuum/k0", text_of(scene.continuum.k0), "only the law's point (material-point, element tests) starts with it");
    if (scene.sample.rough_platens)
      refuse("sample/rough_platens", "true", "the forces on grains that are part of a platen are not mapped");
    const WallDrives                drives  = drives_of(scene.discrete.drives);
    const discrete::LateralOptions &lateral = scene.discrete.lateral;
    const bool                      smooth  = scene.continuum.platens == continuum::Platens::smooth;
    check_sides(lateral, scene.continuum, scene.loading.mode);
    check_platen_drives(drives, scene.loading.mode, smooth, lateral.lateral);
    check_side_drives(drives);
    check_friction(scene.continuum, drives, scene.loading.mode);
    check_mesh_key(scene);
    check_load_steps(scene.loading, scene.continuum.max_step);
  }

  ContinuumSample measured(const continuum::QuadMesh &mesh, const double solid_fraction)
  {
    const continuum::MeshSummary summary = continuum::summarise(mesh);
    return {summary.height, summary.platen_width, solid_fraction};
  }

  continuum::Loading continuum_loading(const Scene &scene, const ContinuumSample &sample)
  {
    const WallDrives drives = drives_of(scene.discrete.drives);
    const double rate = discrete::strain_rate(discrete_loading(scene.loading), scene.sample.mean_diameter, scene.sample.density);
    continuum::Loading loading;
    loading.pressure   = scene.loading.pressure;
    loading.lateral    = lateral_of(scene.discrete.lateral, drives[3][0], rate);
    loading.body_force = scene.sample.density * sample.solid_fraction *
                         Eigen::Vector2d(scene.discrete.stepping.gravity_x, scene.discrete.stepping.gravity_y);
    loading.stages            = stages(scene.loading);
    loading.loading_variable  = continuum_walk(scene.loading.mode);
    loading.time_per_progress = loading.loading_variable == continuum::LoadingVariable::time ? 1. : 1 / rate;
    set_mode(scene.loading, sample, loading);
    if (scene.discrete.method.method == discrete::Method::imported)
      {
        follow_walls(imported_walls(load_imported(scene)), scene.discrete.lateral.side_motion, sample, loading);
        return loading;
      }
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t c = 0; c < 2; ++c)
        if (!drives[p][c].is_auto())
          loading.platens[p][c] = drive_of(drives[p][c], rate);
    return loading;
  }

  void require_platen_travel(const Scene &scene)
  {
    if (scene.loading.mode != LoadingMode::time || scene.discrete.method.method == discrete::Method::imported)
      return; // these loadings always move the platen
    const continuum::Loading loading = continuum_loading(scene, {1, 1, 1});
    const auto               rests   = [&](const double from, const double to) {
      return std::all_of(loading.platens[1].begin(), loading.platens[1].end(), [&](const continuum::Drive &drive) {
        return !drive.value || (!drive.is_force && drive.value(to) == drive.value(from));
      });
    };
    double from = 0;
    for (const double to : loading.stages)
      {
        if (rests(from, to))
          throw SceneError(
            "discrete/drive_upper_x = " + text_of(scene.discrete.drives.upper_x) +
            ", discrete/drive_upper_y = " + text_of(scene.discrete.drives.upper_y) + ": the upper platen rests from time " +
            text_of(from) + " to " + text_of(to) +
            ", but its displacement is the unit of the comparison; `diptych discrete` and `diptych continuum` accept it");
        from = to;
      }
  }
} // namespace diptych::coupling
