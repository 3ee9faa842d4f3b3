// diptych: checkpoint of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::continuum
{
  // Plain values. Except for the preconditioner they do not depend on the number of processes.
  struct Checkpoint
  {
    std::vector<std::string>              cells;     // CellId of every active cell as text (deal.II), sorted
    std::vector<std::vector<std::string>> divisions; // cells divided by each refinement, in order of time
    int                                   values_per_cell = 0;
    std::vector<double> values; // cells.size() x values_per_cell, row by row: nodal values and point states of one cell

    int                            stage    = 0; // number of stages reached
    double                         progress = 0, step = 0, last_step = 0;
    bool                           motion_is_smooth = false;
    std::array<Eigen::Vector2d, 2> platen_force{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()}; // on the sample
    double                         friction_work = 0;                                              // [pressure * length^2]
    std::optional<double>          localisation_progress, localisation_angle;
    int    steps = 0, cut_backs = 0, newton_iterations = 0, refinements = 0, linear_iterations = 0, factorisations = 0;
    double point_cpu_s = 0, assembly_cpu_s = 0, geometry_cpu_s = 0, solve_cpu_s = 0;

    // The matrix behind the preconditioner, as values in the order of the tangent's pattern. Without it the linear solves would
    // take other iterations. Empty if the panel ran on several processes.
    bool                             preconditioner_is_stale = true;
    std::vector<double>              factorised_matrix;
    std::vector<std::vector<double>> rigid_modes;
  };

  template <class AnyCheckpoint, class Visit> void visit_entries(AnyCheckpoint &c, Visit &&visit)
  {
    visit("cells", c.cells);
    visit("divisions", c.divisions);
    visit("values_per_cell", c.values_per_cell);
    visit("values", c.values);
    visit("stage", c.stage);
    visit("progress", c.progress);
    visit("step", c.step);
    visit("last_step", c.last_step);
    visit("motion_is_smooth", c.motion_is_smooth);
    visit("lower_platen_force", c.platen_force[0]);
    visit("upper_platen_force", c.platen_force[1]);
    visit("friction_work", c.friction_work);
    visit("localisation_progress", c.localisation_progress);
    visit("localisation_angle", c.localisation_angle);
    visit("steps", c.steps);
    visit("cut_backs", c.cut_backs);
    visit("newton_iterations", c.newton_iterations);
    visit("refinements", c.refinements);
    visit("linear_iterations", c.linear_iterations);
    visit("factorisations", c.factorisations);
    visit("point_cpu_s", c.point_cpu_s);
    visit("assembly_cpu_s", c.assembly_cpu_s);
    visit("geometry_cpu_s", c.geometry_cpu_s);
    visit("solve_cpu_s", c.solve_cpu_s);
    visit("preconditioner_is_stale", c.preconditioner_is_stale);
    visit("factorised_matrix", c.factorised_matrix);
    visit("rigid_modes", c.rigid_modes);
  }
} // namespace diptych::continuum
