// diptych: estimate of the memory, disk space and CPU time of a run
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/resource_estimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include <sys/resource.h>
#include <unistd.h>

#include "coupling/processes/progress.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    std::string bytes(const double n)
    {
      char text[32];
      std::snprintf(text, sizeof text, n < 1e9 ? "%.3g MB" : "%.3g GB", n < 1e9 ? n / 1e6 : n / 1e9);
      return text;
    }

    void require(const double needed, const double present, const std::string &of)
    {
      if (needed / 2 > present)
        throw std::runtime_error("the run takes about " + bytes(needed) + of + ", and there are " + bytes(present) +
                                 " (sample/grains, continuum/element_size, discrete/history_interval)");
    }

    double elements_of(const continuum::Options &o, const discrete::SampleOptions &sample, const double grains)
    {
      const double size = o.element_size * (o.refinement == continuum::Refinement::adaptive ? std::exp2(o.refinement_levels) : 1);
      if (o.mesh.kind == continuum::MeshOption::Kind::rectangle)
        return o.rectangle_width * o.rectangle_height / std::pow(size * sample.mean_diameter, 2);
      return o.mesh.kind == continuum::MeshOption::Kind::file ? 0 : grains * M_PI / 4 / sample.solid_fraction / (size * size);
    }
  } // namespace

  // Factors measured on a 2.6 GHz EPYC: moreau_1997, moreau_quick with 100 to 40000 grains, dense_biaxial, both with springs, and
  // rectangles of 2400 to 153600 elements. The CPU time lies within a factor of two.
  ResourceEstimate estimate_resources(const Scene &scene, const RunParts &parts)
  {
    const discrete::Loading loading    = discrete_loading(scene.loading);
    const discrete::Method  method     = scene.discrete.method.method;
    const bool              springs    = parts.grains && method == discrete::Method::penalty;
    const bool              has_file   = !scene.sample.file.empty() || method == discrete::Method::imported;
    const double            grains     = has_file ? 0 : discrete::expected_grains(scene.sample);
    const double            steps      = parts.grains ? discrete::expected_steps(scene.sample, loading, scene.discrete) : 0;
    const double            rows       = parts.grains ? discrete::expected_rows(scene.sample, loading, scene.discrete) : 0;
    const double            elements   = parts.continuum ? elements_of(scene.continuum, scene.sample, grains) : 0;
    double                  load_steps = 0, before = 0;
    for (std::size_t k = 0; parts.continuum && k < loading.stages.size(); before = loading.stages[k++])
      load_steps += std::ceil((loading.stages[k] - before) / scene.continuum.max_step - 1e-9);

    // Each further process repeats what is not a sweep: 0.8 of the preparation, and 0.2 of the loading of 64000 grains.
    const double bodies = (parts.grains ? grains : 0) + elements, n = parts.samples, others = parts.processes - 1;
    const double cpu_s  = n * (grains * ((springs ? 1.8e-3 : 6e-4) * (1 + 0.8 * others) +
                                        steps * (springs ? 2.5e-7 : 2e-6) * (1 + (springs ? 1 : 0.2) * others)) +
                              load_steps * elements * 9e-5);
    const double memory = 4e3 * grains + 4e4 * elements + 3.3e3 * rows;
    const double disk   = 2e6 + n * (2e3 * bodies * double(loading.stages.size() + 1) + 1.2e3 * rows);

    std::vector<std::string> counts;
    for (const auto &[number, name] : {std::pair{grains, " grains"}, std::pair{steps, " steps"}, std::pair{elements, " elements"},
                                       std::pair{load_steps, " load steps"}})
      if (number > 0)
        counts.push_back(std::to_string(std::lround(std::min(std::ceil(number), 1e15))) + name);
    return {memory, disk, cpu_s,
            (n > 1 ? std::to_string(parts.samples) + " samples, each of " : "") +
              (counts.empty() ? "size unknown before its files are read" : discrete::listed(counts)) + "; about " +
              bytes(memory) + " of memory" + (others > 0 ? " on each of " + std::to_string(parts.processes) + " processes" : "") +
              ", " + bytes(disk) + " of files, " + duration_text(cpu_s / 2) + " to " + duration_text(2 * cpu_s) + " of CPU time"};
  }

  void announce_resources(const CommandLine &line, const Scene &scene, const RunParts &parts)
  {
    if (line.resume)
      return;
    const ResourceEstimate estimate = estimate_resources(scene, parts);
    rlimit                 limit{};
    getrlimit(RLIMIT_AS, &limit); // without a limit: the largest number
    const double machine = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    require(estimate.memory, std::min(machine, double(limit.rlim_cur)), " of memory");
    std::error_code       none;
    std::filesystem::path folder = std::filesystem::absolute(scene.output.directory);
    while (!std::filesystem::exists(folder, none) && folder.has_relative_path())
      folder = folder.parent_path();
    if (const auto disk = std::filesystem::space(folder, none); !none)
      require(estimate.disk, double(disk.available), " of files");
    say(line, scene.name + ": " + estimate.text);
  }
} // namespace diptych::coupling
