// diptych: the quantities by which the panels are compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/key_quantities.h"

#include <cmath>

namespace diptych::coupling
{
  QuantityBasis basis_of(const Scene &scene)
  {
    const discrete::LateralOptions &sides      = scene.discrete.lateral;
    const bool                      is_pressed = sides.lateral == discrete::Lateral::end_grains ||
                            (sides.lateral == discrete::Lateral::rigid_walls &&
                             sides.side_motion == discrete::SideMotion::pressure);
    const bool is_biaxial = scene.loading.mode == discrete::LoadingMode::descent && is_pressed;
    return {averaging_width(scene), scene.loading.mode == discrete::LoadingMode::time,
            scene.loading.pressure * scene.sample.mean_diameter, is_biaxial ? scene.loading.pressure : NAN};
  }

  std::vector<double> nominal_stress_ratio(const QuantityBasis &basis, const HistoryTable &h)
  {
    std::vector<double>        ratio(column(h, "progress").size(), NAN);
    const std::vector<double> &lower = column(h, "lower_fy"), &upper = column(h, "upper_fy"), &width = column(h, "width");
    for (std::size_t k = 0; k < ratio.size(); ++k)
      {
        const double axial = (lower[k] - upper[k]) / 2 / width[k];
        ratio[k]           = (axial - basis.side_pressure) / (axial + basis.side_pressure);
      }
    return ratio;
  }

  double peak_nominal_stress_ratio(const QuantityBasis &basis, const HistoryTable &h)
  {
    const HistoryTable nominal = {{"progress", column(h, "progress")}, {"ratio", nominal_stress_ratio(basis, h)}};
    return peak_of_running_mean(nominal, "ratio", basis.averaging_width).value;
  }

  double nominal_friction_angle(const QuantityBasis &basis, const HistoryTable &h)
  {
    return std::asin(peak_nominal_stress_ratio(basis, h)) * 180 / M_PI;
  }

  double peak_stress_ratio(const QuantityBasis &basis, const HistoryTable &h)
  {
    return peak_of_running_mean(h, "stress_ratio", basis.averaging_width).value;
  }

  double peak_friction_angle(const QuantityBasis &basis, const HistoryTable &h)
  {
    return std::asin(peak_stress_ratio(basis, h)) * 180 / M_PI;
  }

  // Largest running mean of t/s from columns, with sxx as if the side forces acted on the outline.
  static double peak_at_outline(const QuantityBasis &basis, const HistoryTable &h, const std::array<const char *, 3> &names)
  {
    const std::vector<double> &xx = column(h, names[0]), &xy = column(h, names[1]), &yy = column(h, names[2]);
    const auto                 found   = h.find("side_sxx"); // the sides of the continuum are the outline
    const std::vector<double> *side    = found == h.end() || std::isnan(basis.side_pressure) ? nullptr : &found->second;
    HistoryTable               outline = {{"progress", column(h, "progress")}, {"ratio", {}}};
    for (std::size_t k = 0; k < xx.size(); ++k)
      {
        const double moved = xx[k] + (side ? basis.side_pressure - (*side)[k] : 0.);
        outline["ratio"].push_back(std::hypot(moved - yy[k], 2 * xy[k]) / (moved + yy[k]));
      }
    return peak_of_running_mean(outline, "ratio", basis.averaging_width).value;
  }

  double peak_outline_stress_ratio(const QuantityBasis &basis, const HistoryTable &h)
  {
    return peak_at_outline(basis, h, {"sxx", "sxy", "syy"});
  }

  double peak_core_stress_ratio(const QuantityBasis &basis, const HistoryTable &h)
  {
    return peak_at_outline(basis, h, {"core_sxx", "core_sxy", "core_syy"});
  }

  double early_strength(const QuantityBasis &basis, const HistoryTable &h)
  {
    return basis.is_timed ? NAN : ratio_of_means(h, 0, early_strain);
  }

  double strength(const QuantityBasis &basis, const HistoryTable &h)
  {
    return basis.is_timed ? NAN : ratio_of_means(h, early_strain, column(h, "progress").back());
  }

  double platen_force(const QuantityBasis &basis, const HistoryTable &h)
  {
    const double end = column(h, "progress").back();
    if (basis.is_timed || !is_beyond(end, early_strain))
      return NAN;
    const auto mean = [&](const char *name) { return mean_over_progress(h, name, early_strain, end); };
    return (mean("lower_fy") - mean("upper_fy")) / 2 / basis.force;
  }

  double final_volume(const QuantityBasis &, const HistoryTable &h)
  {
    return column(h, "volumetric_strain").back();
  }

  Interval angle_of(const BandValues &band, double)
  {
    return band.angle_deg;
  }

  Interval width_of(const BandValues &band, const double d)
  {
    return times(1 / d, band.width_10_90);
  }

  PanelValues panel_values(const QuantityBasis &basis, const HistoryTable &h)
  {
    PanelValues values;
    for (const KeyQuantity &q : key_quantities)
      if (q.of_panel)
        values[q.key] = q.of_panel(basis, h);
    return values;
  }
} // namespace diptych::coupling
