// diptych: files of other codes of any bytes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "coupling/import/arrival.h"
#include "coupling/import/imported_results.h"
#include "coupling/import/readers.h"
#include "fuzz.h"

namespace
{
  using namespace diptych;

  using Reader                               = coupling::ForeignSample (*)(const coupling::ForeignOptions &);
  constexpr std::array<Reader, 6> readers    = {coupling::read_lammps, coupling::read_liggghts,   coupling::read_yade,
                                                coupling::read_lmgc90, coupling::read_mercurydpm, coupling::read_plain_csv};
  constexpr char                  next_file  = '\x1e'; // before the name of every file of an input, which a line end closes
  constexpr std::size_t           most_files = 6;

  // A name of the input's own, as readers look at names and endings.
  std::string plain_name(std::string_view name)
  {
    std::string plain(name.substr(0, 40));
    std::replace_if(
      plain.begin(), plain.end(), [](const unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '_' && c != '-'; },
      '_');
    return plain.empty() || plain[0] == '.' ? "file" + plain : plain;
  }

  std::vector<std::string> put_files(const fuzz::Folder &folder, std::string_view content)
  {
    std::vector<std::string> files;
    while (!content.empty() && files.size() < most_files)
      {
        content.remove_prefix(content[0] == next_file ? 1 : 0);
        const std::string_view one  = content.substr(0, content.find(next_file));
        const std::size_t      end  = std::min(one.find('\n'), one.size());
        const std::string      file = folder.put(plain_name(one.substr(0, end)), one.substr(std::min(end + 1, one.size())));
        if (std::find(files.begin(), files.end(), file) == files.end())
          files.push_back(file);
        content.remove_prefix(one.size());
      }
    return files;
  }

  void check_results(const coupling::DiscreteResults &results)
  {
    for (const discrete::Snapshot &s : results.snapshots)
      for (std::size_t i = 0; i < s.position.size(); ++i)
        if (!s.position[i].allFinite() || !(s.radius[i] > 0))
          fuzz::finding("grain " + std::to_string(i) + " was taken without a place or a radius");
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const fuzz::Folder folder;
  const fuzz::Choice        choice(data, size, 2 * unsigned(readers.size()));
  coupling::ForeignOptions  options;
  options.files = put_files(folder, choice.content);
  if (choice.way % 2 == 1) // spheres need it, and some files have no masses
    options.thickness = 1, options.density = 1, options.timestep = 1;
  fuzz::is_taken(folder.path,
                 [&] { check_results(coupling::imported_results(coupling::arrive(readers[choice.way / 2](options), options))); });
  for (const std::string &file : options.files)
    std::filesystem::remove(file);
  return 0;
}
