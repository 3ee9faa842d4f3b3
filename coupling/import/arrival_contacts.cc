// diptych: puts contacts and walls of another code's frame in order
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/arrived_sample.h"
#include "coupling/scene/scene_error.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace diptych::coupling
{
  namespace
  {
    using discrete::ContactForce;

    constexpr int    axis_of[]   = {1, 1, 0, 0};   // axis normal to a side
    constexpr double inward_of[] = {1, -1, 1, -1}; // direction into the sample along that axis
    constexpr double same_force  = 1e-6;           // for the two rows of one pair, relative
    constexpr double flat        = 0.02;           // allowed scatter of a wall's contact points along its normal [mean radii]

    Eigen::Vector2d inward(const int side)
    {
      Eigen::Vector2d n = Eigen::Vector2d::Zero();
      n[axis_of[side]]  = inward_of[side];
      return n;
    }

    std::string place_of(const ForeignFrame &frame, const ForeignContact &c)
    {
      return frame.contact_file + (c.line > 0 ? ", line " + std::to_string(c.line) : "") + ": frame " + frame.name;
    }

    int index_of(const Arrival &arrival, const long id)
    {
      const auto found = std::lower_bound(arrival.id.begin(), arrival.id.end(), id);
      return found != arrival.id.end() && *found == id ? int(found - arrival.id.begin()) : -1;
    }

    int required_index(const Arrival &arrival, const ForeignFrame &frame, const ForeignContact &c, const long id)
    {
      const int index = index_of(arrival, id);
      if (index < 0)
        throw SceneError(place_of(frame, c) + ": a contact of body " + std::to_string(id) + ", which is not a grain of " +
                         frame.grain_file);
      return index;
    }

    std::array<double, 4> extremes(const ArrivedFrame &frame)
    {
      std::array<double, 4> e = {HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL};
      for (std::size_t i = 0; i < frame.position.size(); ++i)
        for (const int side : {0, 1, 2, 3})
          {
            const double surface = frame.position[i][axis_of[side]] - inward_of[side] * frame.radius[i];
            e[std::size_t(side)] = inward_of[side] > 0 ? std::min(e[std::size_t(side)], surface)
                                                       : std::max(e[std::size_t(side)], surface);
          }
      return e;
    }

    // The side whose outermost surface is nearest to the touching grains, on average.
    Side nearest_side(const ForeignFrame &from, const Arrival &arrival, const int wall, const ArrivedFrame &to)
    {
      const std::array<double, 4> extreme  = extremes(to);
      std::array<double, 4>       distance = {0, 0, 0, 0};
      int                         n        = 0;
      for (const ForeignContact &c : from.contacts)
        if (c.wall == wall)
          {
            const int i = required_index(arrival, from, c, c.first);
            ++n;
            for (const int side : {0, 1, 2, 3})
              distance[std::size_t(side)] += std::abs(to.position[std::size_t(i)][axis_of[side]] -
                                                      inward_of[side] * to.radius[std::size_t(i)] - extreme[std::size_t(side)]);
          }
      const auto   best = std::min_element(distance.begin(), distance.end());
      const double mean = n > 0 ? *best / n : HUGE_VAL;
      if (!(mean < arrival.mean_diameter))
        throw SceneError(from.contact_file + ": frame " + from.name + ": " + from.walls[std::size_t(wall)].name +
                         " touches no grain at the lower, upper, left or right end of the sample, so its side is unknown");
      return Side(best - distance.begin());
    }

    // The side of each of from.walls. A wall in a table and one in contacts may be the same.
    std::vector<int> sides_of(const ForeignFrame &from, const Arrival &arrival, const ArrivedFrame &to)
    {
      std::vector<int>           sides;
      std::map<int, std::size_t> of_contacts;
      for (std::size_t w = 0; w < from.walls.size(); ++w)
        {
          const ForeignWall &wall    = from.walls[w];
          const bool         touched = std::any_of(from.contacts.begin(), from.contacts.end(),
                                                   [w](const auto &c) { return c.wall == int(w); });
          if (!wall.side && !touched && std::isnan(wall.place))
            {
              sides.push_back(-1); // nothing touches this wall
              continue;
            }
          const int side = int(wall.side ? *wall.side : nearest_side(from, arrival, int(w), to));
          if (touched && !of_contacts.emplace(side, w).second)
            throw SceneError(from.contact_file + ": frame " + from.name + ": " + from.walls[of_contacts[side]].name + " and " +
                             wall.name + " both appear to be the " + side_names[side] + " wall");
          sides.push_back(side);
        }
      return sides;
    }

    // Mean position of a wall's contact points along its normal; NaN without contacts. Throws if they scatter more than
    // most_scatter [length].
    double place_from_points(const ForeignFrame &from, const std::vector<int> &sides, const int side, const double most_scatter)
    {
      double sum = 0, low = HUGE_VAL, high = -HUGE_VAL;
      int    n = 0;
      for (const ForeignContact &c : from.contacts)
        if (c.wall >= 0 && sides[std::size_t(c.wall)] == side && c.point.allFinite())
          {
            const double x = c.point[axis_of[side]];
            ++n;
            sum += x;
            low  = std::min(low, x);
            high = std::max(high, x);
          }
      if (n == 0)
        return not_told;
      if (high - low > most_scatter)
        throw SceneError(from.contact_file + ": frame " + from.name + ": contact points of the " + side_names[side] +
                         " wall scatter over " + std::to_string(high - low) +
                         " [length] along its normal; a flat wall is needed");
      return sum / n;
    }

    void place_walls(const ForeignFrame     &from,
                     const std::vector<int> &sides,
                     const ForeignOptions   &options,
                     const double            thickness,
                     ArrivedFrame           &to)
    {
      double radius = 0;
      for (const double r : to.radius)
        radius += r / double(to.radius.size());
      const std::array<double, 4> extreme = extremes(to);
      to.wall_force.fill({not_told, not_told});
      to.told_wall_force.fill({not_told, not_told});
      for (const int side : {0, 1, 2, 3})
        {
          bool there = false;
          for (std::size_t w = 0; w < from.walls.size(); ++w)
            if (sides[w] == side)
              {
                there = true;
                if (std::isfinite(from.walls[w].place))
                  to.wall[std::size_t(side)] = from.walls[w].place;
                if (from.walls[w].force.allFinite())
                  to.told_wall_force[std::size_t(side)] = from.walls[w].force / thickness;
                if (side == int(Side::upper) && from.walls[w].travel != 0)
                  to.upper_travel = from.walls[w].travel;
              }
          const bool   is_placed   = std::isfinite(to.wall[std::size_t(side)]);
          const double from_points = there ? place_from_points(from, sides, side, is_placed ? HUGE_VAL : flat * radius)
                                           : not_told;
          if (!is_placed)
            to.wall[std::size_t(side)] = from_points;
          else if (std::isfinite(from_points))
            to.wall_miss = std::max(to.wall_miss, std::abs(from_points - to.wall[std::size_t(side)]));
          if (options.walls_touch && std::isnan(to.wall[std::size_t(side)]) && (there || axis_of[side] == 1))
            {
              to.wall[std::size_t(side)] = extreme[std::size_t(side)];
              to.walls_touch             = true;
            }
          if (there && std::isnan(to.wall[std::size_t(side)]))
            throw SceneError(from.grain_file + ": frame " + from.name + ": the place of the " + side_names[side] +
                             " wall is in none of the files; give a table with frame, width and height (or left_x, right_x, "
                             "lower_y, upper_y), or --walls-touch to place walls at the outermost grains");
        }
    }

    // Contact forces push bodies apart. If their sum pulls, the file contains the forces on the other body.
    template <class Contacts> bool turn_if_pulling(Contacts &contacts, const bool of_walls, const int n_grains)
    {
      double pushes = 0;
      for (const ContactForce &c : contacts)
        if ((c.j >= n_grains) == of_walls)
          pushes += c.force.dot(c.normal);
      if (pushes < 0)
        for (ContactForce &c : contacts)
          if ((c.j >= n_grains) == of_walls)
            c.force = -c.force;
      return pushes < 0;
    }

    struct PairOrder
    {
      std::map<std::pair<int, int>, std::size_t> place; // of pairs of grains
      int                                        repeated = 0;
    };

    // True if the pair occurred before with the same force on i. Throws if the two forces differ.
    bool is_repeated(const ForeignFrame   &from,
                     const ForeignContact &c,
                     const ContactForce   &contact,
                     const ArrivedFrame   &to,
                     PairOrder            &order)
    {
      const auto [found, is_new] = order.place.emplace(std::pair(contact.i, contact.j), to.contacts.size());
      if (is_new)
        return false;
      const Eigen::Vector2d &other = to.contacts[found->second].force;
      if ((other - contact.force).norm() > same_force * (other.norm() + contact.force.norm()))
        throw SceneError(place_of(from, c) + ": the pair " + std::to_string(c.first) + ", " + std::to_string(c.second) +
                         " occurs twice with different forces");
      ++order.repeated;
      return true;
    }

    // Sets the normal. Without a contact point in the file it uses the middle of the overlap, or the nearest point of the wall.
    void complete(const ForeignFrame &from, const ForeignContact &c, ContactForce &contact, ArrivedFrame &to)
    {
      const std::size_t     i = std::size_t(contact.i), n = to.position.size();
      const Eigen::Vector2d x = to.position[i];
      double                overlap;
      if (std::size_t(contact.j) >= n)
        {
          const int side      = contact.j - int(n);
          contact.normal      = inward(side);
          const double height = inward_of[side] * (x[axis_of[side]] - to.wall[std::size_t(side)]);
          overlap             = to.radius[i] - height;
          contact.point       = x - height * contact.normal;
        }
      else
        {
          const Eigen::Vector2d branch = x - to.position[std::size_t(contact.j)];
          overlap                      = to.radius[i] + to.radius[std::size_t(contact.j)] - branch.norm();
          contact.normal               = branch.normalized();
          contact.point                = x - (to.radius[i] - 0.5 * overlap) * contact.normal;
        }
      const double diameter = 2 * std::max(to.radius[i], std::size_t(contact.j) < n ? to.radius[std::size_t(contact.j)] : 0);
      if (-overlap > diameter && contact.force != Eigen::Vector2d::Zero())
        throw SceneError(place_of(from, c) + ": the surfaces of the two bodies in contact (grain " + std::to_string(c.first) +
                         " and " + (c.wall >= 0 ? from.walls[std::size_t(c.wall)].name : "grain " + std::to_string(c.second)) +
                         ") are " + std::to_string(-overlap / diameter) +
                         " grain diameters apart; do the files belong to one frame, and the columns have this meaning?");
      to.widest_gap = std::max(to.widest_gap, -overlap);
      if (c.point.allFinite())
        {
          to.point_miss = std::max(to.point_miss, (c.point - contact.point).norm());
          contact.point = c.point;
        }
      if (std::isfinite(c.overlap))
        to.overlap_miss = std::max(to.overlap_miss, std::abs(c.overlap - overlap));
    }
  } // namespace

  void remark_once(Arrival &arrival, const std::string &text)
  {
    if (std::find(arrival.remarks.begin(), arrival.remarks.end(), text) == arrival.remarks.end())
      arrival.remarks.push_back(text);
  }

  void take_contacts(const ForeignFrame &from, Arrival &arrival, const ForeignOptions &options, ArrivedFrame &to)
  {
    const int              n     = int(to.position.size());
    const std::vector<int> sides = sides_of(from, arrival, to);
    place_walls(from, sides, options, arrival.thickness, to);
    to.has_contacts = from.has_contacts;
    PairOrder order;
    for (const ForeignContact &c : from.contacts)
      {
        ContactForce contact;
        contact.i     = required_index(arrival, from, c, c.first);
        contact.force = c.force / arrival.thickness;
        contact.j     = c.wall >= 0 ? n + sides[std::size_t(c.wall)] : required_index(arrival, from, c, c.second);
        if (contact.j == contact.i)
          throw SceneError(place_of(from, c) + ": grain " + std::to_string(c.first) + " touches itself");
        if (contact.j < contact.i)
          {
            std::swap(contact.i, contact.j);
            contact.force = -contact.force;
          }
        if (contact.j < n && is_repeated(from, c, contact, to, order))
          continue;
        complete(from, c, contact, to);
        if (!contact.point.allFinite() || !contact.normal.allFinite())
          throw SceneError(place_of(from, c) + ": grains " + std::to_string(c.first) + " and " + std::to_string(c.second) +
                           " have the same position");
        to.contacts.push_back(contact);
        to.status.push_back(c.status);
      }
    if (order.repeated > 0)
      remark_once(arrival, "pairs of grains occur in two rows; each was counted once");
    if (turn_if_pulling(to.contacts, false, n))
      remark_once(arrival, "forces between grains were reversed: in the files they pull, so they act on the other grain");
    if (turn_if_pulling(to.contacts, true, n))
      remark_once(arrival, "forces of walls on grains were reversed: in the files they pull, so they act on the wall");
    std::array<Eigen::Vector2d, 4> sum;
    std::array<bool, 4>            touched = {};
    sum.fill(Eigen::Vector2d::Zero());
    for (const ContactForce &c : to.contacts)
      if (c.j >= n)
        {
          sum[std::size_t(c.j - n)] += c.force;
          touched[std::size_t(c.j - n)] = true;
        }
    for (const int side : {0, 1, 2, 3})
      {
        Eigen::Vector2d &told = to.told_wall_force[std::size_t(side)];
        if (told.allFinite() && told.dot(inward(side)) < 0)
          {
            told = -told;
            remark_once(arrival, "wall forces in the files act on the walls; they were reversed");
          }
        to.wall_force[std::size_t(side)] = touched[std::size_t(side)] ? sum[std::size_t(side)] : told;
      }
  }
} // namespace diptych::coupling
