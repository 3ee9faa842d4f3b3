// diptych: the names of the files in a result folder
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdio>
#include <string>

namespace diptych::coupling
{
  inline std::string scene_prm(const std::string &folder) // the resolved scene
  {
    return folder + "/scene.prm";
  }
  inline std::string import_json(const std::string &folder)
  {
    return folder + "/import.json";
  }
  inline std::string discrete_csv(const std::string &folder)
  {
    return folder + "/discrete.csv";
  }
  inline std::string discrete_h5(const std::string &folder)
  {
    return folder + "/discrete.h5";
  }
  inline std::string grain_checkpoint(const std::string &folder)
  {
    return folder + "/checkpoint.h5";
  }
  // A stored contact problem; stages are counted from 1.
  inline std::string contact_problem(const std::string &folder, const int stage)
  {
    char name[32];
    std::snprintf(name, sizeof name, "/problem_%04d.h5", stage);
    return folder + name;
  }
  inline std::string continuum_csv(const std::string &folder)
  {
    return folder + "/continuum.csv";
  }
  inline std::string continuum_h5(const std::string &folder)
  {
    return folder + "/continuum.h5";
  }
  inline std::string continuum_checkpoint(const std::string &folder)
  {
    return folder + "/continuum_checkpoint.h5";
  }
  inline std::string sample_msh(const std::string &folder)
  {
    return folder + "/sample.msh";
  }
  inline std::string coarse_folder(const std::string &folder) // the continuum on the coarse mesh
  {
    return folder + "/coarse";
  }
  inline std::string material_point_csv(const std::string &folder)
  {
    return folder + "/material_point.csv";
  }
  inline std::string comparison_json(const std::string &folder)
  {
    return folder + "/comparison.json";
  }
  inline std::string comparison_csv(const std::string &folder)
  {
    return folder + "/comparison.csv";
  }
  inline std::string summary_csv(const std::string &folder) // the numbers that a user asks for first
  {
    return folder + "/summary.csv";
  }
  inline std::string comparison_h5(const std::string &folder)
  {
    return folder + "/comparison.h5";
  }
  inline std::string fields_series(const std::string &folder) // fields on the continuum's mesh: .pvd and a folder of stages
  {
    return folder + "/fields";
  }
  inline std::string report_html(const std::string &folder)
  {
    return folder + "/report.html";
  }
} // namespace diptych::coupling
