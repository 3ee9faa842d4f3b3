// diptych: bodies of the discrete panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "discrete/bodies/periodicity.h"

namespace diptych::discrete
{
  // Values of Grains::fixed. A held grain keeps its velocity and spin under any force. A grain of a platen moves with the
  // platen without turning. Forces on it act on the platen, which keeps its own mass.
  inline constexpr std::uint8_t held_grain = 1, lower_platen_grain = 2, upper_platen_grain = 3;

  // Rigid discs of unit thickness. One entry per grain in every vector.
  struct Grains
  {
    std::vector<Eigen::Vector2d> position; // at the end of the last step [length]
    std::vector<Eigen::Vector2d> velocity; // [length/time]
    std::vector<double>          rotation; // counter-clockwise [rad]
    std::vector<double>          spin;     // counter-clockwise [rad/time]
    std::vector<double>          radius;   // [length]
    std::vector<double>          mass;     // rho pi r^2, per unit thickness
    std::vector<std::uint8_t>    fixed;    // how a grain is held: 0 free, else one of the constants above

    std::size_t size() const { return radius.size(); }

    double moment_of_inertia(const std::size_t i) const { return 0.5 * mass[i] * radius[i] * radius[i]; }

    // Number of the wall that a grain is part of; -1 for a grain that belongs to no platen.
    int platen(const std::size_t i) const { return fixed[i] >= lower_platen_grain ? fixed[i] - lower_platen_grain : -1; }

    // 1/m; 0 for a fixed grain, because forces cannot move it, or only through its platen.
    double inverse_mass(const std::size_t i) const { return fixed[i] ? 0. : 1 / mass[i]; }
  };

  inline void add_grain(Grains &grains, const Eigen::Vector2d &position, const double radius, const double density)
  {
    grains.position.push_back(position);
    grains.velocity.push_back(Eigen::Vector2d::Zero());
    grains.rotation.push_back(0.);
    grains.spin.push_back(0.);
    grains.radius.push_back(radius);
    grains.mass.push_back(density * M_PI * radius * radius);
    grains.fixed.push_back(0);
  }

  // Motion of one component of a wall. Forces act on the wall along the positive axis, per unit thickness.
  struct KeptVelocity
  {};
  struct PrescribedVelocity
  {
    TimeTable velocity; // [length/time]
  };
  struct AppliedForce
  {
    TimeTable force; // [pressure x length]
  };
  // Force = pressure x length along the wall's normal, i.e. towards the sample. length = 0: the present distance between the two
  // neighbouring walls (walls 0 and 1 for a side, walls 2 and 3 for a platen, the width of a periodic cell).
  struct AppliedPressure
  {
    double pressure; // [pressure]
    double length = 0;
  };
  using Drive = std::variant<KeptVelocity, PrescribedVelocity, AppliedForce, AppliedPressure>;

  inline bool is_free(const Drive &drive)
  {
    return std::holds_alternative<AppliedForce>(drive) || std::holds_alternative<AppliedPressure>(drive);
  }

  enum class WallKind : std::uint8_t
  {
    platen,
    side
  };

  // Straight rigid wall or platen: the half plane behind `point`, which does not turn. If only one component is free, the
  // normal must lie along an axis. Otherwise the normal and tangential parts of a contact would be coupled.
  struct Wall
  {
    Eigen::Vector2d point;  // any point of its surface [length]
    Eigen::Vector2d normal; // unit, into the sample
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    Drive           drive_x = {}, drive_y = {};
    double          mass = 1; // of a free component
    WallKind        kind = WallKind::platen;

    Eigen::Vector2d inverse_mass() const { return {is_free(drive_x) ? 1 / mass : 0., is_free(drive_y) ? 1 / mass : 0.}; }
  };

  // Impulse of a pair, kept as first guess for the next step. Walls are bodies n_grains, n_grains + 1, ...
  struct PairImpulse
  {
    int    i, j; // i < j
    double normal, tangential;
    double normal_change = 0, tangential_change = 0; // since the previous step; 0 if the pair did not act then
    double rolling = 0, rolling_change = 0;          // couple / effective radius
  };

  struct State
  {
    Grains                   grains;
    std::vector<Wall>        walls; // lower and upper platen, then the left and right side if there are any
    Periodicity              periodicity = {};
    std::vector<PairImpulse> impulses    = {}; // of the last step, ascending in (i, j)
    double                   time        = 0;

    // The kind of periodicity, or nullptr if it is another one.
    PeriodicWidth       *width() { return std::get_if<PeriodicWidth>(&periodicity); }
    const PeriodicWidth *width() const { return std::get_if<PeriodicWidth>(&periodicity); }
    Lattice             *lattice() { return std::get_if<Lattice>(&periodicity); }
    const Lattice       *lattice() const { return std::get_if<Lattice>(&periodicity); }
  };

  // The image of grain j nearest to grain i, at x_j + shift.
  inline Image nearest_image(const State &state, const Eigen::Vector2d &xi, const Eigen::Vector2d &xj)
  {
    return std::visit([&](const auto &kind) { return kind.nearest_image(xi - xj); }, state.periodicity);
  }

  // A uniform strain of the whole sample along the axes, positive in compression. `centre` stays.
  struct UniformStrain
  {
    Eigen::Vector2d strain, centre;

    Eigen::Vector2d moved(const Eigen::Vector2d &place) const { return place - strain.cwiseProduct(place - centre); }
    void            deform(Periodicity &periodicity) const;
  };

  // Moves free grains, walls and images. Grains of a platen move with it, held ones stay. Velocities do not change.
  void deform(State &state, const UniformStrain &strain);

  // Gives the grains of a platen the velocity of the platen.
  void carry_platen_grains(State &state);

  // Rescales the impulses of the last step for steps `factor` times as long.
  void scale_impulses(State &state, double factor);
} // namespace diptych::discrete
