// diptych: pairs of bodies that may touch within a step
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>

#include "discrete/bodies/state.h"

namespace diptych::discrete
{
  // A candidate contact between grain i and body j > i (a grain, or a wall for j >= n_grains).
  struct Contact
  {
    int             i, j;
    double          gap;        // negative if the bodies interpenetrate [length]
    Eigen::Vector2d normal;     // unit, from j to i
    Eigen::Vector2d point;      // midway between the surfaces, next to i
    Image           image = {}; // j enters as this image
  };

  // Gap, normal and point of one pair at the present positions, with the image of j nearest to i.
  Contact make_contact(const State &state, int i, int j);

  // Pairs that can touch as long as no grain has moved far. This is only a cache: contacts are the same with or without it.
  class NeighbourList
  {
  public:
    struct Pair
    {
      int i, j; // as in Contact
    };

    // All pairs with a gap below the sum of their margins, and some others, ascending in (i, j). `margin` [length] has one entry
    // per grain; walls have none. Pairs of two immovable bodies are left out, and pairs of a platen grain with anything but a
    // free grain. The list is rebuilt, in O(n), if margin + motion of a grain exceed its reach. If `go_on`, called during a
    // rebuild, returns false, the result is empty. Throws std::invalid_argument if a periodic cell is narrower than four times
    // the reach of a grain, in a lattice if its parallelogram is.
    const std::vector<Pair> &near_pairs(const State                 &state,
                                        const std::vector<double>   &margin,
                                        const std::function<bool()> &go_on = {});

    // Only those with a gap below the sum of their margins.
    std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin);

    // Keeps the list for a state to which deform() was applied.
    void follow(const UniformStrain &strain);

  private:
    bool covers(const State &state, const std::vector<double> &margin) const;
    void build(const State &state, const std::vector<double> &margin, const std::function<bool()> &go_on);

    std::vector<Pair>            pairs_; // ascending
    std::vector<Eigen::Vector2d> position_, wall_point_;
    std::vector<double>          reach_;
    double                       largest_radius_ = 0;
    Periodicity                  periodicity_;
  };

  std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin);
} // namespace diptych::discrete
