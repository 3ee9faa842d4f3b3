// diptych: given grains between platens and sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/placed_grains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  namespace
  {
    // Positions of platens and sides of given grains: from the keys, from a snapshot, or at the outermost edge of any grain.
    // Fixed grains count with their centre, because they may be a rough bottom that platens cross.
    SampleBox box_around(const SampleOptions &o, const GrainFile &file)
    {
      const Grains   &g   = file.grains;
      constexpr auto  far = std::numeric_limits<double>::infinity();
      Eigen::Vector2d low = Eigen::Vector2d::Constant(far), high = -low;
      for (std::size_t i = 0; i < g.size(); ++i)
        {
          const Eigen::Vector2d r(g.radius[i], g.fixed[i] ? 0. : g.radius[i]);
          low  = low.cwiseMin(g.position[i] - r);
          high = high.cwiseMax(g.position[i] + r);
        }
      const auto stored = [&](const std::optional<double> &value) {
        return value && std::isfinite(*value) ? value : std::nullopt;
      };
      const auto place = [&](const std::optional<double> &key, const std::optional<double> &of_file, const double edge) {
        return key ? *key : stored(of_file).value_or(edge);
      };
      std::optional<double> lower, upper, left, right;
      if (file.stage)
        {
          lower = file.stage->lower_y;
          upper = file.stage->upper_y;
          left  = file.stage->left_x;
          right = file.stage->right_x;
        }
      return {place(o.lower_platen, lower, low.y()),
              place(o.upper_platen, upper, high.y()),
              place(o.left_wall, left, low.x()),
              place(o.right_wall, right, high.x()),
              {}};
    }

    FileSample read_and_placed(const SampleOptions &o, const PreparationSetting &preparation, const CheckStop &check_stop)
    {
      return read_for("file", o.file, [&](const std::string &path) {
        const bool snapshots = path.size() > 3 && path.compare(path.size() - 3, 3, ".h5") == 0;
        GrainFile  read      = snapshots ? read_grains_hdf5(path) : read_grains_csv(path, o.density, check_stop);
        call(check_stop);
        FileSample sample = place_grains(o, preparation, std::move(read));
        call(check_stop);
        return sample;
      });
    }
  } // namespace

  void enclose(State &state, const LateralCondition &lateral, const Eigen::Vector2d &size)
  {
    if (std::holds_alternative<CellSides>(lateral))
      {
        state.periodicity = Lattice{size.asDiagonal()};
        return;
      }
    state.walls         = {{{0, 0}, {0, 1}}, {{0, size.y()}, {0, -1}}, {{0, 0}, {1, 0}}, {{size.x(), 0}, {-1, 0}}};
    state.walls[2].kind = state.walls[3].kind = WallKind::side;
    if (std::holds_alternative<PeriodicSides>(lateral))
      {
        state.periodicity = PeriodicWidth{size.x()};
        state.walls.resize(2);
      }
  }

  double default_wall_mass(const Grains &grains)
  {
    return std::accumulate(grains.mass.begin(), grains.mass.end(), 0.) / std::sqrt(double(grains.size()));
  }

  // Sides during the preparation: a free side is free under the pressure, and a lattice in all components.
  void set_sides(State &state, const PreparationSetting &setting)
  {
    const double mass = default_wall_mass(state.grains);
    if (const auto *sides = std::get_if<RigidSides>(&setting.lateral))
      {
        state.walls[3].drive_x = AppliedPressure{setting.pressure};
        state.walls[3].mass    = sides->mass > 0 ? sides->mass : mass;
      }
    else if (const auto *periodic = std::get_if<PeriodicSides>(&setting.lateral))
      {
        PeriodicWidth &width = *state.width();
        width.mass           = periodic->mass > 0 ? periodic->mass : mass;
        if (periodic->free_width)
          width.pressure = setting.pressure;
        else
          {
            state.walls[1].drive_y = AppliedPressure{setting.pressure};
            state.walls[1].mass    = width.mass;
          }
      }
    else if (std::holds_alternative<CellSides>(setting.lateral))
      {
        state.lattice()->drive = {Eigen::Matrix3d::Identity(),
                                  {true, true, true},
                                  {{0.}, {{setting.pressure, setting.pressure, 0}}},
                                  lattice_inertia(state.grains)};
      }
    else
      state.walls.resize(2);
  }

  FileSample place_grains(const SampleOptions &o, const PreparationSetting &preparation, GrainFile file)
  {
    SampleBox  box = box_around(o, file);
    FileSample sample{{}, file.stage};
    State     &state = sample.state;
    enclose(state, preparation.lateral, {o.width, o.height});
    for (std::size_t w = 0; w < state.walls.size(); ++w)
      state.walls[w].point = {w % 2 == 0 ? *box.left_x : *box.right_x, w % 2 == 0 ? *box.lower_y : *box.upper_y};
    if (!std::holds_alternative<RigidSides>(preparation.lateral))
      {
        box.left_x.reset();
        box.right_x.reset();
      }
    if (const PeriodicWidth *periodic = state.width())
      {
        if (periodic->width <= 0)
          throw WrongKeys({"sample/width", "discrete/lateral"},
                          "sample/width = 0: for a periodic sample from a file, give its period here");
      }
    if (Lattice *lattice = state.lattice())
      {
        box.lower_y.reset();
        box.upper_y.reset();
        if (file.stage && !file.stage->cell_vectors.isZero())
          lattice->vectors = file.stage->cell_vectors;
        if (!(lattice->area() > 0))
          throw WrongKeys({"sample/width", "sample/height", "sample/file", "discrete/lateral"},
                          "sample/file = " + o.file + " holds no cell: give its periods with sample/width and sample/height");
        for (std::size_t i = 0; i < file.grains.size() && !file.stage; ++i)
          if (!file.grains.velocity[i].isZero(0) || file.grains.spin[i] != 0)
            throw WrongKeys({"sample/file", "discrete/lateral"},
                            file.place(i) + ": vx, vy or omega is not 0, but the loading of a cell starts from rest: leave out "
                                            "these columns");
        for (Eigen::Vector2d &v : file.grains.velocity)
          v.setZero(); // the motion of the cell is part of the velocities in snapshots
      }
    box.periodicity = state.periodicity;
    check_grains(file, box, o.allowed_overlap);
    if (const auto &fixed = file.grains.fixed; std::all_of(fixed.begin(), fixed.end(), [](const auto held) { return held != 0; }))
      throw std::invalid_argument("every grain is fixed (column or dataset `fixed`), so nothing can move");
    state.grains = std::move(file.grains);
    set_sides(state, preparation);
    validate_walls(state);
    return sample;
  }

  std::optional<FileSample> file_sample(const SampleOptions         &o,
                                        const PreparationSetting    &preparation,
                                        const std::function<bool()> &go_on)
  {
    struct Leave
    {};
    try
      {
        return read_and_placed(o, preparation, [&] {
          if (!go_on())
            throw Leave();
        });
      }
    catch (const Leave &)
      {
        return std::nullopt;
      }
  }

  void check_sample_file(const SampleOptions &o, const PreparationSetting &preparation, const CheckStop &check_stop)
  {
    if (!o.file.empty())
      (void)read_and_placed(o, preparation, check_stop);
  }
} // namespace diptych::discrete
