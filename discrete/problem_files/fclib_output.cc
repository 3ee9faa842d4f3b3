// diptych: writes contact problems in the layout of FCLIB
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <stdexcept>

#include "discrete/problem_files/fclib.h"
#include "discrete/problem_files/fclib_input.h"
#include "discrete/files/hdf5_file.h"

namespace diptych::discrete
{
  namespace
  {
    using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    void write_matrix(Hdf5Writer &writer, const std::string &name, RowMatrix matrix)
    {
      matrix.makeCompressed();
      const int  n = int(matrix.nonZeros());
      const int *p = matrix.outerIndexPtr(), *i = matrix.innerIndexPtr();
      writer.write(name + "/m", std::vector<int>{int(matrix.rows())});
      writer.write(name + "/n", std::vector<int>{int(matrix.cols())});
      writer.write(name + "/nz", std::vector<int>{-2});
      writer.write(name + "/nzmax", std::vector<int>{n});
      writer.write(name + "/p", std::vector<int>(p, p + matrix.rows() + 1));
      writer.write(name + "/i", std::vector<int>(i, i + n));
      writer.write(name + "/x", std::vector<double>(matrix.valuePtr(), matrix.valuePtr() + n));
    }

    void write_vector(Hdf5Writer &writer, const std::string &name, const Eigen::VectorXd &v)
    {
      writer.write(name, std::vector<double>(v.data(), v.data() + v.size()));
    }

    template <class Pair> std::vector<double> normal_first(const std::vector<Pair> &pairs)
    {
      std::vector<double> flat;
      for (const Pair &pair : pairs)
        flat.insert(flat.end(), {pair.normal, pair.tangential});
      return flat;
    }

    // Nothing if no contact resists rolling.
    void write_rolling(Hdf5Writer &writer, const ContactProblem &problem)
    {
      std::vector<double> friction, arm;
      for (const ContactRow &c : problem.contacts)
        {
          friction.push_back(c.rolling_friction);
          arm.push_back(c.rolling_arm);
        }
      if (std::all_of(friction.begin(), friction.end(), [](const double f) { return f == 0; }))
        return;
      writer.write("/rolling/friction", friction);
      writer.write("/rolling/arm", arm);
    }

    void write_impulses(Hdf5Writer &writer, const std::vector<Impulse> &r)
    {
      writer.write("/solution/r", normal_first(r));
      std::vector<double> rolling;
      for (const Impulse &each : r)
        rolling.push_back(each.rolling);
      if (std::any_of(rolling.begin(), rolling.end(), [](const double x) { return x != 0; }))
        writer.write("/solution/rolling", rolling);
    }

    void write_head(Hdf5Writer &writer, const std::string &group, const StoredText &about, const BodyMatrices &b)
    {
      writer.write(group + "/spacedim", std::vector<int>{2});
      writer.write_string(group + "/info/title", about.title);
      writer.write_string(group + "/info/description", about.description);
      writer.write_string(group + "/info/math_info", "W symmetric positive semi-definite");
      write_vector(writer, group + "/vectors/mu", b.friction);
    }

    void write_local(Hdf5Writer &writer, const DelassusProblem &problem)
    {
      std::vector<Eigen::Triplet<double>> entries;
      for (int k = 0; k < int(problem.n_contacts()); ++k)
        for (std::size_t e = problem.row_begin[k]; e < problem.row_begin[k + 1]; ++e)
          {
            const int            l = problem.column[e];
            const DelassusBlock &w = problem.blocks[e];
            entries.emplace_back(2 * k, 2 * l, w.nn);
            entries.emplace_back(2 * k, 2 * l + 1, w.nt);
            entries.emplace_back(2 * k + 1, 2 * l, w.tn);
            entries.emplace_back(2 * k + 1, 2 * l + 1, w.tt);
          }
      RowMatrix matrix(2 * problem.n_contacts(), 2 * problem.n_contacts());
      matrix.setFromTriplets(entries.begin(), entries.end());
      write_matrix(writer, "/fclib_local/W", matrix);
      writer.write("/fclib_local/vectors/q", normal_first(problem.q));
    }

    // Components that do not move are not unknowns. Their contribution to u goes into w.
    void write_global(Hdf5Writer &writer, const BodyMatrices &b)
    {
      std::vector<int> free;
      for (int a = 0; a < b.inverse_mass.size(); ++a)
        if (b.inverse_mass[a] > 0)
          free.push_back(a);
      const auto      n = Eigen::Index(free.size());
      RowMatrix       all(b.h), h(n, b.h.cols()), m(n, n);
      Eigen::VectorXd f(n), driven = b.free_velocity;
      for (Eigen::Index row = 0; row < n; ++row)
        {
          for (RowMatrix::InnerIterator entry(all, free[row]); entry; ++entry)
            h.insert(row, entry.col()) = entry.value();
          m.insert(row, row) = 1 / b.inverse_mass[free[row]];
          f[row]             = b.free_velocity[free[row]] / b.inverse_mass[free[row]];
          driven[free[row]]  = 0;
        }
      write_matrix(writer, "/fclib_global/M", m);
      write_matrix(writer, "/fclib_global/H", h);
      write_vector(writer, "/fclib_global/vectors/f", f);
      write_vector(writer, "/fclib_global/vectors/w", b.h.transpose() * driven + b.velocity_offset);
    }

    // The third component is the rate of rotation omega = s / r of a disc. Walls do not turn.
    void write_nscd(Hdf5Writer &writer, const ContactProblem &problem, BodyMatrices b, const StoredGeometry &geometry)
    {
      const std::size_t n_discs = geometry.radius.size(), n_bodies = problem.free_velocity.size();
      Eigen::VectorXd   scale = Eigen::VectorXd::Ones(b.inverse_mass.size());
      std::vector<int>  free, body_i, body_j;
      for (std::size_t body = 0; body < n_bodies; ++body)
        scale[3 * body + 2] = body < n_discs ? geometry.radius[body] : 0;
      for (std::size_t body = 0; body < n_bodies; ++body)
        if (const double w = problem.free_velocity[body].inverse_mass; w > 0) // discs without a contact also move
          b.inverse_mass.segment<2>(3 * body).setConstant(w);
      b.h = scale.asDiagonal() * b.h;
      for (int a = 0; a < scale.size(); ++a)
        {
          b.inverse_mass[a] /= scale[a] > 0 ? scale[a] * scale[a] : 1;
          b.free_velocity[a] /= scale[a] > 0 ? scale[a] : 1;
          if (b.inverse_mass[a] > 0)
            free.push_back(a);
        }
      std::vector<Eigen::Vector2d> normal, tangent;
      for (const ContactRow &c : problem.contacts)
        {
          body_i.push_back(c.i);
          body_j.push_back(c.j);
          normal.emplace_back(c.nx, c.ny);
          tangent.emplace_back(-c.ny, c.nx);
        }
      write_matrix(writer, "/nscd/H", b.h);
      write_vector(writer, "/nscd/Minv_diag", b.inverse_mass);
      write_vector(writer, "/nscd/v_free", b.free_velocity);
      write_vector(writer, "/nscd/w", b.velocity_offset);
      writer.write("/nscd/body_i", body_i);
      writer.write("/nscd/body_j", body_j);
      writer.write("/nscd/normal", normal);
      writer.write("/nscd/tangent", tangent);
      writer.write("/nscd/gap", geometry.gap);
      writer.write("/nscd/dt", std::vector<double>{geometry.step});
      writer.write("/nscd/x", geometry.position);
      writer.write("/nscd/radius", geometry.radius);
      writer.write("/nscd/free_dof_index", free);
    }

    void require_sizes(const ContactProblem &problem, const StoredGeometry &geometry)
    {
      if (geometry.gap.size() != problem.contacts.size() || geometry.position.size() != geometry.radius.size() ||
          geometry.radius.size() > problem.free_velocity.size())
        throw std::invalid_argument(text("the geometry has ", geometry.gap.size(), " gaps, ", geometry.radius.size(),
                                         " radii and ", geometry.position.size(), " positions, but the problem has ",
                                         problem.contacts.size(), " contacts and ", problem.free_velocity.size(), " bodies"));
    }
  } // namespace

  StoredGeometry stored_geometry(const Grains &grains, const std::vector<Contact> &contacts, const double step)
  {
    StoredGeometry geometry{step, {}, grains.radius, grains.position};
    for (std::size_t i = 0; i < grains.size(); ++i)
      geometry.position[i] += 0.5 * step * grains.velocity[i];
    for (const Contact &c : contacts)
      geometry.gap.push_back(c.gap);
    return geometry;
  }

  void write_fclib(const std::string                   &path,
                   const ContactProblem                &problem,
                   const StoredText                    &about,
                   const std::optional<StoredGeometry> &geometry,
                   const std::vector<Impulse>          &solution)
  {
    if (geometry)
      require_sizes(problem, *geometry);
    if (!solution.empty() && solution.size() != problem.contacts.size())
      throw std::invalid_argument("the solution must have one impulse per contact");
    const BodyMatrices    b     = body_matrices(problem);
    const DelassusProblem local = delassus_form(problem);
    Hdf5Writer            writer(path);
    for (const std::string group : {"/fclib_local", "/fclib_global"})
      write_head(writer, group, about, b);
    write_local(writer, local);
    write_global(writer, b);
    const bool free_width = std::any_of(problem.contacts.begin(), problem.contacts.end(),
                                        [](const auto &c) { return c.image_body >= 0; });
    if (geometry && !free_width)
      write_nscd(writer, problem, b, *geometry);
    write_rolling(writer, problem);
    if (!solution.empty())
      {
        const bool rolls = std::any_of(solution.begin(), solution.end(), [](const Impulse &r) { return r.rolling != 0; });
        write_impulses(writer, solution);
        writer.write("/solution/u",
                     normal_first(rolls ? relative_velocities(problem, solution) : relative_velocities(local, solution)));
      }
    writer.finish();
  }

  void write_solution(const std::string &from, const std::string &to, const StoredSolution &solution)
  {
    const Hdf5Reader reader(from);
    Hdf5Writer       writer(to);
    for (const std::string &name : reader.members("/"))
      if (name != "solution")
        writer.copy_values(reader, name);
    write_impulses(writer, solution.r);
    writer.write("/solution/u", normal_first(solution.u));
    writer.attribute("/solution", "solver", solution.solver);
    writer.attribute("/solution", "status", solution.status);
    writer.attribute("/solution", "residual", solution.residual);
    writer.finish();
  }
} // namespace diptych::discrete
