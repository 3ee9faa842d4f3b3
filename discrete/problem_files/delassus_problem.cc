// diptych: contact problem with the bodies eliminated, and its solution
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/problem_files/delassus_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "discrete/contacts/natural_map.h"
#include "discrete/solvers/iteration.h"

namespace diptych::discrete
{
  BodyMatrices body_matrices(const ContactProblem &problem)
  {
    const auto                          n_bodies = int(problem.free_velocity.size()), n = int(problem.contacts.size());
    std::vector<Eigen::Triplet<double>> entries;
    BodyMatrices result = {Eigen::SparseMatrix<double>(3 * n_bodies, 2 * n), Eigen::VectorXd::Zero(3 * n_bodies),
                           Eigen::VectorXd(3 * n_bodies), Eigen::VectorXd(2 * n), Eigen::VectorXd(n)};
    for (int b = 0; b < n_bodies; ++b)
      {
        const BodyVelocity &v = problem.free_velocity[b];
        result.free_velocity.segment<3>(3 * b) << v.x, v.y, v.surface;
      }
    for (int k = 0; k < n; ++k)
      {
        const ContactRow &c   = problem.contacts[k];
        const auto        add = [&](const int row, const double normal, const double tangential) {
          entries.emplace_back(row, 2 * k, normal);
          entries.emplace_back(row, 2 * k + 1, tangential);
        };
        add(3 * c.i, c.nx, -c.ny);
        add(3 * c.i + 1, c.ny, c.nx);
        add(3 * c.i + 2, 0, -1);
        add(3 * c.j, -c.nx, c.ny);
        add(3 * c.j + 1, -c.ny, -c.nx);
        add(3 * c.j + 2, 0, -1);
        const double mi = problem.free_velocity[c.i].inverse_mass;
        result.inverse_mass.segment<3>(3 * c.i) << mi, mi, c.ki;
        result.inverse_mass.segment<3>(3 * c.j) << c.jx, c.jy, c.kj;
        result.velocity_offset.segment<2>(2 * k) << c.normal_term, c.tangential_term;
        result.friction[k] = c.friction;
        if (c.image_body < 0)
          continue;
        add(3 * c.image_body, -c.image.along * c.nx, c.image.along * c.ny);
        result.inverse_mass[3 * c.image_body] = problem.free_velocity[c.image_body].inverse_mass;
      }
    result.h.setFromTriplets(entries.begin(), entries.end());
    return result;
  }

  DelassusProblem delassus_problem(const Eigen::SparseMatrix<double, Eigen::RowMajor> &w,
                                   const Eigen::VectorXd                              &q,
                                   const Eigen::VectorXd                              &friction)
  {
    using RowIterator = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;
    DelassusProblem result;
    for (int k = 0; k < friction.size(); ++k)
      {
        std::map<int, DelassusBlock> row = {{k, {}}};
        for (RowIterator entry(w, 2 * k); entry; ++entry)
          if (entry.value() != 0)
            (entry.col() % 2 == 0 ? row[entry.col() / 2].nn : row[entry.col() / 2].nt) += entry.value();
        for (RowIterator entry(w, 2 * k + 1); entry; ++entry)
          if (entry.value() != 0)
            (entry.col() % 2 == 0 ? row[entry.col() / 2].tn : row[entry.col() / 2].tt) += entry.value();
        for (const auto &[column, block] : row)
          {
            result.column.push_back(column);
            result.blocks.push_back(block);
          }
        result.row_begin.push_back(result.column.size());
        result.q.push_back({q[2 * k], q[2 * k + 1]});
        result.friction.push_back(friction[k]);
      }
    return result;
  }

  DelassusProblem delassus_form(const ContactProblem &problem)
  {
    const BodyMatrices b = body_matrices(problem);
    // With the rows of immovable bodies, a driven wall would couple all its contacts with zeros.
    Eigen::SparseMatrix<double> velocity = b.inverse_mass.asDiagonal() * b.h;
    velocity.prune([](int, int, const double value) { return value != 0; });
    DelassusProblem result = delassus_problem(b.h.transpose() * velocity, b.h.transpose() * b.free_velocity + b.velocity_offset,
                                              b.friction);
    result.order           = problem.order;
    return result;
  }

  namespace
  {
    struct Extent
    {
      double difference = 0, scale = 0;

      void add(const double a, const double b)
      {
        difference = std::max(difference, std::abs(a - b));
        scale      = std::max(scale, std::abs(a));
      }

      double ratio() const { return difference == 0 ? 0. : difference / scale; }
    };

    void add_row(Extent &w, const DelassusProblem &a, const DelassusProblem &b, const std::size_t k)
    {
      std::map<int, std::pair<DelassusBlock, DelassusBlock>> row;
      for (std::size_t e = a.row_begin[k]; e < a.row_begin[k + 1]; ++e)
        row[a.column[e]].first = a.blocks[e];
      for (std::size_t e = b.row_begin[k]; e < b.row_begin[k + 1]; ++e)
        row[b.column[e]].second = b.blocks[e];
      for (const auto &[column, pair] : row)
        {
          w.add(pair.first.nn, pair.second.nn);
          w.add(pair.first.tn, pair.second.tn);
          w.add(pair.first.nt, pair.second.nt);
          w.add(pair.first.tt, pair.second.tt);
        }
    }

    double square(const Impulse &r)
    {
      return r.normal * r.normal + r.tangential * r.tangential;
    }

    // Row k of W r + q.
    inline RelativeVelocity relative_velocity(const DelassusProblem &problem, const std::size_t k, const Impulse *r)
    {
      RelativeVelocity  u   = problem.q[k];
      const std::size_t end = problem.row_begin[k + 1];
      for (std::size_t b = problem.row_begin[k]; b < end; ++b)
        {
          const DelassusBlock &w = problem.blocks[b];
          const Impulse        s = r[problem.column[b]];
          u.normal += w.nn * s.normal + w.nt * s.tangential;
          u.tangential += w.tn * s.normal + w.tt * s.tangential;
        }
      return u;
    }

    const DelassusBlock &diagonal(const DelassusProblem &problem, const std::size_t k)
    {
      const auto begin = problem.column.begin();
      return problem.blocks[std::lower_bound(begin + problem.row_begin[k], begin + problem.row_begin[k + 1], int(k)) - begin];
    }

    struct Own
    {
      DelassusBlock w;
      double        inverse_wnn, inverse_wtt, friction;
      bool          coupled; // W_nt matters
      bool          locks;   // sliding presses the bodies together (Painleve), so relaxation of one part at a time diverges
    };

    std::vector<Own> own_blocks(const DelassusProblem &problem)
    {
      std::vector<Own> own;
      for (std::size_t k = 0; k < problem.n_contacts(); ++k)
        {
          const DelassusBlock &w = diagonal(problem, k);
          own.push_back({w, 1 / w.nn, 1 / w.tt, problem.friction[k], std::abs(w.nt) > 1e-12 * std::sqrt(w.nn * w.tt),
                         w.nn < problem.friction[k] * std::abs(w.nt)});
        }
      return own;
    }

    inline double clamp(const double value, const double bound)
    {
      return std::min(bound, std::max(-bound, value));
    }

    // One relaxation, normal direction first. The tangential velocity includes the new normal impulse, so that a contact with
    // W_nt != 0 also converges.
    inline Impulse relaxed(const Own &c, const RelativeVelocity &u, const Impulse &r, const double omega)
    {
      const double normal     = std::max(0., r.normal - omega * u.normal * c.inverse_wnn);
      const double tangential = u.tangential + c.w.tn * (normal - r.normal);
      return {normal, clamp(r.tangential - omega * tangential * c.inverse_wtt, c.friction * normal)};
    }

    // Exact solution of one contact with the others held: open, sticking, or slipping in one of two directions.
    Impulse exact(const Own &c, const RelativeVelocity &u, const Impulse &r)
    {
      const DelassusBlock   &w = c.w;
      const RelativeVelocity z = {u.normal - w.nn * r.normal - w.nt * r.tangential,
                                  u.tangential - w.tn * r.normal - w.tt * r.tangential};
      if (z.normal >= 0)
        return {0, 0};
      const double  determinant = w.nn * w.tt - w.nt * w.tn;
      const Impulse stick       = {(-w.tt * z.normal + w.nt * z.tangential) / determinant,
                                   (w.tn * z.normal - w.nn * z.tangential) / determinant};
      if (determinant > 0 && stick.normal >= 0 && std::abs(stick.tangential) <= c.friction * stick.normal)
        return stick;
      Impulse slip;
      for (const double side : {1., -1.})
        {
          slip.normal     = -z.normal / (w.nn + side * c.friction * w.nt);
          slip.tangential = side * c.friction * slip.normal;
          if (slip.normal >= 0 && side * (z.tangential + w.tn * slip.normal + w.tt * slip.tangential) <= 0)
            break;
        }
      return slip;
    }

    void sweep_nsgs(const DelassusProblem  &problem,
                    const std::vector<int> &order,
                    const std::vector<Own> &own,
                    std::vector<Impulse>   &r)
    {
      for (const int k : order)
        {
          const RelativeVelocity u = relative_velocity(problem, k, r.data());
          r[k]                     = own[k].coupled ? exact(own[k], u, r[k]) : relaxed(own[k], u, r[k], 1.);
        }
    }

    struct Omega
    {
      double sticking, slipping;
    };

    void sweep_psor(const DelassusProblem  &problem,
                    const std::vector<int> &order,
                    const std::vector<Own> &own,
                    const Omega            &omega,
                    std::vector<Impulse>   &r)
    {
      for (const int k : order)
        {
          const RelativeVelocity u        = relative_velocity(problem, k, r.data());
          const bool             slipping = is_slipping(own[k].friction, r[k]);
          r[k] = own[k].locks ? exact(own[k], u, r[k]) : relaxed(own[k], u, r[k], slipping ? omega.slipping : omega.sticking);
        }
    }

    // Solution of contact k by itself, with W_nt left out.
    Parts<double> natural_map(const DelassusProblem &problem, const std::size_t k, const LawTerms<double> &own, const Impulse *r)
    {
      return signorini_coulomb(own, relative_velocity(problem, k, r), {r[k].normal, r[k].tangential}, 1.);
    }

    LawTerms<double> terms_of(const Own &own)
    {
      return {0, 0, own.friction, own.inverse_wnn, own.inverse_wtt};
    }

    double residual(const DelassusProblem &problem, const std::vector<Own> &own, const std::vector<Impulse> &impulses)
    {
      double difference = 0, norm = 0;
      for (std::size_t k = 0; k < own.size(); ++k)
        {
          const Parts<double> p = natural_map(problem, k, terms_of(own[k]), impulses.data());
          difference += square({impulses[k].normal - p.normal, impulses[k].tangential - p.tangential});
          norm += square(impulses[k]);
        }
      return relative_norm(difference, norm);
    }

    double velocity_error(const DelassusProblem &problem, const std::vector<Own> &own, const std::vector<Impulse> &impulses)
    {
      VelocitySquares squares;
      for (std::size_t k = 0; k < own.size(); ++k)
        squares.add(terms_of(own[k]), {impulses[k].normal, impulses[k].tangential},
                    natural_map(problem, k, terms_of(own[k]), impulses.data()), problem.q[k]);
      return squares.relative();
    }

    // Nearest point with |r_t| <= mu r_n.
    Impulse onto_coulombs_cone(const Impulse &r, const double mu)
    {
      const double tangential = std::abs(r.tangential);
      if (tangential <= mu * r.normal)
        return r;
      if (mu * tangential <= -r.normal)
        return {0, 0};
      const double normal = (r.normal + mu * tangential) / (1 + mu * mu);
      return {normal, std::copysign(mu * normal, r.tangential)};
    }
  } // namespace

  double relative_difference(const DelassusProblem &a, const DelassusProblem &b)
  {
    if (a.n_contacts() != b.n_contacts())
      return std::numeric_limits<double>::infinity();
    Extent w, q;
    for (std::size_t k = 0; k < a.n_contacts(); ++k)
      {
        add_row(w, a, b, k);
        q.add(a.q[k].normal, b.q[k].normal);
        q.add(a.q[k].tangential, b.q[k].tangential);
      }
    return std::max(w.ratio(), q.ratio());
  }

  std::vector<RelativeVelocity> relative_velocities(const ContactProblem &problem, const std::vector<Impulse> &impulses)
  {
    const std::vector<BodyVelocity> v = velocities(problem, impulses);
    std::vector<RelativeVelocity>   result;
    for (const ContactRow &c : problem.contacts)
      {
        const RelativeVelocity u = relative_velocity(c, v);
        result.push_back({u.normal + c.normal_term, u.tangential + c.tangential_term});
      }
    return result;
  }

  std::vector<RelativeVelocity> relative_velocities(const DelassusProblem &problem, const std::vector<Impulse> &impulses)
  {
    std::vector<RelativeVelocity> u;
    for (std::size_t k = 0; k < problem.n_contacts(); ++k)
      u.push_back(relative_velocity(problem, k, impulses.data()));
    return u;
  }

  double natural_map_residual(const DelassusProblem &problem, const std::vector<Impulse> &impulses)
  {
    return residual(problem, own_blocks(problem), impulses);
  }

  double siconos_residual(const DelassusProblem &problem, const std::vector<Impulse> &impulses)
  {
    double difference = 0, norm_r = 0, norm_u = 0, norm_q = 0;
    for (std::size_t k = 0; k < problem.n_contacts(); ++k)
      {
        const RelativeVelocity u = relative_velocity(problem, k, impulses.data()), q = problem.q[k];
        const Impulse          r  = impulses[k];
        const double           mu = problem.friction[k];
        const Impulse p = onto_coulombs_cone({r.normal - u.normal - mu * std::abs(u.tangential), r.tangential - u.tangential},
                                             mu);
        difference += square({r.normal - p.normal, r.tangential - p.tangential});
        norm_r += square(r);
        norm_u += square({u.normal, u.tangential});
        norm_q += square({q.normal, q.tangential});
      }
    return difference == 0 ? 0. : std::sqrt(difference / std::max({norm_r, norm_u, norm_q}));
  }

  SolveReport solve(const DelassusProblem &problem, const SolverOptions &options, std::vector<Impulse> &impulses)
  {
    const std::vector<Own> own   = own_blocks(problem);
    std::vector<int>       order = problem.order;
    if (order.empty())
      {
        order.resize(problem.n_contacts());
        std::iota(order.begin(), order.end(), 0);
      }
    const bool plain = options.solver == ContactSolver::nsgs;
    Iteration  iteration;
    iteration.refresh        = [] {}; // W r + q is always computed from scratch
    iteration.residual       = [&] { return residual(problem, own, impulses); };
    iteration.velocity_error = [&] { return velocity_error(problem, own, impulses); };
    iteration.sweep          = [&](const double sticking, const double slipping, const int n_sweeps) {
      for (int sweep = 0; sweep < n_sweeps; ++sweep)
        if (plain)
          sweep_nsgs(problem, order, own, impulses);
        else
          sweep_psor(problem, order, own, {sticking, slipping}, impulses);
    };
    return iterate(options, iteration);
  }
} // namespace diptych::discrete
