// diptych: scenes and fragments of them of any bytes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene_file.h"
#include "fuzz.h"

namespace
{
  using namespace diptych;

  // An accepted scene is reproduced by its resolved scene.
  void check_echo(const fuzz::Folder &folder, const coupling::Scene &scene)
  {
    const std::string first  = coupling::resolved_text(scene);
    auto              second = coupling::resolved_scene(folder.put("echo.prm", first));
    if (!second)
      fuzz::finding("the echo is no scene:\n" + first);
    second->name = scene.name; // stands in the file that was echoed
    if (coupling::resolved_text(*second) != first)
      fuzz::finding("the echo of the echo differs:\n" + first + "\n" + coupling::resolved_text(*second));
  }
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const fuzz::Folder folder;
  const fuzz::Choice        choice(data, size, 3);
  const std::string         file = folder.put(choice.way % 2 == 0 ? "input.prm" : "input.json", choice.content);
  fuzz::is_taken(folder.path, [&] {
    if (choice.way < 2)
      check_echo(folder, coupling::read_scene(file, {}));
    else
      (void)coupling::read_fragment(file);
  });
  return 0;
}
