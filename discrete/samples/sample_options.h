// diptych: what a scene says of the sample, and under what it is prepared
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include <optional>

#include "discrete/bodies/boundary.h"
#include "discrete/choices.h"
#include "discrete/samples/radius_distribution.h"
#include "discrete/solvers/solver_options.h"

namespace diptych::discrete
{
  enum class RadiusKind
  {
    uniform_by_number,
    uniform_by_mass,
    table
  };

  constexpr auto choices(RadiusKind)
  {
    return std::array{std::pair{RadiusKind::uniform_by_number, "uniform_by_number"},
                      std::pair{RadiusKind::uniform_by_mass, "uniform_by_mass"}, std::pair{RadiusKind::table, "table"}};
  }

  struct SampleOptions
  {
    int                   grains              = 4000;
    double                mean_diameter       = 1;
    RadiusKind            radius_distribution = RadiusKind::uniform_by_number;
    double                radius_min          = 0.3;
    double                radius_max          = 0.7;
    std::string           radius_table        = "";
    double                width_over_height   = 0.7;
    double                width               = 0;
    double                height              = 0;
    double                density             = 1;
    double                solid_fraction      = 0.85;
    double                box_solid_fraction  = 0.835;
    int                   preparation_steps   = 300;
    std::optional<double> preparation_step; // [time]; none: 0.2 d sqrt(rho/P)
    double                preparation_tolerance  = 1e-3;
    int                   preparation_max_sweeps = 300;
    double                preparation_friction   = 0;
    double                target_solid_fraction  = 0;
    double                quiet_unbalanced_force = 0.05;
    int                   seed                   = 1;
    std::string           file                   = "";
    bool                  prepare_file           = false;
    bool                  rough_platens          = false;
    std::optional<double> lower_platen           = {};
    std::optional<double> upper_platen           = {};
    std::optional<double> left_wall              = {};
    std::optional<double> right_wall             = {};
    double                allowed_overlap        = 0.01;
  };

  template <class Visitor> void visit_parameters(SampleOptions &o, Visitor &&visitor)
  {
    visitor("grains", o.grains, "-", {10, 10000000}, "number of discs, unless width and height are both given");
    visitor("mean_diameter", o.mean_diameter, "length", {1e-9, 1e9}, "mean diameter d");
    visitor("radius_distribution", o.radius_distribution, "-",
            "of the radii between radius_min and radius_max, or a grading curve; rescaled to the mean diameter 1");
    visitor("radius_min", o.radius_min, "mean diameters", {0.05, 0.5}, "smallest radius");
    visitor("radius_max", o.radius_max, "mean diameters", {0.5, 5.},
            "largest radius; uniform_by_number: the two must average 0.5; uniform_by_mass: only their ratio counts");
    visitor("radius_table", FileName{o.radius_table}, "-",
            "CSV file with the columns radius, passing (share of the mass up to this radius), for radius_distribution = table");
    visitor("width_over_height", o.width_over_height, "-", {0.05, 20.},
            "of the sample; below 1 a 45 degree band leaves by the sides");
    visitor("width", o.width, "length", {0., 1e12},
            "of the sample; 0: from the number of grains. The period of a periodic sample from a file");
    visitor("height", o.height, "length", {0., 1e12}, "of the sample; 0: from the number of grains");
    visitor("density", o.density, "mass/length^2", {1e-12, 1e12}, "of the grains, per unit thickness");
    visitor("solid_fraction", o.solid_fraction, "-", {0.3, 0.92}, "expected; relates number of grains and size of the sample");
    visitor(
      "box_solid_fraction", o.box_solid_fraction, "-", {0.3, 0.9},
      "of the box in which soft discs are relaxed first; with friction in the preparation a loose box gives a loose sample");
    visitor("preparation_steps", o.preparation_steps, "-", {1, 1000000},
            "steps of compaction under the lateral condition, platens fixed; ten times as many are allowed to get quiet");
    visitor("preparation_step", o.preparation_step, "time", {1e-12, 1e12}, "their length; auto: 0.2 d sqrt(rho/P)");
    visitor("preparation_tolerance", o.preparation_tolerance, "-", {1e-14, 1.},
            "natural map residual at which a preparation step ends, and which the last one must have reached");
    visitor("preparation_max_sweeps", o.preparation_max_sweeps, "-", {1, 100000000}, "sweeps a preparation step may take");
    visitor("preparation_friction", o.preparation_friction, "-", {0., 100.},
            "Coulomb coefficient of grains, platens and walls during the preparation; 0: densest");
    visitor("target_solid_fraction", o.target_solid_fraction, "-", {0., 0.92},
            "if not 0, the preparation friction is searched between 0 and 1 until the sample has this fraction within 0.002");
    visitor("quiet_unbalanced_force", o.quiet_unbalanced_force, "-", {1e-12, 1e3},
            "the sample is quiet when the mean unbalanced force on a grain / mean contact force is below this; a tenth of it, "
            "where it gets there, once the "
            "overlaps are taken out");
    visitor("rough_platens", o.rough_platens, "-",
            "grains that come within a tenth of their diameter to a platen become part of it once the sample is prepared: they "
            "move with it and do not turn");
    visitor("seed", o.seed, "-", {0, 2147483647}, "of the one random generator");
    visitor(
      "file", FileName{o.file}, "-",
      "read the grains from here: CSV with the columns x, y, r and, where wanted, vx, vy, omega, fixed (1: held, 2 or 3: part "
      "of the lower or upper platen); or .h5 snapshots");
    visitor("prepare_file", o.prepare_file, "-", "compact a sample from a file, too");
    visitor("lower_platen", o.lower_platen, "length", {-1e12, 1e12},
            "height of the lower platen of a sample from a file; auto: as a snapshot stores it, else the lowest grain that moves "
            "or the "
            "lowest centre of a fixed one");
    visitor("upper_platen", o.upper_platen, "length", {-1e12, 1e12},
            "height of the upper platen of a sample from a file; auto: as a snapshot stores it, else the highest grain that "
            "moves or the "
            "highest centre of a fixed one");
    visitor(
      "left_wall", o.left_wall, "length", {-1e12, 1e12},
      "lateral = rigid_walls: place of the left wall of a sample from a file; auto: as a snapshot stores it, else the outermost "
      "edge of any grain, fixed or not");
    visitor("right_wall", o.right_wall, "length", {-1e12, 1e12},
            "lateral = rigid_walls: place of the right wall of a sample from a file; auto as on the left");
    visitor("allowed_overlap", o.allowed_overlap, "-", {0., 1.},
            "of two grains of a file, relative to the smaller radius, or of a grain and a wall; more is an error");
  }

  // Under what a sample is prepared: the lateral condition and pressure it will be loaded with.
  struct PreparationSetting
  {
    LateralCondition lateral;
    SolverOptions    solver;
    double           pressure = 1;
    Eigen::Vector2d  gravity  = Eigen::Vector2d::Zero();
  };

  // How many grains a generated sample has: sample/grains, or as many as fill width x height. Not rounded.
  double expected_grains(const SampleOptions &options);

  // Width and height of a generated sample at sample/solid_fraction [length]; prepared, it has them to some percent.
  Eigen::Vector2d expected_size(const SampleOptions &options);
} // namespace diptych::discrete
