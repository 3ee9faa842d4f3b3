// diptych: a material point instead of the continuum's boundary problem, for tests of calibrations
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/laws/material_point.h"
#include "coupling/calibration/calibrate.h"
#include "coupling/statistics/history_table.h"

namespace diptych::coupling::tests
{
  struct SetNumber
  {
    const std::string &key;
    const double       value;

    template <class T> void operator()(const char *name, T &to, const char *, const char *) const { take(name, to); }
    template <class T> void operator()(const char *name, T &to, const char *, const std::array<double, 2> &, const char *) const
    {
      take(name, to);
    }
    template <class T> void take(const char *name, T &to) const
    {
      if constexpr (std::is_same_v<T, double>)
        if (key == name)
          to = value;
    }
  };

  inline continuum::LawOptions options_of(const Settings &settings)
  {
    continuum::LawOptions o;
    o.hardening        = continuum::HardeningKind::mobilisation;
    o.softening_strain = 0.05;
    for (const Entry &entry : settings)
      continuum::visit_parameters(o, SetNumber{entry.key, std::stod(entry.value)});
    return o;
  }

  inline ModelRun surrogate(const Settings &settings, const std::vector<Observable> &observables)
  {
    ModelRun run;
    try
      {
        const continuum::Law law    = continuum::make_law(continuum::LawKind::mohr_coulomb, options_of(settings));
        const auto           report = continuum::drive_material_point(law, {1, 0.03, 2.5e-4});
        if (report.status != continuum::MaterialPointStatus::finished)
          {
            run.words = report.message;
            return run;
          }
        HistoryTable table     = history_table(report.rows);
        table["progress"]      = table["axial_strain"];
        run.observation.values = Eigen::VectorXd(Eigen::Index(observables.size()));
        for (std::size_t k = 0; k < observables.size(); ++k)
          run.observation.values[Eigen::Index(k)] = mean_over_progress(
            table, observables[k].kind == ObservableKind::stress_ratio ? "stress_ratio" : "volumetric_strain",
            observables[k].from, observables[k].to);
      }
    catch (const std::invalid_argument &error)
      {
        run.words = error.what();
      }
    return run;
  }

  // Six parameters, thirteen bins to 3 % of both curves.
  inline Calibration six_parameters()
  {
    Calibration c;
    c.targets    = {{"synthetic", "", {}, {}, {1, 2, 3, 4}, true}};
    c.kinds      = {ObservableKind::stress_ratio, ObservableKind::volumetric_strain};
    c.bins       = {0.0005, 0.001, 0.0015, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.0125, 0.015, 0.02, 0.025, 0.03};
    c.parameters = {{"friction_angle_peak", Coordinate::logarithm, "", 30, 12, 45},
                    {"friction_angle_residual", Coordinate::drop_from, "friction_angle_peak", 0.6, 0.02, 0.9},
                    {"friction_angle_start", Coordinate::share_of, "friction_angle_peak", 0.9, 0.3, 1},
                    {"mobilisation_strain", Coordinate::logarithm, "", 0.01, 5e-4, 0.05},
                    {"dilatancy_angle_peak", Coordinate::share_of, "friction_angle_start", 0.3, 0.05, 1},
                    {"youngs_modulus", Coordinate::logarithm, "", 4000, 100, 20000}};
    c.starts     = 1;
    return c;
  }
  // Numbers of the coordinates.
  inline const std::vector<double> six_truths = {23, 0.35, 0.6, 0.004, 0.7, 900};

  inline Eigen::VectorXd point_of(Calibration c, const std::vector<double> &numbers)
  {
    for (std::size_t k = 0; k < numbers.size(); ++k)
      c.parameters[k].start = numbers[k];
    return Coordinates(c.parameters, {}).start();
  }
} // namespace diptych::coupling::tests
