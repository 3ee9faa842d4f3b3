// diptych: messages of the panel if it cannot continue
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>

#include "discrete/panel/options.h"
#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  std::string unrest_text(const PreparationReport &report);
  std::string press_text(const Options &options); // springs blew up while they took up the pressure
  std::string momentum_text(int step, double residual);
  std::string interpenetration_text(int step, double penetration, const Options &options); // [mean diameters]

  // Reason why a cell cannot follow its path any further, if there is one. The prescribed stress accelerates a cell whose grains
  // do not carry it, and a large shear narrows every cell until a grain would meet two images of another one.
  std::optional<std::string> cell_obstacle(const State &state, const Loading &loading, double mean_diameter, double density);

  // Reason why rigid grains cannot follow a path that has_no_pressure(), if there is one.
  std::optional<std::string> rigid_obstacle(const Loading &loading, const StepResult &last, double mean_diameter);

  std::string endless_text(int stage, double steps, const StepChoice &choice);

  // A step that did not converge, or in which springs blew up.
  struct FailedStep
  {
    int         step;  // counts from 1
    std::string where; // on the loading path
    SolveReport solve;
    double      tolerance, length;
  };
  std::string failure_text(const FailedStep &failed, const Loading &loading, const Options &options);
} // namespace diptych::discrete
