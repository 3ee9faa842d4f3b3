// diptych: keys of the sample and of its preparation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "discrete/bodies/boundary.h"
#include "discrete/choices.h"
#include "discrete/files/out_of_memory.h"
#include "discrete/files/wrong_keys.h"
#include "discrete/samples/radius_distribution.h"
#include "discrete/solvers/solver_options.h"
#include "discrete/solvers/thread_team.h"

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
            "distribution of the radii between radius_min and radius_max, or a grading curve; rescaled to the mean diameter 1");
    visitor("radius_min", o.radius_min, "mean diameters", {0.05, 0.5}, "smallest radius");
    visitor(
      "radius_max", o.radius_max, "mean diameters", {0.5, 5.},
      "largest radius; uniform_by_number: radius_min and radius_max must average 0.5; uniform_by_mass: only their ratio counts");
    visitor("radius_table", FileName{o.radius_table}, "-",
            "CSV file with the columns radius and passing (share of the mass up to this radius) for radius_distribution = table");
    visitor("width_over_height", o.width_over_height, "-", {0.05, 20.},
            "width / height of the sample; below 1 a shear band at 45 degrees ends at the sides");
    visitor("width", o.width, "length", {0., 1e12},
            "width of the sample; 0: from the number of grains. For a periodic sample from a file: its period, "
            "which a discrete.h5 with lateral = cell contains");
    visitor("height", o.height, "length", {0., 1e12},
            "height of the sample; 0: from the number of grains. For a cell from a file: its vertical period");
    visitor("density", o.density, "mass/length^2", {1e-12, 1e12}, "density of the grains, per unit thickness");
    visitor("solid_fraction", o.solid_fraction, "-", {0.3, 0.92},
            "expected solid fraction; relates the number of grains to the size of the sample");
    visitor("box_solid_fraction", o.box_solid_fraction, "-", {0.3, 0.9},
            "solid fraction of the box in which soft discs are relaxed first; with preparation_friction a loose box gives a "
            "loose sample");
    visitor(
      "preparation_steps", o.preparation_steps, "-", {1, 1000000},
      "steps of compaction under the lateral condition with fixed platens; up to ten times as many may be needed to come "
      "to rest. Samples of more than 10000 grains need as many as it takes, at most ten times these in each of three stages "
      "(discrete/README.md)");
    visitor("preparation_step", o.preparation_step, "time", {1e-12, 1e12},
            "length of the steps of compaction; auto: 0.2 d sqrt(rho/P). Samples of more than 10000 grains choose shorter ones "
            "for stiff springs");
    visitor(
      "preparation_tolerance", o.preparation_tolerance, "-", {1e-14, 1.},
      "residual (natural map) at which a preparation step ends; the last step must reach it. Samples of more than 10000 grains "
      "take at most 1e-4");
    visitor("preparation_max_sweeps", o.preparation_max_sweeps, "-", {1, 100000000},
            "largest number of sweeps in a preparation step");
    visitor("preparation_friction", o.preparation_friction, "-", {0., 100.},
            "Coulomb coefficient of grains, platens and walls during the preparation; 0 gives the densest sample");
    visitor(
      "target_solid_fraction", o.target_solid_fraction, "-", {0., 0.92},
      "if not 0, the program searches the preparation friction between 0 and 1 that gives this solid fraction within 0.002");
    visitor("quiet_unbalanced_force", o.quiet_unbalanced_force, "-", {1e-12, 1e3},
            "the sample is at rest if the mean unbalanced force on a grain / mean contact force is below this value; once the "
            "overlaps are "
            "removed, the target is a tenth of it, if the sample reaches that");
    visitor("rough_platens", o.rough_platens, "-",
            "after the preparation, grains within a tenth of their diameter of a platen become part of it: they move with it and "
            "do not "
            "turn");
    visitor("seed", o.seed, "-", {0, 2147483647}, "seed of the random generator");
    visitor("file", FileName{o.file}, "-",
            "file with the grains: CSV with the columns x, y, r and, optionally, vx, vy, omega, fixed (1: held, 2 or 3: part of "
            "the lower "
            "or upper platen); or .h5 snapshots");
    visitor("prepare_file", o.prepare_file, "-", "also compact a sample from a file");
    visitor("lower_platen", o.lower_platen, "length", {-1e12, 1e12},
            "height of the lower platen of a sample from a file; auto: as stored in a snapshot, otherwise the lowest edge of a "
            "free grain "
            "or the lowest centre of a fixed one");
    visitor("upper_platen", o.upper_platen, "length", {-1e12, 1e12},
            "height of the upper platen of a sample from a file; auto: as stored in a snapshot, otherwise the highest edge of a "
            "free grain "
            "or the highest centre of a fixed one");
    visitor("left_wall", o.left_wall, "length", {-1e12, 1e12},
            "lateral = rigid_walls: x of the left wall of a sample from a file; auto: as stored in a snapshot, otherwise the "
            "outermost edge "
            "of any grain, fixed or not");
    visitor("right_wall", o.right_wall, "length", {-1e12, 1e12},
            "lateral = rigid_walls: x of the right wall of a sample from a file; auto: as for left_wall");
    visitor("allowed_overlap", o.allowed_overlap, "-", {0., 1.},
            "largest overlap of two grains of a file, or of a grain and a wall, relative to the smaller radius; a larger one is "
            "an error");
  }

  // Conditions of the preparation: the lateral condition and the pressure of the loading.
  struct PreparationSetting
  {
    LateralCondition lateral;
    SolverOptions    solver;
    double           pressure = 1;
    Eigen::Vector2d  gravity  = Eigen::Vector2d::Zero();

    std::shared_ptr<ThreadTeam> team = std::make_shared<ThreadTeam>(1);
  };

  // Reads the file of a key. Wrong input and a lack of memory are reported with file and key. Other exceptions pass.
  template <class Read> auto read_for(const std::string &key, const std::string &file, Read &&read)
  {
    try
      {
        return read(file);
      }
    catch (const WrongKeys &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        if (dynamic_cast<const std::invalid_argument *>(&error) == nullptr && !is_out_of_memory(error))
          throw;
        throw_wrong_input("sample/" + key, file, error);
      }
  }

  // Throws std::invalid_argument with key and range if options contradict each other.
  void validate(const SampleOptions &options);

  // Radii of n grains, ascending [length], and the area of such discs.
  std::vector<double> sorted_radii(const SampleOptions &options, int n);
  double              disc_area(const std::vector<double> &radius);

  // Number of grains of a generated sample, not rounded: sample/grains, or as many as fill width x height.
  double expected_grains(const SampleOptions &options);

  // Width and height of a generated sample at sample/solid_fraction [length]. The prepared sample has them within some percent.
  Eigen::Vector2d expected_size(const SampleOptions &options);
  Eigen::Vector2d sample_size(const SampleOptions &options, double area); // of grains with this area
} // namespace diptych::discrete
