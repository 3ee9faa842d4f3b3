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

    // Most pairs in a list are.
    bool are_apart(const State &state, const int i, const int j)
    {
      const Grains         &g      = state.grains;
      const Eigen::Vector2d branch = g.position[i] - g.position[j] - nearest_image(state, g.position[i], g.position[j]).shift;
      const double          reach  = g.radius[i] + g.radius[j];
      return branch.squaredNorm() >= reach * reach;
    }

    // Returns the largest overlap [length]. Two bodies repel each other by their overlap.
    double contact_forces(const State &state, const std::vector<NeighbourList::Pair> &pairs, Vectors &force)
    {
      const int n       = int(state.grains.size());
      double    largest = 0;
      std::fill(force.begin(), force.end(), Eigen::Vector2d::Zero());
      for (const auto &[i, j] : pairs)
        {
          if (j < n && are_apart(state, i, j))
            continue;
          const Contact c = make_contact(state, i, j);
          if (c.gap >= 0)
            continue;
          largest = std::max(largest, -c.gap);
          force[i] -= c.gap * c.normal;
          if (j < n)
            force[j] += c.gap * c.normal;
        }
      return largest;
    }

    struct Products
    {
      double power = 0, velocity_squared = 0, force_squared = 0;
    };

    Products products(const Vectors &force, const Vectors &velocity)
    {
      Products sum;
      for (std::size_t i = 0; i < force.size(); ++i)
        {
          sum.power += force[i].dot(velocity[i]);
          sum.velocity_squared += velocity[i].squaredNorm();
          sum.force_squared += force[i].squaredNorm();
        }
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
        const std::vector<NeighbourList::Pair> &pairs = neighbours.near_pairs(state, no_margin, goes_on);
        if (report.stopped)
          break;
        report.largest_overlap = contact_forces(state, pairs, force);
        if (report.largest_overlap < largest_overlap)
          break;
        const Products sum  = products(force, velocity);
        double         kept = 0, turned = 0; // factors of velocity and force
        if (sum.power > 0)
          {
            kept   = 1 - mixing;
            turned = mixing * std::sqrt(sum.velocity_squared / sum.force_squared);
            if (++downhill > patience)
              {
                step = std::min(largest_step, grow * step);
                mixing *= mixing_decay;
              }
          }
        else
          {
            step *= shrink;
            mixing   = mixing_start;
            downhill = 0;
          }
        for (std::size_t i = 0; i < g.size(); ++i)
          {
            velocity[i] = kept * velocity[i] + turned * force[i] + step * force[i];
            g.position[i] += step * velocity[i];
          }
      }
    return report;
  }
} // namespace diptych::discrete
