// diptych: what an import says of itself: import.json
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/import/arrived_sample.h"

namespace diptych::coupling
{
  struct ImportRecord
  {
    std::vector<std::string> files;
    Arrival                  arrival;
  };

  template <class Record, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Record>, ImportRecord>, int> = 0>
  void list_numbers(Record &r, Visitor &v)
  {
    v({"format", "-", "of the files", Kind::setting}, r.arrival.format);
    v({"files", "-", "that were read", Kind::setting}, r.files);
    v({"thickness", "length", "over which forces and masses were divided", Kind::setting}, r.arrival.thickness);
    v({"mean_diameter", "length", "mean diameter d of the grains, or as it was given"}, r.arrival.mean_diameter);
    v({"density", "mass/length^2", "mass of the grains / their area, per unit thickness; null: not told"}, r.arrival.density);
    v({"remarks", "-", "what was taken in another way than it stood in the files", Kind::setting}, r.arrival.remarks);
    v({"lacking", "-", "what the files do not hold: left out of all that is made of them", Kind::setting}, r.arrival.lacking);
    v({"doubtful", "-", "what the checks found that a user should look at", Kind::setting}, r.arrival.doubtful);
    v.list("frames", "one a frame", r.arrival.checks);
  }
} // namespace diptych::coupling
