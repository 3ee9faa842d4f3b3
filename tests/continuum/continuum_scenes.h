// diptych: samples, loadings and whole courses that the tests of the continuum panel share
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "continuum/mesh.h"
#include "continuum/panel.h"

namespace diptych::continuum::tests
{
  inline std::string temporary_path(const std::string &name)
  {
    static int n = 0;
    return (std::filesystem::path(testing::TempDir()) /
            ("diptych" + std::to_string(::getpid()) + "_" + std::to_string(n++) + name))
      .string();
  }

  // Mesh file that lives as long as the test.
  struct MeshFile
  {
    std::string path = temporary_path(".msh");
    MeshSummary summary;

    MeshFile(const double width, const double height, const double element_size)
        : summary(make_rectangle_mesh({width, height, 0, element_size}, path))
    {}
    MeshFile(const Outline &outline, const double element_size)
        : summary(make_mesh(outline, element_size, path))
    {}
    MeshFile(const MeshFile &)            = delete;
    MeshFile &operator=(const MeshFile &) = delete;
    ~MeshFile() { std::filesystem::remove(path); }
  };

  inline Outline wavy_outline(const double width, const double height, const int points, const double waviness)
  {
    Outline outline;
    for (int k = 0; k < points; ++k)
      {
        const double y    = height * k / (points - 1);
        const double wave = waviness * std::sin(2 * M_PI * 3 * y / height);
        outline.left.emplace_back(-wave, y);
        outline.right.emplace_back(width + wave, y);
      }
    return outline;
  }

  // Perfect plasticity: nothing hardens or softens.
  inline Options perfectly_plastic(const std::string &law, const double friction, const double dilatancy, const double cohesion)
  {
    Options options;
    options.law                           = law;
    options.material.hardening            = "constant";
    options.material.friction_angle_peak  = friction;
    options.material.dilatancy_angle_peak = dilatancy;
    options.material.cohesion             = cohesion;
    return options;
  }

  inline Options elastic()
  {
    Options options;
    options.law = "linear_elastic";
    return options;
  }

  // Platen of the smooth or rough kind, in the geometry named.
  inline Options with(Options options, const std::string &platens, const std::string &geometry)
  {
    options.platens  = platens;
    options.geometry = geometry;
    return options;
  }

  // All accepted steps of one length.
  inline Options with_steps(Options options, const double step)
  {
    options.initial_step = options.max_step = step;
    return options;
  }

  struct Course
  {
    Report                  report;
    std::vector<Snapshot>   snapshots;
    std::vector<HistoryRow> rows;

    const HistoryRow &end() const { return rows.back(); }
  };

  inline Course course(const std::string &mesh, const Loading &loading, const Options &options, Callbacks callbacks = {})
  {
    Course result;
    callbacks.on_stage = [&](const Snapshot &s) { result.snapshots.push_back(s); };
    callbacks.on_step  = [&](const HistoryRow &row) { result.rows.push_back(row); };
    result.report      = run(mesh, 1., loading, options, callbacks);
    return result;
  }

  // A course that must come to its end.
  inline Course finished(const std::string &mesh, const Loading &loading, const Options &options)
  {
    Course result = course(mesh, loading, options);
    if (result.report.status != Status::finished)
      throw std::runtime_error("the course ended early: " + result.report.message);
    EXPECT_EQ(result.report.axial_strain, loading.stages.back());
    EXPECT_EQ(result.snapshots.size(), loading.stages.size());
    return result;
  }

  // d/d progress of a displacement, or a constant force.
  inline Drive travel(const double rate)
  {
    return {false, [rate](const double progress) { return rate * progress; }};
  }
  inline Drive force(const double value)
  {
    return {true, [value](double) { return value; }};
  }
} // namespace diptych::continuum::tests
