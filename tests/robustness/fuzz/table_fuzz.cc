// diptych: tables of grains, times and radii of any bytes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>

#include "discrete/samples/radius_distribution.h"
#include "discrete/samples/sample_file.h"
#include "fuzz.h"

namespace
{
  using namespace diptych;

  // Accepted grains have finite numbers, and they survive writing and reading unchanged.
  void check_grains(const fuzz::Folder &folder, const discrete::Grains &grains)
  {
    for (std::size_t i = 0; i < grains.size(); ++i)
      if (!grains.position[i].allFinite() || !grains.velocity[i].allFinite() || !std::isfinite(grains.spin[i]) ||
          !(grains.radius[i] > 0) || !(grains.mass[i] > 0) || !std::isfinite(grains.mass[i]))
        fuzz::finding("grain " + std::to_string(i) + " was taken with a number that is none");
    const std::string file = folder.path + "/again.csv";
    discrete::write_grains_csv(file, grains);
    const discrete::Grains again = discrete::read_grains_csv(file, 1).grains;
    if (again.position != grains.position || again.velocity != grains.velocity || again.radius != grains.radius ||
        again.spin != grains.spin || again.fixed != grains.fixed)
      fuzz::finding("grains differ after they were written and read");
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const fuzz::Folder folder;
  const fuzz::Choice        choice(data, size, 3);
  const std::string         file = folder.put("input.csv", choice.content);
  fuzz::is_taken(folder.path, [&] {
    if (choice.way == 0)
      check_grains(folder, discrete::read_grains_csv(file, 1).grains);
    else if (choice.way == 1)
      (void)discrete::read_time_table(file, "velocity");
    else
      (void)discrete::read_radius_table(file);
  });
  return 0;
}
