// diptych: one homogeneous point along the biaxial path
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/material_point.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "continuum/laws/plastic_flow.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr double degree = 3.14159265358979323846 / 180;

    struct Point
    {
      MaterialState state;
      double        lateral = 0, axial = 0;
    };

    struct LateralSolution
    {
      MaterialUpdate      update;
      Strain              d_strain;
      MaterialPointStatus status = MaterialPointStatus::finished;
    };

    // Solves sigma_xx(d e_xx) = -pressure. Newton's step is halved if it does not reduce the error of the stress or if the law
    // fails.
    template <class AnyLaw>
    LateralSolution solve_lateral(const AnyLaw        &law,
                                  const MaterialState &s0,
                                  Strain               d_strain,
                                  const double         d_time,
                                  const double         pressure)
    {
      LateralSolution best{law.update(s0, d_strain, d_time), d_strain, MaterialPointStatus::lateral_not_found};
      if (best.update.verdict == Verdict::failed)
        best.status = MaterialPointStatus::law_failed;
      double step = 0;
      for (unsigned int trial = 0; trial < 200 && best.update.verdict != Verdict::failed; ++trial)
        {
          const double residual = best.update.state.stress[xx] + pressure;
          if (std::abs(residual) <= 1e-10 * pressure)
            {
              best.status = MaterialPointStatus::finished;
              break;
            }
          if (step == 0)
            step = -residual / best.update.tangent[xx][xx];
          d_strain = best.d_strain;
          d_strain[xx] += step;
          const MaterialUpdate next = law.update(s0, d_strain, d_time);
          step /= 2;
          if (next.verdict == Verdict::failed || !(std::abs(next.state.stress[xx] + pressure) < std::abs(residual)))
            continue;
          best.update   = next;
          best.d_strain = d_strain;
          step          = 0;
        }
      return best;
    }

    template <class AnyLaw> MaterialPointRow row_of(const AnyLaw &law, const Point &point, const double axial_strain)
    {
      const MaterialState &state = point.state;
      MaterialPointRow     row;
      row.axial_strain              = axial_strain;
      row.lateral_strain            = 0 - std::expm1(point.lateral);
      row.volumetric_strain         = 0 - std::expm1(point.lateral + point.axial);
      row.sxx                       = -state.stress[xx];
      row.syy                       = -state.stress[yy];
      row.szz                       = -state.stress_zz;
      row.stress_ratio              = (row.syy - row.sxx) / (row.syy + row.sxx);
      row.mobilised_friction_angle  = std::asin(row.stress_ratio) / degree;
      row.equivalent_plastic_strain = state.equivalent_plastic_strain;
      row.overstress_share          = state.overstress / law.shear_strength(state);
      row.dissipation               = state.dissipation;
      row.variables                 = state.variables;
      return row;
    }

    template <class AnyLaw> MaterialPointReport drive(const AnyLaw &law, const MaterialPointPath &path)
    {
      MaterialPointReport report;
      Point               point;
      point.state.stress[xx] = point.state.stress[yy] = point.state.stress_zz = -path.pressure;
      start(law, point.state);
      report.rows.push_back(row_of(law, point, 0));

      const unsigned int n_steps = std::max(1., std::ceil(path.axial_strain / path.step - 1e-9));
      Strain             d_strain;
      for (unsigned int k = 1; k <= n_steps; ++k)
        {
          const double end = k < n_steps ? k * path.step : path.axial_strain, d_time = end - report.axial_strain;
          const double last = d_strain[yy];
          d_strain[yy]      = std::log1p(-end) - point.axial;
          if (last != 0)
            d_strain[xx] *= d_strain[yy] / last; // scaled, as too large a guess in a shorter last step ends at the tip
          const auto solution = solve_lateral(law, point.state, d_strain, d_time, path.pressure);
          report.status       = solution.status;
          if (report.status != MaterialPointStatus::finished)
            break;
          d_strain               = solution.d_strain; // also the guess for the next step
          const MaterialState s0 = point.state;
          point.state            = solution.update.state;
          point.lateral += d_strain[xx];
          point.axial += d_strain[yy];
          report.axial_strain = end;
          add_plastic_flow(law.moduli(), s0, d_strain, point.state);
          MaterialPointRow row = row_of(law, point, end);
          row.dilatancy_angle  = std::asin(std::clamp((d_strain[xx] + d_strain[yy]) / (d_strain[xx] - d_strain[yy]), -1., 1.)) /
                                degree;
          row.verdict = solution.update.verdict;
          report.rows.push_back(row);
        }
      return report;
    }

    std::string message_of(const MaterialPointReport &report)
    {
      std::ostringstream text;
      switch (report.status)
        {
        case MaterialPointStatus::finished:
          text << "finished";
          break;
        case MaterialPointStatus::law_failed:
          text << "the law found no stress";
          break;
        case MaterialPointStatus::lateral_not_found:
          text << "no lateral strain was found that holds the pressure";
          break;
        }
      text << (report.status == MaterialPointStatus::finished ? " at" : " in the step after") << " axial strain "
           << report.axial_strain;
      return text.str();
    }
  } // namespace

  void validate(const MaterialPointPath &path)
  {
    std::ostringstream wrong;
    if (!(path.pressure > 0 && std::isfinite(path.pressure)))
      wrong << "pressure = " << path.pressure << " must be positive";
    else if (!(path.axial_strain > 0 && path.axial_strain < 1))
      wrong << "axial_strain = " << path.axial_strain << " must lie in (0, 1)";
    else if (!(path.step >= 1e-7 && path.step < 1))
      wrong << "step = " << path.step << " must lie in [1e-7, 1)";
    if (!wrong.str().empty())
      throw std::invalid_argument(wrong.str());
  }

  MaterialPointReport drive_material_point(const Law &law, const MaterialPointPath &path)
  {
    validate(path);
    MaterialPointReport report = std::visit([&](const auto &one) { return drive(one, path); }, law);
    report.message             = message_of(report);
    if (const auto *library = std::get_if<LibraryLaw>(&law))
      {
        report.variables = variable_names(library->library());
        if (library->failure().is_broken)
          report.status = MaterialPointStatus::law_failed;
        if (report.status == MaterialPointStatus::law_failed)
          report.message = message_of(report) + ": " + library->failure().text;
      }
    return report;
  }
} // namespace diptych::continuum
