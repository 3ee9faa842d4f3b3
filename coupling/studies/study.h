// diptych: the contents of a study file: points, samples, quantities and the reference
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
  // The command that every point of a study runs.
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

  using Settings = std::vector<Entry>; // of a scene, with their place in the study and the folder of their files

  // One or several keys that are set together.
  struct AxisPoint
  {
    std::string label;
    Settings    settings;
    double      value = NAN; // if the axis varies one key that is a number
  };

  struct Axis
  {
    std::string            name;
    bool                   converges     = false; // results have a limit as the values go to 0: a step, an element size
    bool                   own_reference = false; // each point is compared with the reference at that point
    std::vector<AxisPoint> points;
  };

  // Points that share settings and axes.
  struct Family
  {
    std::string       name;
    Settings          settings;
    bool              is_grid = true; // all combinations; else the k-th points of all axes together
    std::vector<Axis> axes;
  };

  // Only these points, numbered.
  inline Family family_of(const std::vector<Settings> &points)
  {
    Axis axis;
    axis.name = "point";
    for (const Settings &settings : points)
      axis.points.push_back({std::to_string(axis.points.size()), settings});
    return {"", {}, true, {axis}};
  }

  // The file that a quantity is read from.
  enum class Source
  {
    discrete,       // columns of discrete.csv
    continuum,      // columns of continuum.csv
    material_point, // columns of material_point.csv
    comparison      // numbers of comparison.json, with the names of ensemble.csv
  };
  constexpr auto choices(Source)
  {
    return std::array{std::pair{Source::discrete, "discrete"}, std::pair{Source::continuum, "continuum"},
                      std::pair{Source::material_point, "material_point"}, std::pair{Source::comparison, "comparison"}};
  }

  enum class Reduction
  {
    strength, // T/S over a range of the progress: mean of t / mean of s
    mean,     // mean of a column over a range of the progress
    at,       // value of a column at a progress
    peak,     // largest running mean of a column over a width of the progress
    largest,  // largest value of a column
    last,     // last value of a column
    number    // a number of a comparison
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
    std::string           column;               // column, or name of the number
    double                from = NAN, to = NAN; // range; `at`: from; `peak`: the width is `to`
    bool                  is_relative = true;   // errors are relative to the reference's mean
    std::optional<double> limit;                // largest error that counts as right
    std::string           unit    = "-";
    bool                  is_line = false; // an angle that repeats after 180 degrees
  };

  // The border beyond which a method fails by theory: y = coefficient x^exponent between two axes of a family.
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
    std::vector<std::string>   cost; // phases that count; empty: all except the report
    std::vector<Border>        borders;

    int n_samples() const { return seeds.empty() ? 1 : int(seeds.size()); }
  };
} // namespace diptych::coupling
