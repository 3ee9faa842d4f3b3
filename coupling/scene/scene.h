// diptych: the scene, every parameter of one comparison
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/options.h"
#include "coupling/averaging/averaging_options.h"
#include "coupling/bands/band_options.h"
#include "coupling/probes/probe_options.h"
#include "coupling/scene/keys.h"
#include "coupling/statistics/equivalence_margins.h"
#include "discrete/panel/options.h"

namespace diptych::coupling
{
  struct LoadingOptions
  {
    double pressure                 = 1;
    double inertial_number          = 3e-5;
    double horizontal_over_vertical = 1;
    double axial_strain             = 0.04;
    double stage_strain             = 0.005;
    bool   affine_start             = true;

    discrete::LoadingMode mode            = discrete::LoadingMode::descent;
    double                strain_rate     = 0;
    double                normal_pressure = 1;
    double                duration        = 10;
    double                stage_time      = 1;
    std::vector<double>   stages          = {};
    PathOption            path            = {};
  };

  template <class Visitor> void visit_parameters(LoadingOptions &o, Visitor &&visitor)
  {
    visitor("pressure", o.pressure, "pressure", {1e-12, 1e15}, "P of the lateral action; also the initial isotropic stress");
    visitor("inertial_number", o.inertial_number, "-", {1e-9, 1.},
            "I = strain rate d sqrt(rho/P): fixes the speed of the upper platen in the discrete panel");
    visitor("horizontal_over_vertical", o.horizontal_over_vertical, "-", {-10., 10.},
            "travel of the upper platen to the right per descent: 1 is 45 degrees, 0 vertical");
    visitor(
      "axial_strain", o.axial_strain, "-", {1e-6, 1e4},
      "at the end: axial strain, descent of the upper platen / initial height (modes shear and plane_shear: shear strain, its "
      "travel / initial height; mode path: the progress of the path)");
    visitor("stage_strain", o.stage_strain, "-", {1e-6, 1e4}, "strain between two stages, at which both panels are compared");
    visitor("affine_start", o.affine_start, "-",
            "grains start with the affine velocity field between the platens, not at rest (an impulsive start)");
    visitor(
      "mode", o.mode, "-",
      "descent: the upper platen descends and moves sideways; shear: it moves sideways at constant height; plane_shear: it moves "
      "sideways under normal_pressure x width; time: the walls move as discrete/drive_* say, for `duration`; path: a cell "
      "(discrete/lateral = cell) follows strains and stresses of `path`");
    visitor("strain_rate", o.strain_rate, "1/time", {0., 1e12},
            "strain rate of the loading; if not 0, it replaces inertial_number");
    visitor("normal_pressure", o.normal_pressure, "pressure", {0., 1e15},
            "plane_shear: pressure on the upper platen, which is free to rise and sink");
    visitor("duration", o.duration, "time", {1e-12, 1e12}, "mode time: duration of the loading");
    visitor("stage_time", o.stage_time, "time", {1e-12, 1e12}, "mode time: time between two stages");
    visitor(
      "stages", o.stages, "strain (mode time: time)", {1e-12, 1e12},
      "list of all stages, ascending, which replaces equal stages; the last one is the end (axial_strain, mode time: duration)");
    visitor(
      "path", o.path, "-",
      "mode path: drained, constant_volume, constant_mean_stress or simple_shear up to axial_strain, or a CSV file. Three of "
      "its columns are strains or stresses, as for `diptych material-point --path`; progress is optional");
  }

  struct ComparisonOptions
  {
    std::vector<double> window_edges        = {0, 0.01, 0.02, 0.04};
    double              coarse_element_size = 4;
    double              averaging_strain    = 0.005;
    BandOptions         band;
    ProbeOptions        probes;
    EquivalenceMargins  margins;
    AveragingOptions    averaging;
    double              grid_size = 3;
    std::string         parameters_from;
  };

  template <class Visitor> void visit_parameters(ComparisonOptions &o, Visitor &&visitor)
  {
    visitor(
      "window_edges", o.window_edges, "strain (mode time: time)", {0., 1e12},
      "edges of the windows over which displacement increments are compared; each must be a stage (mode time: a time) or 0");
    visitor("coarse_element_size", o.coarse_element_size, "mean diameters", {0., 100.},
            "element size, at least 0.1, of a second continuum run that shows the effect of the mesh; 0: no such run. Twice "
            "element_size costs about a quarter of the first run");
    visitor("averaging_strain", o.averaging_strain, "strain", {1e-9, 0.5},
            "last part of a stage over which stress ratio and platen forces are averaged, in both panels; mode time: the whole "
            "stage");
    visit_parameters(o.band, visitor);
    visit_parameters(o.probes, visitor);
    visit_parameters(o.margins, visitor);
    visit_parameters(o.averaging, visitor);
    visitor("parameters_from", o.parameters_from, "-",
            "origin of the continuum's parameters (data of the fit, or predicted); the report shows it beside every comparison");
    visitor("grid_size", o.grid_size, "mean diameters", {0.5, 1000.},
            "approximate cell size of the regular grid; all fields are given on this grid and on the continuum's mesh");
  }

  struct OutputOptions
  {
    std::string directory;
    bool        report = true;
  };

  template <class Visitor> void visit_parameters(OutputOptions &o, Visitor &&visitor)
  {
    visitor("directory", o.directory, "-", "result folder; empty: results/<scene name>");
    visitor("report", o.report, "-", "draw report.html at the end of a run");
  }

  struct Scene
  {
    std::string             name; // name of the file, or of its folder if the file is called scene.*
    discrete::SampleOptions sample;
    LoadingOptions          loading;
    discrete::Options       discrete;
    continuum::Options      continuum;
    ComparisonOptions       comparison;
    OutputOptions           output;

    std::string              method_reason; // of discrete/method = auto; the resolved scene states it
    std::vector<std::string> warnings;      // from reading it: unused keys, doubtful values
  };

  // The sections of a scene, in their order: function(name, options). A new section needs an entry only here.
  template <class AnyScene, class Function> void for_each_section(AnyScene &scene, Function &&function)
  {
    function("sample", scene.sample);
    function("loading", scene.loading);
    function("discrete", scene.discrete);
    function("continuum", scene.continuum);
    function("comparison", scene.comparison);
    function("output", scene.output);
  }

  // Every key with its value, section by section.
  std::vector<KeyDescription> keys_of(Scene scene);

  // Progress (strain; mode time: time) at the end of each stage, ascending. `discrete_loading()` contains the same values.
  std::vector<double> stages(const LoadingOptions &loading);
  discrete::Loading   discrete_loading(const LoadingOptions &loading);

  // Pressure and length by which the keys of the continuum's law are multiplied.
  continuum::Units continuum_units(const Scene &scene);

  // True if only chance tells left from right: vertical descent, no horizontal gravity, no wall with its own drive.
  bool is_mirror_symmetric(const Scene &scene);

  // I = strain rate d sqrt(rho/P), from loading/inertial_number or strain_rate.
  double inertial_number(const Scene &scene);

  // The last part of a stage over which stress ratio and platen forces are averaged, in the unit of the stages.
  double averaging_width(const Scene &scene);
} // namespace diptych::coupling
