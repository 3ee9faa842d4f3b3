// diptych: what the realisations of an ensemble have in common: means, intervals, verdicts
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "coupling/statistics/equivalence.h"
#include "coupling/statistics/equivalence_margins.h"
#include "coupling/comparison/comparison_schema.h"
#include "coupling/scene/scene.h"

namespace diptych::coupling
{
  // The numbers of one comparison.json that may be averaged over realisations.
  struct MemberNumber
  {
    std::string              name;
    double                   value  = 0;
    const NumberDescription *number = nullptr; // what it is
  };

  struct Member
  {
    int                                      seed = 0;
    std::vector<MemberNumber>                numbers;     // in the order of the file
    std::vector<std::pair<std::string, int>> band_counts; // "window 0-0.01 discrete": bands found there
  };

  // Names are made of the place and the key: "stage 0.04 discrete stress_ratio", "stage 0.04 discrete probe zone t_over_s",
  // "window 0.02-0.04 continuum band angle_deg" (of the strongest band; absent where none was found), "discrete_summary
  // peak_stress_ratio". Of {"value", "low", "high"} the value is taken; lists, texts, nulls, and what comparison_numbers.h lists
  // as a setting or as measured by a clock are left out. Throws std::invalid_argument naming what is missing.
  Member member_of(const nlohmann::json &comparison);

  // Whether nothing but chance tells left from right: vertical descent, no horizontal gravity, no wall driven by a key of its
  // own.
  bool is_mirror_symmetric(const Scene &scene);

  // Brings mirror images of a band together: angle_deg and offset_d become their absolute values, jump changes its sign with the
  // angle. Differences of the panels' bands, which were taken between mirror images, are removed.
  void fold(Member &member);

  struct Quantity
  {
    std::string         name, unit;
    bool                is_line = false; // an angle that repeats after 180 degrees
    SampleStatistics    statistics;
    std::vector<double> values; // one a member; NaN where it has none
  };

  struct BandCount
  {
    std::string name;                   // "window 0-0.01 discrete"
    int         members[3] = {0, 0, 0}; // in which no, one, two bands were found
  };

  // Continuum minus grains, member by member.
  struct PanelVerdict
  {
    std::string         quantity, unit; // of the margin and the difference
    double              margin   = 0;
    bool                relative = false; // to the grains' mean
    Equivalence         equivalence;
    std::vector<double> discrete, continuum; // one a member; NaN where it has none
  };

  struct Ensemble
  {
    std::vector<int>          seeds; // of the members, ascending
    std::vector<Quantity>     quantities;
    std::vector<BandCount>    bands;
    std::vector<PanelVerdict> verdicts; // peak stress ratio, volumetric strain, angle and thickness of each window
  };

  std::string text_of(const BandCount &count); // "one band in 6 of 8, none in 2"

  Ensemble evaluate(const std::vector<Member> &members, const EquivalenceMargins &margins);

  // A realisation that ended with another exit code than 0.
  struct FailedMember
  {
    int         seed      = 0;
    int         exit_code = 0; // 128 + signal where a signal ended it
    std::string message;
  };

  // What became of each seed.
  struct EnsembleRecord
  {
    std::vector<int>          seeds;       // asked for, ascending
    std::vector<FailedMember> failed;      // ascending
    std::vector<int>          interrupted; // stopped or not begun, ascending
    Ensemble                  ensemble;    // of the rest
  };
} // namespace diptych::coupling
