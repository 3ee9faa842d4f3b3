// diptych: what a run will take of the machine
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/run_room.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    // Measured: peak memory of `diptych discrete` with 10000 and 40000 grains and of `diptych continuum` on rectangles of 2400 to
    // 153600 elements, files of moreau_quick.
    constexpr double memory_of_a_grain = 4e3, memory_of_an_element = 4e4;
    constexpr double bytes_of_a_grain = 1e3, bytes_of_an_element = 1e3; // in one stage
    constexpr double memory_of_a_row = 3.3e3, bytes_of_a_row = 620;     // of discrete.csv, 10000 and 100000 of them

    std::string gigabytes(const double bytes)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.3g GB", bytes / 1e9);
      return text;
    }

    std::string counted(const double n)
    {
      return std::to_string(std::lround(std::min(n, 1e15)));
    }

    // Of the sample, by what the scene says of it; 0: its file does.
    double n_grains(const discrete::SampleOptions &o)
    {
      return o.file.empty() ? discrete::expected_grains(o) : 0;
    }

    double n_elements(const Scene &scene)
    {
      const continuum::Options &o    = scene.continuum;
      const double              edge = o.element_size * scene.sample.mean_diameter, area = edge * edge;
      if (o.mesh.kind == continuum::MeshOption::Kind::rectangle)
        return o.rectangle_width * o.rectangle_height / area;
      if (o.mesh.kind == continuum::MeshOption::Kind::file)
        return 0;
      return n_grains(scene.sample) * M_PI / 4 / scene.sample.solid_fraction / (o.element_size * o.element_size);
    }

    double n_rows(const Scene &scene, const RunParts &parts)
    {
      return parts.grains ? discrete::fewest_rows(scene.sample, discrete_loading(scene.loading), scene.discrete) : 0;
    }

    // The nearest folder above that is there.
    fs::path standing(fs::path path)
    {
      std::error_code unreadable;
      for (path = fs::absolute(path); !fs::exists(path, unreadable) && path.has_relative_path(); path = path.parent_path())
        {}
      return path;
    }
  } // namespace

  RunRoom expected_room(const Scene &scene, const RunParts &parts)
  {
    const double grains = n_grains(scene.sample), elements = parts.continuum ? n_elements(scene) : 0;
    const double stages = double(coupling::stages(scene.loading).size()) + 1;
    const double rows = n_rows(scene, parts), loaded = parts.grains ? grains : 0;
    return {memory_of_a_grain * grains + memory_of_an_element * elements + memory_of_a_row * rows,
            parts.samples * (stages * (bytes_of_a_grain * loaded + bytes_of_an_element * elements) + bytes_of_a_row * rows)};
  }

  void demand_room(const Scene &scene, const RunParts &parts)
  {
    const RunRoom     room     = expected_room(scene, parts);
    const double      memory   = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    const double      elements = parts.continuum ? n_elements(scene) : 0;
    const std::string asked    = "the scene asks for " + counted(n_grains(scene.sample)) + " grains, " + counted(elements) +
                              " elements and " + counted(n_rows(scene, parts)) + " rows of discrete.csv, ";
    const std::string keys = " (sample/grains, continuum/element_size, discrete/history_interval); nothing was written";
    if (room.memory > memory)
      throw std::runtime_error(asked + "which take about " + gigabytes(room.memory) + " of memory; this machine has " +
                               gigabytes(memory) + keys);
    std::error_code      unknown;
    const fs::space_info disk = fs::space(standing(scene.output.directory), unknown);
    if (!unknown && room.disk > double(disk.available))
      throw std::runtime_error(asked + "which take about " + gigabytes(room.disk) + " of disk; " + scene.output.directory +
                               " has " + gigabytes(double(disk.available)) + keys);
  }
} // namespace diptych::coupling
