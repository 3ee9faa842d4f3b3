// diptych: the continuum's law on one point
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <iostream>
#include <sstream>

#include "coupling/program/commands.h"
#include "continuum/laws/material_point.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/path_warning.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"
#include "coupling/store/provenance.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/csv_file.h"
#include "discrete/files/table_file.h"
#include "discrete/files/words.h"
#include "discrete/files/wrong_keys.h"

namespace diptych::coupling
{
  namespace
  {
    using continuum::MaterialPointRow;

    // Refined to the steps of the scene.
    continuum::PointPath path_of_table(const std::string &file, const Scene &scene)
    {
      const continuum::PointPath path = read_path_table(file, scene.loading.pressure, scene.continuum.k0);
      if (path.progress.empty() && scene.continuum.material.viscosity > 0 && continuum::traits(scene.continuum.law).is_plastic)
        throw SceneError(file +
                         ", header line: column 'progress' is missing, which continuum/viscosity needs; give strain or time of "
                         "each row");
      try
        {
          return continuum::refined(path, scene.continuum.initial_step);
        }
      catch (const continuum::WrongPath &wrong)
        {
          throw SceneError(file + ", row " + std::to_string(wrong.row + 1) + ": " + wrong.what());
        }
    }

    continuum::PointPath path_of(const CommandLine &line, const Scene &scene)
    {
      const auto name = continuum::value_of<continuum::NamedPath>(line.path);
      if (!name)
        return path_of_table(line.path, scene);
      try
        {
          return named_path_of(
            *name, {scene.loading.pressure, scene.loading.axial_strain, scene.continuum.initial_step, scene.continuum.k0});
        }
      catch (const discrete::WrongKeys &error)
        {
          throw SceneError(line.target + ": " + error.what());
        }
    }

    std::string summary(const CommandLine &line, const std::vector<MaterialPointRow> &rows)
    {
      const auto name = continuum::value_of<continuum::NamedPath>(line.path);
      const auto at   = [&](const MaterialPointRow &row) {
        if (!name)
          return "progress " + discrete::exact_text(discrete::tidy(row.progress));
        const bool shears = *name == continuum::NamedPath::simple_shear;
        return text_of(shears ? continuum::LoadingVariable::shear_strain : continuum::LoadingVariable::axial_strain,
                       row.progress);
      };
      const auto         ratio = [](const MaterialPointRow &row) { return row.syy + row.sxx > 0 ? row.stress_ratio : -1; };
      const auto         peak  = std::max_element(rows.begin(), rows.end(),
                                                  [&](const auto &a, const auto &b) { return ratio(a) < ratio(b); });
      std::ostringstream text;
      text.precision(6);
      text << "peak stress ratio " << peak->stress_ratio << " (friction angle "
           << std::asin(std::min(1., peak->stress_ratio)) * 180 / M_PI << " degrees) at " << at(*peak) << ", ";
      if (ratio(rows.back()) < 0)
        text << "mean stress " << 0.5 * (rows.back().sxx + rows.back().syy) << " (tension)";
      else
        text << rows.back().stress_ratio;
      text << " at " << at(rows.back());
      const auto outside = std::find_if(rows.begin(), rows.end(),
                                        [](const auto &row) { return row.verdict == continuum::PointVerdict::zz_outside; });
      if (outside != rows.end())
        text << "\n  from " << at(*outside)
             << " on sigma_zz is beyond the yield surface, which this law ignores: its answer is not "
             << "exact; check with continuum/law = cosserat_drucker_prager";
      return text.str();
    }

    void write(const continuum::MaterialPointReport &report, const std::string &csv)
    {
      std::string header = discrete::csv_header<MaterialPointRow>();
      for (const std::string &name : report.variables)
        header += "," + name;
      discrete::TableFile table(csv, header);
      for (const MaterialPointRow &row : report.rows)
        {
          std::string line = discrete::csv_line(row);
          for (const double value : row.variables)
            line += "," + discrete::exact_text(value);
          table.add(line);
        }
      table.flush();
    }
  } // namespace

  int run_material_point(const CommandLine &given, const Scene &scene)
  {
    CommandLine line = given;
    if (line.path.empty())
      line.path = scene.loading.mode == discrete::LoadingMode::path ? scene.loading.path.text : "drained";
    const continuum::PointPath path = path_of(line, scene);
    if (const std::string warning = reversal_warning(scene.continuum, path.values); !warning.empty())
      warn(line.path + ": " + warning);
    return writing(scene.output.directory, [&](FolderLock &lock) {
      Opening opening = opening_of(line, true);
      if (!continuum::value_of<continuum::NamedPath>(line.path))
        opening.inputs.emplace_back("--path", line.path);
      ResultFolder(scene).open(lock, opening);
      const PhaseTimer                     timer("material_point");
      const continuum::MaterialPointReport report = continuum::drive_material_point(scene.continuum.law, scene.continuum.material,
                                                                                    continuum_units(scene), path);
      const std::string                    csv    = material_point_csv(scene.output.directory);
      write(report, csv);
      record_phases(scene.output.directory, {scene.name, {scene.sample.seed}, line.text}, {timer.stop()});
      std::cout << summary(line, report.rows) << std::endl;
      say(line, "material point: " + csv);
      if (report.status == continuum::MaterialPointStatus::finished)
        return int(done);
      std::cerr << "material point: " << report.message << ", kept in " << csv << std::endl;
      return int(not_converged);
    });
  }
} // namespace diptych::coupling
