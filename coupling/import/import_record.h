// diptych: the contents of import.json
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
    v({"format", "-", "format of the files", Kind::setting}, r.arrival.format);
    v({"files", "-", "files that were read", Kind::setting}, r.files);
    v({"thickness", "length", "thickness by which forces and masses were divided", Kind::setting}, r.arrival.thickness);
    v({"mean_diameter", "length", "mean diameter d of the grains, or the value of --mean-diameter"}, r.arrival.mean_diameter);
    v({"density", "mass/length^2", "mass of the grains / their area, per unit thickness; null: unknown"}, r.arrival.density);
    v({"remarks", "-", "notes on data that were reordered, reversed or left out", Kind::setting}, r.arrival.remarks);
    v({"lacking", "-", "quantities that the files do not contain; absent from all results", Kind::setting}, r.arrival.lacking);
    v({"doubtful", "-", "findings of the checks that a user should look at", Kind::setting}, r.arrival.doubtful);
    v.list("frames", "one per frame", r.arrival.checks);
  }
} // namespace diptych::coupling
