// diptych: lateral condition of the grain sample, forces and motions of its walls
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/boundary.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::discrete
{
  namespace
  {
    void share_force(const Grains                 &grains,
                     const int                    *begin,
                     const int                    *end,
                     const double                  total,
                     std::vector<Eigen::Vector2d> &force)
    {
      double mass = 0;
      for (const int *i = begin; i != end; ++i)
        mass += grains.mass[*i];
      for (const int *i = begin; i != end; ++i)
        force[*i].x() += total * grains.mass[*i] / mass;
    }
  } // namespace

  LateralCondition lateral_condition(const LateralOptions &o)
  {
    const bool pressure = o.side_motion == SideMotion::pressure;
    switch (o.lateral)
      {
      case Lateral::end_grains:
        return EndGrains{o.band_height, o.end_grains};
      case Lateral::rigid_walls:
        return RigidSides{pressure ? std::nullopt : std::optional<double>(o.side_velocity), o.wall_mass};
      case Lateral::periodic:
        return PeriodicSides{pressure, o.side_velocity, o.wall_mass};
      case Lateral::cell:
        return CellSides{};
      case Lateral::none:
        break;
      }
    return NoSides{};
  }

  void add_lateral_forces(const State                  &state,
                          const EndGrains              &action,
                          const double                  pressure,
                          const double                  mean_diameter,
                          std::vector<Eigen::Vector2d> &force)
  {
    const Grains &g      = state.grains;
    const double  bottom = state.walls[0].point.y(), height = state.walls[1].point.y() - bottom;
    const int     n_bands = std::max(1, int(std::lround(height / (action.band_height * mean_diameter))));
    const double  w       = height / n_bands;

    std::vector<std::vector<int>> band(n_bands);
    for (std::size_t i = 0; i < g.size(); ++i)
      if (!g.fixed[i])
        band[std::clamp(int((g.position[i].y() - bottom) / w), 0, n_bands - 1)].push_back(int(i));

    for (std::vector<int> &members : band)
      {
        // Ties of equal abscissae are broken by the grain number, because the order of std::partial_sort would not be unique.
        const auto left_of = [&](const int a, const int b) {
          return g.position[a].x() != g.position[b].x() ? g.position[a].x() < g.position[b].x() : a < b;
        };
        const std::size_t n = std::min<std::size_t>(action.end_grains, members.size() / 2);
        if (n == 0)
          continue;
        std::partial_sort(members.begin(), members.begin() + n, members.end(), left_of);
        std::partial_sort(members.rbegin(), members.rbegin() + n, members.rend() - n,
                          [&](const int a, const int b) { return left_of(b, a); });
        share_force(g, members.data(), members.data() + n, w * pressure, force);
        share_force(g, members.data() + members.size() - n, members.data() + members.size(), -w * pressure, force);
      }
  }

  double sample_height(const State &state)
  {
    if (const Lattice *lattice = state.lattice())
      return lattice->vectors(1, 1);
    if (state.walls.size() < 2)
      throw std::invalid_argument("the height of the sample needs a lower and an upper platen");
    return state.walls[1].point.y() - state.walls[0].point.y();
  }

  double sample_width(const State &state)
  {
    if (const PeriodicWidth *periodic = state.width())
      return periodic->width;
    if (state.walls.size() < 4)
      throw std::invalid_argument("the width of the sample needs side walls or a periodic cell");
    return state.walls[3].point.x() - state.walls[2].point.x();
  }

  Eigen::Vector2d applied_wall_force(const State &state, const std::size_t index, const double time)
  {
    const Wall     &wall      = state.walls[index];
    Eigen::Vector2d force     = Eigen::Vector2d::Zero();
    const auto      component = [&](const Drive &drive, const int axis) {
      if (const auto *applied = std::get_if<AppliedForce>(&drive))
        force[axis] = applied->force.at(time);
      else if (const auto *applied = std::get_if<AppliedPressure>(&drive))
        force[axis] = wall.normal[axis] * applied->pressure *
                      (applied->length > 0 ? applied->length : (axis == 0 ? sample_height(state) : sample_width(state)));
    };
    component(wall.drive_x, 0);
    component(wall.drive_y, 1);
    return force;
  }

  Eigen::Vector2d prescribed_wall_velocity(const Wall &wall, const double time)
  {
    Eigen::Vector2d velocity = wall.velocity;
    if (const auto *prescribed = std::get_if<PrescribedVelocity>(&wall.drive_x))
      velocity.x() = prescribed->velocity.at(time);
    if (const auto *prescribed = std::get_if<PrescribedVelocity>(&wall.drive_y))
      velocity.y() = prescribed->velocity.at(time);
    return velocity;
  }

  void validate_walls(const State &state)
  {
    for (std::size_t w = 0; w < state.walls.size(); ++w)
      {
        const Wall &wall   = state.walls[w];
        const bool  x_free = is_free(wall.drive_x), y_free = is_free(wall.drive_y);
        if (x_free != y_free && std::abs(wall.normal.x() * wall.normal.y()) > 1e-12)
          throw std::invalid_argument("wall " + std::to_string(w) +
                                      ": if only one component of motion is free, the normal must be horizontal or vertical");
        if ((x_free || y_free) && !(wall.mass > 0))
          throw std::invalid_argument("wall " + std::to_string(w) +
                                      ": a wall that moves under a force needs a positive mass, not " +
                                      std::to_string(wall.mass));
        (void)applied_wall_force(state, w, state.time);
      }
    if (const PeriodicWidth *periodic = state.width(); periodic && !(periodic->width > 0 && periodic->mass > 0))
      throw std::invalid_argument("a periodic sample needs a positive width, and a positive mass of this width");
  }
} // namespace diptych::discrete
