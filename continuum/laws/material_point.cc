// diptych: one homogeneous point along a path of strains and stresses
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/material_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include <Eigen/LU>

#include "continuum/laws/any_law.h"
#include "continuum/laws/plastic_flow.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr double degree = 3.14159265358979323846 / 180, infinity = std::numeric_limits<double>::infinity();

    // A state of the path, tension positive.
    struct Point
    {
      MaterialState   state;
      Eigen::Vector3d strain  = Eigen::Vector3d::Zero(); // e_xx, e_yy, gamma_xy since the start
      PointVerdict    verdict = PointVerdict::reliable;  // the worst since the last row
    };

    struct Trial
    {
      Eigen::Vector3d d_strain;
      MaterialUpdate  update;
      double          error = infinity; // norm of the missing stress [pressure]; infinite if the law failed
    };

    template <class AnyLaw> class PointDriver
    {
    public:
      // `judge`: see drive_material_point() below.
      PointDriver(const AnyLaw &law, const PointPath &path, const std::optional<MohrCoulomb> &judge)
          : law(law),
            path(path),
            judge(judge)
      {
        now.state.stress[xx] = -path.stress(0, 0);
        now.state.stress[yy] = -path.stress(1, 1);
        now.state.stress[xy] = -path.stress(0, 1);
        now.state.stress_zz  = -path.stress_zz;
        start(law, now.state);
        note(Verdict::reliable);
      }

      MaterialPointReport run()
      {
        MaterialPointReport report;
        report.rows.push_back(row_since(now, path.progress_at(0)));
        for (std::size_t row = 1; row < path.values.size() && report.status == MaterialPointStatus::finished; ++row)
          {
            const Point  before = now;
            const double share  = advance(row, report.status);
            if (share == 0)
              break;
            const double p0 = path.progress_at(row - 1), p1 = path.progress_at(row);
            report.rows.push_back(row_since(before, share < 1 ? p0 + share * (p1 - p0) : p1));
          }
        if constexpr (std::is_same_v<AnyLaw, LibraryLaw>)
          report.variables = variable_names(law.library());
        report.message = message_of(report);
        return report;
      }

    private:
      // Goes on to a row. Returns the share of the way that succeeded.
      double advance(const std::size_t row, MaterialPointStatus &status)
      {
        const double length = path.progress_at(row) - path.progress_at(row - 1);
        double       share = 0, size = relaxes_before(row) ? 1. / 1024 : 1;
        const double least = size / 1024;
        now.verdict        = PointVerdict::reliable;
        while (share < 1 && size >= least)
          {
            const double end = std::min(1., share + size), d_progress = (end - share) * length;
            target                      = target_at(row, end);
            const Eigen::Vector3d guess = last_length > 0 ? Eigen::Vector3d(d_progress / last_length * last) : last;
            const Trial           trial = solve(time_of(d_progress), guess);
            status                      = status_of(trial);
            if (status != MaterialPointStatus::finished)
              {
                note_failure(trial, d_progress);
                size /= 2;
                continue;
              }
            accept(trial);
            share       = end;
            last        = trial.d_strain;
            last_length = d_progress;
          }
        target = target_at(row, 1); // for the message
        return share;
      }

      // Time alone leads to the row. A stress that decays by steps of n-ths of a row is wrong there by at most 0.27/n of its
      // start.
      bool relaxes_before(const std::size_t row) const
      {
        const bool creeps = std::is_same_v<AnyLaw, LibraryLaw> || law.yield_function(now.state) > 1e-9 * path.pressure;
        return creeps && !path.progress.empty() && path.values[row] == path.values[row - 1];
      }

      // Tension positive.
      Eigen::Vector3d target_at(const std::size_t row, const double share) const
      {
        Eigen::Vector3d value = path.values[row];
        if (share < 1)
          value = (1 - share) * path.values[row - 1] + share * value;
        for (int k = 0; k < 3; ++k)
          value[k] = (is_stress(path.controls[k]) ? 0 : path.values[0][k]) - value[k];
        return value;
      }

      MaterialPointStatus status_of(const Trial &trial) const
      {
        if (!std::isfinite(trial.error))
          return MaterialPointStatus::law_failed;
        return trial.error <= tolerance() ? MaterialPointStatus::finished : MaterialPointStatus::strain_not_found;
      }

      double tolerance() const
      {
        double scale = path.pressure;
        for (int k = 0; k < 3; ++k)
          if (is_stress(path.controls[k]))
            scale = std::max(scale, std::abs(target[k]));
        return 1e-10 * scale;
      }

      // Starts from the elastic step or from the last one, whichever is closer. Newton's step is halved if it does not reduce the
      // error or if the law fails.
      Trial solve(const double d_time, const Eigen::Vector3d &guess) const
      {
        const auto            elastic = rates(law.elastic_tangent());
        const Eigen::Vector3d none    = Eigen::Vector3d::Zero();
        Trial                 best    = attempt(elastic.solve(missing_strain(none) + missing_stress(now.state)), d_time);
        if (best.error > tolerance())
          if (const Trial other = attempt(guess + elastic.solve(missing_strain(guess)), d_time); other.error < best.error)
            best = other;
        Eigen::Vector3d step = none;
        double          size = 0;
        for (unsigned int n = 0; n < 200 && std::isfinite(best.error) && best.error > tolerance(); ++n)
          {
            if (size == 0)
              {
                step = rates(best.update.tangent).solve(missing_stress(best.update.state));
                size = 1;
              }
            const Trial next = attempt(best.d_strain + size * step, d_time);
            size             = next.error < best.error ? 0 : size / 2;
            if (size == 0)
              best = next;
          }
        return best;
      }

      Trial attempt(const Eigen::Vector3d &d_strain, const double d_time) const
      {
        Trial trial{d_strain, law.update(now.state, strain_of_law(d_strain), d_time)};
        if (trial.update.verdict != Verdict::failed)
          trial.error = missing_stress(trial.update.state).norm();
        return trial;
      }

      // Derivatives of the controls by the strain, decomposed.
      Eigen::PartialPivLU<Eigen::Matrix3d> rates(const Tangent &tangent) const
      {
        Eigen::Matrix3d plane, rows;
        for (unsigned int i = 0; i < n_classical; ++i)
          for (unsigned int k = 0; k < n_classical; ++k)
            plane(i, k) = tangent[i][k];
        for (int k = 0; k < 3; ++k)
          rows.row(k) = is_stress(path.controls[k]) ? form_of(path.controls[k]) * plane : form_of(path.controls[k]);
        return rows.partialPivLu();
      }

      // Prescribed strain - reached one; zero where the stress is prescribed.
      Eigen::Vector3d missing_strain(const Eigen::Vector3d &d_strain) const
      {
        Eigen::Vector3d missing = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
          if (!is_stress(path.controls[k]))
            missing[k] = target[k] - form_of(path.controls[k]) * (now.strain + d_strain);
        return missing;
      }

      // Prescribed stress - reached one; zero where the strain is prescribed.
      Eigen::Vector3d missing_stress(const MaterialState &state) const
      {
        const Eigen::Vector3d stress(state.stress[xx], state.stress[yy], state.stress[xy]);
        Eigen::Vector3d       missing = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
          if (is_stress(path.controls[k]))
            missing[k] = target[k] - form_of(path.controls[k]) * stress;
        return missing;
      }

      static Strain strain_of_law(const Eigen::Vector3d &strain)
      {
        Strain result;
        result[xx] = strain[0];
        result[yy] = strain[1];
        result[xy] = strain[2];
        return result;
      }

      void accept(const Trial &trial)
      {
        const MaterialState s0 = now.state;
        now.state              = trial.update.state;
        now.strain += trial.d_strain;
        add_plastic_flow(law.moduli(), s0, strain_of_law(trial.d_strain), now.state);
        note(trial.update.verdict);
      }

      // Adds the law's verdict, and that of the law that judges sigma_zz, to the worst since the last row.
      void note(const Verdict verdict)
      {
        if (verdict == Verdict::unreliable)
          now.verdict = PointVerdict::unreliable;
        if (judge && judge->yield_function(now.state) - now.state.overstress > 1e-8 * std::abs(judge->shear_strength(now.state)))
          now.verdict = std::max(now.verdict, PointVerdict::zz_outside);
      }

      MaterialPointRow row_since(const Point &before, const double progress) const
      {
        const MaterialState  &state = now.state;
        const Eigen::Vector3d d     = now.strain - before.strain;
        const double          sum = d[0] + d[1], shear = std::hypot(d[0] - d[1], d[2]);
        MaterialPointRow      row;
        row.progress                  = progress;
        row.axial_strain              = 0 - std::expm1(now.strain[1]);
        row.lateral_strain            = 0 - std::expm1(now.strain[0]);
        row.volumetric_strain         = 0 - std::expm1(now.strain[0] + now.strain[1]);
        row.exx                       = 0 - now.strain[0];
        row.eyy                       = 0 - now.strain[1];
        row.exy                       = 0 - now.strain[2] / 2;
        row.sxx                       = 0 - state.stress[xx];
        row.syy                       = 0 - state.stress[yy];
        row.sxy                       = 0 - state.stress[xy];
        row.szz                       = 0 - state.stress_zz;
        row.stress_ratio              = std::hypot((row.syy - row.sxx) / 2, row.sxy) / ((row.syy + row.sxx) / 2);
        row.mobilised_friction_angle  = std::asin(row.stress_ratio) / degree;
        row.dilatancy_angle           = shear > 0 ? std::asin(std::clamp(sum / shear, -1., 1.)) / degree : 0;
        row.equivalent_plastic_strain = state.equivalent_plastic_strain;
        row.overstress_share          = state.overstress > 0 ? state.overstress / law.shear_strength(state) : 0;
        row.dissipation               = state.dissipation;
        row.verdict                   = now.verdict;
        row.variables                 = part_of<LibraryState>(state);
        return row;
      }

      std::string message_of(const MaterialPointReport &report) const
      {
        const MaterialPointRow &end = report.rows.back();
        std::ostringstream      text;
        text.precision(6);
        if (report.status == MaterialPointStatus::finished)
          text << "finished at ";
        else
          text << reason_of(report.status) << "reached sxx = " << end.sxx << ", syy = " << end.syy << ", sxy = " << end.sxy
               << " at ";
        text << "progress " << end.progress;
        if (report.status == MaterialPointStatus::law_failed)
          text << library_failure;
        return text.str();
      }

      // Why no state follows the present one. Each sentence ends with its way out.
      std::string reason_of(const MaterialPointStatus status) const
      {
        std::ostringstream text;
        text.precision(6);
        const Stress &s              = now.state.stress;
        const double  strength       = law.shear_strength(now.state);
        const bool    is_at_strength = law.yield_function(now.state) > -0.01 * strength;
        if (is_at_strength)
          text << "the strength is reached at stress ratio " << -2 * shear_radius(s) / (s[xx] + s[yy]) << "; ";
        if (missing_stress(now.state).norm() > tolerance())
          {
            text << (is_at_strength ? "it does not carry" : "no strain was found that gives");
            for (int k = 0; k < 3; ++k)
              if (is_stress(path.controls[k]))
                text << ' ' << name_of(path.controls[k]) << " = " << -target[k] << ',';
            text << (is_at_strength ? " so prescribe a strain to pass a peak; " : " ");
          }
        if (const double fall = softening(); status == MaterialPointStatus::law_failed && fall > law.moduli().shear)
          text << "after its peak the strength falls by " << fall << " per plastic strain, faster than the stress can unload "
               << "elastically (shear modulus " << law.moduli().shear << "), so the path has no next state (snap-back): a larger "
               << "softening_strain or youngs_modulus or a viscosity helps; ";
        else if (status == MaterialPointStatus::law_failed)
          text << "the law found no stress; ";
        return text.str();
      }

      // Loss of strength per hardening variable.
      double softening() const
      {
        constexpr double d_kappa = 1e-7;
        MaterialState    later   = now.state;
        later.equivalent_plastic_strain += d_kappa;
        return (law.shear_strength(now.state) - law.shear_strength(later)) / d_kappa;
      }

      void note_failure(const Trial &trial, const double d_progress)
      {
        if constexpr (std::is_same_v<AnyLaw, LibraryLaw>)
          if (!std::isfinite(trial.error))
            library_failure = ": " + law.failure(now.state, strain_of_law(trial.d_strain), time_of(d_progress)).text;
      }

      double time_of(const double d_progress) const { return path.progress.empty() ? 0 : d_progress; }

      const AnyLaw                     &law;
      const PointPath                  &path;
      const std::optional<MohrCoulomb> &judge;
      Point                             now;
      Eigen::Vector3d                   target      = Eigen::Vector3d::Zero(); // of the present step, tension positive
      Eigen::Vector3d                   last        = Eigen::Vector3d::Zero(); // strain increment of the last step
      double                            last_length = 0;                       // its progress; 0: there is none
      std::string                       library_failure;
    };
  } // namespace

  MaterialPointReport drive_material_point(const LawKind     law,
                                           const LawOptions &options,
                                           const Units      &units,
                                           const PointPath  &path)
  {
    validate(path);
    // Three-dimensional Mohr-Coulomb judges where a law that stays in the plane leaves sigma_zz.
    std::optional<MohrCoulomb> judge;
    if (traits(law).stays_in_plane())
      judge.emplace(in_units(options, units));
    return std::visit([&](const auto &one) { return PointDriver(one, path, judge).run(); },
                      make_uniform_law(law, options, units));
  }
} // namespace diptych::continuum
