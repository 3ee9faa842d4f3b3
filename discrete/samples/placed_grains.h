// diptych: given grains between platens and sides
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "discrete/files/out_of_memory.h"
#include "discrete/files/wrong_keys.h"
#include "discrete/samples/sample_file.h"
#include "discrete/samples/sample_options.h"

namespace diptych::discrete
{
  // Sets walls and periodicity of a box from the origin on; free sides have walls until set_sides().
  void enclose(State &state, const LateralCondition &lateral, const Eigen::Vector2d &size);

  // Default inertia of a wall or cell width that moves under a force: sqrt(number of grains) x mean grain mass.
  double default_wall_mass(const Grains &grains);

  void set_sides(State &state, const PreparationSetting &setting);

  // Reads the file of a key. Wrong input and a lack of memory are reported with file and key. Other exceptions pass.
  template <class Read> auto read_for(const std::string &key, const std::string &file, Read &&read)
  {
    try
      {
        return read(file);
      }
    catch (const WrongKeys &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        if (dynamic_cast<const std::invalid_argument *>(&error) == nullptr && !is_out_of_memory(error))
          throw;
        throw_wrong_input("sample/" + key, file, error);
      }
  }

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
