// diptych: bodies of an LMGC90 run, shared by its two formats
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <string>

#include "coupling/import/foreign_sample.h"

namespace diptych::coupling
{
  // RBDY2 with one contactor: a disc (DISKx) or a wall (JONCx).
  struct Lmgc90Body
  {
    std::string     material;                     // nickname of the bulk behaviour
    double          equivalent_radius = not_told; // mass = density pi avrd^2
    Eigen::Vector2d reference         = {not_told, not_told};
    double          disc_radius       = not_told;                      // of a disc
    double          half_length = not_told, half_thickness = not_told; // of a wall

    bool is_wall() const { return half_thickness == half_thickness; }
  };
  using Lmgc90Bodies = std::map<long, Lmgc90Body>; // by number, from 1

  // Reads BODIES.DAT. Throws SceneError naming file, line and the expected text.
  Lmgc90Bodies read_lmgc90_bodies(const std::string &path);

  // Reads BULK_BEHAV.DAT: density by nickname [mass/length^2].
  std::map<std::string, double> read_lmgc90_densities(const std::string &path);

  // Displacement from the reference and velocity at one instant: x, y and rotation.
  struct Lmgc90Motion
  {
    Eigen::Vector3d displacement = Eigen::Vector3d::Zero(), velocity = Eigen::Vector3d::Zero();
  };

  // Adds grains and walls of one instant. The rotation of a wall is its orientation and not a motion. Its inner face is
  // half_thickness before its centre. Throws SceneError if a body has no motion or a wall is inclined.
  void place_lmgc90_bodies(const Lmgc90Bodies                  &bodies,
                           const std::map<std::string, double> &densities,
                           const std::map<long, Lmgc90Motion>  &motions,
                           ForeignFrame                        &frame);

  // Index in frame.walls for a body number.
  std::map<long, int> lmgc90_walls(const Lmgc90Bodies &bodies);

  // A contact. The force on the candidate is rln n + rlt t with t = (n_y, -n_x). The antagonist may be a wall.
  struct Lmgc90Contact
  {
    long            candidate = 0, antagonist = 0;
    double          tangential = 0, normal = 0, gap = not_told;
    Eigen::Vector2d direction = Eigen::Vector2d::Zero(), point = {not_told, not_told};
    bool            slides = false;
    int             line   = 0;
  };
  ForeignContact foreign_contact(const Lmgc90Contact &contact, const std::map<long, int> &walls);
} // namespace diptych::coupling
