// diptych: contact problem of a step, made from the bodies and their contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/step_problem.h"

#include <algorithm>
#include <cmath>

#include "discrete/bodies/boundary.h"
#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/contact_order.h"
#include "discrete/contacts/lattice_motion.h"
#include "discrete/stepping/step_setting.h"

namespace diptych::discrete
{
  namespace
  {
    // c_n. `share` is corrected_share().
    double normal_term(const Contact &c, const double un, const double en, const double share, const double h)
    {
      if (en > 0 && un < 0 && (c.gap <= 0 || c.gap + h * un < 0))
        return en * un;
      return (c.gap < 0 ? share * c.gap : c.gap) / h;
    }

    // Bodies of a row. The platen replaces a grain that is part of it. If that grain is i, the row is turned round: the normal is
    // reversed, and relative velocity and impulse keep their signs.
    struct RowBodies
    {
      int  i, j;
      bool turned = false;
    };

    RowBodies row_bodies(const State &state, const Contact &c)
    {
      const int n = int(state.grains.size());
      if (const int platen = state.grains.platen(c.i); platen >= 0)
        return {c.j, n + platen, true};
      const int platen = c.j < n ? state.grains.platen(c.j) : -1;
      return {c.i, platen >= 0 ? n + platen : c.j};
    }

    void set_kinematics(const State &state, const Contact &c, const std::vector<BodyVelocity> &v, ContactRow &row)
    {
      const int       n      = int(state.grains.size());
      const RowBodies body   = row_bodies(state, c);
      const double    normal = body.turned ? -1 : 1;
      row.nx                 = normal * c.normal.x();
      row.ny                 = normal * c.normal.y();
      row.i                  = body.i;
      row.j                  = body.j;
      row.image              = 0;
      row.image_body         = -1;
      const double wi        = v[row.i].inverse_mass;
      row.ki                 = 2 * wi; // r^2/I of a disc
      if (row.j < n)
        {
          const double wj = v[row.j].inverse_mass;
          row.jx = row.jy = wj;
          row.kj          = 2 * wj;
        }
      else
        {
          const Eigen::Vector2d wj = state.walls[row.j - n].inverse_mass();
          row.jx                   = wj.x();
          row.jy                   = wj.y();
          row.kj                   = 0;
        }
      double    wnn        = wi + row.jx * row.nx * row.nx + row.jy * row.ny * row.ny;
      double    wtt        = wi + row.jx * row.ny * row.ny + row.jy * row.nx * row.nx + row.ki + row.kj;
      const int image_body = n + int(state.walls.size()); // exists if images move relative to their grains
      if ((c.image.along != 0 || c.image.upward != 0) && image_body < int(v.size()))
        {
          row.image      = {int(normal) * c.image.along, int(normal) * c.image.upward};
          row.image_body = image_body;
          const double w = v[image_body].inverse_mass * c.image.along * c.image.along;
          wnn += w * row.nx * row.nx;
          wtt += w * row.ny * row.ny;
        }
      const bool is_disc = row.image_body < 0 && row.jx == row.jy && row.kj == 2 * row.jx;
      row.inverse_wnn    = 1 / wnn;
      row.inverse_wtt    = is_disc ? row.inverse_wnn * disc_wnn_over_wtt : 1 / wtt;
    }

    // The length of the law is 2R between discs and R at a wall (contact_law.h).
    void add_rolling(const Grains &grains, const Contact &c, const double coefficient, ContactRow &row)
    {
      row.rolling_friction = 0;
      if (coefficient == 0)
        return;
      const double arm = effective_radius(grains, c.i, c.j) / grains.radius[row.i];
      set_rolling((std::size_t(c.j) < grains.size() ? 2 : 1) * coefficient, row.i == c.i ? arm : -arm, row);
    }

    // Positions of the grains, then the lattice vectors.
    std::vector<Eigen::Vector2d> places(const Grains &grains, const Lattice &lattice)
    {
      std::vector<Eigen::Vector2d> place = grains.position;
      place.insert(place.end(), {lattice.vectors.col(0), lattice.vectors.col(1)});
      return place;
    }
  } // namespace

  std::vector<BodyVelocity> body_velocities(const State &state)
  {
    const Grains             &g = state.grains;
    std::vector<BodyVelocity> v;
    v.reserve(g.size() + state.walls.size() + 3);
    for (std::size_t i = 0; i < g.size(); ++i)
      v.push_back({g.velocity[i].x(), g.velocity[i].y(), g.radius[i] * g.spin[i], g.inverse_mass(i)});
    for (const Wall &wall : state.walls)
      v.push_back({wall.velocity.x(), wall.velocity.y(), 0, 0});
    if (const PeriodicWidth *periodic = state.width(); periodic && periodic->moves())
      v.push_back({periodic->velocity, 0, 0, periodic->inverse_mass()});
    if (const Lattice *lattice = state.lattice())
      {
        v.insert(v.end(), {{0, 0, 0, 0}, {0, 0, 0, 0}, record_of(lattice->rate)});
        add_gradient(places(state.grains, *lattice), velocity_gradient(lattice->rate), v);
      }
    return v;
  }

  std::vector<BodyVelocity> free_velocities(const State                        &state,
                                            const std::vector<BodyVelocity>    &v,
                                            const std::vector<Eigen::Vector2d> &force,
                                            const StepSetting                  &setting)
  {
    const double              h    = setting.step;
    const std::size_t         n    = state.grains.size();
    std::vector<BodyVelocity> free = v;
    for (std::size_t i = 0; i < n; ++i)
      {
        free[i].x += h * force[i].x() * v[i].inverse_mass;
        free[i].y += h * force[i].y() * v[i].inverse_mass;
      }
    for (std::size_t w = 0; w < state.walls.size(); ++w)
      {
        const Eigen::Vector2d velocity = prescribed_wall_velocity(state.walls[w], state.time + h);
        const Eigen::Vector2d push = applied_wall_force(state, w, state.time + 0.5 * h), mobility = state.walls[w].inverse_mass();
        free[n + w].x = velocity.x() + h * push.x() * mobility.x();
        free[n + w].y = velocity.y() + h * push.y() * mobility.y();
      }
    if (const Lattice *lattice = state.lattice())
      {
        const Eigen::Vector3d rate = lattice_motion(*lattice, state.time, h).free_rate;
        add_gradient(places(state.grains, *lattice), velocity_gradient(rate - lattice->rate), free);
        free.back() = record_of(rate);
      }
    if (const PeriodicWidth *periodic = state.width(); periodic && periodic->pressure)
      free.back().x -= h * *periodic->pressure * sample_height(state) * periodic->inverse_mass();
    return free;
  }

  double corrected_share(const StepOptions &stepping)
  {
    if (stepping.penetration_correction == PenetrationCorrection::velocity)
      return 1;
    return stepping.penetration_correction == PenetrationCorrection::soft_velocity ? 0.2 : 0.;
  }

  Friction friction_of(const State &state, const StepSetting &setting, const int body_j)
  {
    const ContactLawOptions &law = setting.law;
    const int                n   = int(state.grains.size());
    if (body_j < n)
      return {law.friction, law.rolling_friction};
    return state.walls[body_j - n].kind == WallKind::platen ? Friction{law.platen_friction, law.platen_rolling_friction}
                                                            : Friction{law.wall_friction, law.wall_rolling_friction};
  }

  double effective_radius(const Grains &grains, const int i, const int j)
  {
    const double ri = grains.radius[i];
    return std::size_t(j) < grains.size() ? ri * grains.radius[j] / (ri + grains.radius[j]) : ri;
  }

  double couple_impulse(const Grains &grains, const Contact &c, const Impulse &r)
  {
    return r.rolling * effective_radius(grains, c.i, c.j);
  }

  ContactProblem make_problem(const State                     &state,
                              const StepSetting               &setting,
                              const std::vector<Contact>      &contacts,
                              const std::vector<BodyVelocity> &v,
                              ContactProblem                   problem)
  {
    problem.order = sweep_order(contacts, setting.mean_diameter);
    problem.contacts.resize(contacts.size());
    problem.lattice.reset();
    if (const Lattice *lattice = state.lattice())
      problem.lattice = LatticeProblem{places(state.grains, *lattice),
                                       lattice_motion(*lattice, state.time, setting.step).mobility};
    const double share = corrected_share(setting.stepping);
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        const Contact &c   = contacts[k];
        ContactRow    &row = problem.contacts[k];
        set_kinematics(state, c, v, row);
        const RelativeVelocity u = relative_velocity(row, v);
        const Friction         f = friction_of(state, setting, c.j);
        row.friction             = f.sliding;
        row.normal_term          = normal_term(c, u.normal, setting.law.normal_restitution, share, setting.step);
        row.tangential_term      = setting.law.tangential_restitution * u.tangential;
        add_rolling(state.grains, c, f.rolling, row);
      }
    return problem;
  }

  void add_springs(const StepSetting          &setting,
                   const std::vector<Contact> &contacts,
                   const std::vector<Impulse> &last,
                   ContactProblem             &problem)
  {
    const double h = setting.step, kn = setting.compliance.stiffness, kt = tangential_over_normal_stiffness * kn;
    const auto   with = [](const double compliance, const double inverse) { return 1 / (1 / inverse + compliance); };
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        ContactRow  &row          = problem.contacts[k];
        const double gap          = contacts[k].gap;
        const bool   damps        = gap < 0 && std::isfinite(row.inverse_wnn);
        const double duration     = h + (damps ? 2 * setting.compliance.damping * std::sqrt(row.inverse_wnn / kn) : 0);
        row.normal_compliance     = 1 / (h * kn * duration);
        row.tangential_compliance = 1 / (h * kt * h);
        row.normal_term           = gap / duration;
        row.tangential_term       = -row.tangential_compliance * last[k].tangential;
        row.rolling_term          = -row.tangential_compliance * last[k].rolling;
        row.inverse_wnn           = with(row.normal_compliance, row.inverse_wnn);
        row.inverse_wtt           = with(row.tangential_compliance, row.inverse_wtt);
        row.inverse_wmm           = with(row.tangential_compliance, row.inverse_wmm);
      }
  }

  std::vector<BoundWork> work_at_bounds(const ContactProblem            &problem,
                                        const std::vector<BodyVelocity> &v,
                                        const std::vector<Impulse>      &impulses)
  {
    std::vector<BoundWork> work(impulses.size());
    for (std::size_t k = 0; k < impulses.size(); ++k)
      {
        const ContactRow &c = problem.contacts[k];
        const Impulse    &r = impulses[k];
        work[k].sliding     = 0 - r.tangential * (velocity_with_give(c, v, r).tangential + c.tangential_term);
        if (c.rolling_friction != 0)
          work[k].rolling = 0 - r.rolling * rolling_with_give(c, rolling_velocity(c, v), r);
      }
    return work;
  }
} // namespace diptych::discrete
