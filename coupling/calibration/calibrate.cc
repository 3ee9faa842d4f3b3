// diptych: fits parameters of the continuum to the curves of the grains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/calibration/calibrate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "coupling/calibration/findings.h"
#include "coupling/calibration/fitted_data.h"
#include "coupling/calibration/identification.h"
#include "coupling/calibration/least_squares.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double same_minimum = 0.05; // in every coordinate; they run over [0, 1]
    constexpr double hardly_worse = 4;    // in chi^2: two deviations

    // The k-th point of the Halton sequence, in the middle four fifths of the cube.
    Eigen::VectorXd spread_point(const int k, const Eigen::Index n)
    {
      constexpr std::array<int, 12> primes = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
      Eigen::VectorXd               point(n);
      for (Eigen::Index d = 0; d < n; ++d)
        {
          const int base = primes.at(std::size_t(d));
          double    sum = 0, part = 1;
          for (int rest = k; rest > 0; rest /= base)
            part /= base, sum += part * (rest % base);
          point[d] = 0.1 + 0.8 * sum;
        }
      return point;
    }

    class Calibrator
    {
    public:
      Calibrator(const Calibration                  &calibration,
                 const Coordinates                  &coordinates,
                 const std::vector<CalibrationPath> &paths,
                 const RunModel                     &run,
                 CalibrationRecord                  &record)
          : calibration(calibration),
            coordinates(coordinates),
            paths(paths),
            run(run),
            record(record)
      {
        std::vector<TargetData> of_fitted;
        for (std::size_t p = 0; p < paths.size(); ++p)
          if (paths[p].target.is_fitted)
            fitted.push_back(p), of_fitted.push_back(paths[p].data);
        std::vector<TargetData> all;
        for (const CalibrationPath &path : paths)
          all.push_back(path.data);
        record.noise = noise_of(of_fitted.front().samples.size() > 1 || of_fitted.size() > 1 ? of_fitted : all,
                                calibration.noise);
        data.emplace(record.noise, calibration.noise);
        for (const std::size_t p : fitted)
          data->add(paths[p].data, paths[p].left_out);
        record.n_observables = data->n_counting();
        if (record.n_observables == 0)
          throw std::invalid_argument("no observable is left to fit; check targets, quantities and bins");
      }

      void calibrate()
      {
        const LeastSquaresFit coarse = fit_coarse();
        const LeastSquaresFit fine   = fit_fine(coarse);
        best                         = fine.point;
        report(fine, coarse);
        profile(coarse);
        add_predictions();
        record.status = "finished";
      }

    private:
      std::vector<std::vector<ModelRun>> runs_at(const std::vector<Eigen::VectorXd> &points,
                                                 const std::vector<std::size_t>     &on,
                                                 const ModelMesh                     mesh,
                                                 int                                &count)
      {
        ModelTask task{on, {}, mesh, calibration.load_step};
        for (const Eigen::VectorXd &point : points)
          task.points.push_back(settings_on(on, point));
        count += int(points.size() * on.size());
        return run(task);
      }

      Settings settings_at(const Eigen::VectorXd &point, const std::string &target) const
      {
        Settings       settings = calibration.fixed;
        const Settings found    = coordinates.settings(point, target);
        settings.insert(settings.end(), found.begin(), found.end());
        return settings;
      }

      std::vector<Settings> settings_on(const std::vector<std::size_t> &on, const Eigen::VectorXd &point) const
      {
        std::vector<Settings> settings;
        for (const std::size_t p : on)
          settings.push_back(settings_at(point, paths[p].target.name));
        return settings;
      }

      // Records the settings that all targets share, and the values of single targets.
      void keep_settings(const Eigen::VectorXd &point)
      {
        record.settings = settings_at(point, "");
        record.own.clear();
        for (const CalibrationPath &path : paths)
          for (std::size_t k = 0; k < coordinates.size(); ++k)
            if (const CalibrationParameter &p = coordinates.parameter(k); !p.targets.empty() && p.belongs_to(path.target.name))
              record.own.push_back({path.target.name, p.key, coordinates.values(point)[k]});
      }

      // Unweighted values of the fitted paths, one after the other. Empty if a run failed.
      static Eigen::VectorXd joined_values(const std::vector<ModelRun> &runs)
      {
        Eigen::VectorXd joined;
        for (const ModelRun &one : runs)
          {
            if (!one.words.empty())
              return {};
            const Eigen::Index n = joined.size();
            joined.conservativeResize(n + one.observation.values.size());
            joined.tail(one.observation.values.size()) = one.observation.values;
          }
        return joined;
      }

      // Appends the prior: each coordinate has a deviation about the first start.
      Eigen::VectorXd with_prior(const Eigen::VectorXd &residual, const Eigen::VectorXd &point) const
      {
        if (residual.size() == 0)
          return residual;
        Eigen::VectorXd joined(residual.size() + point.size());
        joined << residual, (point - coordinates.start()) / deviation_beforehand;
        return joined;
      }
      double chi2_of_data(const LeastSquaresFit &fit) const { return fit.residual.head(data->size()).squaredNorm(); }

      BatchResiduals residuals_on(const ModelMesh mesh)
      {
        return [this, mesh](const std::vector<Eigen::VectorXd> &points) {
          std::vector<Eigen::VectorXd> residuals;
          for (const std::vector<ModelRun> &runs :
               runs_at(points, fitted, mesh, mesh == ModelMesh::coarse ? record.coarse_runs : record.fine_runs))
            residuals.push_back(with_prior(data->residual(joined_values(runs)), points[residuals.size()]));
          for (std::size_t k = 0; k < points.size(); ++k)
            keep_best(points[k], residuals[k], mesh);
          return residuals;
        };
      }

      void keep_best(const Eigen::VectorXd &point, const Eigen::VectorXd &residual, const ModelMesh mesh)
      {
        if (mesh != best_mesh)
          best_chi2 = std::numeric_limits<double>::infinity(), best_mesh = mesh;
        if (residual.size() == 0 || residual.squaredNorm() >= best_chi2)
          return;
        best_chi2 = residual.squaredNorm();
        keep_settings(point);
        record.chi2 = residual.head(data->size()).squaredNorm();
      }

      LeastSquaresFit fit_coarse()
      {
        const BatchResiduals         residuals = residuals_on(ModelMesh::coarse);
        std::vector<LeastSquaresFit> fits;
        for (int k = 0; k < calibration.starts; ++k)
          {
            LeastSquaresOptions options;
            options.difference          = difference;
            options.most_jacobians      = k == 0 ? std::max(2, calibration.start_jacobians) : calibration.start_jacobians;
            const Eigen::VectorXd start = k == 0 ? coordinates.start()
                                                 : spread_point(calibration.seed + k, Eigen::Index(coordinates.size()));
            fits.push_back(least_squares(residuals, start, options));
            note_minimum(start, fits.back());
          }
        auto found = std::min_element(fits.begin(), fits.end(),
                                      [](const LeastSquaresFit &a, const LeastSquaresFit &b) { return a.chi2 < b.chi2; });
        if (!std::isfinite(found->chi2))
          throw std::invalid_argument("the continuum did not finish at any start; change start, low and high");
        if (found != fits.begin()) // so far with the Jacobian of its start
          {
            LeastSquaresOptions options;
            options.difference     = difference;
            options.most_jacobians = 2;
            *found                 = least_squares(residuals, found->point, options);
          }
        report_minima(std::size_t(found - fits.begin()), *found);
        record.chi2_coarse = chi2_of_data(*found);
        return *found;
      }

      void note_minimum(const Eigen::VectorXd &start, const LeastSquaresFit &fit)
      {
        MinimumRecord minimum;
        minimum.start   = coordinates.numbers(start);
        minimum.numbers = coordinates.numbers(fit.point);
        minimum.chi2    = std::isfinite(fit.chi2) ? chi2_of_data(fit) : NAN;
        minimum.total   = fit.chi2;
        minimum.runs    = fit.evaluations;
        minimum.words   = fit.words;
        record.minima.push_back(minimum);
        points.push_back(fit.point), totals.push_back(fit.chi2);
      }

      void report_minima(const std::size_t found, const LeastSquaresFit &fit)
      {
        record.minima[found].is_best = true;
        record.minima[found].numbers = coordinates.numbers(fit.point);
        record.minima[found].chi2    = chi2_of_data(fit);
        record.minima[found].total   = fit.chi2;
        for (std::size_t k = 0; k < record.minima.size(); ++k)
          if (k != found && std::isfinite(totals[k]) && (points[k] - fit.point).cwiseAbs().maxCoeff() > same_minimum)
            {
              std::ostringstream text;
              text.precision(3);
              text << "start " << k + 1 << " ended at another point, with chi^2 (prior included) " << totals[k] << " instead of "
                   << fit.chi2
                   << (totals[k] < fit.chi2 + hardly_worse ? ": the data hardly distinguish the two"
                                                           : ": a second minimum, or a valley that the search did not leave");
              record.words.push_back(text.str());
            }
      }

      LeastSquaresFit fit_fine(const LeastSquaresFit &coarse)
      {
        LeastSquaresOptions options;
        options.difference     = difference;
        options.most_jacobians = 1;
        options.trusts_given   = true;
        options.first_radius   = 0.1;
        LeastSquaresFit fine   = least_squares(residuals_on(ModelMesh::fine), coarse.point, options, coarse.jacobian);
        if (!std::isfinite(fine.chi2))
          throw std::invalid_argument("the continuum did not finish on the samples' own mesh: " + fine.words);
        record.chi2 = chi2_of_data(fine);
        keep_settings(fine.point);
        return fine;
      }

      void report(const LeastSquaresFit &fine, const LeastSquaresFit &coarse)
      {
        jacobian = data->unweighted(fine.jacobian.topRows(data->size()));
        // A misfit beyond noise and model tolerance counts as noise, too.
        record.misfit = std::sqrt(record.chi2 / expected_chi2(jacobian, data->weights(), data->noise_of_means()));
        if (record.n_observables <= int(coordinates.size()))
          record.misfit = NAN; // nothing is left over to estimate it
        const double wider = std::pow(std::max(1., record.misfit), 2);
        knowledge          = identify(jacobian, data->weights(), wider * data->noise_of_means());
        take_degrees_of_freedom(jacobian, data->weights(), wider * data->scatter_of_means(), record.noise.degrees_of_freedom,
                                knowledge);
        tell_misfit(record);
        tell_parameters(coordinates, knowledge, fine.point, record);
        for (const auto &[mesh, words] : {std::pair("the samples' own", &fine.words), {"the coarse", &coarse.words}})
          if (!words->empty())
            record.words.push_back(std::string("on ") + mesh + " mesh " + *words);
      }

      // chi^2 one and a half deviations to either side; the linear model gives the other parameters.
      void profile(const LeastSquaresFit &coarse)
      {
        constexpr double             reach = 1.5;
        std::vector<Eigen::VectorXd> at;
        const Eigen::Index           n = coarse.point.size();
        for (Eigen::Index k = 0; k < n; ++k)
          for (const double side : {-reach, reach})
            {
              const Eigen::VectorXd along = knowledge.covariance.col(k) / knowledge.covariance(k, k);
              const double          to    = std::clamp(coarse.point[k] + side * knowledge.deviation[k], 0., 1.);
              at.push_back((coarse.point + (to - coarse.point[k]) * along).cwiseMax(0.).cwiseMin(1.));
            }
        const auto runs = runs_at(at, fitted, ModelMesh::coarse, record.coarse_runs);
        for (Eigen::Index k = 0; k < n; ++k)
          {
            ParameterRecord &p = record.parameters[std::size_t(k)];
            for (const std::size_t side : {std::size_t(0), std::size_t(2), std::size_t(1)}) // the minimum in the middle
              {
                const bool            middle   = side == 2;
                const std::size_t     place    = 2 * std::size_t(k) + (middle ? 0 : side);
                const Eigen::VectorXd point    = middle ? coarse.point : at[place];
                const Eigen::VectorXd residual = middle ? coarse.residual.head(data->size()).eval()
                                                        : data->residual(joined_values(runs[place]));
                const Eigen::VectorXd expected = (coarse.residual + coarse.jacobian * (point - coarse.point)).head(data->size());
                p.profile_number.push_back(coordinates.numbers(point)[std::size_t(k)]);
                p.profile_chi2.push_back(residual.size() > 0 ? residual.squaredNorm() : NAN);
                p.profile_expected.push_back(expected.squaredNorm());
              }
          }
      }

      // All paths on their own meshes: before, calibrated, and calibrated with half the load step.
      void add_predictions()
      {
        std::vector<std::size_t> all;
        for (std::size_t p = 0; p < paths.size(); ++p)
          all.push_back(p);
        std::vector<Settings> formerly;
        for (const CalibrationPath &path : paths)
          formerly.push_back(path.target.before);
        const std::vector<Settings> calibrated = settings_on(all, best);
        record.other_runs += 3 * int(all.size());
        const auto runs   = run({all, {formerly, calibrated}, ModelMesh::fine, calibration.load_step});
        const auto halved = run({all, {calibrated}, ModelMesh::fine, 0.5 * calibration.load_step});
        for (const std::size_t p : all)
          {
            const Eigen::MatrixXd by_coordinates = jacobian_on(p);
            record.paths.push_back(path_record(paths[p], {record.noise, runs[0][p], runs[1][p], halved[0][p]}));
            const Eigen::MatrixXd spread = by_coordinates * knowledge.covariance * by_coordinates.transpose();
            for (std::size_t k = 0; k < record.paths.back().observables.size(); ++k)
              record.paths.back().observables[k].parameter_deviation = std::sqrt(spread(Eigen::Index(k), Eigen::Index(k)));
            if (!paths[p].target.is_fitted)
              add_parameters_to_predictions(knowledge.quantile.maxCoeff(), record.paths.back());
          }
        take_weights();
        const Eigen::VectorXd before = data->residual(joined_on_fitted(runs[0]));
        record.chi2_before           = before.size() > 0 ? before.squaredNorm() : NAN;
      }

      Eigen::VectorXd joined_on_fitted(const std::vector<ModelRun> &runs) const
      {
        std::vector<ModelRun> of_fitted;
        for (const std::size_t p : fitted)
          of_fitted.push_back(runs[p]);
        return joined_values(of_fitted);
      }

      // Marks the observables that the fit used.
      void take_weights()
      {
        Eigen::Index at = 0;
        for (const std::size_t p : fitted)
          for (ObservableRecord &one : record.paths[p].observables)
            one.counts = data->weights()[at++] > 0;
      }

      bool have_same_parameters(const CalibrationTarget &a, const CalibrationTarget &b) const
      {
        return std::all_of(calibration.parameters.begin(), calibration.parameters.end(),
                           [&](const CalibrationParameter &p) { return p.belongs_to(a.name) == p.belongs_to(b.name); });
      }

      // Jacobian of one path's observables. Reuses the fit's if the path was fitted, on these or other samples; else
      // coarse-mesh differences.
      Eigen::MatrixXd jacobian_on(const std::size_t p)
      {
        const Eigen::Index n  = Eigen::Index(paths[p].data.observables.size());
        Eigen::Index       at = 0;
        for (const std::size_t q : fitted)
          {
            if (is_same_path(paths[p].target, paths[q].target) && have_same_parameters(paths[p].target, paths[q].target))
              return jacobian.middleRows(at, n);
            at += Eigen::Index(paths[q].data.observables.size());
          }
        const auto values = [&](const std::vector<Eigen::VectorXd> &points) {
          std::vector<Eigen::VectorXd> result;
          for (const std::vector<ModelRun> &runs : runs_at(points, {p}, ModelMesh::coarse, record.other_runs))
            result.push_back(joined_values(runs));
          return result;
        };
        const Eigen::VectorXd here = values({best}).front();
        return here.size() == 0 ? Eigen::MatrixXd::Constant(n, best.size(), NAN)
                                : difference_jacobian(values, best, here, difference);
      }

      static constexpr double difference = 0.005;

      const Calibration                  &calibration;
      const Coordinates                  &coordinates;
      const std::vector<CalibrationPath> &paths;
      const RunModel                     &run;
      CalibrationRecord                  &record;
      std::vector<std::size_t>            fitted;
      std::optional<FittedData>           data;
      Eigen::VectorXd                     best;
      std::vector<Eigen::VectorXd>        points; // ends of the searches
      std::vector<double>                 totals; // and their chi^2 with the prior
      Identification                      knowledge;
      Eigen::MatrixXd                     jacobian; // d fitted observables / d coordinates
      double                              best_chi2 = std::numeric_limits<double>::infinity();
      ModelMesh                           best_mesh = ModelMesh::coarse;
    };
  } // namespace

  void calibrate(const Calibration                  &calibration,
                 const Coordinates                  &coordinates,
                 const std::vector<CalibrationPath> &paths,
                 const RunModel                     &run,
                 CalibrationRecord                  &record)
  {
    Calibrator(calibration, coordinates, paths, run, record).calibrate();
  }
} // namespace diptych::coupling
