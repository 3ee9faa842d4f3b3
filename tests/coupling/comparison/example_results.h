// diptych: results of both panels in memory with a known comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/comparison/comparison.h"
#include "tests/coupling/synthetic_samples.h"

namespace diptych::coupling::synthetic
{
  // 40 x 56 grains of diameter 1 on a square lattice between platens at 0 and 56, with two stages of 1 %. Both panels move alike:
  // per stage the upper platen moves right and down by 0.56e-6, so little that all places stay the same. A band of -45 degrees
  // through the middle, half width 3, carries the whole motion.
  constexpr int      example_columns = 40, example_rows = 56;
  inline const Truth example_band = {-45, 3, 0, 1, 0};
  constexpr double   sigma_xx = 1, sigma_yy = 2; // of the grains; the continuum has 1.25 times these stresses
  constexpr double   continuum_over_grains = 1.25;

  inline const Eigen::Vector2d example_step(0.56e-6, -0.56e-6); // motion of the upper platen per stage

  inline Eigen::Vector2d example_travel(const int stage)
  {
    return stage * example_step;
  }

  inline Eigen::Vector2d example_displacement(const Eigen::Vector2d &x, const int stage)
  {
    return stage *
           (band_displacement(example_band, frame_of(example_columns, example_rows, example_step), x) + 0.5 * example_step);
  }

  // Horizontal contacts carry sigma_xx x 1, vertical ones sigma_yy x 1. The moment of a grain is diag(sigma_xx, sigma_yy) x 1.
  inline void add_lattice_forces(discrete::Snapshot &s)
  {
    const int  n     = example_columns * example_rows;
    const auto touch = [&](const int i, const int j, const Eigen::Vector2d &towards, const double size) {
      s.window_forces.push_back({i, j, s.position[i] + 0.5 * towards, -towards, -size * towards});
    };
    for (int r = 0; r < example_rows; ++r)
      for (int c = 0; c < example_columns; ++c)
        {
          const int i = r * example_columns + c;
          if (c + 1 < example_columns)
            touch(i, i + 1, {1, 0}, sigma_xx);
          if (r + 1 < example_rows)
            touch(i, i + example_columns, {0, 1}, sigma_yy);
          else
            touch(i, n + 1, {0, 1}, sigma_yy);
          if (r == 0)
            touch(i, n, {0, -1}, sigma_yy);
          // The two ends of a row lack one neighbour each.
          const double halves = (c > 0) + (c + 1 < example_columns);
          s.internal_moment.push_back(Eigen::Vector2d(0.5 * halves * sigma_xx, sigma_yy).asDiagonal());
        }
    s.contacts             = s.window_forces;
    s.mean_internal_moment = s.internal_moment;
    s.window_dissipation.assign(s.window_forces.size(), 0.01);
    s.window_impact_dissipation.assign(s.window_forces.size(), 0.);
  }

  inline discrete::Snapshot example_grains(const int stage)
  {
    discrete::Snapshot s;
    const std::size_t  n = example_columns * example_rows;
    s.progress = s.axial_strain = s.shear_strain = 0.01 * stage;
    s.time = s.window_time = 10 * stage;
    s.step                 = 0.1;
    for (int r = 0; r < example_rows; ++r)
      for (int c = 0; c < example_columns; ++c)
        {
          const Eigen::Vector2d x(c + 0.5, r + 0.5);
          s.position.push_back(x); // the places omit displacements, which are small beside the lattice
          s.displacement.push_back(example_displacement(x, stage));
        }
    s.velocity.assign(n, Eigen::Vector2d::Zero());
    s.rotation.assign(n, 0.), s.spin.assign(n, 0.), s.mean_spin_term.assign(n, 0.);
    s.radius.assign(n, 0.5), s.mass.assign(n, M_PI / 4);
    s.rattler.assign(n, 0), s.fixed.assign(n, 0);
    add_lattice_forces(s);
    s.gap.assign(s.contacts.size(), 0.), s.status.assign(s.contacts.size(), discrete::ContactStatus::sticking);
    s.applied_force.assign(n, Eigen::Vector2d::Zero());
    s.upper_y                   = example_rows;
    s.upper_platen_displacement = example_travel(stage);
    s.outline.left              = {{0, 0}, {0, example_rows}};
    s.outline.right             = {{example_columns, 0}, {example_columns, example_rows}};
    s.area                      = example_columns * example_rows;
    return s;
  }

  // Elements of 2 x 2 with nine nodes.
  inline continuum::Snapshot example_nodes(const int stage)
  {
    continuum::Snapshot s;
    constexpr int       columns = example_columns / 2, rows = example_rows / 2;
    s.progress = s.axial_strain = s.shear_strain = 0.01 * stage;
    s.time                                       = 10 * stage;
    for (int r = 0; r <= 2 * rows; ++r)
      for (int c = 0; c <= 2 * columns; ++c)
        {
          const Eigen::Vector2d x(c, r);
          s.displacement.push_back(example_displacement(x, stage));
          s.position.push_back(x + s.displacement.back());
          s.weight.push_back((r % (2 * rows) == 0 ? 0.5 : 1) * (c % (2 * columns) == 0 ? 0.5 : 1));
          s.platen_force.emplace_back(0, 0);
        }
    continuum::CellState state;
    state.stress.diagonal() << continuum_over_grains * sigma_xx, continuum_over_grains * sigma_yy, 1;
    state.area        = 4;
    state.dissipation = 0.02 * stage;
    s.cells           = nine_node_cells(columns, rows);
    s.cell_state.assign(s.cells.size(), state);
    s.mean_stress        = state.stress;
    s.upper_platen_force = {0, -continuum_over_grains * sigma_yy * example_columns};
    s.lower_platen_force = -s.upper_platen_force;
    s.area               = example_columns * example_rows;
    return s;
  }

  template <class Row> std::vector<Row> example_rows_of(const double stress_ratio, const double volumetric_strain)
  {
    std::vector<Row> rows;
    for (int k = 1; k <= 40; ++k)
      {
        Row row;
        row.step     = k;
        row.progress = row.axial_strain = row.shear_strain = 0.02 * k / 40;
        row.time                                           = 0.5 * k;
        row.stress_ratio                                   = stress_ratio;
        row.volumetric_strain                              = volumetric_strain * k / 40;
        rows.push_back(row);
      }
    return rows;
  }

  inline Scene example_scene()
  {
    Scene scene;
    scene.name                              = "example";
    scene.loading.axial_strain              = 0.02;
    scene.loading.stage_strain              = 0.01;
    scene.comparison.window_edges           = {0, 0.02};
    scene.comparison.band.resamples         = 0;
    scene.comparison.probes.probe_resamples = 0;
    return scene;
  }

  // t/s = (2 - 1)/(2 + 1) in both panels. The volumetric strain at the end is -1 % for the grains and -0.8 % for the continuum.
  inline Results example_results()
  {
    Results results;
    for (int stage = 0; stage <= 2; ++stage)
      {
        results.discrete.snapshots.push_back(example_grains(stage));
        results.continuum.snapshots.push_back(example_nodes(stage));
      }
    results.discrete.rows  = example_rows_of<discrete::HistoryRow>(1. / 3, -0.01);
    results.continuum.rows = example_rows_of<continuum::HistoryRow>(1. / 3, -0.008);
    for (discrete::HistoryRow &row : results.discrete.rows)
      {
        row.upper_force = {0.5, -80}, row.lower_force = {-0.5, 80};
        row.sweeps = 100, row.residual = 1e-5 * row.step, row.inertial_number = 1e-3;
        row.kinetic_energy_ratio = row.step, row.contacts = 4000 + row.step, row.max_penetration = 0.001 * (row.step % 7);
        row.energy_residual = row.step == 5 ? -1e-12 : 1e-14, row.rattlers = 3;
      }
    for (continuum::HistoryRow &row : results.continuum.rows)
      {
        row.upper_platen_force = {1, -100}, row.lower_platen_force = {-1, 99};
        row.newton_iterations = 3 * row.step, row.cut_backs = row.step > 20, row.max_equivalent_plastic_strain = 0.01 * row.step;
        row.share_zz_not_intermediate = row.step == 7 ? 0.25 : 0, row.viscous_share = 0.001 * row.step;
        row.unstable_share = row.step == 9 ? 0.125 : 0;
      }
    results.phases = {{"preparation", 2, 1.5, 100}, {"discrete", 20, 18, 300}, {"continuum", 3, 2.5, 250}};
    return results;
  }
} // namespace diptych::coupling::synthetic
