// diptych: facts that the panels record about their runs
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "coupling/numbers/number_entry.h"

namespace diptych::coupling
{
  struct DiscreteFacts
  {
    double      preparation_solid_fraction = NAN, preparation_friction = NAN;
    int         preparation_steps    = 0;
    double      preparation_residual = NAN, preparation_unbalanced_force = NAN, preparation_largest_overlap = NAN;
    int         preparation_settling_steps = 0;
    double      initial_height = NAN, platen_speed = NAN; // [length], [length/time]
    double      step = NAN, tolerance = NAN;              // [time], -
    double      expected_strength_error = NAN, expected_dilation_error = NAN;
    std::string step_bound;
    int         halved_steps = 0, kinetic_energy_bursts = 0;
    double      ns_per_update = NAN, solver_share_of_cpu = NAN;
    double      residual_factor = NAN, residual_factor_reference_residual = NAN;
    double      residual_factor_error = NAN, residual_factor_estimate = NAN;
    int         snapshots_sampled = 0, snapshots_accurate = 0;
    bool        finished         = false;
    double      reached_progress = NAN, reached_axial_strain = NAN, reached_shear_strain = NAN;
    std::string message;
    std::string warnings; // one per line
  };

  template <class Facts, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Facts>, DiscreteFacts>, int> = 0>
  void list_numbers(Facts &f, Visitor &v)
  {
    v({"preparation_solid_fraction", "-", "solid fraction as prepared"}, f.preparation_solid_fraction);
    v({"preparation_friction", "-", "friction of the preparation"}, f.preparation_friction);
    v({"preparation_steps", "-", "steps of the preparation"}, f.preparation_steps);
    v({"preparation_residual", "-", "residual at the end of the preparation"}, f.preparation_residual);
    v({"preparation_unbalanced_force", "-", "unbalanced force after the preparation"}, f.preparation_unbalanced_force);
    v({"preparation_settling_steps", "-", "steps after the compaction, from rest, that removed the overlaps"},
      f.preparation_settling_steps);
    v({"preparation_largest_overlap", "mean diameters", "largest overlap of the sample when its loading began"},
      f.preparation_largest_overlap);
    v({"initial_height", "length", "initial height"}, f.initial_height);
    v({"platen_speed", "length/time", "platen speed"}, f.platen_speed);
    v({"step", "time", "step of the last stage"}, f.step);
    v({"step_bound", "-", "bound that gave the step, if it was chosen automatically"}, f.step_bound);
    v({"tolerance", "-", "residual at which the steps of the last stage ended"}, f.tolerance);
    v({"expected_strength_error", "-", "relative error of the strength expected for this step and strain rate"},
      f.expected_strength_error);
    v({"expected_dilation_error", "-",
       "relative error of the dilation expected: what the step adds, less what the tolerance takes"},
      f.expected_dilation_error);
    v({"halved_steps", "-", "steps halved because the sweeps stalled"}, f.halved_steps);
    v({"kinetic_energy_bursts", "-", "times the kinetic energy rose above twice M|V|²/4"}, f.kinetic_energy_bursts);
    v({"ns_per_update", "ns", "time of one contact update", Kind::clock}, f.ns_per_update);
    v({"solver_share_of_cpu", "-", "contact solver's share of the CPU time", Kind::clock}, f.solver_share_of_cpu);
    v({"residual_factor", "-", "grain-stress error over residual"}, f.residual_factor);
    v({"residual_factor_reference_residual", "-", "residual of the more accurate solve used for that measurement"},
      f.residual_factor_reference_residual);
    v({"residual_factor_error", "-", "error of the grain stress, measured in that solve"}, f.residual_factor_error);
    v({"residual_factor_estimate", "-", "error of the grain stress, estimated in that solve"}, f.residual_factor_estimate);
    v({"snapshots_sampled", "-", "snapshots whose grain stress was estimated"}, f.snapshots_sampled);
    v({"snapshots_accurate", "-", "snapshots that reached the demanded accuracy"}, f.snapshots_accurate);
    v({"finished", "-", "ran to its end"}, f.finished);
    v({"reached_progress", "strain or time", "progress reached"}, f.reached_progress);
    v({"reached_axial_strain", "-", "axial strain reached"}, f.reached_axial_strain);
    v({"reached_shear_strain", "-", "shear strain reached"}, f.reached_shear_strain);
    v({"message", "-", "message"}, f.message);
    v({"warnings", "-", "reasons to doubt the result, one per line"}, f.warnings);
  }

  struct ContinuumFacts
  {
    int                   cells = 0, unknowns = 0, steps = 0, processes = 1;
    std::optional<double> localisation_strain, localisation_angle; // [progress], [degrees]
    bool                  finished         = false;
    double                reached_progress = NAN, reached_axial_strain = NAN, reached_shear_strain = NAN;
    std::string           message;
  };

  template <class Facts, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Facts>, ContinuumFacts>, int> = 0>
  void list_numbers(Facts &f, Visitor &v)
  {
    v({"cells", "-", "cells"}, f.cells);
    v({"unknowns", "-", "unknowns"}, f.unknowns);
    v({"steps", "-", "steps"}, f.steps);
    v({"processes", "-", "processes"}, f.processes);
    v({"localisation_strain", "strain or time", "progress at which localisation is first possible (singular acoustic tensor)"},
      f.localisation_strain);
    v({"localisation_angle_deg", "degrees", "angle of the band that could form at that point", Kind::line}, f.localisation_angle);
    v({"finished", "-", "ran to its end"}, f.finished);
    v({"reached_progress", "strain or time", "progress reached"}, f.reached_progress);
    v({"reached_axial_strain", "-", "axial strain reached"}, f.reached_axial_strain);
    v({"reached_shear_strain", "-", "shear strain reached"}, f.reached_shear_strain);
    v({"message", "-", "message"}, f.message);
  }

  // Cost of one phase of a run. Memory is the peak of the whole process so far [MB].
  struct PhaseCost
  {
    std::string name;
    double      wall_s = 0, cpu_s = 0, peak_memory_mb = 0;
  };

  template <class Phase, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Phase>, PhaseCost>, int> = 0>
  void list_numbers(Phase &p, Visitor &v)
  {
    v({"name", "-", "name of the phase", Kind::setting}, p.name);
    v({"wall_s", "s", "time on the clock", Kind::clock}, p.wall_s);
    v({"cpu_s", "s", "CPU time", Kind::clock}, p.cpu_s);
    v({"peak_memory_mb", "MB", "peak memory of the process so far", Kind::clock}, p.peak_memory_mb);
  }

  // Checksums (FNV-1a, 64 bits, hexadecimal) of the two files of a part, taken when the part ended. Empty: not known.
  struct FileSums
  {
    std::string table, snapshots;
  };

  template <class Sums, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Sums>, FileSums>, int> = 0>
  void list_numbers(Sums &s, Visitor &v)
  {
    v({"table", "-", "checksum of the .csv file (comparison, ensemble: of the .json file) as the run wrote it (FNV-1a, 64 bits)",
       Kind::setting},
      s.table);
    v({"snapshots", "-", "checksum of the .h5 file as the run wrote it", Kind::setting}, s.snapshots);
  }

  // Hashes of a scene's values and of the contents of its files, and of the text of scene.prm (FNV-1a, 64 bits, hexadecimal).
  // Empty: not known.
  struct SceneHashes
  {
    std::string sample, continuum, comparison, text, law_library;
  };

  template <class Hashes, class Visitor, std::enable_if_t<std::is_same_v<std::remove_const_t<Hashes>, SceneHashes>, int> = 0>
  void list_numbers(Hashes &h, Visitor &v)
  {
    v({"sample", "-", "hash of sample, loading and discrete", Kind::setting}, h.sample);
    v({"continuum", "-", "hash of these and of continuum", Kind::setting}, h.continuum);
    v({"comparison", "-", "hash of these and of comparison, without seed and margins", Kind::setting}, h.comparison);
    v({"text", "-", "hash of scene.prm as the run wrote it", Kind::setting}, h.text);
    v({"law_library", "-", "hash of the library of law = library; empty: another law", Kind::setting}, h.law_library);
  }

  // The contents of provenance.json.
  struct RunFacts
  {
    DiscreteFacts          discrete;
    ContinuumFacts         continuum, continuum_coarse;
    FileSums               discrete_files, continuum_files, continuum_coarse_files, comparison_files, ensemble_files;
    SceneHashes            hashes;
    std::vector<PhaseCost> phases;
  };
} // namespace diptych::coupling
