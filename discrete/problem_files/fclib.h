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
#include "discrete/contacts/contact_problem.h"
#include "discrete/problem_files/delassus_problem.h"

namespace diptych::discrete
{
  enum class ProblemForm
  {
    body, // bodies with their masses
    local // contacts alone
  };
  constexpr auto choices(ProblemForm)
  {
    return std::array{std::pair{ProblemForm::body, "body"}, std::pair{ProblemForm::local, "local"}};
  }

  // A plane problem of a file: u = W r + q, impulses r, normal component first. The layout is that of FCLIB (Acary, Bremond,
  // Koziara & Perignon 2014): /fclib_local (W, q, mu) and /fclib_global (M v = f + H r, u = H^T v + w, mu), beside /solution
  // and /guesses; matrices by rows (nz = -2), by columns (nz = -1) or as triplets (nz >= 0; p is the column and i the row).
  struct StoredProblem
  {
    DelassusProblem local; // contacts in the order of the file; made from /fclib_global where that is all
    std::optional<ContactProblem>
                         bodies; // of our own group /nscd: discs, then walls; rows in the order of the file, swept upwards
    ProblemForm          form = ProblemForm::local; // body where there are bodies
    std::string          reason;                    // why there are none
    std::vector<Impulse> solution;                  // /solution/r; empty: none
    std::vector<std::vector<Impulse>> guesses;      // /guesses/1, 2, ...
  };

  // The body form is taken where its W and q are those of the file within 1e-10 and no contact couples its normal and
  // tangential directions. Throws std::invalid_argument naming file, dataset and values on whatever is missing or malformed, on
  // space dimension 3 and on equality constraints (V, G).
  StoredProblem read_fclib(const std::string &path);

  // One of the two descriptions alone, contacts in the order of the file. Throws like read_fclib().
  DelassusProblem read_fclib_local(const std::string &path);
  DelassusProblem read_fclib_global(const std::string &path);

  // What a contact problem does not say of its sample. Discs come first among the bodies.
  struct StoredGeometry
  {
    double                       step = 0; // [time]
    std::vector<double>          gap;      // (contacts) [length]
    std::vector<double>          radius;   // (discs)
    std::vector<Eigen::Vector2d> position; // (discs)
  };

  struct StoredText
  {
    std::string title, description;
  };

  // Writes /fclib_local and /fclib_global by rows, contacts in the order of the problem, under `path`.part, then renames.
  // Third component of a body in /fclib_global: its surface speed. With a geometry also /nscd, from which the body form can be
  // read again, but not where a contact acts on a free cell. With impulses (one a contact) also /solution. Throws
  // std::runtime_error where the file cannot be written and std::invalid_argument where sizes do not fit.
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

  // All of `from`, its solution replaced. The two paths may be the same.
  void write_solution(const std::string &from, const std::string &to, const StoredSolution &solution);
} // namespace diptych::discrete
