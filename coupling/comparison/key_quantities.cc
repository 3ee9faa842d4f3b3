// diptych: the quantities by which the panels are compared
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/key_quantities.h"

#include <cmath>

namespace diptych::coupling
{
  double peak_stress_ratio(const Scene &scene, const HistoryTable &h)
  {
    return peak_of_running_mean(h, "stress_ratio", averaging_width(scene)).value;
  }

  double early_strength(const Scene &scene, const HistoryTable &h)
  {
    return scene.loading.mode == discrete::LoadingMode::time ? NAN : ratio_of_means(h, 0, early_strain);
  }

  double strength(const Scene &scene, const HistoryTable &h)
  {
    return scene.loading.mode == discrete::LoadingMode::time ? NAN
                                                             : ratio_of_means(h, early_strain, column(h, "progress").back());
  }

  double platen_force(const Scene &scene, const HistoryTable &h)
  {
    const double end = column(h, "progress").back();
    if (scene.loading.mode == discrete::LoadingMode::time || !is_beyond(end, early_strain))
      return NAN;
    const auto mean = [&](const char *name) { return mean_over_progress(h, name, early_strain, end); };
    return (mean("lower_fy") - mean("upper_fy")) / 2 / (scene.loading.pressure * scene.sample.mean_diameter);
  }

  double final_volume(const Scene &, const HistoryTable &h)
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

  PanelValues panel_values(const Scene &scene, const HistoryTable &h)
  {
    PanelValues values;
    for (const KeyQuantity &q : key_quantities)
      if (q.of_panel)
        values[q.key] = q.of_panel(scene, h);
    return values;
  }
} // namespace diptych::coupling
