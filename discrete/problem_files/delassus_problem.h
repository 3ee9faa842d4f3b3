// diptych: contact problem with the bodies eliminated, and its solution
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/contact_problem.h"
#include "discrete/solvers/solver.h"

namespace diptych::discrete
{
  // Influence of the impulse of one contact on the relative velocity of another [1/mass]. `nt` is the normal velocity due to a
  // tangential impulse. The members are stored column by column, because a sweep reads them in this order.
  struct DelassusBlock
  {
    double nn = 0, tn = 0, nt = 0, tt = 0;
  };

  // u = W r + q [length/time] with the laws 0 <= u_n _|_ r_n >= 0, |r_t| <= mu r_n, sliding against u_t. W = H^T M^-1 H is
  // symmetric and positive semi-definite. `q` contains the gap and restitution terms of the contacts.
  struct DelassusProblem
  {
    std::vector<std::size_t>      row_begin = {0}; // (contacts + 1): blocks of contact k are row_begin[k] .. row_begin[k+1] - 1
    std::vector<int>              column;          // (blocks), ascending in each row; the diagonal is always there
    std::vector<DelassusBlock>    blocks;
    std::vector<RelativeVelocity> q;        // (contacts)
    std::vector<double>           friction; // (contacts), mu

    std::vector<int> order; // of the sweeps; empty: the order of the contacts

    std::size_t n_contacts() const { return friction.size(); }
  };

  // The body form as matrices: u + c = H^T v + c with v = v_free + M^-1 H r. Every body has the three components x, y and surface
  // speed, whether it moves or not. The normal component of a contact comes first.
  struct BodyMatrices
  {
    Eigen::SparseMatrix<double> h;               // (3 bodies, 2 contacts)
    Eigen::VectorXd             inverse_mass;    // (3 bodies) [1/mass]; 0 for immovable components or without contacts
    Eigen::VectorXd             free_velocity;   // (3 bodies)
    Eigen::VectorXd             velocity_offset; // c, (2 contacts)
    Eigen::VectorXd             friction;        // (contacts)
  };

  // A contact across the edge of a free width also acts on the width. Its inverse masses of y and surface speed are 0.
  BodyMatrices body_matrices(const ContactProblem &problem);

  // Blocks of W (2 contacts, 2 contacts), q (2 contacts) and mu (contacts). Entries that are exactly zero are left out.
  DelassusProblem delassus_problem(const Eigen::SparseMatrix<double, Eigen::RowMajor> &w,
                                   const Eigen::VectorXd                              &q,
                                   const Eigen::VectorXd                              &friction);

  // Eliminates the bodies of a problem. Contacts and their order stay, so both forms have the same u + c and the same
  // residual for the same impulses.
  DelassusProblem delassus_form(const ContactProblem &problem);

  // The larger of max|W_a - W_b| / max|W_a| and max|q_a - q_b| / max|q_a|. Infinity if the numbers of contacts differ.
  double relative_difference(const DelassusProblem &a, const DelassusProblem &b);

  // u of both forms.
  std::vector<RelativeVelocity> relative_velocities(const DelassusProblem &problem, const std::vector<Impulse> &impulses);
  std::vector<RelativeVelocity> relative_velocities(const ContactProblem &problem, const std::vector<Impulse> &impulses);

  // Natural map ||r - P(r)||_2 / ||r||_2 as in the body form (natural_map.h).
  double natural_map_residual(const DelassusProblem &problem, const std::vector<Impulse> &impulses);

  // The error that Siconos' 2D solvers report: ||r - P_K(r - (u_n + mu |u_t|, u_t))||_2 / max(||r||, ||u||, ||q||), where P_K
  // projects onto Coulomb's cone (Acary & Brogliato 2008, A.13). It depends on the unit of mass, and open contacts with a large
  // q make it small. Use it for comparison, not as a stopping criterion.
  double siconos_residual(const DelassusProblem &problem, const std::vector<Impulse> &impulses);

  // Solves in place from the given first guess. The number of sweeps depends on their order. `nsgs` solves the 2x2 problem of
  // each contact exactly. `psor` takes the sticking or the slipping omega by the status of the old impulse. Throws
  // std::invalid_argument on an unknown solver.
  SolveReport solve(const DelassusProblem &problem, const SolverOptions &options, std::vector<Impulse> &impulses);
} // namespace diptych::discrete
