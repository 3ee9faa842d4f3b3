// diptych: an HDF5 file to which stages are appended
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/staged_file.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace diptych::discrete
{
  namespace fs = std::filesystem;

  namespace
  {
    const std::string n_stages_name = "stages"; // attribute of the root: how many there are
  }                                             // namespace

  std::string stage_name(const std::size_t stage)
  {
    char name[32];
    std::snprintf(name, sizeof name, "stage_%04zu", stage);
    return name;
  }

  bool is_written_by_us(const Hdf5Reader &file)
  {
    return file.has_attribute("/", n_stages_name);
  }

  std::size_t count_stages(const Hdf5Reader &file)
  {
    std::size_t n = 0;
    while (file.has(stage_name(n)))
      ++n;
    if (n == 0)
      throw std::invalid_argument(file.path() + ": holds no group " + stage_name(0) + "; is it a result file of a panel?");
    const std::vector<std::string> members  = file.members("/");
    const auto                     is_stage = [](const std::string &name) { return name.rfind("stage_", 0) == 0; };
    const double                   stages   = is_written_by_us(file) ? file.attribute("/", n_stages_name) : double(n);
    if (double(n) != stages || std::size_t(std::count_if(members.begin(), members.end(), is_stage)) != n)
      throw std::invalid_argument(file.path() + ": a group is missing: " + stage_name(n));
    return n;
  }

  std::vector<double> progress_of_stages(const std::string &h5_path, const std::size_t n)
  {
    const Hdf5Reader    file(h5_path);
    std::vector<double> progress;
    for (std::size_t stage = 0; stage < n; ++stage)
      progress.push_back(file.attribute(stage_name(stage), "progress"));
    return progress;
  }

  StagedFile::StagedFile(std::string path_without_ending)
      : path(std::move(path_without_ending))
  {
    fs::remove(file());
    remove_parts(0);
  }

  StagedFile::StagedFile(std::string path_without_ending, const std::size_t n)
      : path(std::move(path_without_ending)),
        n_stages(n)
  {
    {
      const Hdf5Reader  whole(file());
      const std::size_t found = count_stages(whole);
      if (found < n)
        throw std::invalid_argument(file() + ": holds " + std::to_string(found) + " stages, not the " + std::to_string(n) +
                                    " that the checkpoint beside it goes on from");
      for (std::size_t stage = 0; stage < n; ++stage)
        if (!whole.is_link(stage_name(stage)))
          {
            fs::create_directories(path);
            Hdf5Writer writer(part(stage));
            writer.copy(whole, stage_name(stage));
            writer.finish();
          }
    }
    write_links();
    remove_parts(n);
  }

  void StagedFile::add(const std::function<void(Hdf5Writer &, const std::string &)> &write)
  {
    fs::create_directories(path);
    Hdf5Writer writer(part(n_stages));
    write(writer, stage_name(n_stages));
    writer.finish();
    ++n_stages;
    write_links();
  }

  void StagedFile::write_links() const
  {
    Hdf5Writer        links(file());
    const std::string folder = fs::path(path).filename().string() + "/";
    for (std::size_t stage = 0; stage < n_stages; ++stage)
      links.link(stage_name(stage), folder + stage_name(stage) + ".h5", "/" + stage_name(stage));
    links.attribute("/", n_stages_name, double(n_stages));
    links.finish();
  }

  void StagedFile::close()
  {
    std::size_t n_bytes = 0;
    for (std::size_t stage = 0; stage < n_stages; ++stage)
      n_bytes += fs::file_size(part(stage));
    Hdf5Writer whole(file(), n_bytes);
    for (std::size_t stage = 0; stage < n_stages; ++stage)
      whole.copy(Hdf5Reader(part(stage)), stage_name(stage));
    whole.attribute("/", n_stages_name, double(n_stages));
    whole.finish();
    remove_parts(0);
  }

  void StagedFile::remove_parts(const std::size_t from) const
  {
    for (std::size_t stage = from; fs::remove(part(stage)); ++stage)
      {}
    std::error_code not_empty;
    fs::remove(path, not_empty);
  }
} // namespace diptych::discrete
