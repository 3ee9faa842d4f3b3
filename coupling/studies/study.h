// diptych: what a study asks: which settings of a scene, on which samples, held against what
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/scene/scene_text.h"

namespace diptych::coupling
{
  // What of the program every point of a study runs.
  enum class StudyCommand
  {
    discrete,
    continuum,
    run,
    material_point
  };
  constexpr auto choices(StudyCommand)
  {
    return std::array{std::pair{StudyCommand::discrete, "discrete"}, std::pair{StudyCommand::continuum, "continuum"},
                      std::pair{StudyCommand::run, "run"}, std::pair{StudyCommand::material_point, "material-point"}};
  }

  using Settings = std::vector<Entry>; // of a scene; where they were made and where their files are

  // One or several keys that are set together.
  struct AxisPoint
  {
    std::string label;
    Settings    settings;
    double      value = NAN; // of an axis over one key that is a number
  };

  struct Axis
  {
    std::string            name;
    bool                   converges     = false; // results have a limit as its values go to 0: a step, the size of elements
    bool                   own_reference = false; // each of its points is held against the reference at that point
    std::vector<AxisPoint> points;
  };

  // Points that share settings and axes.
  struct Family
  {
    std::string       name;
    Settings          settings;
    bool              is_grid = true; // every point of an axis with every point of the others; else the k-th of all together
    std::vector<Axis> axes;
  };

  // These points alone, numbered.
  inline Family family_of(const std::vector<Settings> &points)
  {
    Axis axis;
    axis.name = "point";
    for (const Settings &settings : points)
      axis.points.push_back({std::to_string(axis.points.size()), settings});
    return {"", {}, true, {axis}};
  }

  // From what a quantity is read.
  enum class Source
  {
    discrete,       // columns of discrete.csv
    continuum,      // of continuum.csv
    material_point, // of material_point.csv
    comparison      // numbers of comparison.json, named as ensembles name them
  };
  constexpr auto choices(Source)
  {
    return std::array{std::pair{Source::discrete, "discrete"}, std::pair{Source::continuum, "continuum"},
                      std::pair{Source::material_point, "material_point"}, std::pair{Source::comparison, "comparison"}};
  }

  enum class Reduction
  {
    strength, // T/S over a window of the progress: mean of t over mean of s
    mean,     // of a column over a window of the progress
    at,       // a value of a column at a progress
    peak,     // largest running mean of a column over a width of the progress
    largest,  // of a column
    last,     // of a column
    number    // of a comparison
  };
  constexpr auto choices(Reduction)
  {
    return std::array{
      std::pair{Reduction::strength, "strength"}, std::pair{Reduction::mean, "mean"},       std::pair{Reduction::at, "at"},
      std::pair{Reduction::peak, "peak"},         std::pair{Reduction::largest, "largest"}, std::pair{Reduction::last, "last"},
      std::pair{Reduction::number, "number"}};
  }

  struct StudyQuantity
  {
    std::string           name;
    Source                source    = Source::discrete;
    Reduction             reduction = Reduction::last;
    std::string           column;               // or the number's name
    double                from = NAN, to = NAN; // window; `at`: from; `peak`: the width is `to`
    bool                  is_relative = true;   // errors are shares of the reference's mean
    std::optional<double> limit;                // the error that still counts as right
    std::string           unit    = "-";
    bool                  is_line = false; // an angle that repeats after 180 degrees
  };

  // Where theory says that a method begins to fail: y = coefficient x^exponent between two axes of a family.
  struct Border
  {
    std::string label, family, x, y;
    double      coefficient = 1, exponent = 1;
  };

  struct Study
  {
    std::string                name, file, title, scene;
    StudyCommand               command = StudyCommand::run;
    Settings                   settings; // of all points
    std::vector<int>           seeds;    // empty: the one sample of the scene
    Settings                   reference;
    std::vector<Family>        families;
    std::vector<StudyQuantity> quantities;
    std::vector<std::string>   cost; // phases that count; empty: all but the report
    std::vector<Border>        borders;

    int n_samples() const { return seeds.empty() ? 1 : int(seeds.size()); }
  };
} // namespace diptych::coupling
