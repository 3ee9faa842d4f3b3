// diptych: descriptions of all numbers that a record can list
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/numbers/number_entry.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  struct NumberDescription
  {
    std::string place; // keys on the path, as stages/discrete/probes/t_over_s; entries of a list are below the list's key
    std::string shape; // number, number with its 95 % interval, list, vector, tensor, text, yes or no
    std::string unit, meaning;
    Kind        kind = Kind::number;
  };
  using NumberSchema = std::vector<NumberDescription>;

  struct CollectNumbers
  {
    NumberSchema &schema;
    std::string   place; // ends with a slash, or is empty

    template <class T> void operator()(const NumberEntry &entry, const T &)
    {
      schema.push_back({place + entry.key, shape_of<T>(), entry.unit, entry.meaning, entry.kind});
    }
    template <class Record> void group(const char *key, const char *meaning, const Record &record)
    {
      schema.push_back({place + key, "group", "", meaning, Kind::setting});
      CollectNumbers inner{schema, place + key + "/"};
      list_numbers(record, inner);
    }
    template <class Record> void group(const char *key, const char *meaning, const std::optional<Record> &)
    {
      group(key, meaning, Record());
    }
    template <class Record> void list(const char *key, const char *meaning, const std::vector<Record> &)
    {
      group(key, meaning, Record());
    }

  private:
    template <class T> static std::string shape_of()
    {
      if constexpr (std::is_same_v<T, bool>)
        return "yes or no";
      else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::optional<double>>)
        return "number";
      else if constexpr (std::is_same_v<T, Interval>)
        return "number with its 95 % interval";
      else if constexpr (std::is_same_v<T, std::string>)
        return "text";
      else if constexpr (std::is_same_v<T, Eigen::Vector2d>)
        return "vector";
      else if constexpr (std::is_same_v<T, Eigen::Matrix2d>)
        return "tensor";
      else
        return "list";
    }
  };
} // namespace diptych::coupling
