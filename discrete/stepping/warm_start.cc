// diptych: first guess of the solution of a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/stepping/warm_start.h"

#include <algorithm>

#include "discrete/contacts/contact_law.h"
#include "discrete/contacts/natural_map.h"

namespace diptych::discrete
{
  namespace
  {
    std::vector<BodyVelocity> at_rest(std::vector<BodyVelocity> bodies)
    {
      for (BodyVelocity &v : bodies)
        v.x = v.y = v.surface = 0;
      return bodies;
    }
  } // namespace

  FirstGuess first_guess(const std::vector<PairImpulse> &previous, const std::vector<Contact> &contacts)
  {
    FirstGuess result{std::vector<Impulse>(contacts.size()), std::vector<Impulse>(contacts.size())};
    auto       pair = previous.begin(); // both lists ascend in (i, j)
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        const Contact &c = contacts[k];
        while (pair != previous.end() && (pair->i < c.i || (pair->i == c.i && pair->j < c.j)))
          ++pair;
        if (pair == previous.end())
          break;
        // Selects without a branch, because no branch predictor can foresee which contacts were there before.
        const PairImpulse  none{c.i, c.j, 0, 0};
        const bool         known = pair->i == c.i && pair->j == c.j;
        const PairImpulse &r     = *(known ? &*pair : &none);
        result.impulses[k]       = {r.normal, r.tangential, r.rolling};
        result.changes[k]        = {r.normal_change, r.tangential_change, r.rolling_change};
        pair += known;
      }
    return result;
  }

  void extrapolate(const ContactProblem &problem, const std::vector<Impulse> &changes, std::vector<Impulse> &impulses)
  {
    const std::vector<int> changed = acting_contacts(changes);
    if (changed.empty())
      return;
    const std::vector<BodyVelocity> v = velocities(problem, impulses);
    const std::vector<BodyVelocity> w = velocities_from(at_rest(problem.free_velocity), problem, changes, changed); // due to them
    double                          work = 0, change_of_work = 0;
    for (const int k : changed)
      {
        const ContactRow      &c = problem.contacts[k];
        const RelativeVelocity u = velocity_with_give(c, v, impulses[k]), du = velocity_with_give(c, w, changes[k]);
        const double           violation = u.tangential + c.tangential_term;
        const bool             slides    = is_slipping(c.friction, impulses[k]) &&
                            impulses[k].tangential * violation < 0; // in the right direction
        const double tangential = slides ? 0 : changes[k].tangential;
        work += changes[k].normal * (u.normal + c.normal_term) + tangential * violation;
        change_of_work += changes[k].normal * du.normal + tangential * du.tangential;
        if (c.rolling_friction == 0)
          continue;
        const double turning = rolling_with_give(c, rolling_velocity(c, v), impulses[k]),
                     bound   = coulomb_margin * c.rolling_friction * impulses[k].normal;
        const bool   rolls   = std::abs(impulses[k].rolling) > bound && impulses[k].rolling * turning < 0;
        const double rolling = rolls ? 0 : changes[k].rolling;
        work += rolling * turning;
        change_of_work += rolling * (rolling_velocity(c, w) + c.tangential_compliance * changes[k].rolling);
      }
    if (!(change_of_work > 0))
      return;
    const double share = std::clamp(-work / change_of_work, -1., 1.);
    for (const int k : changed)
      {
        Impulse &r         = impulses[k];
        r.normal           = std::max(0., r.normal + share * changes[k].normal);
        const double bound = problem.contacts[k].friction * r.normal;
        r.tangential       = std::clamp(r.tangential + share * changes[k].tangential, -bound, bound);
        const double most  = problem.contacts[k].rolling_friction * r.normal;
        r.rolling          = std::clamp(r.rolling + share * changes[k].rolling, -most, most);
      }
  }
} // namespace diptych::discrete
