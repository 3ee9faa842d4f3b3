// diptych: traction and slip along a platen, and the friction law of the pair
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/platen_slip.h"

#include <algorithm>
#include <cmath>

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
    Fit fit_at(const double scale, const std::vector<PlatenPart> &parts)
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
    Fit fit(const std::vector<PlatenPart> &parts)
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
      return at((low + high) / 2);
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

  std::vector<PlatenContact> platen_contacts(const discrete::Snapshot &from, const discrete::Snapshot &to, const bool upper)
  {
    const int                  platen = int(to.position.size()) + upper;
    const double               travel = upper ? (to.upper_platen_displacement - from.upper_platen_displacement).x() : 0;
    std::vector<PlatenContact> contacts;
    for (const discrete::ContactForce &c : to.window_forces)
      if (c.j == platen)
        {
          const std::size_t i     = std::size_t(c.i);
          const double      moved = (to.displacement[i] - from.displacement[i]).x() - travel;
          contacts.push_back({c.point.x(), c.force.dot(c.normal), c.force.x(), moved / (to.progress - from.progress)});
        }
    return contacts;
  }

  std::vector<PlatenPart> platen_parts(const std::vector<PlatenContact> &lower,
                                       const std::vector<PlatenContact> &upper,
                                       const PlatenFrame                &frame,
                                       const int                         n_parts)
  {
    std::vector<PlatenPart> parts(static_cast<std::size_t>(n_parts));
    const double            left = frame.is_mirror_symmetric ? 0 : -1;
    const auto              add  = [&](const PlatenContact &c, const double turn) {
      const double place  = turn * (c.x - frame.middle) / frame.half_width;
      const double side   = frame.is_mirror_symmetric && place < 0 ? -turn : turn;
      const double within = ((frame.is_mirror_symmetric ? std::abs(place) : place) - left) / (1 - left);
      PlatenPart  &part   = parts[std::size_t(std::clamp(int(std::floor(within * n_parts)), 0, n_parts - 1))];
      part.normal += c.normal;
      part.shear += side * c.shear;
      part.slip += side * c.normal * c.slip;
    };
    for (const PlatenContact &c : lower)
      add(c, 1);
    for (const PlatenContact &c : upper)
      add(c, -1);
    for (PlatenPart &part : parts)
      part.slip /= part.normal > 0 ? part.normal : 1;
    return parts;
  }

  PlatenFriction platen_friction(const std::vector<std::vector<PlatenPart>> &windows)
  {
    const auto but = [&](const std::size_t left_out) {
      std::vector<PlatenPart> sum(windows.front().size());
      for (std::size_t w = 0; w < windows.size(); ++w)
        for (std::size_t k = 0; k < sum.size() && w != left_out; ++k)
          {
            const PlatenPart &part  = windows[w][k];
            const double      total = sum[k].normal + part.normal;
            sum[k].slip             = total > 0 ? (sum[k].normal * sum[k].slip + part.normal * part.slip) / total : 0.;
            sum[k].normal           = total;
            sum[k].shear += part.shear;
          }
      return fit(sum);
    };
    const Fit           all = but(windows.size());
    std::vector<double> friction, slip_length;
    for (std::size_t w = 0; w < windows.size(); ++w)
      {
        const Fit one = but(w);
        friction.push_back(one.friction);
        slip_length.push_back(one.slip_length);
      }
    return {jackknife(all.friction, friction), jackknife(all.slip_length, slip_length)};
  }

  PlatenFriction platen_friction(const std::vector<discrete::Snapshot> &snapshots, const bool is_mirror_symmetric)
  {
    std::vector<std::vector<PlatenPart>> windows;
    for (std::size_t k = 1; k < snapshots.size(); ++k)
      {
        const discrete::Snapshot &from = snapshots[k - 1], &to = snapshots[k];
        const double              left  = (to.outline.left.front().x() + to.outline.left.back().x()) / 2;
        const double              right = (to.outline.right.front().x() + to.outline.right.back().x()) / 2;
        windows.push_back(platen_parts(platen_contacts(from, to, false), platen_contacts(from, to, true),
                                       {(left + right) / 2, (right - left) / 2, is_mirror_symmetric}, 10));
      }
    return windows.empty() ? PlatenFriction() : platen_friction(windows);
  }
} // namespace diptych::coupling
