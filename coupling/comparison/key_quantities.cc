// diptych: the quantities by which the panels are compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/key_quantities.h"

#include <cmath>

namespace diptych::coupling
{
  QuantityBasis basis_of(const Scene &scene)
  {
    return {averaging_width(scene), scene.loading.mode == discrete::LoadingMode::time,
            scene.loading.pressure * scene.sample.mean_diameter};
  }

  double peak_stress_ratio(const QuantityBasis &basis, const HistoryTable &h)
  {
    return peak_of_running_mean(h, "stress_ratio", basis.averaging_width).value;
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
