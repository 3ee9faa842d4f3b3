// diptych: facts that the panels record about their runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "continuum/report.h"
#include "coupling/numbers/number_entry.h"
#include "discrete/panel/report.h"

namespace diptych::coupling
{
  // Entries of a panel's report. Angles are those of lines.
  template <class T>
  inline constexpr bool is_report = std::is_same_v<T, discrete::Report> || std::is_same_v<T, continuum::Report>;
  template <class Report, class Visitor, std::enable_if_t<is_report<std::remove_const_t<Report>>, int> = 0>
  void list_numbers(Report &report, Visitor &v)
  {
    visit_facts(report, [&](const char *name, auto &value, const std::string_view unit, const discrete::Meaning &meaning) {
      const Kind kind = meaning.is_clock ? Kind::clock : unit == "degrees" ? Kind::line : Kind::number;
      v({name, unit.data(), meaning, kind}, value);
    });
  }

  // The report of a run of which nothing is known.
  template <class Report> Report unknown_report()
  {
    Report report;
    visit_facts(report, [](const char *, auto &value, const char *, const char *) {
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
        value = NAN;
    });
    return report;
  }

  // Cost of one phase of a run. Memory is the peak of the whole process so far [MB].
  struct PhaseCost
  {
    std::string name;
    double      wall_s = 0, cpu_s = 0, peak_memory_mb = 0;
  };

  template <class Phase, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Phase>, PhaseCost>, int> = 0>
  void list_numbers(Phase &p, Visitor &v)
  {
    v({"name", "-", "name of the phase", Kind::setting}, p.name);
    v({"wall_s", "s", "time on the clock", Kind::clock}, p.wall_s);
    v({"cpu_s", "s", "CPU time", Kind::clock}, p.cpu_s);
    v({"peak_memory_mb", "MB", "peak memory of the process so far", Kind::clock}, p.peak_memory_mb);
  }

  // Checksums (FNV-1a, 64 bits, hexadecimal) of the two files of a part, taken when the part ended. Empty: not known.
  struct FileSums
  {
    std::string table, snapshots;
  };

  template <class Sums, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Sums>, FileSums>, int> = 0>
  void list_numbers(Sums &s, Visitor &v)
  {
    v({"table", "-", "checksum of the .csv file (comparison, ensemble: of the .json file) as the run wrote it (FNV-1a, 64 bits)",
       Kind::setting},
      s.table);
    v({"snapshots", "-", "checksum of the .h5 file as the run wrote it", Kind::setting}, s.snapshots);
  }

  // Hashes of a scene's values and of the contents of its files, and of the text of scene.prm (FNV-1a, 64 bits, hexadecimal).
  // Empty: not known.
  struct SceneHashes
  {
    std::string sample, continuum, comparison, text, law_library;
  };

  template <class Hashes, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Hashes>, SceneHashes>, int> = 0>
  void list_numbers(Hashes &h, Visitor &v)
  {
    v({"sample", "-", "hash of sample, loading and discrete", Kind::setting}, h.sample);
    v({"continuum", "-", "hash of these and of continuum", Kind::setting}, h.continuum);
    v({"comparison", "-", "hash of these and of comparison, without seed and margins", Kind::setting}, h.comparison);
    v({"text", "-", "hash of scene.prm as the run wrote it", Kind::setting}, h.text);
    v({"law_library", "-", "hash of the library of law = library; empty: another law", Kind::setting}, h.law_library);
  }

  // The contents of provenance.json.
  struct RunFacts
  {
    discrete::Report       discrete         = unknown_report<discrete::Report>();
    continuum::Report      continuum        = unknown_report<continuum::Report>();
    continuum::Report      continuum_coarse = continuum;
    FileSums               discrete_files, continuum_files, continuum_coarse_files, comparison_files, ensemble_files;
    SceneHashes            hashes;
    std::vector<PhaseCost> phases;
  };
} // namespace diptych::coupling
