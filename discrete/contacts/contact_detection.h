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
    double          gap;       // negative if the bodies interpenetrate [length]
    Eigen::Vector2d normal;    // unit, from j to i
    Eigen::Vector2d point;     // midway between the surfaces, next to i
    int             image = 0; // j enters as its image this many cell widths away
  };

  // Gap, normal and point of one pair at the present positions, with the image of j nearest to i.
  Contact make_contact(const State &state, int i, int j);

  // Pairs that can touch as long as no grain has moved far. This is only a cache: contacts are the same with or without it.
  class NeighbourList
  {
  public:
    // Returns all pairs with a gap below the sum of their margins, ascending in (i, j). Walls have no margin. Pairs of two
    // immovable bodies are left out, and so are pairs of a platen grain with anything but a free grain. `margin` [length] has one
    // entry per grain. The list is rebuilt if margin + motion of some grain exceed the reach of the list. A rebuild visits O(n)
    // cells. Throws std::invalid_argument if a periodic cell is narrower than four times the reach of a grain. `go_on` is called
    // during a rebuild. If it returns false, the result is empty and no list is kept.
    std::vector<Contact> find_contacts(const State                 &state,
                                       const std::vector<double>   &margin,
                                       const std::function<bool()> &go_on = {});

  private:
    struct Pair
    {
      int i, j;
    };
    bool covers(const State &state, const std::vector<double> &margin) const;
    void build(const State &state, const std::vector<double> &margin, const std::function<bool()> &go_on);

    std::vector<Pair>            pairs_; // ascending
    std::vector<Eigen::Vector2d> position_, wall_point_;
    std::vector<double>          reach_;
    double                       width_ = 0;
  };

  // The same without a stored list.
  std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin);
} // namespace diptych::discrete
