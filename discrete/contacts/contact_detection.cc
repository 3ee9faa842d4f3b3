// diptych: pairs of bodies that may touch within a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/contact_detection.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "discrete/contacts/search_grid.h"

namespace diptych::discrete
{
  namespace
  {
    // Data of a grain that decide whether it is near another one, contiguous in memory.
    struct Disc
    {
      Eigen::Vector2d position;
      double          radius, margin;
    };

    Contact contact_of_discs(const Contact &pair, const Disc &a, const Disc &b, const Eigen::Vector2d &branch)
    {
      const double distance = branch.norm();
      // Coinciding centres have no normal; any fixed direction separates them.
      const Eigen::Vector2d normal = distance > 0 ? Eigen::Vector2d(branch / distance) : Eigen::Vector2d::UnitX();
      const double          gap    = distance - a.radius - b.radius;
      return {pair.i, pair.j, gap, normal, a.position - (a.radius + 0.5 * gap) * normal, pair.image};
    }

    constexpr int grains_between_questions = 4096; // calls of go_on

    // True if one body can move relative to the other. A grain that is part of a platen meets only free grains.
    bool may_act(const State &state, const int i, const int j)
    {
      const Grains &g      = state.grains;
      const int     n      = int(g.size());
      const bool    i_free = !g.fixed[i], j_free = j < n && !g.fixed[j];
      if (i_free || j_free)
        return true;
      return j >= n && g.platen(i) < 0 && state.walls[j - n].inverse_mass() != Eigen::Vector2d::Zero();
    }
  } // namespace

  Contact make_contact(const State &state, const int i, const int j)
  {
    const Grains &g = state.grains;
    const int     n = int(g.size());
    if (j >= n)
      {
        const Wall  &wall = state.walls[j - n];
        const double gap  = (g.position[i] - wall.point).dot(wall.normal) - g.radius[i];
        return {i, j, gap, wall.normal, g.position[i] - (g.radius[i] + 0.5 * gap) * wall.normal};
      }
    const Image           image  = nearest_image(state, g.position[i], g.position[j]);
    const Eigen::Vector2d branch = g.position[i] - g.position[j] - image.shift;
    return contact_of_discs({i, j, 0, {}, {}, image}, {g.position[i], g.radius[i], 0}, {g.position[j], g.radius[j], 0}, branch);
  }

  bool NeighbourList::covers(const State &state, const std::vector<double> &margin) const
  {
    const Grains &g = state.grains;
    if (position_.size() != g.size() || wall_point_.size() != state.walls.size())
      return false;
    double wall_motion = 0;
    for (std::size_t w = 0; w < wall_point_.size(); ++w)
      wall_motion = std::max(wall_motion, (state.walls[w].point - wall_point_[w]).norm());
    if (const PeriodicWidth *periodic = state.width())
      wall_motion = std::max(wall_motion, std::abs(periodic->width - std::get<PeriodicWidth>(periodicity_).width));
    Eigen::Matrix2d map = Eigen::Matrix2d::Identity(); // of the lattice since the list was built; grains follow it
    if (const Lattice *lattice = state.lattice())
      {
        map = lattice->vectors * std::get<Lattice>(periodicity_).vectors.inverse();
        // A pair in the list is at most two largest reaches apart; each grain takes half of what the map moves them.
        wall_motion = (map - Eigen::Matrix2d::Identity()).norm() *
                      (*std::max_element(g.radius.begin(), g.radius.end()) + *std::max_element(reach_.begin(), reach_.end()));
      }
    for (std::size_t i = 0; i < g.size(); ++i)
      {
        const double          left  = reach_[i] - margin[i] - wall_motion;
        const Eigen::Vector2d moved = g.position[i] - map * position_[i];
        if (left < 0 || moved.squaredNorm() > left * left)
          return false;
      }
    return true;
  }

  void NeighbourList::build(const State &state, const std::vector<double> &margin, const std::function<bool()> &go_on)
  {
    const Grains &g              = state.grains;
    const int     n              = int(g.size());
    const double  largest_radius = largest_radius_ = *std::max_element(g.radius.begin(), g.radius.end());
    // The list remains valid until a grain moves by a quarter of the largest radius, or of the mean diameter, beyond its margin.
    const double slack = 0.25 * std::min(largest_radius, 2 * std::accumulate(g.radius.begin(), g.radius.end(), 0.) / n);
    reach_             = margin;
    for (double &reach : reach_)
      reach = 1.5 * reach + slack;
    position_ = g.position;
    wall_point_.clear();
    for (const Wall &wall : state.walls)
      wall_point_.push_back(wall.point);
    periodicity_        = state.periodicity;
    const double extent = std::visit([](const auto &kind) { return kind.least_extent(); }, periodicity_);
    if (extent > 0 && extent < 4 * (largest_radius + *std::max_element(reach_.begin(), reach_.end())))
      throw std::invalid_argument(
        "the periodic sample is too narrow: its period is " + std::to_string(extent) + ", too small for grains of radius " +
        std::to_string(largest_radius) +
        " that move this far in a step: give a shorter step (discrete/step, or sample/preparation_step) "
        "or a wider sample");

    pairs_.clear();
    const std::vector<SizedGrid> grids = sort_by_size(state);
    for (int i = 0; i < n; ++i)
      {
        if (go_on && (i + 1) % grains_between_questions == 0 && !go_on())
          {
            pairs_.clear();
            position_.clear(); // an empty list covers no state
            return;
          }
        // The member with the larger reach finds the pair, so a search circle needs only the reach of its grain.
        const auto meet = [&](const int j) {
          if (reach_[j] > reach_[i] || (reach_[j] == reach_[i] && j <= i))
            return;
          const double          alert  = g.radius[i] + g.radius[j] + reach_[i] + reach_[j];
          const Eigen::Vector2d branch = g.position[i] - g.position[j] - nearest_image(state, g.position[i], g.position[j]).shift;
          if (branch.squaredNorm() < alert * alert && may_act(state, i, j))
            pairs_.push_back({std::min(i, j), std::max(i, j)});
        };
        for (const SizedGrid &sized : grids)
          sized.grid.visit_around(g.position[i], g.radius[i] + sized.largest_radius + 2 * reach_[i], meet);
        for (int w = 0; w < int(state.walls.size()); ++w)
          if (make_contact(state, i, n + w).gap < reach_[i] && may_act(state, i, n + w))
            pairs_.push_back({i, n + w});
      }
    std::sort(pairs_.begin(), pairs_.end(), [](const Pair &a, const Pair &b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
  }

  const std::vector<NeighbourList::Pair> &NeighbourList::near_pairs(const State                 &state,
                                                                    const std::vector<double>   &margin,
                                                                    const std::function<bool()> &go_on)
  {
    if (state.grains.size() > 0 && !covers(state, margin))
      build(state, margin, go_on);
    return pairs_;
  }

  void NeighbourList::follow(const UniformStrain &strain)
  {
    if (position_.empty())
      return;
    for (Eigen::Vector2d &x : position_)
      x = strain.moved(x);
    for (Eigen::Vector2d &x : wall_point_)
      x = strain.moved(x);
    strain.deform(periodicity_);
    // A pair that is not in the list has a gap above the sum of both reaches. Each grain gives up half of what the strain closes.
    const double closer = strain.strain.cwiseAbs().maxCoeff() *
                          (largest_radius_ + *std::max_element(reach_.begin(), reach_.end()));
    for (double &reach : reach_)
      reach -= closer;
  }

  std::vector<Contact> NeighbourList::find_contacts(const State &state, const std::vector<double> &margin)
  {
    const Grains            &g     = state.grains;
    const int                n     = int(g.size());
    const std::vector<Pair> &pairs = near_pairs(state, margin);
    std::vector<Contact>     contacts;
    contacts.reserve(pairs.size());
    std::vector<Disc> disc(n);
    for (int i = 0; i < n; ++i)
      disc[i] = {g.position[i], g.radius[i], margin[i]};
    for (const Pair &pair : pairs)
      {
        const Disc &a = disc[pair.i];
        if (pair.j >= n)
          {
            const Contact contact = make_contact(state, pair.i, pair.j);
            if (contact.gap < a.margin)
              contacts.push_back(contact);
            continue;
          }
        const Disc           &b      = disc[pair.j];
        const Image           image  = nearest_image(state, a.position, b.position);
        const Eigen::Vector2d branch = a.position - b.position - image.shift;
        const double          alert = a.margin + b.margin, distance = a.radius + b.radius + alert;
        if (branch.squaredNorm() >= distance * distance)
          continue;
        const Contact contact = contact_of_discs({pair.i, pair.j, 0, {}, {}, image}, a, b, branch);
        if (contact.gap < alert)
          contacts.push_back(contact);
      }
    return contacts;
  }

  std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin)
  {
    return NeighbourList().find_contacts(state, margin);
  }
} // namespace diptych::discrete
