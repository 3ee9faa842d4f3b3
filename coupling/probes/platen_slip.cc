// diptych: traction and slip along a platen, and the friction law of the pair
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/platen_slip.h"

#include <algorithm>
#include <cmath>

#include "coupling/fields/node_transfer.h"
#include "coupling/statistics/student.h"

namespace diptych::coupling
{
  namespace
  {
    struct Fit
    {
      double friction = NAN, slip_length = NAN, misfit = INFINITY;
    };

    // The best friction for one scale of the slip: with h = tanh(v / scale) the law is linear in it.
    Fit fit_at(const double scale, const PlatenParts &parts)
    {
      double th = 0, hh = 0, tt = 0;
      for (const PlatenPart &part : parts)
        if (part.normal > 0)
          {
            const double t = -part.shear / part.normal, h = std::tanh(part.slip / scale);
            th += part.normal * t * h;
            hh += part.normal * h * h;
            tt += part.normal * t * t;
          }
      if (hh == 0)
        return {};
      const double friction = th / hh;
      return {friction, scale / friction, tt - th * friction};
    }

    // The scale lies between a hundredth and a hundred times the largest slip. Steps of 10 %, then golden section.
    Fit fit(const PlatenParts &parts)
    {
      double largest = 0;
      for (const PlatenPart &part : parts)
        largest = std::max(largest, std::abs(part.slip));
      if (largest == 0)
        return {};
      const auto at   = [&](const double log_scale) { return fit_at(largest * std::exp(log_scale), parts); };
      double     best = 0;
      for (double z = -4.6; z <= 4.6; z += 0.1)
        if (at(z).misfit < at(best).misfit)
          best = z;
      const double golden = (std::sqrt(5.) - 1) / 2;
      double       low = best - 0.1, high = best + 0.1;
      while (high - low > 1e-6)
        {
          const double a = high - golden * (high - low), b = low + golden * (high - low);
          (at(a).misfit < at(b).misfit ? high : low) = at(a).misfit < at(b).misfit ? b : a;
        }
      // Traction in proportion to the slip has no largest value.
      return low > std::log(2.) ? Fit() : at((low + high) / 2);
    }

    // value and 95 % interval from the values without each of the n groups.
    Interval jackknife(const double value, const std::vector<double> &without)
    {
      const double n    = double(without.size());
      double       mean = 0, sum = 0;
      for (const double v : without)
        mean += v / n;
      for (const double v : without)
        sum += (v - mean) * (v - mean);
      const double half = n > 1 ? student_quantile(0.975, n - 1) * std::sqrt((n - 1) / n * sum) : NAN;
      return {value, value - half, value + half};
    }
  } // namespace

  PlatenContacts platen_contacts(const discrete::Snapshot &from, const discrete::Snapshot &to)
  {
    const int      lower  = int(to.position.size());
    const double   travel = (to.upper_platen_displacement - from.upper_platen_displacement).x();
    PlatenContacts contacts;
    for (const discrete::ContactForce &c : to.window_forces)
      if (c.j == lower || c.j == lower + 1)
        {
          const std::size_t i     = std::size_t(c.i);
          const double      moved = (to.displacement[i] - from.displacement[i]).x() - (c.j == lower ? 0 : travel);
          PlatenContact     contact;
          contact.x      = c.point.x();
          contact.normal = c.force.dot(c.normal);
          contact.shear  = c.force.x();
          contact.slip   = moved / (to.progress - from.progress);
          (c.j == lower ? contacts.lower : contacts.upper).push_back(contact);
        }
    return contacts;
  }

  PlatenContacts platen_contacts(const continuum::Snapshot &from, const continuum::Snapshot &to, const double travel)
  {
    const std::vector<Eigen::Vector2d> before = displacement_at_nodes_of(from, to);
    double                             low = INFINITY, high = -INFINITY;
    for (const Eigen::Vector2d &x : to.position)
      {
        low  = std::min(low, x.y());
        high = std::max(high, x.y());
      }
    PlatenContacts contacts;
    for (std::size_t k = 0; k < to.platen_force.size(); ++k)
      if (const Eigen::Vector2d &force = to.platen_force[k]; force.y() != 0)
        {
          const bool    upper = to.position[k].y() > 0.5 * (low + high);
          const double  moved = (to.displacement[k] - before[k]).x() - (upper ? travel : 0);
          PlatenContact contact;
          contact.x      = to.position[k].x();
          contact.normal = upper ? -force.y() : force.y();
          contact.shear  = force.x();
          contact.slip   = moved / (to.progress - from.progress);
          (upper ? contacts.upper : contacts.lower).push_back(contact);
        }
    return contacts;
  }

  PlatenParts platen_parts(const PlatenContacts &both, const bool is_mirror_symmetric, const int n_parts)
  {
    PlatenParts  parts(static_cast<std::size_t>(n_parts));
    const double left = is_mirror_symmetric ? 0 : -1;
    for (const auto &[contacts, turn] : {std::pair{&both.lower, 1.}, {&both.upper, -1.}})
      {
        double low = INFINITY, high = -INFINITY;
        for (const PlatenContact &c : *contacts)
          {
            low  = std::min(low, c.x);
            high = std::max(high, c.x);
          }
        for (const PlatenContact &c : *contacts)
          {
            const double place  = turn * (2 * c.x - low - high) / std::max(high - low, 1e-300);
            const double side   = is_mirror_symmetric && place < 0 ? -turn : turn;
            const double within = ((is_mirror_symmetric ? std::abs(place) : place) - left) / (1 - left);
            PlatenPart  &part   = parts[std::size_t(std::clamp(int(std::floor(within * n_parts)), 0, n_parts - 1))];
            part.normal += c.normal;
            part.shear += side * c.shear;
            part.slip += side * c.normal * c.slip;
          }
      }
    for (std::size_t k = 0; k < parts.size(); ++k)
      {
        parts[k].place = left + (1 - left) * (double(k) + 0.5) / n_parts;
        parts[k].slip /= parts[k].normal > 0 ? parts[k].normal : 1;
      }
    return parts;
  }

  PlatenParts sum_of(const std::vector<PlatenParts> &windows)
  {
    PlatenParts sum(windows.empty() ? 0 : windows.front().size());
    for (const PlatenParts &window : windows)
      for (std::size_t k = 0; k < sum.size(); ++k)
        {
          const double total = sum[k].normal + window[k].normal;
          sum[k].slip        = total > 0 ? (sum[k].normal * sum[k].slip + window[k].normal * window[k].slip) / total : 0.;
          sum[k].place       = window[k].place;
          sum[k].normal      = total;
          sum[k].shear += window[k].shear;
        }
    return sum;
  }

  PlatenFriction platen_friction(const std::vector<PlatenParts> &windows)
  {
    const Fit           all = fit(sum_of(windows));
    std::vector<double> friction, slip_length;
    for (std::size_t w = 0; w < windows.size(); ++w)
      {
        std::vector<PlatenParts> others = windows;
        others.erase(others.begin() + std::ptrdiff_t(w));
        const Fit without = fit(sum_of(others));
        friction.push_back(without.friction);
        slip_length.push_back(without.slip_length);
      }
    return {jackknife(all.friction, friction), jackknife(all.slip_length, slip_length)};
  }
} // namespace diptych::coupling
