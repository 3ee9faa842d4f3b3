// diptych: makes a snapshot of the state of a loading
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/make_snapshot.h"

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/internal_moment.h"
#include "discrete/bodies/outline.h"
#include "discrete/stepping/step_problem.h"

namespace diptych::discrete
{
  namespace
  {
    ContactStatus contact_status(const double friction, const Impulse &r)
    {
      if (r.normal == 0)
        return ContactStatus::open;
      return is_slipping(friction, r) ? ContactStatus::slipping : ContactStatus::sticking;
    }

    void add_contacts(const State &state, const StepResult &result, const StepSetting &setting, Snapshot &s)
    {
      for (std::size_t k = 0; k < result.contacts.size(); ++k)
        {
          const Contact c      = make_contact(state, result.contacts[k].i, result.contacts[k].j);
          const double  couple = couple_impulse(state.grains, c, result.impulses[k]) / setting.step;
          s.contacts.push_back({c.i, c.j, c.point, c.normal,
                                impulse_vector(result.contacts[k], result.impulses[k]) / setting.step, c.image.shift.x(), couple,
                                c.image.shift.y()});
          s.gap.push_back(c.gap);
          s.status.push_back(contact_status(friction_of(state, setting, c.j).sliding, result.impulses[k]));
        }
    }

    void add_boundary(const State &state, const StepResult &result, const Reference &reference, Snapshot &s)
    {
      s.outline = make_outline(state, s.mean_diameter);
      s.area    = outline_area(s.outline);
      if (const Lattice *lattice = state.lattice())
        {
          s.cell_vectors = lattice->vectors;
          s.lower_y      = s.outline.left.front().y();
          s.upper_y      = s.outline.right.back().y();
          for (std::size_t i = 0; i < s.velocity.size(); ++i)
            s.velocity[i] += velocity_gradient(lattice->rate) * s.position[i];
          return;
        }
      s.lower_y                   = state.walls[0].point.y();
      s.upper_y                   = state.walls[1].point.y();
      s.upper_platen_displacement = state.walls[1].point - reference.platen;
      s.lower_platen_force        = result.wall_force[0];
      s.upper_platen_force        = result.wall_force[1];
      if (state.walls.size() >= 4)
        {
          s.left_x  = state.walls[2].point.x();
          s.right_x = state.walls[3].point.x();
        }
      s.cell_width = state.width() ? state.width()->width : 0;
    }
  } // namespace

  Snapshot make_snapshot(const State        &state,
                         const StepResult   &result,
                         const WindowForces &window,
                         const Reference    &reference,
                         const StepSetting  &setting)
  {
    const Grains &g = state.grains;
    Snapshot      s;
    const Strains strains = strains_of(state, reference);
    s.axial_strain        = strains.axial;
    s.shear_strain        = strains.shear;
    s.time                = state.time;
    s.step                = setting.step;
    s.residual            = result.solve.residual;
    s.mean_diameter       = setting.mean_diameter;
    s.position            = g.position;
    s.velocity            = g.velocity;
    s.rotation            = g.rotation;
    s.spin                = g.spin;
    s.radius              = g.radius;
    s.mass                = g.mass;
    s.fixed               = g.fixed;
    for (std::size_t i = 0; i < g.size(); ++i)
      s.displacement.push_back(g.position[i] - reference.position[i]);
    add_contacts(state, result, setting, s);
    s.internal_moment           = internal_moments(g.position, s.contacts, spin_terms(g));
    s.window_forces             = window.time > 0 ? window.mean_forces(state) : s.contacts;
    s.mean_spin_term            = window.time > 0 ? window.mean_spin_term() : spin_terms(g);
    s.window_time               = window.time;
    s.window_dissipation        = window.time > 0 ? window.dissipation() : std::vector<double>(s.contacts.size(), 0.);
    s.window_impact_dissipation = window.time > 0 ? window.impact_dissipation() : std::vector<double>(s.contacts.size(), 0.);
    s.mean_internal_moment      = internal_moments(g.position, s.window_forces, s.mean_spin_term);
    s.rattler                   = rattlers(result, g);
    s.applied_force             = result.applied_force;
    if (result.accuracy)
      {
        s.stress_error  = result.accuracy->stress_error;
        s.stress_change = result.accuracy->stress_change;
      }
    add_boundary(state, result, reference, s);
    return s;
  }
} // namespace diptych::discrete
