// diptych: what the panel says where it cannot go on
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/messages.h"

#include <sstream>

namespace diptych::discrete
{
  std::string unrest_text(const PreparationReport &report)
  {
    std::ostringstream text;
    if (!report.touches)
      {
        text << "after " << report.steps
             << " preparation steps no grain touches another: nothing carries loading/pressure (solid "
             << "fraction " << report.solid_fraction << ")";
        return text.str();
      }
    text << "the sample was not quiet after " << report.steps << " preparation steps";
    if (report.settling_steps > 0)
      text << " and " << report.settling_steps << " from rest";
    text << ": residual " << report.residual << ", unbalanced force " << report.unbalanced_force;
    if (report.settling_steps > 0)
      text << ", largest overlap " << report.largest_overlap << " mean diameters";
    text << "; a little sample/preparation_friction quiets slender or tiny samples";
    return text.str();
  }

  std::string press_text(const Options &options)
  {
    std::ostringstream text;
    text << "the springs blew up while they took up the pressure: penalty_step_fraction is " << options.penalty.step_fraction
         << ", and overlaps of the sample fling its grains apart";
    return text.str();
  }

  std::string momentum_text(const int step, const double residual)
  {
    std::ostringstream text;
    text << "the balance of momentum is violated in step " << step << ": " << residual
         << " of the contact impulses, more than round-off";
    return text.str();
  }

  std::string interpenetration_text(const int step, const double penetration)
  {
    std::ostringstream text;
    text << "step " << step << ": grains interpenetrate by " << penetration << " mean diameters";
    return text.str();
  }

  std::string endless_text(const int stage, const double steps, const StepChoice &choice)
  {
    std::ostringstream text;
    text << "stage " << stage << " would take " << steps << " steps of " << choice.step << ", a loading at most " << most_steps;
    if (!choice.bound.empty())
      text << "; discrete/step = auto is bound there by: " << choice.bound;
    return text.str();
  }

  std::string failure_text(const FailedStep &failed, const Options &options)
  {
    std::ostringstream text;
    text << "step " << failed.step << " at " << failed.where;
    if (options.method.method == Method::penalty)
      text << " blew up: a grain went further than its radius in one step, penalty_step_fraction is "
           << options.penalty.step_fraction;
    else
      text << " did not converge: residual " << failed.solve.residual << " after " << failed.solve.sweeps << " sweeps, wanted "
           << failed.tolerance << ", nor did its halves, down to a step of " << failed.length
           << "; a larger step, tolerance or max_sweeps may help";
    return text.str();
  }
} // namespace diptych::discrete
