// diptych: grains and time tables from files, checked before the computation
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "discrete/bodies/state.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  // Contents of a stage of a snapshot file besides its grains.
  struct StoredStage
  {
    int                      number  = 0;                             // of the group stage_NNNN
    double                   time    = 0;                             // [time]
    double                   step    = 0;                             // length of the step that the impulses belong to [time]
    double                   lower_y = 0, upper_y = 0;                // platens [length]
    double                   left_x = NAN, right_x = NAN;             // side walls [length]; NaN without side walls
    double                   mean_diameter = 0;                       // [length]
    Eigen::Matrix2d          cell_vectors  = Eigen::Matrix2d::Zero(); // of a cell; 0: there is none
    std::vector<PairImpulse> impulses; // closed contacts, ascending in (i, j); sign as in State; may be empty
  };

  struct GrainFile
  {
    std::string                path;
    Grains                     grains;
    std::vector<int>           line  = {}; // of each grain in a CSV file, counted from 1; empty for a snapshot file
    std::optional<StoredStage> stage = {}; // of a snapshot file

    // "FILE, line 12" or "FILE, grain 3 (counted from 0)"
    std::string place(std::size_t grain) const;
  };

  // Region of the grains; absent members do not limit it.
  struct SampleBox
  {
    std::optional<double> lower_y = {}, upper_y = {}; // platens [length]
    std::optional<double> left_x = {}, right_x = {};  // side walls [length]
    Periodicity           periodicity = {};
  };

  // Reads a CSV file. Its header names x, y, r and, optionally, vx, vy, omega and fixed in any order; missing columns are 0. x, y
  // and r are centre and radius [length; radius 1e-12 to 1e12], vx and vy the velocity [length/time], omega the anticlockwise
  // spin [rad/time]. `fixed` is a value of Grains::fixed. Rotations start from 0 and masses are density x pi r^2 (density:
  // mass/length^2 per unit thickness). Throws std::invalid_argument with file, line, column, value and range (see read_csv).
  GrainFile read_grains_csv(const std::string &path, double density, const CheckStop &check_stop = {});

  // Writes such a file with all columns. The numbers read back with the same bits; rotations and masses are lost.
  void write_grains_csv(const std::string &path, const Grains &grains);

  // Grains of one stage (default: the last) of a file of write_snapshots. If grains/fixed is absent, all grains are free.
  // A frame of another code has no step: it has no impulses, and grains whose velocities and spins are not told are at rest.
  // Throws std::invalid_argument if the file is truncated or incomplete, the stage does not exist, or sizes or values are
  // impossible.
  // The message contains file, dataset, row, value and range.
  GrainFile read_grains_hdf5(const std::string &path, int stage = -1);

  // Throws std::invalid_argument with the grains' places, values and range. A disc may reach beyond a platen or side wall by
  // allowed_overlap x radius. Two discs (or images in a cell) may overlap by that share of the smaller radius. Fixed grains may
  // overlap each other and straddle walls, as in rough bottoms, because neither gives way.
  void check_grains(const GrainFile &file, const SampleBox &box, double allowed_overlap);

  // CSV file with the columns `time` (ascending) and `column`; others are ignored. Throws std::invalid_argument with the place.
  TimeTable read_time_table(const std::string &path, const std::string &column);
} // namespace diptych::discrete
