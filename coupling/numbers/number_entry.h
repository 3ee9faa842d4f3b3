// diptych: description of each number of a result: key, unit, kind and meaning
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <utility>

namespace diptych::coupling
{
  enum class Kind
  {
    number,  // may be averaged over realisations
    line,    // angle of a line or axis, with a period of 180 degrees
    setting, // a place, a choice or the size of a computation: the same in every realisation, or without a mean
    clock    // a measured duration
  };
  constexpr auto choices(Kind)
  {
    return std::array{std::pair{Kind::number, "number"}, std::pair{Kind::line, "line"}, std::pair{Kind::setting, "setting"},
                      std::pair{Kind::clock, "clock"}};
  }

  // A record with public numbers has a function beside it:
  // template <class Visitor> void list_numbers(const Record &record, Visitor &visitor)
  // It calls
  //   visitor(NumberEntry{...}, member) for each number, text or list of numbers,
  //   visitor.group(key, meaning, member) for a record (or an optional one),
  //   visitor.list(key, meaning, member) for a list of records.
  // Keys and units are defined only here. JSON, CSV, ensembles, the page and `diptych explain results` use this function.
  struct NumberEntry
  {
    const char *key, *unit, *meaning;
    Kind        kind         = Kind::number;
    bool        in_diameters = false; // the member is a length that is written in mean diameters
  };

  template <class Columns> std::string header_of(const Columns &columns)
  {
    std::string line;
    for (const NumberEntry &column : columns)
      line += (line.empty() ? "" : ",") + std::string(column.key);
    return line;
  }
} // namespace diptych::coupling
