// diptych: the contact problem of one step as data
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  // Velocity of a body in the form that contact kinematics needs, together with the inverse mass (32 bytes).
  struct alignas(32) BodyVelocity
  {
    double x, y;
    double surface;      // s = r omega: speed of the surface due to spin; 0 for walls
    double inverse_mass; // of a grain or a free width; 0 for fixed grains and walls (jx, jy of the row) [1/mass]
  };

  // Impulse on body i of a contact. Body j receives the opposite impulse. `rolling` is the couple divided by the effective radius
  // R of the contact: 1/R = 1/r_i + 1/r_j, or R = r_i at a plane. All three parts thus have the unit of an impulse.
  struct Impulse
  {
    double normal = 0, tangential = 0, rolling = 0;
  };

  // Number of widths (lattice vectors a1) and of lattice vectors a2 to an image.
  struct RowImage
  {
    RowImage(const int along = 0, const int upward = 0)
        : along(std::int16_t(along)),
          upward(std::int16_t(upward))
    {}

    std::int16_t along, upward;
  };

  // One contact between bodies i and j: normal n from j to i, tangent t = n turned by +90 degrees, relative velocity
  //   u_n = n.(v_i - v_j),  u_t = t.(v_i - v_j) - s_i - s_j,  w = R (omega_i - omega_j) = a s_i - (1 - a) s_j,  a = R / r_i.
  struct alignas(64) ContactRow
  {
    // The velocities depend on these members. They fill one cache line, because they are read separately from the rest.
    double   nx, ny;
    int      i = 0, j = 0;    // i is a grain
    RowImage image      = {}; // j enters as this image
    int      image_body = -1; // moves like the width or a1, and the next body like a2; -1 if the image moves like j
    double   ki, kj;          // r^2/I of each side, 2/m for a disc, 0 for a wall [1/mass]
    double   jx, jy;          // inverse mass of body j along x and y; they differ only for walls with one free component [1/mass]
    double   normal_term;     // c_n of  0 <= u_n' + c_n  _|_  r_n >= 0   [length/time]
    double   tangential_term; // c_t = e_t u_t of the friction law        [length/time]
    double   friction;        // mu
    double   inverse_wnn;     // 1 / (1/m_i + 1/m_j + C_n)                [mass]
    double   inverse_wtt;     // 1 / (1/m_i + 1/m_j + k_i + k_j + C_t)    [mass]
    double rolling_friction = 0; // bound of |r_m| / r_n: mu_r times length of the law / R; the next two count only if it is not 0
    double rolling_arm      = 0; // a; -a if the row is turned (step_problem.cc), so that r_m keeps its sign
    // Springs give way by C r within the step: the law holds for u_n + C_n r_n, u_t + C_t r_t and w + c_m + C_t r_m. C_n = 0
    // means a rigid contact without the other two. Place: the solver reads the members below only if C_n > 0.
    double normal_compliance     = 0; // C_n [1/mass]
    double tangential_compliance = 0; // C_t
    double rolling_term          = 0; // c_m [length/time]
    double inverse_wmm           = 0; // 1 / (k_i a^2 + k_j (1 - a)^2 + C_t) [mass]
  };

  // Deformation of a lattice as three more unknowns, its rate of strain (lattice_motion.h).
  struct LatticeProblem
  {
    std::vector<Eigen::Vector2d> place;    // of each grain, then a1 and a2: their velocity contains gradient x place [length]
    Eigen::Matrix3d              mobility; // rate of strain = free rate - mobility x moment of the impulses
  };

  // Unknowns are the impulses r; the velocities are v = v_free + M^-1 H r. Every contact obeys Signorini's condition, Coulomb's
  // law and the law of rolling resistance (discrete/README.md, Method). For discs and walls the coupling W_nt between the normal
  // and tangential part of one contact vanishes. Each contact by itself therefore has a closed solution (contact_law.h). Across
  // the edge of a free width W_nt is small but not zero.
  struct ContactProblem
  {
    // Grains first, then walls, then the periodic width if it changes (x = d width/dt). With a lattice: grains, a1, a2 and a
    // record of the rate of strain (x: exx, y: eyy, surface: 2 exy).
    std::vector<BodyVelocity> free_velocity;
    std::vector<ContactRow>   contacts;
    std::vector<int>          order; // rows in the order of the sweeps; empty: the stored order

    std::optional<LatticeProblem> lattice = {};
  };

  // True for free grains and a free width. False for walls, because their rows hold their mobility.
  inline bool moves(const ContactProblem &problem, const int body)
  {
    return problem.free_velocity[body].inverse_mass != 0;
  }
} // namespace diptych::discrete
