// diptych: estimate of the memory, disk space and CPU time of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/resource_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

#include "coupling/processes/progress.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    // Measured: peak memory of `diptych discrete` with 10000 and 40000 grains and of `diptych continuum` on rectangles of 2400 to
    // 153600 elements, files of moreau_quick.
    constexpr double memory_of_a_grain = 4e3, memory_of_an_element = 4e4;
    constexpr double bytes_of_a_grain = 1e3, bytes_of_an_element = 1e3; // in one stage
    constexpr double ways_of_keeping = 2, disk_of_files = 2e6;
    constexpr double memory_of_a_row = 3.3e3, bytes_of_a_row = 620; // of discrete.csv, 10000 and 100000 of them

    // Measured, CPU seconds of a 2.6 GHz EPYC: moreau_1997, moreau_quick with 100 to 8000 grains at inertial numbers of 2e-4 and
    // 1e-3, dense_biaxial at 1e-4 and 1e-3, its springs and those of moreau_quick; elements of 1 to 2.5 d.
    constexpr CpuRange preparation_of_a_grain{4e-4, 8e-4}, spring_preparation_of_a_grain{1.5e-3, 2.1e-3}; // whole
    constexpr CpuRange step_of_a_grain{9e-7, 4e-6}, spring_step_of_a_grain{1.8e-7, 3.6e-7}, step_of_an_element{4.5e-5, 1e-4};

    CpuRange operator*(const double factor, const CpuRange &range)
    {
      return {factor * range.low, factor * range.high};
    }

    CpuRange operator+(const CpuRange &a, const CpuRange &b)
    {
      return {a.low + b.low, a.high + b.high};
    }

    std::string bytes(const double n)
    {
      char text[32];
      std::snprintf(text, sizeof text, n < 1e9 ? "%.3g MB" : "%.3g GB", n < 1e9 ? n / 1e6 : n / 1e9);
      return text;
    }

    std::string counted(const double n)
    {
      return std::to_string(std::lround(std::min(n, 1e15)));
    }

    // Of the sample, by what the scene says of it; 0: its file does.
    double n_grains(const Scene &scene)
    {
      const bool of_file = !scene.sample.file.empty() || scene.discrete.method.method == discrete::Method::imported;
      return of_file ? 0 : discrete::expected_grains(scene.sample);
    }

    double n_elements(const Scene &scene, const double element_size)
    {
      const continuum::Options &o    = scene.continuum;
      const double              edge = element_size * scene.sample.mean_diameter, area = edge * edge;
      if (o.mesh.kind == continuum::MeshOption::Kind::rectangle)
        return o.rectangle_width * o.rectangle_height / area;
      if (o.mesh.kind == continuum::MeshOption::Kind::file)
        return 0;
      return n_grains(scene) * M_PI / 4 / scene.sample.solid_fraction / (element_size * element_size);
    }

    double n_elements(const Scene &scene, const RunParts &parts)
    {
      return parts.continuum ? n_elements(scene, scene.continuum.element_size) : 0;
    }

    double n_rows(const Scene &scene, const RunParts &parts)
    {
      return parts.grains ? discrete::expected_rows(scene.sample, discrete_loading(scene.loading), scene.discrete) : 0;
    }

    double n_steps(const Scene &scene, const RunParts &parts)
    {
      return parts.grains ? discrete::expected_steps(scene.sample, discrete_loading(scene.loading), scene.discrete) : 0;
    }

    // Without cut-backs; every stage is met.
    double n_load_steps(const Scene &scene, const RunParts &parts)
    {
      double before = 0, steps = 0;
      for (const double stage : stages(scene.loading))
        {
          steps += std::ceil((stage - before) / scene.continuum.max_step - 1e-9);
          before = stage;
        }
      return parts.continuum ? steps : 0;
    }

    // Of the two panels; both meshes.
    CpuRange cpu_seconds(const Scene &scene, const RunParts &parts, const double steps, const double load_steps)
    {
      const bool   are_made = parts.grains || scene.continuum.mesh.kind == continuum::MeshOption::Kind::outline;
      const double grains = are_made ? n_grains(scene) : 0, coarse = scene.comparison.coarse_element_size;
      const double elements = n_elements(scene, parts) + (parts.continuum && coarse > 0 ? n_elements(scene, coarse) : 0);
      const bool   springs  = scene.discrete.method.method == discrete::Method::penalty;
      return grains * (springs && parts.grains ? spring_preparation_of_a_grain : preparation_of_a_grain) +
             (steps * grains) * (springs ? spring_step_of_a_grain : step_of_a_grain) +
             (load_steps * elements) * step_of_an_element;
    }

    // Of the machine, or what this process may have of it (ulimit -v) besides what the continuum's libraries map (main.cc).
    double memory_of_process(const RunParts &parts)
    {
      const double libraries = parts.continuum ? 464e6 : 0;
      const double machine   = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
      rlimit       limit{};
      const bool   is_limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
      return is_limited ? std::min(machine, double(limit.rlim_cur) - libraries) : machine;
    }

    bool is_adaptive(const Scene &scene, const RunParts &parts)
    {
      return parts.continuum && scene.continuum.refinement == continuum::Refinement::adaptive &&
             scene.continuum.mesh.kind != continuum::MeshOption::Kind::file;
    }

    // With the meshes on which the run begins; refinement = adaptive divides their elements where plastic strain gathers.
    Scene with_first_meshes(Scene scene, const RunParts &parts)
    {
      if (!is_adaptive(scene, parts))
        return scene;
      const double larger = std::exp2(scene.continuum.refinement_levels);
      scene.continuum.element_size *= larger;
      scene.comparison.coarse_element_size *= larger;
      scene.continuum.refinement = continuum::Refinement::uniform;
      return scene;
    }

    // The nearest folder above that is there.
    fs::path standing(fs::path path)
    {
      std::error_code unreadable;
      for (path = fs::absolute(path); !fs::exists(path, unreadable) && path.has_relative_path(); path = path.parent_path())
        {}
      return path;
    }

    double bytes_in(const std::string &directory)
    {
      double          sum = 0;
      std::error_code none;
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(directory, none))
        sum += entry.is_regular_file(none) ? double(entry.file_size(none)) : 0;
      return sum;
    }
  } // namespace

  ResourceEstimate estimate_resources(const Scene &scene, const RunParts &parts)
  {
    const double     grains = n_grains(scene), elements = n_elements(scene, parts);
    const double     n_stages = double(stages(scene.loading).size()) + 1;
    const double     rows = n_rows(scene, parts), loaded = parts.grains ? grains : 0;
    ResourceEstimate estimate;
    estimate.steps      = n_steps(scene, parts);
    estimate.load_steps = n_load_steps(scene, parts);
    estimate.memory     = memory_of_a_grain * grains + memory_of_an_element * elements + memory_of_a_row * rows;
    // At the end the stages stand one by one and in the whole file, too; a megabyte is what every file is given at first.
    estimate.disk = disk_of_files +
                    ways_of_keeping * parts.samples *
                      (n_stages * (bytes_of_a_grain * loaded + bytes_of_an_element * elements) + bytes_of_a_row * rows);
    const auto seconds = [&](const Scene &of) {
      return double(parts.samples) * cpu_seconds(of, parts, estimate.steps, estimate.load_steps);
    };
    estimate.cpu_s = {seconds(with_first_meshes(scene, parts)).low, seconds(scene).high};
    return estimate;
  }

  void require_resources(const Scene &asked_scene, const RunParts &parts, const bool resume)
  {
    const Scene      scene    = with_first_meshes(asked_scene, parts);
    ResourceEstimate estimate = estimate_resources(scene, parts);
    if (resume)
      estimate.disk -= bytes_in(scene.output.directory);
    const double      memory = memory_of_process(parts);
    const std::string asked = "the scene asks for " + counted(n_grains(scene)) + " grains, " + counted(n_elements(scene, parts)) +
                              " elements and " + counted(n_rows(scene, parts)) + " rows of discrete.csv, ";
    const std::string keys = " (sample/grains, continuum/element_size, discrete/history_interval)";
    if (estimate.memory > memory)
      throw std::runtime_error(asked + "which take about " + bytes(estimate.memory) + " of memory; this process may have " +
                               bytes(memory) + keys);
    std::error_code      unknown;
    const fs::space_info disk = fs::space(standing(scene.output.directory), unknown);
    if (!unknown && estimate.disk > double(disk.available))
      throw std::runtime_error(asked + "which take about " + bytes(estimate.disk) + " of disk; the disk of " +
                               scene.output.directory + " has " + bytes(double(disk.available)) + " free" + keys);
  }

  void announce_resources(const CommandLine &line, const Scene &scene, const RunParts &parts)
  {
    require_resources(scene, parts, line.resume);
    if (!line.resume)
      say(line, scene.name + ": " + resource_text(scene, parts));
  }

  std::string resource_text(const Scene &scene, const RunParts &parts)
  {
    const ResourceEstimate   estimate = estimate_resources(scene, parts);
    std::vector<std::string> of_each, in_all;
    const auto               add = [&](const double number, const std::string &what) {
      if (number > 0)
        of_each.push_back(counted(std::ceil(number)) + " " + what);
    };
    add(n_grains(scene), "grains");
    add(estimate.steps, "steps");
    add(n_elements(scene, parts), is_adaptive(scene, parts) ? "elements at most" : "elements");
    add(estimate.load_steps, "load steps");
    if (estimate.memory > 0)
      in_all.push_back(bytes(estimate.memory) + " of memory" + (parts.samples > 1 ? " a process" : ""));
    if (estimate.disk > 0)
      in_all.push_back(bytes(estimate.disk) + " of files");
    if (estimate.cpu_s.low > 0)
      in_all.push_back((estimate.cpu_s.high < 1
                          ? "less than 1 s"
                          : duration_text(estimate.cpu_s.low) + " to " + duration_text(estimate.cpu_s.high)) +
                       " of CPU time");
    const auto known = [](const std::vector<std::string> &items) {
      return items.empty() ? "size unknown before its files are read" : discrete::listed(items);
    };
    return (parts.samples > 1 ? std::to_string(parts.samples) + " samples, each of " : "") + known(of_each) +
           (is_adaptive(scene, parts) ? "; at most " : "; about ") + known(in_all);
  }
} // namespace diptych::coupling
