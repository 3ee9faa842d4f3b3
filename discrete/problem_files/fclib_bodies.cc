// diptych: discs and walls of a stored contact problem
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "discrete/problem_files/fclib_input.h"

namespace diptych::discrete
{
  namespace
  {
    struct NscdGroup
    {
      std::vector<double> inverse_mass, free_velocity, normal, tangent, offset, radius, position;
      std::vector<int>    body_i, body_j;

      int  n_bodies() const { return int(free_velocity.size() / 3); }
      bool is_disc(const int body) const { return std::size_t(body) < radius.size(); }
    };

    std::vector<int> read_bodies(const FclibInput &file, const std::string &name, const std::size_t n, const int n_bodies)
    {
      const std::vector<int> bodies = file.integers(name);
      if (bodies.size() != n)
        file.refuse(name, text("has ", bodies.size(), " entries where ", n, " are needed"));
      for (std::size_t k = 0; k < n; ++k)
        if (bodies[k] < 0 || bodies[k] >= n_bodies)
          file.refuse(name, text("contact ", k, " has body number ", bodies[k], " of ", n_bodies));
      return bodies;
    }

    NscdGroup read_nscd(const FclibInput &file, const std::size_t n)
    {
      NscdGroup group;
      group.free_velocity = file.numbers("/nscd/v_free");
      group.radius        = file.numbers("/nscd/radius");
      if (file.has("/nscd/H/x"))
        (void)file.numbers("/nscd/H/x"); // redundant, but copied to the solution
      if (group.free_velocity.size() % 3 != 0 || group.radius.size() > group.free_velocity.size() / 3)
        file.refuse("/nscd/v_free", text("has ", group.free_velocity.size(), " entries for ", group.radius.size(), " discs"));
      group.inverse_mass = file.numbers("/nscd/Minv_diag", group.free_velocity.size());
      group.position     = file.numbers("/nscd/x", 2 * group.radius.size());
      group.normal       = file.numbers("/nscd/normal", 2 * n);
      group.tangent      = file.numbers("/nscd/tangent", 2 * n);
      group.offset       = file.numbers("/nscd/w", 2 * n);
      group.body_i       = read_bodies(file, "/nscd/body_i", n, group.n_bodies());
      group.body_j       = read_bodies(file, "/nscd/body_j", n, group.n_bodies());
      for (const auto &[name, size] : {std::pair("/nscd/gap", n), std::pair("/nscd/dt", std::size_t(1))})
        if (file.has(name)) // not used here, but by readers of a solved file
          (void)file.numbers(name, size);
      return group;
    }

    // Reason why the group does not describe discs and walls that do not turn; empty if it does.
    std::string obstacle(const NscdGroup &g)
    {
      for (int b = 0; b < g.n_bodies(); ++b)
        {
          const double *w = &g.inverse_mass[3 * b];
          if (g.is_disc(b) && w[0] != w[1])
            return text("disc ", b, " has the inverse masses ", w[0], " and ", w[1]);
          if (!g.is_disc(b) && w[2] != 0)
            return text("wall ", b, " can turn");
          if (w[0] < 0 || w[1] < 0 || w[2] < 0)
            return text("body ", b, " has a negative inverse mass");
        }
      for (std::size_t k = 0; k < g.body_i.size(); ++k)
        {
          if (!g.is_disc(g.body_i[k]) && !g.is_disc(g.body_j[k]))
            return text("contact ", k, " joins two walls");
          if (std::hypot(g.tangent[2 * k] + g.normal[2 * k + 1], g.tangent[2 * k + 1] - g.normal[2 * k]) > 1e-12)
            return text("the tangent of contact ", k, " is not its normal turned by +90 degrees");
        }
      return "";
    }

    std::vector<BodyVelocity> free_velocities(const NscdGroup &g)
    {
      std::vector<BodyVelocity> bodies;
      for (int b = 0; b < g.n_bodies(); ++b)
        {
          const double *v = &g.free_velocity[3 * b];
          BodyVelocity  body{v[0], v[1], 0, 0};
          if (g.is_disc(b))
            {
              body.surface      = g.radius[b] * v[2];
              body.inverse_mass = g.inverse_mass[3 * b];
            }
          bodies.push_back(body);
        }
      return bodies;
    }

    // Body i of a row must be a disc. Seen from the other body, the relative velocity is the same and the normal is reversed.
    ContactRow contact_row(const NscdGroup &g, const std::size_t k, const double friction)
    {
      const bool   reversed = !g.is_disc(g.body_i[k]);
      const int    i = reversed ? g.body_j[k] : g.body_i[k], j = reversed ? g.body_i[k] : g.body_j[k];
      const double sign = reversed ? -1 : 1, nx = sign * g.normal[2 * k], ny = sign * g.normal[2 * k + 1];
      const double mi = g.inverse_mass[3 * i], jx = g.inverse_mass[3 * j], jy = g.inverse_mass[3 * j + 1];
      const auto   spin = [&](const int b) { return g.is_disc(b) ? g.radius[b] * g.radius[b] * g.inverse_mass[3 * b + 2] : 0.; };
      const double wnn = mi + nx * nx * jx + ny * ny * jy, wtt = mi + ny * ny * jx + nx * nx * jy + spin(i) + spin(j);
      ContactRow   row;
      row.nx              = nx;
      row.ny              = ny;
      row.i               = i;
      row.j               = j;
      row.ki              = spin(i);
      row.kj              = spin(j);
      row.jx              = jx;
      row.jy              = jy;
      row.normal_term     = g.offset[2 * k];
      row.tangential_term = g.offset[2 * k + 1];
      row.friction        = friction;
      row.inverse_wnn     = 1 / wnn;
      row.inverse_wtt     = 1 / wtt;
      return row;
    }

    double own_coupling(const ContactProblem &problem)
    {
      double largest = 0;
      for (const ContactRow &c : problem.contacts)
        largest = std::max(largest, std::abs(c.nx * c.ny * (c.jy - c.jx)) * std::sqrt(c.inverse_wnn * c.inverse_wtt));
      return largest;
    }

    std::vector<int> upwards(const NscdGroup &g, const ContactProblem &problem)
    {
      std::vector<double> height;
      for (const ContactRow &c : problem.contacts)
        height.push_back(g.position[2 * c.i + 1] - g.radius[c.i] * c.ny);
      std::vector<int> order(height.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](const int a, const int b) { return height[a] < height[b]; });
      return order;
    }
  } // namespace

  BodyForm read_body_form(const FclibInput &file, const DelassusProblem &local)
  {
    if (!file.has("/nscd"))
      return {std::nullopt, "the file has no group /nscd"};
    const NscdGroup g = read_nscd(file, local.n_contacts());
    if (const std::string reason = obstacle(g); !reason.empty())
      return {std::nullopt, reason};
    ContactProblem bodies;
    bodies.free_velocity = free_velocities(g);
    for (std::size_t k = 0; k < local.n_contacts(); ++k)
      bodies.contacts.push_back(contact_row(g, k, local.friction[k]));
    if (const double difference = relative_difference(local, delassus_form(bodies)); !(difference <= 1e-10))
      return {std::nullopt, text("W or q of /nscd differs from the rest of the file, relative difference ", difference)};
    if (const double coupling = own_coupling(bodies); coupling > 1e-10)
      return {std::nullopt,
              text("a contact couples its normal and tangential directions: |W_nt| / sqrt(W_nn W_tt) = ", coupling)};
    bodies.order = upwards(g, bodies);
    return {bodies, ""};
  }
} // namespace diptych::discrete
