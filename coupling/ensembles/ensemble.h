// diptych: statistics over the members of an ensemble: means, intervals, verdicts
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
  // The numbers of one comparison.json that may be averaged over members.
  struct MemberNumber
  {
    std::string              name;
    double                   value  = 0;
    const NumberDescription *number = nullptr; // its unit, kind and meaning
  };

  struct Member
  {
    int                                      seed = 0;
    std::vector<MemberNumber>                numbers;     // in the order of the file
    std::vector<std::pair<std::string, int>> band_counts; // "window 0-0.01 discrete" with the number of bands found
  };

  // Collects numbers by name: place and key. Examples: "stage 0.04 discrete stress_ratio", "stage 0.04 discrete probe zone
  // t_over_s", "window 0.02-0.04 continuum band angle_deg" (of the strongest band; absent without one), "discrete_summary
  // peak_stress_ratio". Of {"value", "low", "high"} it takes the value. It omits lists, texts, nulls, settings and measured
  // times (comparison_numbers.h). Throws std::invalid_argument naming what is missing.
  Member member_of(const nlohmann::json &comparison);

  // True if only chance distinguishes left from right: vertical descent, no horizontal gravity, and no wall with a drive of its
  // own.
  bool is_mirror_symmetric(const Scene &scene);

  // Folds mirror images of a band onto each other. angle_deg and offset_d become absolute values, and jump changes its sign
  // with the angle. Removes differences between the panels' bands, which may have been taken between mirror images.
  void fold(Member &member);

  struct Quantity
  {
    std::string         name, unit;
    bool                is_line = false; // an angle that repeats after 180 degrees
    SampleStatistics    statistics;
    std::vector<double> values; // one per member; NaN if it has none
  };

  struct BandCount
  {
    std::string name;                   // "window 0-0.01 discrete"
    int         members[3] = {0, 0, 0}; // members with no, one and two bands
  };

  // Continuum minus grains, member by member.
  struct PanelVerdict
  {
    std::string         quantity, unit; // of the margin and the difference
    double              margin   = 0;
    bool                relative = false; // to the grains' mean
    Equivalence         equivalence;
    std::vector<double> discrete, continuum; // one per member; NaN if it has none
  };

  struct Ensemble
  {
    std::vector<int>          seeds; // of the members, ascending
    std::vector<Quantity>     quantities;
    std::vector<BandCount>    bands;
    std::vector<PanelVerdict> verdicts; // peak stress ratio, strength, volumetric strain; angle and width of each window
  };

  std::string text_of(const BandCount &count); // "one band in 6 of 8, none in 2"

  Ensemble evaluate(const std::vector<Member> &members, const EquivalenceMargins &margins);

  // A member whose run ended with an exit code other than 0.
  struct FailedMember
  {
    int         seed      = 0;
    int         exit_code = 0; // 128 + signal if a signal ended it
    std::string message;
  };

  // The outcome of every seed.
  struct EnsembleRecord
  {
    std::vector<int>          seeds;       // requested, ascending
    std::vector<FailedMember> failed;      // ascending
    std::vector<int>          interrupted; // stopped or not started, ascending
    Ensemble                  ensemble;    // of the other seeds
  };
} // namespace diptych::coupling
