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
    double          gap;       // negative where the bodies interpenetrate [length]
    Eigen::Vector2d normal;    // unit, from j to i
    Eigen::Vector2d point;     // midway between the surfaces, beside i
    int             image = 0; // j takes part as its image this many cell widths away
  };

  // Gap, normal and point of one pair at the present positions, with the image of j nearest to i.
  Contact make_contact(const State &state, int i, int j);

  // Pairs that can touch while no grain has moved far. A cache: contacts found with it or without it are the same.
  class NeighbourList
  {
  public:
    // All pairs whose gap is below the sum of their margins (walls have none), ascending in (i, j), pairs of two bodies that
    // nothing moves left out, and of a grain that is part of a platen and anything but a free grain. `margin` [length] has one
    // entry per grain. The list behind it is made anew, at a cost of O(n) cells, when for some grain margin + motion since then
    // exceed what the list foresaw. Throws std::invalid_argument where a periodic cell is narrower than four times the reach of a
    // grain. `go_on` is asked while the list is made; where it says no, nothing is found and no list is kept.
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

  // The same without a list to keep.
  std::vector<Contact> find_contacts(const State &state, const std::vector<double> &margin);
} // namespace diptych::discrete
