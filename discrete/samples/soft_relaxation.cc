// diptych: first packing without overlaps, by relaxation of soft discs
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/soft_relaxation.h"

#include <algorithm>
#include <cmath>

#include "discrete/contacts/contact_detection.h"

namespace diptych::discrete
{
  namespace
  {
    using Vectors = std::vector<Eigen::Vector2d>;

    double contact_forces(const std::vector<Contact> &contacts, Vectors &force)
    {
      double largest = 0;
      std::fill(force.begin(), force.end(), Eigen::Vector2d::Zero());
      for (const Contact &c : contacts)
        {
          largest = std::max(largest, -c.gap);
          force[c.i] -= c.gap * c.normal;
          if (std::size_t(c.j) < force.size())
            force[c.j] += c.gap * c.normal;
        }
      return largest;
    }

    double dot(const Vectors &a, const Vectors &b)
    {
      double sum = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += a[i].dot(b[i]);
      return sum;
    }
  } // namespace

  RelaxationReport relax_soft_discs(State                       &state,
                                    const double                 largest_overlap,
                                    const int                    max_iterations,
                                    const std::function<bool()> &go_on)
  {
    // Constants of FIRE. Unit masses and stiffness give a highest frequency of about 3.5, so 0.4 is a safe step.
    constexpr double largest_step = 0.4, shrink = 0.5, grow = 1.1, mixing_start = 0.1, mixing_decay = 0.99;
    constexpr int    patience = 5;

    Grains       &g = state.grains;
    Vectors       velocity(g.size(), Eigen::Vector2d::Zero()), force = velocity;
    double        step = 0.1, mixing = mixing_start;
    int           downhill = 0;
    NeighbourList neighbours;

    const std::vector<double> no_margin(g.size(), 0.);
    RelaxationReport          report;
    const auto                goes_on = [&] {
      report.stopped = report.stopped || (go_on && !go_on());
      return !report.stopped;
    };
    for (; report.iterations < max_iterations; ++report.iterations)
      {
        if (!goes_on())
          break;
        const std::vector<Contact> contacts = neighbours.find_contacts(state, no_margin, goes_on);
        if (report.stopped)
          break;
        report.largest_overlap = contact_forces(contacts, force);
        if (report.largest_overlap < largest_overlap)
          break;
        const double power = dot(force, velocity);
        if (power > 0)
          {
            const double ratio = std::sqrt(dot(velocity, velocity) / dot(force, force));
            for (std::size_t i = 0; i < g.size(); ++i)
              velocity[i] = (1 - mixing) * velocity[i] + mixing * ratio * force[i];
            if (++downhill > patience)
              {
                step = std::min(largest_step, grow * step);
                mixing *= mixing_decay;
              }
          }
        else
          {
            std::fill(velocity.begin(), velocity.end(), Eigen::Vector2d::Zero());
            step *= shrink;
            mixing   = mixing_start;
            downhill = 0;
          }
        for (std::size_t i = 0; i < g.size(); ++i)
          {
            velocity[i] += step * force[i];
            g.position[i] += step * velocity[i];
          }
      }
    return report;
  }
} // namespace diptych::discrete
