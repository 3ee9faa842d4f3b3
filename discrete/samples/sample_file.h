// diptych: grains and time tables read from files, checked before anything is computed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discrete/bodies/state.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  // What a stage of a snapshot file holds beside its grains.
  struct StoredStage
  {
    int                      number;           // of the group stage_NNNN
    double                   time;             // [time]
    double                   step;             // length of the step the impulses belong to [time]
    double                   lower_y, upper_y; // platens [length]
    double                   left_x, right_x;  // side walls [length]; NaN where there are none
    double                   mean_diameter;    // [length]
    std::vector<PairImpulse> impulses;         // closed contacts, ascending in (i, j); sign as in State; empty: none stored
  };

  // Grains with the place each of them stands at.
  struct GrainFile
  {
    std::string                path;
    Grains                     grains;
    std::vector<int>           line  = {}; // of each grain in a CSV file, counted from 1; empty for a snapshot file
    std::optional<StoredStage> stage = {}; // of a snapshot file

    // "FILE, line 12" or "FILE, grain 3 (counted from 0)"
    std::string place(std::size_t grain) const;
  };

  // Where grains may be; what is absent does not bound them.
  struct SampleBox
  {
    std::optional<double> lower_y = {}, upper_y = {}; // platens [length]
    std::optional<double> left_x = {}, right_x = {};  // side walls [length]
    std::optional<double> cell_width = {};            // period along x [length]
  };

  // CSV file whose header line names x, y, r and, where wanted, vx, vy, omega (0 where absent) and fixed (0 or 1; 0 where
  // absent), in any order: centre and radius [length, 1e-12 to 1e12 the radius], velocity [length/time], spin, counter-clockwise
  // positive [rad/time]. Rotations start from 0, masses are density x pi r^2 (density: mass/length^2 per unit thickness).
  // Throws std::invalid_argument naming file, line, column, value and range (see read_csv).
  GrainFile read_grains_csv(const std::string &path, double density, const CheckStop &check_stop = {});

  // Writes such a file with all columns and numbers that read back with the same bits; rotations and masses are not kept.
  // Throws std::runtime_error when it cannot be written.
  void write_grains_csv(const std::string &path, const Grains &grains);

  // Grains of one stage (the last by default) of a file written by write_snapshots; grains/fixed may be absent: none is.
  // Throws std::invalid_argument naming file and dataset, where it is truncated or lacks one, and row, value and range where
  // sizes or values are impossible, or where there is no such stage.
  GrainFile read_grains_hdf5(const std::string &path, int stage = -1);

  // Throws std::invalid_argument naming the grains' places, values and range where a disc reaches beyond a platen or side wall,
  // or two discs (or images in a cell) overlap, by more than allowed_overlap x radius (of the smaller disc). Fixed grains may
  // overlap each other and straddle walls, as in rough bottoms: neither gives way.
  void check_grains(const GrainFile &file, const SampleBox &box, double allowed_overlap);

  // CSV file with the columns `time` (ascending) and `column`; further columns may stand beside them.
  // Throws std::invalid_argument naming file, line, column, value and range.
  TimeTable read_time_table(const std::string &path, const std::string &column);
} // namespace diptych::discrete
