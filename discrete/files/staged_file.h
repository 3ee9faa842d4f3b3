// diptych: an HDF5 file that gains a stage at a time
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <string>

#include "discrete/files/hdf5_file.h"

namespace diptych::discrete
{
  std::string stage_name(std::size_t stage); // "stage_0003": of its group

  // PATH.h5 with a group for each stage. While stages are added each of them is a file of its own in the folder PATH, and PATH.h5
  // holds links to them: no earlier byte is written again, and whatever ends the program leaves a file that any reader of HDF5
  // opens. close() makes one file of all. Functions throw std::runtime_error naming the file.
  class StagedFile
  {
  public:
    // Begins anew: what stands there of an earlier file is removed.
    explicit StagedFile(std::string path_without_ending);

    // Goes on from the first n stages of a file that stands there. Throws std::invalid_argument where it has fewer.
    StagedFile(std::string path_without_ending, std::size_t n);

    // `write` puts the stage into the group it is given.
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

  // How many stages a file holds. Throws std::invalid_argument naming it where there is none.
  bool        is_written_by_us(const Hdf5Reader &file); // it says how many stages it must hold
  std::size_t count_stages(const Hdf5Reader &file);
} // namespace diptych::discrete
