// diptych: columns and numbers that a quantity of a study can be read from
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/studies/study_columns.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>

#include "continuum/history.h"
#include "continuum/laws/material_point_row.h"
#include "coupling/comparison/comparison_schema.h"
#include "coupling/scene/keys.h"
#include "discrete/files/nearest_name.h"
#include "discrete/panel/history.h"

namespace diptych::coupling
{
  namespace
  {
    struct Column
    {
      std::string name, unit;
    };

    template <class Row> std::vector<Column> numbers_of()
    {
      std::vector<Column> columns;
      const Row           row;
      visit_columns(row, [&](const char *name, const auto &value, const char *unit, const char *) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          columns.push_back({name, unit});
      });
      return columns;
    }

    std::vector<Column> columns_of(const Source source)
    {
      switch (source)
        {
        case Source::discrete:
          return numbers_of<discrete::HistoryRow>();
        case Source::continuum:
          return numbers_of<continuum::HistoryRow>();
        case Source::material_point:
          return numbers_of<continuum::MaterialPointRow>();
        default:
          return {};
        }
    }

    // The shortest key that begins with the word, else the key with the fewest letters changed.
    std::string nearest_key(const std::string &word, const std::vector<std::string> &keys)
    {
      std::string nearest;
      for (const std::string &key : keys)
        if (key.compare(0, word.size(), word) == 0 && (nearest.empty() || key.size() < nearest.size()))
          nearest = key;
      return nearest.empty() || word.empty() ? discrete::nearest_name(word, keys) : nearest;
    }

    void describe_number(StudyQuantity &quantity)
    {
      const std::string        key = quantity.column.substr(quantity.column.rfind(' ') + 1);
      std::vector<std::string> keys;
      for (const NumberDescription &number : comparison_schema())
        {
          const std::string own = number.place.substr(number.place.rfind('/') + 1);
          if (number.kind == Kind::number || number.kind == Kind::line) // those that ensembles average
            keys.push_back(own);
          if (own != key)
            continue;
          quantity.unit    = number.unit;
          quantity.is_line = number.kind == Kind::line;
          return;
        }
      throw std::invalid_argument("'" + quantity.column + "': no number of a comparison ends with '" + key +
                                  "'; the nearest is '" + nearest_key(key, keys) +
                                  "'. Use a name from the first column of ensemble.csv, such as "
                                  "'window 0.01-0.03 discrete band angle_deg'");
    }
  } // namespace

  Entry with_seed(Entry entry, const std::string &seed)
  {
    for (std::size_t at = entry.value.find(seed_word); at != std::string::npos; at = entry.value.find(seed_word))
      entry.value.replace(at, std::string(seed_word).size(), seed);
    return entry;
  }

  std::vector<std::string> column_names(const Source source)
  {
    std::vector<std::string> names;
    for (const Column &column : columns_of(source))
      names.push_back(column.name);
    return names;
  }

  void describe(StudyQuantity &quantity)
  {
    if (quantity.reduction == Reduction::number)
      return describe_number(quantity);
    for (const Column &column : columns_of(quantity.source))
      if (column.name == quantity.column)
        quantity.unit = column.unit;
  }

  std::string default_name(const StudyQuantity &quantity)
  {
    const std::string of = discrete::name_of(quantity.source) + " ", from = text_of(quantity.from), to = text_of(quantity.to);
    switch (quantity.reduction)
      {
      case Reduction::strength:
        return of + "strength " + from + "-" + to;
      case Reduction::mean:
        return of + quantity.column + " " + from + "-" + to;
      case Reduction::at:
        return of + quantity.column + " at " + from;
      case Reduction::number:
        return quantity.column;
      default:
        return of + discrete::name_of(quantity.reduction) + " " + quantity.column;
      }
  }
} // namespace diptych::coupling
