// diptych: given grains between platens and sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discrete/samples/sample_file.h"
#include "discrete/samples/sample_options.h"

namespace diptych::discrete
{
  // Sets walls and periodicity of a box from the origin on; free sides have walls until set_sides().
  void enclose(State &state, const LateralCondition &lateral, const Eigen::Vector2d &size);

  // Default inertia of a wall or cell width that moves under a force: sqrt(number of grains) x mean grain mass.
  double default_wall_mass(const Grains &grains);

  void set_sides(State &state, const PreparationSetting &setting);

  struct FileSample
  {
    State                      state;
    std::optional<StoredStage> stage;
  };

  // Places platens and sides at the given positions. Without these it takes the positions of a snapshot, or positions at which
  // they touch the grains. Throws std::invalid_argument with grains, places and keys.
  FileSample place_grains(const SampleOptions &options, const PreparationSetting &preparation, GrainFile file);

  // Reads the file of `sample/file` and calls place_grains(). Empty if `go_on`, which is called while it reads, returns false.
  std::optional<FileSample> file_sample(const SampleOptions         &options,
                                        const PreparationSetting    &preparation,
                                        const std::function<bool()> &go_on);

  // Reads the whole file of the sample. Throws std::invalid_argument with key, file, place and range.
  void check_sample_file(const SampleOptions &options, const PreparationSetting &setting, const CheckStop &check_stop = {});
} // namespace diptych::discrete
