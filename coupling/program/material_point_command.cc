// diptych: the continuum's law on one point
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <iostream>
#include <sstream>

#include "coupling/program/commands.h"
#include "continuum/laws/material_point.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/table_file.h"

namespace diptych::coupling
{
  namespace
  {
    std::string summary(const continuum::MaterialPointReport &report)
    {
      const auto         peak = std::max_element(report.rows.begin(), report.rows.end(),
                                                 [](const auto &a, const auto &b) { return a.stress_ratio < b.stress_ratio; });
      std::ostringstream text;
      text.precision(6);
      text << "peak stress ratio " << peak->stress_ratio << " at "
           << text_of(continuum::LoadingVariable::axial_strain, peak->axial_strain) << ", " << report.rows.back().stress_ratio
           << " at " << text_of(continuum::LoadingVariable::axial_strain, report.axial_strain);
      return text.str();
    }

    void write(const continuum::MaterialPointReport &report, const std::string &csv)
    {
      discrete::TableFile table(csv, discrete::csv_header<continuum::MaterialPointRow>());
      for (const continuum::MaterialPointRow &row : report.rows)
        table.add(discrete::csv_line(row));
      table.flush();
    }
  } // namespace

  int run_material_point(const CommandLine &line)
  {
    const Scene                        scene = scene_of(line);
    const continuum::Law               law   = continuum::make_law(uniform_law(scene.continuum.law), scene.continuum.material,
                                                                   continuum_units(scene));
    const continuum::MaterialPointPath path{scene.loading.pressure, scene.loading.axial_strain, scene.continuum.initial_step};
    try
      {
        continuum::validate(path);
      }
    catch (const std::invalid_argument &error)
      {
        throw SceneError(line.target + ": loading/pressure, loading/axial_strain or continuum/initial_step: " + error.what());
      }
    return writing(scene.output.directory, [&](FolderLock &lock) {
      ResultFolder(scene).open(lock, opening_of(line, true));
      const PhaseTimer                     timer("material_point");
      const continuum::MaterialPointReport report = continuum::drive_material_point(law, path);
      const std::string                    csv    = material_point_csv(scene.output.directory);
      write(report, csv);
      record_phases(scene.output.directory, {scene.name, {scene.sample.seed}, line.text}, {timer.stop()});
      std::cout << summary(report) << std::endl;
      say(line, "material point: " + csv);
      if (report.status == continuum::MaterialPointStatus::finished)
        return int(done);
      std::cerr << "material point: " << report.message << ", kept in " << csv << std::endl;
      return int(not_converged);
    });
  }
} // namespace diptych::coupling
