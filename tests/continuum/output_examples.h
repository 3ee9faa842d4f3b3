// diptych: snapshots and rows of which no two values are alike, and what it takes to compare them after a file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "continuum/output.h"

namespace diptych::continuum::tests::output
{
  namespace fs = std::filesystem;

  struct Folder
  {
    std::string path;

    explicit Folder(const std::string &name = "")
        : path((fs::path(testing::TempDir()) / ("diptych_output" + name + std::to_string(::getpid()))).string())
    {
      fs::remove_all(path);
      fs::create_directory(path);
    }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const std::string &name) const { return path + "/" + name; }
  };

  // No two values of a snapshot are alike, so that no two of its fields can be mistaken for each other.
  struct Numbers
  {
    int                                   n;
    double                                operator()() { return std::sin(++n) / 3; }
    void                                  operator()(double &value) { value = (*this)(); }
    template <int rows, int columns> void operator()(Eigen::Matrix<double, rows, columns> &m)
    {
      for (int k = 0; k < m.size(); ++k)
        m(k) = (*this)();
    }
  };

  // n x n cells of nine nodes on the unit square.
  inline Snapshot example(const unsigned int n, const double axial_strain, const bool cosserat)
  {
    Snapshot s;
    Numbers  next{int(1e6 * axial_strain)};
    s.axial_strain = axial_strain;
    next(s.time), next(s.area), next(s.lower_platen_force), next(s.upper_platen_force), next(s.mean_stress);
    const unsigned int side = 2 * n + 1;
    for (unsigned int k = 0; k < side * side; ++k)
      {
        s.position.emplace_back(double(k % side) / (2 * n), double(k / side) / (2 * n));
        s.displacement.emplace_back(next(), next());
        s.weight.push_back(next());
        if (cosserat)
          s.rotation.push_back(next());
      }
    for (unsigned int k = 0; k < n * n; ++k)
      {
        const unsigned int a = 2 * (k % n) + 2 * side * (k / n), b = a + side, c = b + side;
        s.cells.push_back({a, a + 2, c + 2, c, a + 1, b + 2, c + 1, b, b + 1});
        CellState cell;
        next(cell.stress), next(cell.strain), next(cell.plastic_strain), next(cell.couple_stress), next(cell.area);
        next(cell.equivalent_plastic_strain), next(cell.dissipation), next(cell.overstress);
        next(cell.share_zz_not_intermediate), next(cell.acoustic_determinant), next(cell.localisation_angle);
        s.cell_state.push_back(cell);
      }
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

  // A member added to CellState does not compile here: it needs a place in the files, too.
  inline void expect_same(const CellState &x, const CellState &y)
  {
    const auto &[stress, strain, plastic_strain, couple_stress, area, kappa, dissipation, overstress, zz, determinant, angle] = x;
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
  }

  inline void expect_same(const Snapshot &x, const Snapshot &y)
  {
    const auto &[axial_strain, time, position, displacement, rotation, weight, cells, states, lower, upper, mean_stress,
                 area] = x;
    EXPECT_TRUE(same_bits(axial_strain, y.axial_strain));
    EXPECT_TRUE(same_bits(time, y.time));
    EXPECT_TRUE(same_bits(position, y.position));
    EXPECT_TRUE(same_bits(displacement, y.displacement));
    EXPECT_TRUE(same_bits(rotation, y.rotation));
    EXPECT_TRUE(same_bits(weight, y.weight));
    EXPECT_EQ(cells, y.cells);
    EXPECT_TRUE(same_bits(lower, y.lower_platen_force));
    EXPECT_TRUE(same_bits(upper, y.upper_platen_force));
    EXPECT_TRUE(same_bits(mean_stress, y.mean_stress));
    EXPECT_TRUE(same_bits(area, y.area));
    ASSERT_EQ(states.size(), y.cell_state.size());
    for (std::size_t c = 0; c < states.size(); ++c)
      expect_same(states[c], y.cell_state[c]);
  }

  inline HistoryRow example_row(const int step, const double axial_strain)
  {
    HistoryRow r;
    Numbers    next{1000 * step};
    r.step         = step;
    r.axial_strain = axial_strain;
    next(r.stress_ratio), next(r.volumetric_strain), next(r.lower_platen_force), next(r.upper_platen_force);
    r.mean_stress.topLeftCorner<2, 2>() << next(), next(), next(), next();
    r.mean_stress(2, 2) = next();
    r.n_cells = 100 + step, r.n_unknowns = 200 + step, r.newton_iterations = 300 + step, r.linear_iterations = 400 + step;
    r.factorisations = 500 + step, r.cut_backs = 600 + step;
    next(r.plastic_share), next(r.unreliable_share), next(r.share_zz_not_intermediate), next(r.viscous_share);
    next(r.max_equivalent_plastic_strain), next(r.dissipation), next(r.least_acoustic_determinant), next(r.localisation_angle);
    next(r.point_cpu_s), next(r.assembly_cpu_s), next(r.solve_cpu_s), next(r.geometry_cpu_s);
    return r;
  }

  // A member added to HistoryRow does not compile here: it needs a column, too.
  inline void expect_same(const HistoryRow &x, const HistoryRow &y)
  {
    const auto &[step, axial_strain, stress_ratio, volumetric_strain, mean_stress, lower, upper, n_cells, n_unknowns, newton,
                 linear, factorisations, cut_backs, plastic, unreliable, zz, viscous, kappa, dissipation, determinant, angle,
                 point, assembly, solve, geometry] = x;
    EXPECT_EQ(step, y.step);
    EXPECT_TRUE(same_bits(axial_strain, y.axial_strain));
    EXPECT_TRUE(same_bits(stress_ratio, y.stress_ratio));
    EXPECT_TRUE(same_bits(volumetric_strain, y.volumetric_strain));
    EXPECT_TRUE(same_bits(mean_stress, y.mean_stress)) << mean_stress << "\n\n" << y.mean_stress;
    EXPECT_TRUE(same_bits(lower, y.lower_platen_force));
    EXPECT_TRUE(same_bits(upper, y.upper_platen_force));
    EXPECT_EQ(n_cells, y.n_cells);
    EXPECT_EQ(n_unknowns, y.n_unknowns);
    EXPECT_EQ(newton, y.newton_iterations);
    EXPECT_EQ(linear, y.linear_iterations);
    EXPECT_EQ(factorisations, y.factorisations);
    EXPECT_EQ(cut_backs, y.cut_backs);
    EXPECT_TRUE(same_bits(plastic, y.plastic_share));
    EXPECT_TRUE(same_bits(unreliable, y.unreliable_share));
    EXPECT_TRUE(same_bits(zz, y.share_zz_not_intermediate));
    EXPECT_TRUE(same_bits(viscous, y.viscous_share));
    EXPECT_TRUE(same_bits(kappa, y.max_equivalent_plastic_strain));
    EXPECT_TRUE(same_bits(dissipation, y.dissipation));
    EXPECT_TRUE(same_bits(determinant, y.least_acoustic_determinant));
    EXPECT_TRUE(same_bits(angle, y.localisation_angle));
    EXPECT_TRUE(same_bits(point, y.point_cpu_s));
    EXPECT_TRUE(same_bits(assembly, y.assembly_cpu_s));
    EXPECT_TRUE(same_bits(solve, y.solve_cpu_s));
    EXPECT_TRUE(same_bits(geometry, y.geometry_cpu_s));
  }

  inline std::string contents_of(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    EXPECT_TRUE(in) << path;
    return {std::istreambuf_iterator<char>(in), {}};
  }

  inline void put(const std::string &path, const std::string &contents)
  {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << contents;
  }

  template <class Action> void expect_error_naming(const std::vector<std::string> &names, Action &&action)
  {
    try
      {
        action();
        FAIL() << "no error";
      }
    catch (const std::runtime_error &error)
      {
        for (const std::string &name : names)
          EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << "no '" << name << "' in: " << error.what();
      }
  }
} // namespace diptych::continuum::tests::output
