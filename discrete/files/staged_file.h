// diptych: an HDF5 file to which stages are appended
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "discrete/files/hdf5_file.h"

namespace diptych::discrete
{
  std::string stage_name(std::size_t stage); // name of its group, "stage_0003"

  // PATH.h5 with one group per stage. Until close(), each stage is a separate file in the folder PATH, and PATH.h5 holds links to
  // them. So no earlier byte is written again, and a killed program leaves a file that any HDF5 reader opens. `close()` joins all
  // stages in PATH.h5. Functions throw std::runtime_error with the file's name.
  class StagedFile
  {
  public:
    // Begins a new file and removes an earlier one.
    explicit StagedFile(std::string path_without_ending);

    // Appends to the first n stages of an existing file. Throws std::invalid_argument if it has fewer.
    StagedFile(std::string path_without_ending, std::size_t n);

    void add(const std::function<void(Hdf5Writer &, const std::string &group)> &write);

    std::size_t size() const { return n_stages; }
    void        close();

  private:
    std::string file() const { return path + ".h5"; }
    std::string part(std::size_t stage) const { return path + "/" + stage_name(stage) + ".h5"; }
    void        write_links() const;
    void        remove_parts(std::size_t from) const;

    std::string path;
    std::size_t n_stages = 0;
  };

  // Number of stages in a file. Throws std::invalid_argument with its name if it has none.
  bool        is_written_by_us(const Hdf5Reader &file); // true if the file records how many stages it must have
  std::size_t count_stages(const Hdf5Reader &file);

  // The attribute `progress` of the first n stages.
  std::vector<double> progress_of_stages(const std::string &h5_path, std::size_t n);
} // namespace diptych::discrete
