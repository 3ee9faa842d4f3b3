// diptych: the names of the files in a result folder
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdio>
#include <string>

namespace diptych::coupling
{
  // discrete_csv("results/quick") is results/quick/discrete.csv
  struct FileName
  {
    const char *name;
    std::string operator()(const std::string &folder) const { return folder + "/" + name; }
  };
  inline constexpr FileName scene_prm{"scene.prm"}; // the resolved scene
  inline constexpr FileName import_json{"import.json"};
  inline constexpr FileName discrete_csv{"discrete.csv"};
  inline constexpr FileName discrete_h5{"discrete.h5"};
  inline constexpr FileName grain_checkpoint{"checkpoint.h5"};
  inline constexpr FileName continuum_csv{"continuum.csv"};
  inline constexpr FileName continuum_h5{"continuum.h5"};
  inline constexpr FileName continuum_checkpoint{"continuum_checkpoint.h5"};
  inline constexpr FileName sample_msh{"sample.msh"};
  inline constexpr FileName coarse_folder{"coarse"}; // the continuum on the coarse mesh
  inline constexpr FileName material_point_csv{"material_point.csv"};
  inline constexpr FileName comparison_json{"comparison.json"};
  inline constexpr FileName comparison_csv{"comparison.csv"};
  inline constexpr FileName summary_csv{"summary.csv"}; // the numbers that a user asks for first
  inline constexpr FileName comparison_h5{"comparison.h5"};
  inline constexpr FileName fields_series{"fields"}; // fields on the continuum's mesh: .pvd and a folder of stages
  inline constexpr FileName report_html{"report.html"};

  // A stored contact problem; stages are counted from 1.
  inline std::string contact_problem(const std::string &folder, const int stage)
  {
    char name[32];
    std::snprintf(name, sizeof name, "/problem_%04d.h5", stage);
    return folder + name;
  }
} // namespace diptych::coupling
