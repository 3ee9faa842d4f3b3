// diptych: checks that a table of steps belongs to the snapshots beside it
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  struct HistoryCheck
  {
    std::string table;        // path
    bool        finished;     // true if the run finished; then every stage must have a row
    bool        another_code; // true for imported results, where only progress and axial strain must be finite
  };

  namespace history
  {
    constexpr double same = 1e-9; // relative

    [[noreturn]] inline void refuse(const HistoryCheck &check, const std::string &what)
    {
      throw std::invalid_argument(check.table + what);
    }

    // A meaning given as plain text belongs to a column whose numbers must be finite.
    template <class Meaning> bool may_be_nan(const Meaning &meaning)
    {
      if constexpr (std::is_class_v<Meaning>)
        return meaning.may_be_nan;
      else
        return false;
    }

    // A number is finite unless its column may hold NaN.
    template <class Row> void demand_numbers(const std::vector<Row> &rows, const HistoryCheck &check)
    {
      for (std::size_t k = 0; k < rows.size(); ++k)
        visit_columns(rows[k], [&](const std::string &name, const auto &value, const char *, const auto &meaning) {
          if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
            {
              const bool may_be_unknown = may_be_nan(meaning) ||
                                          (check.another_code && name != "progress" && name != "axial_strain");
              if (!std::isfinite(value) && !may_be_unknown)
                refuse(check, ", line " + std::to_string(k + 2) + ": column '" + name + "' is not finite");
            }
        });
    }

    template <class Row> void demand_ascent(const std::vector<Row> &rows, const HistoryCheck &check)
    {
      for (std::size_t k = 1; k < rows.size(); ++k)
        if (!(rows[k].progress > rows[k - 1].progress && rows[k].step > rows[k - 1].step))
          refuse(check, ", line " + std::to_string(k + 2) + ": 'step' and 'progress' do not grow from the line before");
    }
  } // namespace history

  // Checks rows that were read from a file, at least one. Each stage must have a row at its end; a missing row means that the
  // file is damaged. There is one exception: the last snapshot of an unfinished run may have no row, and rows may follow it.
  // Throws std::invalid_argument with the table's name.
  template <class Row, class Snapshot>
  void check_history(const std::vector<Row> &rows, const std::vector<Snapshot> &snapshots, const HistoryCheck &check)
  {
    using namespace history;
    demand_numbers(rows, check);
    demand_ascent(rows, check);
    const auto is_at = [](const Row &row, const double progress) {
      return std::abs(row.progress - progress) <= same * std::abs(progress);
    };
    const std::size_t n_stages = snapshots.size() - (check.finished || snapshots.empty() ? 0 : 1);
    std::size_t       k        = 0;
    for (std::size_t stage = 1; stage < n_stages; ++stage)
      {
        const double progress = snapshots[stage].progress;
        while (k < rows.size() && rows[k].progress < progress && !is_at(rows[k], progress))
          ++k;
        if (k == rows.size() || !is_at(rows[k], progress))
          refuse(check, ": has no row at the progress " + discrete::exact_text(progress) + " of snapshot " +
                          std::to_string(stage) + " beside it");
      }
    if (check.finished && n_stages > 1 && k + 1 != rows.size())
      refuse(check,
             ": goes on after the last snapshot beside it, at the progress " + discrete::exact_text(snapshots.back().progress));
  }
} // namespace diptych::coupling
