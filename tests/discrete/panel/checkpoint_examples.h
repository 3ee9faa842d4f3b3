// diptych: loadings and checkpoints compared bit by bit
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "discrete/panel/checkpoint.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  // Every number of an object in turn, so that two objects can be compared bit by bit, NaN included.
  struct Bits
  {
    std::vector<std::uint64_t> words = {};

    void operator()(const double value)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, &value, sizeof word);
      words.push_back(word);
    }
    void operator()(const Eigen::Vector2d &v) { (*this)(v.x()), (*this)(v.y()); }
    void operator()(const Eigen::Matrix2d &m) { (*this)(Eigen::Vector2d(m.row(0))), (*this)(Eigen::Vector2d(m.row(1))); }
    void operator()(const ContactForce &c)
    {
      (*this)(c.i), (*this)(c.j), (*this)(c.point), (*this)(c.normal), (*this)(c.force), (*this)(c.shift), (*this)(c.couple);
    }
    void operator()(const ContactStatus &status) { (*this)(double(status)); }
    void operator()(const PairImpulse &r)
    {
      (*this)(r.i), (*this)(r.j), (*this)(r.normal), (*this)(r.tangential);
      (*this)(r.normal_change), (*this)(r.tangential_change), (*this)(r.rolling), (*this)(r.rolling_change);
    }
    void operator()(const WindowForces::PairSum &s)
    {
      (*this)(s.i), (*this)(s.j), (*this)(s.dissipation), (*this)(s.impact), (*this)(s.impulse), (*this)(s.rolling);
    }
    void operator()(const Wall &w)
    {
      (*this)(w.point), (*this)(w.normal), (*this)(w.velocity), (*this)(w.mass), (*this)(double(w.kind));
    }
    void operator()(const HistoryRow &row)
    {
      visit_columns(row, [&](const char *, const auto &value, const char *, const char *) { (*this)(double(value)); });
    }
    template <class T> void operator()(const std::vector<T> &values)
    {
      (*this)(double(values.size()));
      for (const T &value : values)
        (*this)(value);
    }
    template <class First, class Second, class... Rest>
    void operator()(const First &first, const Second &second, const Rest &...rest)
    {
      (*this)(first);
      (*this)(second, rest...);
    }
  };

  inline std::vector<std::uint64_t> bits(const Snapshot &s)
  {
    Bits b;
    b(double(s.loading_variable), s.progress, s.axial_strain, s.time, s.step, s.residual, s.mean_diameter, s.shear_strain,
      s.stress_error, s.stress_change, s.error_over_residual);
    b(s.position, s.displacement, s.velocity, s.rotation, s.spin, s.radius, s.mass, s.internal_moment, s.mean_internal_moment);
    b(s.mean_spin_term, s.rattler, s.fixed, s.contacts, s.gap, s.status, s.applied_force, s.window_forces, s.window_time,
      s.window_dissipation, s.window_impact_dissipation);
    b(s.lower_y, s.upper_y, s.upper_platen_displacement, s.lower_platen_force, s.upper_platen_force, s.left_x, s.right_x);
    b(s.cell_width, s.outline.left, s.outline.right, s.area);
    return b.words;
  }

  inline std::vector<std::uint64_t> bits(const std::vector<HistoryRow> &rows)
  {
    Bits b;
    b(rows);
    return b.words;
  }

  // Everything that a checkpoint must keep. Drives follow from the scene.
  inline std::vector<std::uint64_t> bits(const Checkpoint &p)
  {
    Bits          b;
    const Grains &g = p.state.grains;
    b(g.position, g.velocity, g.rotation, g.spin, g.radius, g.mass, g.fixed);
    b(p.state.walls, p.state.impulses, p.state.time, double(p.state.width() != nullptr));
    if (p.state.width())
      b(p.state.width()->width, p.state.width()->velocity, p.state.width()->mass);
    const Reference &r = p.reference;
    b(r.position, r.platen, r.height, r.area, r.grain_area, r.kinetic_energy, r.platen_kinetic_energy, r.strain_rate,
      r.mean_density);
    b(p.row, p.window.sums, p.window.spin, p.window.time, p.stage, double(p.steps_left), p.step, double(p.interval));
    const Report &q = p.report;
    b(double(q.steps), double(q.sweeps), double(q.updates), q.preparation_cpu_s, q.loading_cpu_s, q.solver_cpu_s,
      double(q.preparation.quiet), q.preparation.soft_overlap, q.expected.dilation_loss);
    visit_facts(q, [&](const char *, const auto &value, const char *, const char *) {
      if constexpr (!std::is_same_v<std::decay_t<decltype(value)>, std::string>)
        b(double(value));
    });
    return b.words;
  }

  // Random values over many decades, with both signs.
  struct Dice
  {
    std::mt19937_64 random{7};

    double operator()()
    {
      const double mantissa = double(std::int64_t(random())) * 0x1.0p-63;
      return std::ldexp(mantissa, int(random() % 200) - 100);
    }
    double          size() { return std::abs((*this)()); }
    int             whole() { return int(random() % 1000000); }
    Eigen::Vector2d vector() { return {(*this)(), (*this)()}; }
  };

  inline HistoryRow random_row(Dice &dice)
  {
    HistoryRow row;
    visit_columns(row, [&](const char *, auto &value, const char *, const char *) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, double>)
        value = dice();
      else if constexpr (std::is_enum_v<Value>)
        value = Value(dice.whole() % 3);
      else
        value = dice.whole();
    });
    return row;
  }

  inline void fill_state(Dice &dice, State &state)
  {
    for (int k = 0; k < 9; ++k)
      {
        add_grain(state.grains, dice.vector(), dice.size(), 1.);
        state.grains.velocity.back() = dice.vector();
        state.grains.rotation.back() = dice(), state.grains.spin.back() = dice(), state.grains.mass.back() = dice.size();
        state.grains.fixed.back() = k % 3 == 0;
      }
    for (int w = 0; w < 4; ++w)
      {
        Wall wall{dice.vector(), dice.vector().normalized(), dice.vector(), {}, {}, dice.size()};
        if (w == 1)
          wall.point.y() = std::nextafter(std::abs(state.walls[0].point.y()), 2.); // the upper platen
        wall.kind = w < 2 ? WallKind::platen : WallKind::side;
        state.walls.push_back(wall);
      }
    state.periodicity = PeriodicWidth{dice.size(), dice(), {}, dice()};
    for (int k = 0; k < 5; ++k)
      state.impulses.push_back({k, k + 3, dice(), dice(), dice(), dice(), dice(), dice()});
    state.time = dice.size();
  }

  inline void fill_report(Dice &dice, Report &q)
  {
    visit_facts(q, [&](const char *, auto &value, const char *, const char *) {
      using Value = std::decay_t<decltype(value)>;
      if constexpr (std::is_same_v<Value, double>)
        value = dice();
      else if constexpr (std::is_same_v<Value, int>)
        value = dice.whole();
    });
    q.steps = dice.whole(), q.sweeps = 123456789012345, q.updates = 9007199254740991; // 2^53 - 1
    q.preparation.quiet = true, q.preparation.soft_overlap = dice(), q.expected.dilation_loss = dice();
    q.preparation_cpu_s = dice(), q.loading_cpu_s = dice(), q.solver_cpu_s = dice();
    q.estimated_error     = std::numeric_limits<double>::infinity();
    q.error_over_residual = q.reference_residual = std::numeric_limits<double>::quiet_NaN();
    q.step_bound                                 = "forces";
  }

  inline StoredCheckpoint random_checkpoint()
  {
    Dice             dice;
    StoredCheckpoint checkpoint;
    Checkpoint      &p = checkpoint.panel;
    fill_state(dice, p.state);
    fill_report(dice, p.report);
    for (std::size_t i = 0; i < p.state.grains.size(); ++i)
      p.reference.position.push_back(dice.vector()), p.window.spin.push_back(dice());
    p.reference.platen = dice.vector(), p.reference.height = dice.size(), p.reference.area = dice.size();
    p.reference.grain_area = dice(), p.reference.kinetic_energy = dice(), p.reference.platen_kinetic_energy = dice();
    p.reference.strain_rate = dice(), p.reference.mean_density = dice();
    for (int k = 0; k < 6; ++k)
      p.window.sums.push_back({k, k + 1, dice(), dice(), dice.vector(), dice()});
    p.window.time = dice(), p.stage = 3, p.steps_left = 77, p.step = dice.size(), p.interval = 5;
    p.row                 = random_row(dice);
    p.row.energy_residual = std::numeric_limits<double>::quiet_NaN();
    checkpoint.n_rows     = 123456789;
    checkpoint.scene      = "sample/seed=1\nsample/file=two lines\n";
    return checkpoint;
  }

  inline StoredCheckpoint written_and_read(const StoredCheckpoint &checkpoint)
  {
    const Folder folder;
    write_checkpoint(folder / "a.h5", checkpoint);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5.part"));
    return read_checkpoint(folder / "a.h5");
  }
} // namespace
