// diptych: snapshots and rows of which no two values are alike, and what it takes to compare them after a file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "continuum/history.h"
#include "continuum/snapshot_fields.h"
#include "tests/coupling/synthetic_samples.h"

namespace diptych::coupling::files
{
  using namespace diptych;
  using namespace diptych::coupling;
  namespace fs = std::filesystem;
  using continuum::CellState;
  using continuum::HistoryRow;
  using continuum::Snapshot;

  using diptych::tests::expect_refused;
  using diptych::tests::Folder;
  using discrete::read_text;
  using discrete::write_text;

  // No two values are alike, so that no two fields can be mistaken for each other.
  struct Numbers
  {
    int                                   n;
    double                                operator()() { return std::sin(++n) / 3; }
    void                                  operator()(double &value) { value = (*this)(); }
    void                                  operator()(int &value) { value = ++n; }
    void                                  operator()(continuum::LoadingVariable &) {}
    template <int rows, int columns> void operator()(Eigen::Matrix<double, rows, columns> &m)
    {
      for (int k = 0; k < m.size(); ++k)
        m(k) = (*this)();
    }
  };

  // n x n cells of nine nodes on the unit square.
  inline Snapshot example(const unsigned int n, const double progress, const bool cosserat)
  {
    Snapshot s;
    Numbers  next{int(1e6 * progress)};
    visit_attributes(s, [&](const char *, auto &value, const char *, const char *) { next(value); });
    s.progress              = progress;
    s.loading_variable      = continuum::LoadingVariable::shear_strain;
    const unsigned int side = 2 * n + 1;
    for (unsigned int k = 0; k < side * side; ++k)
      {
        s.position.emplace_back(double(k % side) / (2 * n), double(k / side) / (2 * n));
        s.displacement.emplace_back(next(), next());
        s.weight.push_back(next());
        s.platen_force.emplace_back(next(), next());
        if (cosserat)
          s.rotation.push_back(next());
      }
    s.cells = synthetic::nine_node_cells(n, n);
    s.cell_state.resize(n * n);
    for (CellState &state : s.cell_state)
      visit_cell_fields(state, [&](const char *, auto &value, const char *, const char *) { next(value); });
    if (!cosserat)
      s.variables = {{"law.strength", "pressure", "of a library", std::vector<double>(n * n, 0.1)}};
    return s;
  }

  inline bool same_bits(const double a, const double b)
  {
    return std::memcmp(&a, &b, sizeof a) == 0;
  }
  template <int rows, int columns>
  bool same_bits(const Eigen::Matrix<double, rows, columns> &a, const Eigen::Matrix<double, rows, columns> &b)
  {
    return std::memcmp(a.data(), b.data(), sizeof a) == 0;
  }
  template <class T> bool same_bits(const std::vector<T> &a, const std::vector<T> &b)
  {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const T &x, const T &y) { return same_bits(x, y); });
  }

  inline bool same_bits(const continuum::LoadingVariable a, const continuum::LoadingVariable b)
  {
    return a == b;
  }

  // A member added to CellState does not compile here: it needs a line in the list of fields, too.
  inline void expect_same(const CellState &x, const CellState &y)
  {
    const auto &[stress, strain, plastic_strain, couple_stress, area, kappa, dissipation, overstress, zz, determinant, angle,
                 friction, solid_fraction, kbar] = x;
    EXPECT_TRUE(same_bits(stress, y.stress)) << stress << "\n\n" << y.stress;
    EXPECT_TRUE(same_bits(strain, y.strain)) << strain << "\n\n" << y.strain;
    EXPECT_TRUE(same_bits(plastic_strain, y.plastic_strain)) << plastic_strain << "\n\n" << y.plastic_strain;
    EXPECT_TRUE(same_bits(couple_stress, y.couple_stress)) << couple_stress << "\n\n" << y.couple_stress;
    EXPECT_TRUE(same_bits(area, y.area));
    EXPECT_TRUE(same_bits(kappa, y.equivalent_plastic_strain));
    EXPECT_TRUE(same_bits(dissipation, y.dissipation));
    EXPECT_TRUE(same_bits(overstress, y.overstress));
    EXPECT_TRUE(same_bits(zz, y.share_zz_not_intermediate));
    EXPECT_TRUE(same_bits(determinant, y.acoustic_determinant));
    EXPECT_TRUE(same_bits(angle, y.localisation_angle));
    EXPECT_TRUE(same_bits(friction, y.friction_angle));
    EXPECT_TRUE(same_bits(solid_fraction, y.solid_fraction));
    EXPECT_TRUE(same_bits(kbar, y.nonlocal_plastic_strain));
  }

  inline void expect_same(const Snapshot &x, const Snapshot &y)
  {
    const auto &[progress, axial_strain, shear_strain, time, loading_variable, position, displacement, rotation, weight,
                 platen_force, cells, states, variables, lower, upper, mean_stress, area] = x;
    EXPECT_TRUE(same_bits(progress, y.progress));
    EXPECT_TRUE(same_bits(axial_strain, y.axial_strain));
    EXPECT_TRUE(same_bits(shear_strain, y.shear_strain));
    EXPECT_TRUE(same_bits(time, y.time));
    EXPECT_EQ(loading_variable, y.loading_variable);
    EXPECT_TRUE(same_bits(position, y.position));
    EXPECT_TRUE(same_bits(displacement, y.displacement));
    EXPECT_TRUE(same_bits(rotation, y.rotation));
    EXPECT_TRUE(same_bits(weight, y.weight));
    EXPECT_TRUE(same_bits(platen_force, y.platen_force));
    EXPECT_EQ(cells, y.cells);
    EXPECT_TRUE(same_bits(lower, y.lower_platen_force));
    EXPECT_TRUE(same_bits(upper, y.upper_platen_force));
    EXPECT_TRUE(same_bits(mean_stress, y.mean_stress));
    EXPECT_TRUE(same_bits(area, y.area));
    ASSERT_EQ(variables.size(), y.variables.size());
    for (std::size_t k = 0; k < variables.size(); ++k)
      {
        EXPECT_EQ(variables[k].name + variables[k].unit + variables[k].meaning,
                  y.variables[k].name + y.variables[k].unit + y.variables[k].meaning);
        EXPECT_TRUE(same_bits(variables[k].of_cells, y.variables[k].of_cells));
      }
    ASSERT_EQ(states.size(), y.cell_state.size());
    for (std::size_t c = 0; c < states.size(); ++c)
      expect_same(states[c], y.cell_state[c]);
  }

} // namespace diptych::coupling::files
