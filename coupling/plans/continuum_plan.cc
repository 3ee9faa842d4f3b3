// diptych: plans elements, load steps, tolerance, law and geometry of the continuum
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/continuum_plan.h"

#include <algorithm>
#include <cmath>

#include "coupling/plans/continuum_knobs.h"
#include "coupling/plans/error_law.h"
#include "coupling/plans/pilot_values.h"
#include "coupling/plans/plan_question.h"
#include "coupling/plans/plan_text.h"
#include "coupling/scene/keys.h"

namespace diptych::coupling
{
  namespace
  {
    // Shares of the accuracy. The rest, at least the last share, is for the scatter of the samples.
    constexpr double share_of_elements = 0.4, share_of_load_steps = 0.2, share_of_tolerance = 0.05, share_of_models = 0.15,
                     share_of_samples = 0.2;
    constexpr int    most_sizes = 6, scatter_samples = 4;
    constexpr double longest_pilot        = 120; // CPU s of one run
    constexpr double worth_saving         = 0.05;
    constexpr double elements_over_length = 2, elements_across = 12; // start of the refinement
    constexpr double longest_load_step = 0.01, coarsest_tolerance = 1e-3;

    class Continuum
    {
    public:
      Continuum(const PlanQuestion &question, const Scene &scene, const RunPilot &run)
          : question(question),
            scene(scene),
            run(run)
      {
        plan.panel   = "continuum";
        plan.command = StudyCommand::continuum;
        for (const PlanQuantity &quantity : question.continuum)
          {
            quantities.push_back(quantity.quantity);
            if (quantity.quantity.source == Source::comparison)
              plan.command = StudyCommand::run;
          }
        chosen = {planned("comparison", "coarse_element_size", "0")};
        if (plan.command == StudyCommand::run)
          for (const char *key : {"band_resamples", "probe_resamples"})
            chosen.push_back(planned("comparison", key, "0"));
        shares_sample = scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline;
        parts.resize(quantities.size());
        values.assign(quantities.size(), NAN);
      }

      PanelPlan plan_it()
      {
        if (scene.continuum.mesh.kind == continuum::MeshOption::Kind::file)
          plan.decisions.emplace_back("elements: from the mesh file; their error is unknown and not in the budget");
        else if (!settle_elements())
          return plan;
        Knob load_step = {"continuum/max_step", std::min(longest_load_step, scene.loading.stage_strain), share_of_load_steps,
                          of_load_step};
        load_step.least_points       = 3;
        load_step.dearer_per_halving = 2;
        if (!settle(load_step))
          return plan;
        settle_tolerance();
        try_models();
        settle_samples();
        conclude();
        return plan;
      }

    private:
      PilotPoint run_with(const Settings &more, const std::vector<int> &seeds = {}) const
      {
        Settings all = question.changes;
        append(all, chosen);
        // Only the grains' outline is used, but the windows of the bands need a run of the grains.
        if (plan.command == StudyCommand::run)
          all.push_back(planned("discrete", "accuracy", "0.05"));
        return run({plan.command, all, {more}, seeds, quantities}).front();
      }

      // Difference of two points on one sample, relative to the second.
      double shift(const PilotPoint &a, const PilotPoint &b, const std::size_t q) const
      {
        return relative_difference(quantities[q], a.values[q], b.values[q]).mean;
      }
      double difference(const PilotPoint &a, const PilotPoint &b, const std::size_t q) const { return std::abs(shift(a, b, q)); }

      struct Settled
      {
        std::vector<double>     sizes;
        std::vector<PilotPoint> points;
        std::vector<Refinement> laws; // one per quantity, of values relative to the finest
        bool                    reached = false;
        std::string             words; // reason if a run did not finish
      };

      std::vector<Refinement> laws_of(const Settled &settled) const
      {
        std::vector<Refinement> laws;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          {
            std::vector<double> relative;
            for (const PilotPoint &point : settled.points)
              relative.push_back(relative_difference(quantities[q], point.values[q], settled.points.back().values[q]).mean);
            laws.push_back(refinement(settled.sizes, relative));
          }
        return laws;
      }

      Settled refine(const Knob &knob)
      {
        Settled settled;
        double  size = knob.coarsest;
        for (int k = 0; k < most_sizes && !settled.reached; ++k, size /= 2)
          {
            PilotPoint point = run_with(knob.settings(size));
            if (!point.words.empty())
              {
                settled.words = knob.name + " = " + text_of(size) + ": " + point.words;
                if (settled.points.empty())
                  continue; // too coarse to run
                break;
              }
            report_size(knob, size, point);
            if (!settled.points.empty() && settled.points.back().values == point.values)
              settled.sizes.pop_back(), settled.points.pop_back(); // the previous size limited nothing
            settled.sizes.push_back(size);
            settled.points.push_back(point);
            settled.laws = laws_of(settled);
            // Estimated from the order of the last changes.
            settled.reached = settled.points.size() >= knob.least_points &&
                              std::all_of(settled.laws.begin(), settled.laws.end(), [&](const Refinement &law) {
                                return law.error <= knob.share * question.accuracy && law.converges;
                              });
            if (knob.dearer_per_halving * point.cpu_s > longest_pilot ||
                (knob.may_have_no_limit && keeps_changing(settled, knob)))
              break;
          }
        return settled;
      }

      // True if changes stay as large as before and exceed the share.
      bool keeps_changing(const Settled &settled, const Knob &knob) const
      {
        return std::any_of(settled.laws.begin(), settled.laws.end(),
                           [&](const Refinement &law) { return !law.converges && law.error > knob.share * question.accuracy; });
      }

      void report_size(const Knob &knob, const double size, const PilotPoint &point)
      {
        std::string text = knob.name + " = " + text_of(size) + ":";
        for (std::size_t q = 0; q < quantities.size(); ++q)
          text += (q > 0 ? ", " : " ") + quantities[q].name + " " + to_four_digits(point.values[q].front());
        plan.decisions.push_back(text + "; " + rounded(point.cpu_s) + " CPU s");
      }

      // The largest size within the share, limited to the sizes that were run.
      double size_of(const Knob &knob, const Settled &settled) const
      {
        double size = settled.sizes.front();
        for (const Refinement &law : settled.laws)
          if (law.error > 0)
            size = std::min(size, size_for(law, knob.share * question.accuracy));
        return std::max(size, settled.sizes.back());
      }

      void take(const Knob &knob, const Settled &settled)
      {
        const double size = settled.reached ? rounded_to_two_digits(size_of(knob, settled)) : settled.sizes.back();
        append(chosen, knob.settings(size));
        std::string text = "  used: " + knob.name + " = " + text_of(size);
        for (std::size_t q = 0; q < quantities.size(); ++q)
          {
            const double error = error_at(settled.laws[q], size);
            parts[q].push_back({knob.name, error, settled.laws[q].sign * error, NAN});
            text += (q > 0 ? ", " : "; error ") + percent(parts[q].back().error);
          }
        plan.decisions.push_back(text + (settled.reached ? "" : "; this exceeds its share of the accuracy"));
        plan.reaches = plan.reaches && settled.reached;
      }

      static std::string why_unsettled(const Knob &knob, const Settled &settled)
      {
        return settled.words.empty()
                 ? knob.name + ": not refined, because a second size would take more than " + rounded(longest_pilot) + " CPU s"
                 : settled.words;
      }

      bool settle(const Knob &knob)
      {
        const Settled settled = refine(knob);
        if (settled.points.size() < 2)
          {
            plan.reaches = false;
            plan.decisions.push_back(why_unsettled(knob, settled));
            return false;
          }
        take(knob, settled);
        return true;
      }

      double first_elements(const bool has_length) const
      {
        const continuum::Options &o      = scene.continuum;
        const double              side   = o.mesh.kind == continuum::MeshOption::Kind::rectangle
                                             ? std::min(o.rectangle_width, o.rectangle_height) / scene.sample.mean_diameter
                                             : std::sqrt(double(scene.sample.grains));
        const double              across = side / elements_across;
        return rounded_to_two_digits(has_length ? std::min(across, elements_over_length * o.material.internal_length) : across);
      }

      bool settle_elements()
      {
        const continuum::LawKind         law   = scene.continuum.law;
        const std::optional<std::string> other = with_length(law);
        Knob                             knob  = {"continuum/element_size", 0, share_of_elements, of_element_size};
        knob.coarsest                          = first_elements(continuum::traits(law).is_cosserat);
        knob.may_have_no_limit                 = other.has_value();
        knob.least_points                      = other ? 3 : 2; // one small change of a law without a length may be chance
        Settled settled                        = refine(knob);
        if (!settled.reached && other)
          {
            plan.decisions.push_back("continuum/law = " + text_of(law) + ": " +
                                     (settled.words.empty()
                                        ? "the results keep changing with the elements, or small enough elements cost too much"
                                        : settled.words) +
                                     "; this law has no internal length; used instead: " + *other +
                                     " with continuum/internal_length = " + text_of(scene.continuum.material.internal_length));
            chosen.push_back(planned("continuum", "law", *other));
            has_changed_law        = true;
            knob.coarsest          = first_elements(true);
            knob.may_have_no_limit = false;
            knob.least_points      = 2;
            settled                = refine(knob);
          }
        if (settled.points.size() >= 2)
          {
            take(knob, settled);
            return true;
          }
        plan.reaches = false;
        plan.decisions.push_back(why_unsettled(knob, settled));
        return false;
      }

      // Uses the loosest tolerance that does not change the results.
      void settle_tolerance()
      {
        const auto       at = [&](const double tolerance) { return run_with({planned("continuum", "tolerance", tolerance)}); };
        const PilotPoint reference = at(1e-2 * std::min(1e-5, scene.continuum.tolerance));
        for (double tolerance = coarsest_tolerance; reference.words.empty() && tolerance > 5e-6; tolerance /= 10)
          {
            const PilotPoint point = at(tolerance);
            double           worst = point.words.empty() ? 0 : 1;
            for (std::size_t q = 0; q < quantities.size() && point.words.empty(); ++q)
              worst = std::max(worst, difference(point, reference, q));
            if (worst > share_of_tolerance * question.accuracy)
              continue;
            chosen.push_back(planned("continuum", "tolerance", tolerance));
            for (std::size_t q = 0; q < quantities.size(); ++q)
              parts[q].push_back({"continuum/tolerance", difference(point, reference, q), shift(point, reference, q), NAN});
            plan.decisions.push_back("used: continuum/tolerance = " + text_of(tolerance) + "; error " + percent(worst));
            now = point;
            return;
          }
        now = run_with({});
        plan.decisions.emplace_back("continuum/tolerance: unchanged, because looser values change the results");
      }

      // Tries a cheaper model instead of the scene's.
      void try_model(const std::string &what, const Settings &settings)
      {
        const PilotPoint point = run_with(settings);
        if (!point.words.empty())
          {
            plan.decisions.push_back(what + ": not possible, " + point.words);
            return;
          }
        double worst = 0;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          worst = std::max(worst, difference(point, now, q));
        const double saving = 1 - point.cpu_s / now.cpu_s;
        if (worst > left_for_models || saving < worth_saving)
          {
            plan.decisions.push_back(what + ": not used; it would save " + (saving > 0 ? percent(saving) + " of the" : "no") +
                                     " time and change a quantity by up to " + percent(worst));
            return;
          }
        for (std::size_t q = 0; q < quantities.size(); ++q)
          parts[q].push_back({what, difference(point, now, q), shift(point, now, q), NAN});
        append(chosen, settings);
        left_for_models -= worst;
        now = point;
        plan.decisions.push_back(what + ": used; it saves " + percent(saving) + " of the time and changes a quantity by up to " +
                                 percent(worst));
      }

      void try_models()
      {
        left_for_models                      = share_of_models * question.accuracy;
        const continuum::LawKind law         = scene.continuum.law;
        const bool               is_cosserat = continuum::traits(law).is_cosserat || has_changed_law;
        if (is_cosserat && !has_changed_law)
          try_model("law without an internal length", {planned("continuum", "law", without_length(law))});
        if (!is_cosserat && scene.continuum.element != continuum::Displacement::q1_bbar)
          try_model("bilinear elements", {planned("continuum", "element", "q1_bbar")});
        if (scene.continuum.geometry == continuum::Kinematics::updated)
          try_model("small strain", {planned("continuum", "geometry", "small_strain")});
      }

      double error_so_far(const std::size_t q) const
      {
        double sum = 0;
        for (const ErrorPart &part : parts[q])
          sum += part.error;
        return sum;
      }

      // The outline of the continuum comes from a sample.
      void settle_samples()
      {
        if (!shares_sample || !scene.sample.file.empty())
          return;
        std::vector<int> seeds;
        for (int k = 0; k < scatter_samples; ++k)
          seeds.push_back(scene.sample.seed + k);
        const PilotPoint point = run_with({}, seeds);
        int              n     = 1;
        for (std::size_t q = 0; q < quantities.size() && point.words.empty(); ++q)
          {
            scatter.push_back(summary_of(quantities[q], point.values[q]).scatter);
            const double left   = std::max(share_of_samples * question.accuracy, question.accuracy - error_so_far(q));
            const int    needed = samples_for(scatter.back(), left);
            plan.reaches        = plan.reaches && needed > 0;
            n                   = std::max(n, needed);
          }
        if (!point.words.empty())
          plan.decisions.push_back("the scatter of the samples is unknown: " + point.words);
        else
          {
            now = point;
            for (int k = 0; k < n; ++k)
              plan.seeds.push_back(scene.sample.seed + k);
            for (std::size_t q = 0; q < quantities.size(); ++q)
              parts[q].push_back({"samples", half_interval(scatter[q], n), 0, NAN});
          }
      }

      void conclude()
      {
        plan.settings       = chosen;
        plan.cpu_s          = now.cpu_s;
        plan.peak_memory_mb = now.peak_memory_mb;
        for (std::size_t q = 0; q < quantities.size(); ++q)
          plan.quantities.push_back({quantities[q].name, summary_of(quantities[q], now.values[q]).statistics.mean,
                                     scatter.empty() ? NAN : scatter[q], parts[q]});
      }

      const PlanQuestion                 &question;
      const Scene                        &scene;
      const RunPilot                     &run;
      PanelPlan                           plan;
      std::vector<StudyQuantity>          quantities;
      Settings                            chosen;
      bool                                shares_sample = false, has_changed_law = false;
      std::vector<std::vector<ErrorPart>> parts; // one list per quantity
      std::vector<double>                 values, scatter;
      PilotPoint                          now; // with the chosen settings
      double                              left_for_models = 0;
    };
  } // namespace

  PanelPlan plan_continuum(const PlanQuestion &question, const Scene &scene, const RunPilot &run)
  {
    return Continuum(question, scene, run).plan_it();
  }
} // namespace diptych::coupling
