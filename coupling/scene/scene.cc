// diptych: the scene, every parameter of one comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace diptych::coupling
{
  std::vector<KeyDescription> keys_of(Scene scene)
  {
    std::vector<KeyDescription> keys;
    for_each_section(scene, [&](const char *section, auto &options) { visit_parameters(options, DescribeKeys{section, keys}); });
    return keys;
  }

  std::vector<double> stages(const LoadingOptions &loading)
  {
    const bool   time          = loading.mode == discrete::LoadingMode::time;
    const double end           = time ? loading.duration : loading.axial_strain,
                 interval      = time ? loading.stage_time : loading.stage_strain;
    std::vector<double> values = loading.stages;
    if (!values.empty())
      return values;
    const int count = int(std::lround(end / interval));
    for (int k = 1; k <= count; ++k)
      values.push_back(k * interval);
    return values;
  }

  discrete::Loading discrete_loading(const LoadingOptions &o)
  {
    discrete::Loading loading;
    loading.pressure                 = o.pressure;
    loading.inertial_number          = o.inertial_number;
    loading.horizontal_over_vertical = o.horizontal_over_vertical;
    loading.stages                   = stages(o);
    loading.affine_start             = o.affine_start;
    loading.mode                     = o.mode;
    loading.strain_rate              = o.strain_rate;
    loading.normal_pressure          = o.normal_pressure;
    if (o.mode == discrete::LoadingMode::path)
      loading.path = cell_path(o.path, {o.pressure, o.axial_strain, std::clamp(1e-3 * o.axial_strain, 1e-7, 0.5)});
    return loading;
  }

  continuum::Units continuum_units(const Scene &scene)
  {
    return {scene.loading.pressure, scene.sample.mean_diameter};
  }

  bool is_mirror_symmetric(const Scene &scene)
  {
    bool is_driven = false;
    discrete::for_each_drive(scene.discrete.drives, [&](int, int, const char *, const discrete::DriveOption &drive) {
      is_driven = is_driven || !drive.is_auto();
    });
    return scene.loading.mode == discrete::LoadingMode::descent && scene.loading.horizontal_over_vertical == 0 && !is_driven &&
           scene.discrete.stepping.gravity_x == 0;
  }

  double inertial_number(const Scene &scene)
  {
    const double rate = discrete::strain_rate(discrete_loading(scene.loading), scene.sample.mean_diameter, scene.sample.density);
    return rate * scene.sample.mean_diameter * std::sqrt(scene.sample.density / scene.loading.pressure);
  }

  double averaging_width(const Scene &scene)
  {
    return scene.loading.mode == discrete::LoadingMode::time ? scene.loading.stage_time : scene.comparison.averaging_strain;
  }
} // namespace diptych::coupling
