// diptych: the contact problem of one step as data
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

namespace diptych::discrete
{
  // Velocity of a body in the form that contact kinematics needs, together with the inverse mass (32 bytes).
  struct alignas(32) BodyVelocity
  {
    double x, y;
    double surface;      // s = r omega: speed of the surface due to spin; 0 for walls
    double inverse_mass; // of a grain or the free cell; 0 for fixed grains and walls (jx, jy of the row) [1/mass]
  };

  // Impulse on body i of a contact. Body j receives the opposite impulse. `rolling` is the couple divided by the effective radius
  // R of the contact: 1/R = 1/r_i + 1/r_j, or R = r_i at a plane. All three parts thus have the unit of an impulse.
  struct Impulse
  {
    double normal = 0, tangential = 0, rolling = 0;
  };

  // One contact between bodies i and j: normal n from j to i, tangent t = n turned by +90 degrees, relative velocity
  //   u_n = n.(v_i - v_j),  u_t = t.(v_i - v_j) - s_i - s_j,  w = R (omega_i - omega_j) = a s_i - (1 - a) s_j,  a = R / r_i.
  struct alignas(64) ContactRow
  {
    // The velocities depend on these members. They fill one cache line, because they are read separately from the rest.
    double nx, ny;
    int    i = 0, j = 0;    // i is a grain
    int    image = 0;       // j enters as its image this many cell widths away, which moves with the width
    int    cell  = -1;      // body whose x is d width/dt, if the image moves; -1 otherwise
    double ki, kj;          // r^2/I of each side, 2/m for a disc, 0 for a wall [1/mass]
    double jx, jy;          // inverse mass of body j along x and y; they differ only for walls with one free component [1/mass]
    double normal_term;     // c_n of  0 <= u_n' + c_n  _|_  r_n >= 0   [length/time]
    double tangential_term; // c_t = e_t u_t of the friction law        [length/time]
    double friction;        // mu
    double inverse_wnn;     // 1 / (1/m_i + 1/m_j)                      [mass]
    double inverse_wtt;     // 1 / (1/m_i + 1/m_j + k_i + k_j)          [mass]
    double rolling_friction = 0; // bound of |r_m| / r_n: mu_r times length of the law / R; the next two count only if it is not 0
    double rolling_arm      = 0; // a; -a if the row is turned (step_problem.cc), so that r_m keeps its sign
    double inverse_wmm      = 0; // 1 / (k_i a^2 + k_j (1 - a)^2)       [mass]
  };

  // Unknowns are the impulses r; the velocities are v = v_free + M^-1 H r. Every contact obeys Signorini's condition, Coulomb's
  // law and the law of rolling resistance (discrete/README.md, Method). For discs and walls the coupling W_nt between the normal
  // and tangential part of one contact vanishes. Each contact by itself therefore has a closed solution (contact_law.h). Across
  // the edge of a cell with free width W_nt is small but not zero.
  struct ContactProblem
  {
    std::vector<BodyVelocity> free_velocity; // grains first, then walls, then the cell if its width changes (x = d width/dt)
    std::vector<ContactRow>   contacts;
    std::vector<int>          order; // rows in the order of the sweeps; empty: the stored order
  };

  // True for free grains and the cell of free width. False for walls, because their rows hold their mobility.
  inline bool moves(const ContactProblem &problem, const int body)
  {
    return problem.free_velocity[body].inverse_mass != 0;
  }
} // namespace diptych::discrete
