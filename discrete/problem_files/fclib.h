// diptych: contact problems stored in the layout of FCLIB
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "discrete/choices.h"
#include "discrete/contacts/contact_detection.h"
#include "discrete/contacts/contact_problem.h"
#include "discrete/problem_files/delassus_problem.h"

namespace diptych::discrete
{
  enum class ProblemForm
  {
    body, // bodies with their masses
    local // contacts only
  };
  constexpr auto choices(ProblemForm)
  {
    return std::array{std::pair{ProblemForm::body, "body"}, std::pair{ProblemForm::local, "local"}};
  }

  // Defaults for a problem that no step follows.
  inline SolverOptions stored_solver_options()
  {
    SolverOptions options;
    options.tolerance  = 1e-8;
    options.max_sweeps = 1000000;
    return options;
  }

  // A plane problem of a file: u = W r + q, impulses r, normal component first. The layout is that of FCLIB (Acary, Bremond,
  // Koziara & Perignon 2014): /fclib_local (W, q, mu), /fclib_global (M v = f + H r, u = H^T v + w, mu), /solution and /guesses.
  // Diptych adds the group /rolling if contacts resist rolling: `friction` and `arm` as in ContactRow, one entry per contact.
  // Only the bodies of /nscd show how couples act; /fclib_local and /fclib_global leave them out. /solution/rolling holds the
  // couples. Matrices are stored by rows (nz = -2), by columns (nz = -1) or as triplets (nz >= 0; p is the column and i the row).
  struct StoredProblem
  {
    DelassusProblem local; // contacts in the order of the file; made from /fclib_global if there is no /fclib_local
    std::optional<ContactProblem>
                         bodies; // from Diptych's group /nscd: discs, then walls; rows in the order of the file, swept upward
    ProblemForm          form = ProblemForm::local;  // body if `bodies` is set
    std::string          reason;                     // reason why `bodies` is empty
    std::vector<Impulse> solution;                   // /solution/r; may be empty
    std::vector<std::vector<Impulse>> guesses;       // /guesses/1, 2, ...
    bool                              rolls = false; // contacts resist rolling

    // Reason why a form cannot be solved; empty if it can.
    std::string obstacle(ProblemForm wanted) const;

    // Solves one form in place to options.tolerance, and to a velocity error of 100 times that.
    SolveReport solve(ProblemForm chosen, SolverOptions options, std::vector<Impulse> &impulses, ThreadTeam &team) const;

    std::vector<RelativeVelocity> velocities(const std::vector<Impulse> &impulses) const;       // u
    double                        siconos_residual(const std::vector<Impulse> &impulses) const; // NaN if contacts resist rolling
  };

  // Takes the body form if its W and q agree with the file within 1e-10 and no contact couples its normal and tangential
  // directions. Throws std::invalid_argument with file, dataset and values if data are missing or malformed. Space dimension 3,
  // equality constraints (V, G), and rolling resistance without a body form are also refused.
  StoredProblem read_fclib(const std::string &path);

  // Reads one of the two descriptions, with the contacts in the order of the file. Throws like read_fclib().
  DelassusProblem read_fclib_local(const std::string &path);
  DelassusProblem read_fclib_global(const std::string &path);

  // Data of the sample that a contact problem does not contain. Discs come first among the bodies.
  struct StoredGeometry
  {
    double                       step = 0; // [time]
    std::vector<double>          gap;      // (contacts) [length]
    std::vector<double>          radius;   // (discs)
    std::vector<Eigen::Vector2d> position; // (discs)
  };
  // Geometry of the contacts at the middle of a step that starts from these grains.
  StoredGeometry stored_geometry(const Grains &grains, const std::vector<Contact> &contacts, double step);

  struct StoredText
  {
    std::string title, description;
  };

  // Writes /fclib_local and /fclib_global by rows to `path`.part, then renames it. Contacts keep the order of the problem; the
  // third component of a body in /fclib_global is its surface speed. A geometry adds /nscd, from which the body form can be
  // restored, unless a contact acts on a free width. Impulses (one per contact) add /solution. Throws std::runtime_error if the
  // file cannot be written and std::invalid_argument if sizes do not match.
  void write_fclib(const std::string                   &path,
                   const ContactProblem                &problem,
                   const StoredText                    &about,
                   const std::optional<StoredGeometry> &geometry = std::nullopt,
                   const std::vector<Impulse>          &solution = {});

  struct StoredSolution
  {
    std::vector<Impulse>          r; // in the order of the file
    std::vector<RelativeVelocity> u;
    std::string                   solver, status;
    double                        residual = 0; // natural map relative to |r|
  };

  // Copies all of `from` except its solution, which is replaced. Both paths may be the same.
  void write_solution(const std::string &from, const std::string &to, const StoredSolution &solution);
} // namespace diptych::discrete
