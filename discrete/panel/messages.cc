// diptych: messages of the panel if it cannot continue
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/panel/messages.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace diptych::discrete
{
  namespace
  {
    const std::string rigid_words =
      "rigid grains have no stress of their own if loading/path prescribes exx and eyy and the grains fill the cell. Use springs "
      "(discrete/method = compliant or penalty, which auto chooses), prescribe a stress, or prepare a looser sample "
      "(sample/preparation_friction)";
  }

  std::string unrest_text(const PreparationReport &report)
  {
    std::ostringstream text;
    if (!report.touches)
      {
        text << "after " << report.steps
             << " preparation steps no grain touches another, so nothing carries loading/pressure (solid "
             << "fraction " << report.solid_fraction << ")";
        return text.str();
      }
    text << "the sample did not come to rest after " << report.steps << " preparation steps";
    if (report.settling_steps > 0)
      text << " and " << report.settling_steps << " from rest";
    text << ": residual " << report.residual << ", unbalanced force " << report.unbalanced_force;
    if (report.largest_overlap > 0)
      text << ", largest overlap " << report.largest_overlap << " mean diameters";
    if (report.evenness < 1)
      text << ". The pressure of one ninth of the sample differs from the mean by a factor of " << report.evenness
           << ", and the mean stress is off by " << report.stress_error << " of that of the sides";
    else
      text << "; for slender or tiny samples a small sample/preparation_friction helps";
    return text.str();
  }

  std::optional<std::string> cell_obstacle(const State   &state,
                                           const Loading &loading,
                                           const double   mean_diameter,
                                           const double   density)
  {
    const Lattice *lattice = state.lattice();
    if (!lattice)
      return {};
    constexpr double           fast   = 0.1; // inertial number at which grains collide rather than press
    const double               unit   = mean_diameter * std::sqrt(density / loading.pressure); // of time
    const double               number = unit * lattice->rate.norm(), height = lattice->least_extent();
    const std::vector<double> &radius = state.grains.radius;
    std::ostringstream         text;
    if (number > fast + 10 * unit * strain_rate(loading, mean_diameter, density))
      text << "the grains do not carry the stress that loading/path prescribes: the cell deforms at an inertial number of "
           << number << "; strains reached: exx " << lattice->strain[0] << ", eyy " << lattice->strain[1] << ", exy "
           << 0.5 * lattice->strain[2];
    else if (height < 4 * (*std::max_element(radius.begin(), radius.end()) + 0.5 * mean_diameter))
      text << "the cell has become too narrow: its smaller height is " << height
           << "; a larger sample/grains follows the path further";
    else
      return {};
    return text.str();
  }

  std::optional<std::string> rigid_obstacle(const Loading &loading, const StepResult &last, const double mean_diameter)
  {
    constexpr double largest_stress = 30, largest_overlap = 0.01; // P, mean diameters
    const double     stress = 0.5 * (last.lattice.contacts[0] + last.lattice.contacts[1]) / loading.pressure,
                 overlap    = last.largest_penetration / mean_diameter;
    if (!has_no_pressure(loading) || (stress <= largest_stress && overlap <= largest_overlap))
      return {};
    std::ostringstream text;
    text << rigid_words << "; mean stress " << stress << " P, overlap " << overlap << " mean diameters";
    return text.str();
  }

  std::string press_text(const Options &options)
  {
    std::ostringstream text;
    text << "the springs blew up while they took up the pressure: penalty_step_fraction is " << options.penalty.step_fraction
         << ", too large for this sample, or overlapping grains push each other apart";
    return text.str();
  }

  std::string momentum_text(const int step, const double residual)
  {
    std::ostringstream text;
    text << "the balance of momentum is violated in step " << step << ": " << residual
         << " of the contact impulses, more than round-off";
    return text.str();
  }

  std::string interpenetration_text(const int step, const double penetration, const Options &options)
  {
    std::ostringstream text;
    text << "step " << step << ": grains interpenetrate by " << penetration << " mean diameters";
    if (options.method.method != Method::nscd)
      text << "; discrete/penalty_stiffness = " << options.penalty.stiffness << " is too soft for these stresses";
    return text.str();
  }

  std::string endless_text(const int stage, const double steps, const StepChoice &choice)
  {
    std::ostringstream text;
    text << "stage " << stage << " would take " << steps << " steps of length " << choice.step << "; a loading may take at most "
         << most_steps;
    if (!choice.bound.empty())
      text << "; the bound of discrete/step = auto is: " << choice.bound;
    return text.str();
  }

  std::string failure_text(const FailedStep &failed, const Loading &loading, const Options &options)
  {
    const std::string  obstacle      = obstacle_to(failed.solve);
    const bool         is_rigid_path = options.method.method == Method::nscd && has_no_pressure(loading);
    std::ostringstream text;
    text << "step " << failed.step << " at " << failed.where;
    if (options.method.method == Method::penalty)
      text << " blew up: a grain moved by more than its radius in one step; give a penalty_step_fraction below "
           << options.penalty.step_fraction;
    else
      text << " did not converge in " << failed.solve.sweeps << " sweeps: residual " << failed.solve.residual << ", tolerance "
           << failed.tolerance << (obstacle.empty() ? "" : "; " + obstacle)
           << "; its halves did not converge either, down to a step of " << failed.length
           << (is_rigid_path      ? "; " + rigid_words
               : obstacle.empty() ? "; a larger step, tolerance or max_sweeps may help"
                                  : "");
    return text.str();
  }
} // namespace diptych::discrete
