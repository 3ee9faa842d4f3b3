// diptych: nonlinear least squares with bounds, where every residual needs a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/least_squares.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <ROL_Bounds.hpp>
#include <ROL_Objective.hpp>
#include <ROL_StdVector.hpp>
#include <ROL_TypeB_LinMoreAlgorithm.hpp>

namespace diptych::coupling
{
  namespace
  {
    constexpr double smallest_step = 1e-6;

    Eigen::VectorXd eigen_of(const ROL::Vector<double> &x)
    {
      const std::vector<double> &values = *dynamic_cast<const ROL::StdVector<double> &>(x).getVector();
      return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
    }

    void set(ROL::Vector<double> &x, const Eigen::VectorXd &values)
    {
      std::vector<double> &to = *dynamic_cast<ROL::StdVector<double> &>(x).getVector();
      to.assign(values.data(), values.data() + values.size());
    }

    // chi^2 / 2 with the Gauss-Newton Hessian.
    class GaussNewton : public ROL::Objective<double>
    {
    public:
      GaussNewton(const BatchResiduals &residuals, const LeastSquaresOptions &options, LeastSquaresFit &fit)
          : residuals(residuals),
            options(options),
            fit(fit),
            trial{fit.point, fit.residual}
      {}

      bool has_failed = false, has_ever_failed = false; // rejected steps: the last one, any
      bool is_little = false;                           // the last accepted step gained little

      void update(const ROL::Vector<double> &, const ROL::UpdateType type, int) override
      {
        if (type == ROL::UpdateType::Revert)
          has_failed = has_ever_failed = true;
        if (type == ROL::UpdateType::Accept)
          accept();
      }

      double value(const ROL::Vector<double> &x, double &) override
      {
        const Eigen::VectorXd point = eigen_of(x);
        if (point == fit.point)
          return 0.5 * fit.chi2;
        trial = {point, residuals({point}).front()};
        ++fit.evaluations;
        return trial.residual.size() > 0 ? 0.5 * trial.residual.squaredNorm() : 10 * (1 + fit.chi2);
      }

      void gradient(ROL::Vector<double> &g, const ROL::Vector<double> &, double &) override
      {
        set(g, fit.jacobian.transpose() * fit.residual);
      }

      void hessVec(ROL::Vector<double> &hv, const ROL::Vector<double> &v, const ROL::Vector<double> &, double &) override
      {
        set(hv, fit.jacobian.transpose() * (fit.jacobian * eigen_of(v)));
      }

    private:
      struct Point
      {
        Eigen::VectorXd point, residual;
      };

      void accept()
      {
        const Eigen::VectorXd step = trial.point - fit.point;
        if (step.squaredNorm() == 0 || trial.residual.size() == 0)
          return;
        fit.jacobian += (trial.residual - fit.residual - fit.jacobian * step) * step.transpose() / step.squaredNorm();
        const double chi2 = trial.residual.squaredNorm();
        is_little         = fit.chi2 - chi2 < std::max(options.least_gain, options.least_decrease * fit.chi2);
        fit.point = trial.point, fit.residual = trial.residual, fit.chi2 = chi2;
        fit.is_fresh = false;
      }

      const BatchResiduals      &residuals;
      const LeastSquaresOptions &options;
      LeastSquaresFit           &fit;
      Point                      trial;
    };

    // Ends a search if a step fails with an old Jacobian, or if steps gain nothing any more.
    class EndOfSearch : public ROL::StatusTest<double>
    {
    public:
      EndOfSearch(GaussNewton &objective, const LeastSquaresFit &fit, const LeastSquaresOptions &options)
          : objective(objective),
            fit(fit),
            options(options)
      {}

      bool check(ROL::AlgorithmState<double> &state) override
      {
        const bool failed    = objective.has_failed && !fit.is_fresh;
        const bool explained = fit.chi2 < options.exact * double(fit.residual.size());
        const bool nothing   = state.iter > 0 && !objective.has_failed && objective.is_little;
        const bool too_short = state.iter > 0 && state.snorm < smallest_step;
        objective.has_failed = false;
        return !failed && !nothing && !explained && !too_short && state.iter < options.most_steps && state.gnorm > 0;
      }

    private:
      GaussNewton               &objective;
      const LeastSquaresFit     &fit;
      const LeastSquaresOptions &options;
    };

    // Searches from the fit's point with its Jacobian. Returns true if no step was rejected.
    bool search(const BatchResiduals &residuals, const LeastSquaresOptions &options, LeastSquaresFit &fit)
    {
      Teuchos::ParameterList list;
      auto                  &region = list.sublist("Step").sublist("Trust Region");
      region.set("Initial Radius", options.first_radius);
      region.set("Radius Growing Threshold", 0.75);
      auto &krylov = list.sublist("General").sublist("Krylov"); // with few unknowns the minimum of the model is found exactly
      krylov.set("Iteration Limit", 200);
      krylov.set("Absolute Tolerance", 1e-14);
      krylov.set("Relative Tolerance", 1e-8);

      const Eigen::Index                   n     = fit.point.size();
      const auto                           x     = ROL::makePtr<std::vector<double>>(fit.point.data(), fit.point.data() + n);
      const auto                           lower = ROL::makePtr<ROL::StdVector<double>>(ROL::makePtr<std::vector<double>>(n, 0.));
      const auto                           upper = ROL::makePtr<ROL::StdVector<double>>(ROL::makePtr<std::vector<double>>(n, 1.));
      ROL::StdVector<double>               unknowns(x), dual(ROL::makePtr<std::vector<double>>(n, 0.));
      ROL::Bounds<double>                  bounds(lower, upper);
      GaussNewton                          objective(residuals, options, fit);
      ROL::TypeB::LinMoreAlgorithm<double> algorithm(list);
      algorithm.setStatusTest(ROL::makePtr<EndOfSearch>(objective, fit, options));
      std::ostringstream nowhere;
      algorithm.run(unknowns, dual, objective, bounds, nowhere);
      return !objective.has_ever_failed;
    }

    void renew(const BatchResiduals &residuals, const double difference, LeastSquaresFit &fit)
    {
      fit.jacobian = difference_jacobian(residuals, fit.point, fit.residual, difference);
      fit.evaluations += int(fit.point.size());
      ++fit.jacobians;
      fit.is_fresh = true;
    }
  } // namespace

  Eigen::MatrixXd difference_jacobian(const BatchResiduals  &residuals,
                                      const Eigen::VectorXd &point,
                                      const Eigen::VectorXd &residual,
                                      const double           difference)
  {
    const auto moved = [&](const Eigen::Index k, const double by) {
      Eigen::VectorXd x = point;
      x[k] += by;
      return x;
    };
    std::vector<double>          steps;
    std::vector<Eigen::VectorXd> points;
    for (Eigen::Index k = 0; k < point.size(); ++k)
      {
        steps.push_back(point[k] + difference <= 1 ? difference : -difference);
        points.push_back(moved(k, steps.back()));
      }
    const std::vector<Eigen::VectorXd> values = residuals(points);
    Eigen::MatrixXd                    jacobian(residual.size(), point.size());
    for (Eigen::Index k = 0; k < point.size(); ++k)
      {
        Eigen::VectorXd value = values[std::size_t(k)];
        double          step  = steps[std::size_t(k)];
        if (value.size() == 0 && point[k] - step >= 0 && point[k] - step <= 1)
          step = -step, value = residuals({moved(k, step)}).front();
        if (value.size() == 0)
          jacobian.col(k).setZero();
        else
          jacobian.col(k) = (value - residual) / step;
      }
    return jacobian;
  }

  LeastSquaresFit least_squares(const BatchResiduals                 &residuals,
                                const Eigen::VectorXd                &start,
                                const LeastSquaresOptions            &options,
                                const std::optional<Eigen::MatrixXd> &jacobian)
  {
    LeastSquaresFit fit;
    fit.point       = start;
    fit.residual    = residuals({start}).front();
    fit.evaluations = 1;
    if (fit.residual.size() == 0)
      {
        fit.words = "the run at the start failed";
        return fit;
      }
    fit.chi2 = fit.residual.squaredNorm();
    if (jacobian)
      fit.jacobian = *jacobian;
    else
      renew(residuals, options.difference, fit);
    for (;;)
      {
        const double before         = fit.chi2;
        const bool   was_fresh      = fit.is_fresh;
        const bool   went_well      = search(residuals, options, fit);
        const bool   changed_little = before - fit.chi2 < std::max(options.least_gain, options.least_decrease * before);
        const bool   explained      = fit.chi2 < options.exact * double(fit.residual.size());
        if (explained && !fit.is_fresh)
          renew(residuals, options.difference, fit);
        if (explained || (was_fresh && changed_little))
          {
            fit.arrived = fit.is_fresh = true;
            return fit;
          }
        if (options.trusts_given && fit.jacobians == 0 && went_well)
          {
            fit.arrived = true;
            return fit;
          }
        if (fit.jacobians >= options.most_jacobians)
          {
            fit.words = "the last of " + std::to_string(fit.jacobians) +
                        " Jacobians still lowered chi^2; the search has not converged";
            return fit;
          }
        renew(residuals, options.difference, fit);
      }
  }
} // namespace diptych::coupling
