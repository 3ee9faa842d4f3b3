// diptych: the report of a plan as text
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/plans/plan_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "discrete/choices.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int name_width = 44;

    std::string with_digits(const double number, const int digits)
    {
      std::ostringstream text;
      text << std::setprecision(digits) << number;
      return text.str();
    }

    std::string padded(std::string text, const int width)
    {
      text.resize(std::max<std::size_t>(text.size() + 1, std::size_t(width)), ' ');
      return text;
    }

    void add_budget(const PanelPlan &panel, std::ostringstream &out)
    {
      for (const QuantityBudget &quantity : panel.quantities)
        {
          out << "  " << padded(quantity.name, name_width) << "error at most about " << percent(quantity.total()) << ", bias "
              << percent(quantity.bias());
          if (std::isfinite(quantity.scatter))
            out << "; one sample scatters by " << percent(quantity.scatter);
          out << '\n';
          for (const ErrorPart &part : quantity.parts)
            {
              out << "    " << padded(part.cause, name_width - 2) << percent(part.error);
              if (std::isfinite(part.deviation))
                out << " +- " << percent(part.deviation);
              out << '\n';
            }
        }
    }

    void add_outcomes(const PanelPlan &panel, std::ostringstream &out)
    {
      if (panel.outcomes.empty())
        return;
      out << "  result, at " << rounded(panel.outcome_cpu_s) << " CPU s per sample:\n";
      for (const QuantityOutcome &one : panel.outcomes)
        {
          out << "    " << padded(one.name, name_width - 2) << rounded(one.statistics.mean);
          if (one.statistics.n > 1)
            out << ", 95 % interval +- " << percent(one.half_interval) << " (" << one.statistics.n << " samples)";
          out << '\n';
        }
    }
  } // namespace

  std::string percent(const double share)
  {
    return with_digits(100 * share, std::abs(share) < 0.995 ? 2 : 3) + " %";
  }

  std::string to_four_digits(const double number)
  {
    return with_digits(number, 4);
  }

  std::string rounded(const double number)
  {
    return with_digits(number, 3);
  }

  double rounded_to_two_digits(const double number)
  {
    return number > 0 ? std::stod(with_digits(number, 2)) : number;
  }

  std::string text_of(const Plan &plan)
  {
    std::ostringstream out;
    out << plan.scene << ": plan for an accuracy of " << with_digits(100 * plan.accuracy, 4) << " %" << '\n';
    for (const PanelPlan &panel : plan.panels)
      {
        out << '\n' << panel.panel << '\n';
        for (const std::string &decision : panel.decisions)
          out << "  " << decision << '\n';
        if (panel.quantities.empty())
          {
            out << "  no plan was found: the accuracy is NOT reached\n";
            continue;
          }
        add_budget(panel, out);
        for (const Entry &entry : panel.settings)
          out << "  set " << entry.section << '/' << entry.key << " = " << entry.value << '\n';
        if (!panel.reaches)
          out << "  the accuracy is NOT reached by this plan\n";
        out << "  " << discrete::name_of(panel.command) << " on " << panel.n_samples()
            << (panel.n_samples() > 1 ? " samples" : " sample");
        if (panel.seeds.size() > 1)
          out << " (seeds " << panel.seeds.front() << '-' << panel.seeds.back() << ')';
        out << ": " << rounded(panel.cpu_s) << " CPU s each, " << rounded(panel.total_cpu_s()) << " s in all, "
            << rounded(panel.peak_memory_mb) << " MB\n";
        add_outcomes(panel, out);
      }
    if (plan.shares_samples())
      out << "\n`diptych run` computes both panels on the same samples.\n";
    out << "\nCPU time of the plan " << rounded(plan.total_cpu_s()) << " s; the pilot took " << rounded(plan.pilot_cpu_s)
        << " s\n";
    return out.str();
  }
} // namespace diptych::coupling
