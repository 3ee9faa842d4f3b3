// diptych: checks of an imported sample
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/arrived_sample.h"
#include "coupling/scene/scene_error.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupling/cells/point_bins.h"
#include "coupling/processes/stop_signal.h"

namespace diptych::coupling
{
  namespace
  {
    // Values above these limits cause a warning. The balance is relative to the mean contact force. It is 1e-6 if a code writes
    // nine digits of the forces that it integrated. It is 0.02 if the code evaluates them again after the step. In slow motion
    // without resultants the rms over all grains stays below 0.3. The worst grain of tests/foreign and of an exported
    // moreau_quick has 0.044. Contacts of rigid grains have gaps up to 0.002 mean diameters. Contact points of soft ones lie up
    // to half an overlap off.
    constexpr double doubtful_balance = 0.05, doubtful_motion = 0.3, doubtful_grain = 3, doubtful_stress = 0.05,
                     doubtful_overlap = 0.05, doubtful_overlap_told = 0.005, doubtful_wall_force = 0.03,
                     doubtful_wall_place = 0.02, doubtful_apart = 0.05;

    // Contacts with a force, per grain. Discs with friction that support each other have 1.5, if floating grains do not count.
    constexpr double few_contacts = 0.5;

    // Changes from one frame to the next. Rigid grains keep their radius to the digits of the file, and no tested sample
    // densifies so much.
    constexpr double doubtful_radius = 1e-4, doubtful_density = 0.15;

    // Equal discs fill at most 0.907 of the area. Overlaps of 9 % of the diameter raise that to 1.1, and the usual 0.84 of a
    // random packing needs 13 %. More means that walls, radii or units are wrong.
    constexpr double most_solid_fraction = 1.1;

    // Share of the grains that may have left the sample through a wall.
    constexpr double most_beyond = 0.05;

    // Discs that touch have at most three pairs per disc, whatever their sizes.
    constexpr std::size_t most_overlaps = 20;

    double area_of(const ArrivedFrame &f)
    {
      return (f.wall[int(Side::right)] - f.wall[int(Side::left)]) * (f.wall[int(Side::upper)] - f.wall[int(Side::lower)]);
    }

    void check_walls(const ArrivedFrame &f)
    {
      for (const auto &[low, high] : {std::pair(Side::lower, Side::upper), std::pair(Side::left, Side::right)})
        if (f.wall[std::size_t(low)] >= f.wall[std::size_t(high)])
          throw SceneError(f.wall_file + ": frame " + f.name + ": the " + side_names[int(low)] + " wall lies beyond the " +
                           side_names[int(high)] + " one");
    }

    // A wall with grains on both sides is in the wrong place or faces the wrong way.
    void refuse_walls_across(const ArrivedFrame &f)
    {
      for (const int side : {0, 1, 2, 3})
        {
          const double      sign   = side % 2 == 0 ? 1 : -1;
          const std::size_t beyond = std::size_t(
            std::count_if(f.position.begin(), f.position.end(), [&](const Eigen::Vector2d &x) {
              return sign * (x[side < 2 ? 1 : 0] - f.wall[std::size_t(side)]) < 0; // false without a wall
            }));
          if (double(beyond) > most_beyond * double(f.position.size()))
            throw SceneError(f.wall_file + ": frame " + f.name + ": the centres of " + std::to_string(beyond) + " of " +
                             std::to_string(f.position.size()) + " grains lie beyond the " + side_names[side] +
                             " wall; it stands across the sample");
        }
    }

    void count_contacts(const ArrivedFrame &f, ArrivalCheck &check)
    {
      const int n = int(f.position.size());
      for (const discrete::ContactForce &c : f.contacts)
        switch (c.j - n)
          {
          case int(Side::lower):
            ++check.lower_contacts;
            break;
          case int(Side::upper):
            ++check.upper_contacts;
            break;
          case int(Side::left):
            ++check.left_contacts;
            break;
          case int(Side::right):
            ++check.right_contacts;
            break;
          default:
            ++check.contacts;
          }
    }

    // Root mean square over all grains, and the largest, of the resultant force / mean contact force.
    struct Residual
    {
      double      rms = 0, worst = -1;
      std::size_t worst_grain = 0;
    };

    Residual residual_of(const std::vector<Eigen::Vector2d> &rest, const double mean, const bool vertical_only)
    {
      Residual residual;
      double   square = 0;
      for (std::size_t i = 0; i < rest.size(); ++i)
        {
          const double miss = (vertical_only ? std::abs(rest[i].y()) : rest[i].norm()) / mean;
          square += miss * miss / double(rest.size());
          if (miss > residual.worst)
            {
              residual.worst       = miss;
              residual.worst_grain = i;
            }
        }
      residual.rms = std::sqrt(square);
      return residual;
    }

    // Contact forces and weight against the resultant, or against zero. Some codes leave the weight out of the resultant.
    void check_balance(const Arrival &arrival, const ArrivedFrame &f, ArrivalCheck &check)
    {
      const std::size_t            n = f.position.size();
      std::vector<Eigen::Vector2d> rest(n, Eigen::Vector2d::Zero());
      double                       mean = 0;
      for (const discrete::ContactForce &c : f.contacts)
        {
          rest[std::size_t(c.i)] += c.force;
          if (std::size_t(c.j) < n)
            rest[std::size_t(c.j)] -= c.force;
          mean += c.force.norm() / double(f.contacts.size());
        }
      check.against_resultants = f.resultant[0].allFinite();
      std::vector<Eigen::Vector2d> with_weight;
      for (std::size_t i = 0; i < n; ++i)
        {
          if (check.against_resultants)
            rest[i] -= f.resultant[i];
          with_weight.push_back(rest[i] + f.weight[i]);
        }
      // The files do not contain the pressure on free sides.
      const bool vertical_only = !check.against_resultants && !std::isfinite(f.wall[int(Side::left)]);
      Residual   residual      = residual_of(with_weight, mean, vertical_only);
      if (const Residual without = residual_of(rest, mean, vertical_only); check.against_resultants && without.rms < residual.rms)
        residual = without;
      check.balance_rms         = residual.rms;
      check.balance_worst       = residual.worst;
      check.balance_worst_grain = arrival.id[residual.worst_grain];
      if (check.against_resultants || !std::isfinite(check.mass) || f.weight[0] != Eigen::Vector2d::Zero())
        return;
      Eigen::Vector2d gravity = Eigen::Vector2d::Zero();
      for (const Eigen::Vector2d &force : rest)
        gravity -= force / check.mass;
      for (std::size_t i = 0; i < n; ++i)
        rest[i] += f.mass[i] * gravity;
      if (residual_of(rest, mean, vertical_only).rms < 0.5 * residual.rms)
        check.balancing_gravity = gravity;
    }

    // Sums of force (x) branch, row of the force. Branches end at the contact points on walls. The stress of the walls uses the
    // lower left corner, so that it does not depend on the origin.
    void add_stresses(const ArrivedFrame &f, ArrivalCheck &check)
    {
      const std::size_t     n    = f.position.size();
      const double          area = area_of(f);
      const Eigen::Vector2d corner(f.wall[int(Side::left)], f.wall[int(Side::lower)]);
      Eigen::Matrix2d       contacts = Eigen::Matrix2d::Zero(), walls = contacts;
      for (const discrete::ContactForce &c : f.contacts)
        {
          const Eigen::Vector2d &x = f.position[std::size_t(c.i)];
          contacts += c.force * (x - (std::size_t(c.j) < n ? f.position[std::size_t(c.j)] : c.point)).transpose();
          if (std::size_t(c.j) >= n)
            walls -= c.force * (c.point - corner).transpose();
        }
      for (std::size_t i = 0; i < n; ++i)
        walls -= f.weight[i] * (f.position[i] - corner).transpose();
      check.contact_stress = contacts / area;
      const bool touched   = check.lower_contacts > 0 && check.upper_contacts > 0 && check.left_contacts > 0 &&
                           check.right_contacts > 0;
      if (!touched)
        return;
      check.wall_stress       = walls / area;
      check.stress_difference = (contacts - walls).cwiseAbs().maxCoeff() / walls.cwiseAbs().maxCoeff();
    }

    void check_wall_forces(const ArrivedFrame &f, ArrivalCheck &check)
    {
      double difference = 0, scale = 0;
      for (const int side : {0, 1, 2, 3})
        {
          const Eigen::Vector2d &told = f.told_wall_force[std::size_t(side)], &sum = f.wall_force[std::size_t(side)];
          if (told.allFinite() && sum.allFinite())
            {
              difference = std::max(difference, (told - sum).norm());
              scale      = std::max(scale, told.norm());
            }
        }
      if (scale > 0)
        check.wall_force_difference = difference / scale;
    }

    void check_overlaps(const Arrival &arrival, const ArrivedFrame &f, ArrivalCheck &check)
    {
      double largest = -HUGE_VAL, mean = 0;
      for (std::size_t i = 0; i < f.position.size(); ++i)
        {
          mean += f.radius[i] / double(f.radius.size());
          for (const int side : {0, 1, 2, 3})
            if (const double place = f.wall[std::size_t(side)]; std::isfinite(place))
              {
                const double height = f.position[i][side < 2 ? 1 : 0] - place;
                largest             = std::max(largest, f.radius[i] - (side % 2 == 0 ? height : -height));
              }
        }
      // Each grain searches those that are not larger, so that one large grain does not make all pairs neighbours.
      const PointBins bins(f.position, 2 * mean);
      std::size_t     n_overlaps = 0;
      for (unsigned int i = 0; i < f.position.size(); ++i)
        {
          leave_if_stopped("import");
          bins.for_each_near(f.position[i], 2 * f.radius[i], [&](const unsigned int j) {
            if (f.radius[j] > f.radius[i] || (f.radius[j] == f.radius[i] && j <= i))
              return;
            const double overlap = f.radius[i] + f.radius[j] - (f.position[i] - f.position[j]).norm();
            largest              = std::max(largest, overlap);
            n_overlaps += overlap > 0;
          });
          if (n_overlaps > most_overlaps * f.position.size())
            throw SceneError(f.grain_file + ": frame " + f.name + ": more than " + std::to_string(most_overlaps) +
                             " overlaps per grain; do grains lie on top of each other?");
        }
      check.largest_overlap = largest / arrival.mean_diameter;
    }

    void find_doubts(const ArrivedFrame &f, const ArrivalCheck &c, Arrival &arrival)
    {
      const double diameter = arrival.mean_diameter;
      const auto   doubt    = [&](const bool is_doubtful, const std::string &what, const double value) {
        std::ostringstream text;
        text.precision(3);
        text << "frame " << c.name << ": " << what << " " << 100 * value << " %";
        if (is_doubtful)
          arrival.doubtful.push_back(text.str());
      };
      const std::string grain = "grain " + std::to_string(c.balance_worst_grain);
      // Without contacts on walls, which is reported, grains at the walls cannot be in balance.
      const bool all_told = std::find(arrival.lacking.begin(), arrival.lacking.end(), "contacts with walls") ==
                            arrival.lacking.end();
      doubt(all_told && c.against_resultants && c.balance_worst > doubtful_balance,
            "contact forces on " + grain + " differ from its resultant; difference / mean contact force:", c.balance_worst);
      std::ostringstream gravity;
      if (c.balancing_gravity.allFinite())
        gravity << "their weight missing? --gravity " << c.balancing_gravity.x() << "," << c.balancing_gravity.y();
      doubt(all_told && !c.against_resultants && c.balance_rms > doubtful_motion,
            "grains are far from balance (" +
              (gravity.str().empty() ? "a contact missing, repeated or of the wrong sign?" : gravity.str()) +
              "); rms / mean contact force:",
            c.balance_rms);
      doubt(
        all_told && !c.against_resultants && c.balance_worst > doubtful_grain,
        grain + " is far from balance (a contact missing or of another grain?); residual / mean contact force:", c.balance_worst);
      doubt(c.stress_difference > doubtful_stress,
            "stress of contacts and stress of wall forces differ; relative difference:", c.stress_difference);
      doubt(c.wall_force_difference > doubtful_wall_force,
            "wall forces in the files and sums over their contacts differ; relative difference:", c.wall_force_difference);
      doubt(c.largest_overlap > doubtful_overlap,
            "discs overlap each other or a wall; largest overlap / mean diameter:", c.largest_overlap);
      doubt(f.overlap_miss > doubtful_overlap_told * diameter,
            "overlaps in the files and of the discs differ; largest difference / mean diameter:", f.overlap_miss / diameter);
      doubt(f.wall_miss > doubtful_wall_place * diameter,
            "a wall lies apart from its contact points; distance / mean diameter:", f.wall_miss / diameter);
      const double contacts = double(f.contacts.size()) / double(c.grains);
      doubt(f.has_contacts && contacts < few_contacts,
            "there are too few contacts to hold the grains (contacts lost?); contacts per grain:", contacts);
      doubt(f.widest_gap > doubtful_apart * diameter,
            "two bodies in contact do not touch; gap / mean diameter:", f.widest_gap / diameter);
      doubt(f.point_miss > doubtful_apart * diameter,
            "a contact point lies off the place where the surfaces meet; distance / mean diameter:", f.point_miss / diameter);
      if (c.contact_stress.trace() <= 0) // false without contacts
        throw SceneError(f.grain_file + ": frame " + c.name +
                         ": the mean stress of the contacts is tensile; do the forces act on the other body?");
    }

    void compare_with_frame_before(Arrival &arrival, const std::size_t k)
    {
      const ArrivedFrame &before = arrival.frames[k - 1], &now = arrival.frames[k];
      const auto          say = [&](const std::string &what, const double was, const double is) {
        std::ostringstream text;
        text.precision(6);
        text << "frame " << now.name << ": " << what << " is " << is << " instead of " << was << " in the frame before";
        arrival.doubtful.push_back(text.str());
      };
      const auto compare = [&](const std::string &what, const std::vector<double> &was, const std::vector<double> &is) {
        for (std::size_t i = 0; i < is.size(); ++i)
          if (std::abs(is[i] - was[i]) > doubtful_radius * was[i])
            return say("the " + what + " of grain " + std::to_string(arrival.id[i]), was[i], is[i]); // one such grain is enough
      };
      compare("radius", before.radius, now.radius);
      compare("mass", before.mass, now.mass);
      const double was = arrival.checks[k - 1].solid_fraction, is = arrival.checks[k].solid_fraction;
      if (std::abs(is - was) > doubtful_density * was)
        say("the solid fraction between the walls", was, is);
    }
  } // namespace

  void check_arrival(Arrival &arrival)
  {
    for (const ArrivedFrame &f : arrival.frames)
      {
        ArrivalCheck check;
        check.name   = f.name;
        check.time   = f.time;
        check.grains = int(f.position.size());
        check_walls(f);
        refuse_walls_across(f);
        double mass = 0, discs = 0;
        for (std::size_t i = 0; i < f.position.size(); ++i)
          {
            mass += f.mass[i];
            discs += M_PI * f.radius[i] * f.radius[i];
          }
        check.mass           = mass;
        check.solid_fraction = discs / area_of(f);
        if (check.solid_fraction > most_solid_fraction) // false without side walls
          throw SceneError(f.wall_file + ": frame " + f.name + ": the discs cover " +
                           std::to_string(int(100 * check.solid_fraction)) + " % of the area between the walls; at most " +
                           std::to_string(int(100 * most_solid_fraction)) +
                           " % is possible. Check the places of the walls and the radii (is one of them a diameter?)");
        const double first = arrival.frames[0].wall[1] - arrival.frames[0].wall[0];
        check.axial_strain = 1 - (f.wall[1] - f.wall[0]) / first;
        check_overlaps(arrival, f, check);
        if (f.has_contacts && !f.contacts.empty())
          {
            count_contacts(f, check);
            check_balance(arrival, f, check);
            add_stresses(f, check);
            check_wall_forces(f, check);
          }
        find_doubts(f, check, arrival);
        arrival.checks.push_back(check);
      }
    for (std::size_t k = 1; k < arrival.frames.size(); ++k)
      compare_with_frame_before(arrival, k);
  }
} // namespace diptych::coupling
