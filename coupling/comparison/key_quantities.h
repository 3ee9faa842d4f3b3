// diptych: the quantities by which the panels are compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "coupling/bands/band.h"
#include "coupling/numbers/number_entry.h"
#include "coupling/scene/scene.h"
#include "coupling/statistics/history_table.h"

namespace diptych::coupling
{
  // A quantity by which the panels are compared. An ensemble calls them equivalent within a margin.
  enum class Difference
  {
    absolute,
    relative, // to the grains
    line      // rotation of a line [degrees]
  };
  constexpr auto choices(Difference)
  {
    return std::array{std::pair{Difference::absolute, "absolute"}, std::pair{Difference::relative, "relative"},
                      std::pair{Difference::line, "line"}};
  }
  struct Margin
  {
    const char *key; // in the section comparison of a scene
    Difference  of;
  };

  // Parts of a scene on which the formulas depend.
  struct QuantityBasis
  {
    double averaging_width; // of running means, in progress
    bool   is_timed;        // the progress is time
    double force;           // P d [pressure * length]
    double side_pressure;   // P; NaN if the sides do not carry it
  };
  QuantityBasis basis_of(const Scene &scene);

  // Formulas. Strengths are T/S of a loading along strain: early up to this strain, which depends on the start and on the
  // solver's accuracy, or the rest. They and the platen force [P d, mean of both platens] are NaN if the history ends before, or
  // along time. d: mean diameter.
  constexpr double    early_strain = 0.003;
  std::vector<double> nominal_stress_ratio(const QuantityBasis &basis, const HistoryTable &history); // as laboratories plot it
  double              peak_stress_ratio(const QuantityBasis &basis, const HistoryTable &history);
  double              peak_friction_angle(const QuantityBasis &basis, const HistoryTable &history); // [degrees]
  double              peak_outline_stress_ratio(const QuantityBasis &basis, const HistoryTable &history);
  double              peak_core_stress_ratio(const QuantityBasis &basis, const HistoryTable &history);
  double              peak_nominal_stress_ratio(const QuantityBasis &basis, const HistoryTable &history);
  double              nominal_friction_angle(const QuantityBasis &basis, const HistoryTable &history); // [degrees]
  double              early_strength(const QuantityBasis &basis, const HistoryTable &history);
  double              strength(const QuantityBasis &basis, const HistoryTable &history);
  double              platen_force(const QuantityBasis &basis, const HistoryTable &history);
  double              final_volume(const QuantityBasis &basis, const HistoryTable &history);
  Interval            angle_of(const BandValues &band, double d);
  Interval            width_of(const BandValues &band, double d); // [d]

  struct KeyQuantity
  {
    const char *key; // as in discrete_summary and continuum_summary; of a band: band_ and its key in windows/PANEL/bands
    const char *name, *unit, *meaning;
    Margin      margin;
    double (*of_panel)(const QuantityBasis &, const HistoryTable &); // null: it is that of a band
    Interval (*of_band)(const BandValues &, double d);
  };
  // The only list: summaries, ensembles, studies, validation and pages take what stands here.
  constexpr Margin      of_ratio         = {"margin_peak_stress_ratio", Difference::relative};
  constexpr Margin      of_volume        = {"margin_volumetric_strain", Difference::absolute};
  constexpr Margin      of_angle         = {"margin_angle", Difference::line};
  constexpr Margin      of_width         = {"margin_thickness", Difference::relative};
  constexpr KeyQuantity key_quantities[] = {
    {"peak_stress_ratio", "peak t/s", "-", "largest running mean of the stress ratio t/s", of_ratio, peak_stress_ratio, nullptr},
    {"peak_friction_angle_deg", "friction angle of the peak", "degrees", "arcsine of the peak t/s", of_ratio, peak_friction_angle,
     nullptr},
    {"peak_outline_stress_ratio", "peak t/s with sides at the outline", "-",
     "largest running mean of t/s, as if the forces on the sides acted on the outline and not on grains inside it", of_ratio,
     peak_outline_stress_ratio, nullptr},
    {"peak_core_stress_ratio", "peak t/s of the core", "-", "the same in the middle half of the height", of_ratio,
     peak_core_stress_ratio, nullptr},
    {"peak_nominal_stress_ratio", "nominal peak t/s", "-",
     "largest running mean of (F/W - P) / (F/W + P), as laboratories plot it: platen force F, width W, pressure P on the sides",
     of_ratio, peak_nominal_stress_ratio, nullptr},
    {"friction_angle_deg", "friction angle of the nominal peak", "degrees", "arcsine of the nominal peak t/s", of_ratio,
     nominal_friction_angle, nullptr},
    {"strength", "strength T/S from 0.3 % strain", "-", "strength T/S from 0.3 % strain to the end", of_ratio, strength, nullptr},
    {"platen_force_pd", "platen force from 0.3 % strain", "P d",
     "mean vertical force of the platens from 0.3 % strain to the end", of_ratio, platen_force, nullptr},
    {"final_volumetric_strain", "volumetric strain at the end", "-", "volumetric strain at the end, positive in compression",
     of_volume, final_volume, nullptr},
    {"band_angle_deg", "inclination of the band", "degrees", "", of_angle, nullptr, angle_of},
    {"band_width_10_90_d", "10-90 % width of the band", "mean diameters", "", of_width, nullptr, width_of}};

  // Values of one panel by the keys of its quantities.
  using PanelValues = std::map<std::string, double>;
  PanelValues   panel_values(const QuantityBasis &basis, const HistoryTable &history);
  inline double value_of(const PanelValues &values, const KeyQuantity &q) // NaN: no panel
  {
    const auto found = values.find(q.key);
    return found == values.end() ? NAN : found->second;
  }
} // namespace diptych::coupling
