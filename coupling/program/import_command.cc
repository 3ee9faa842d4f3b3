// diptych: import FORMAT FILES: starts the importers, which are part of the Python package
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/import_command.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/scene_error.h"
#include "coupling/version.h"

namespace diptych::coupling
{
  namespace
  {
    namespace fs = std::filesystem;

    // The folder of the package: beside the program where it was built, below PREFIX where it is installed.
    std::string package_folder()
    {
      const fs::path beside = fs::path(own_path()).parent_path();
      for (const fs::path &folder : {beside / "python", beside.parent_path() / "lib/python3/dist-packages"})
        if (fs::exists(folder / "diptych/importers"))
          return folder.string();
      throw SceneError("diptych import: this program was built without the Python package, which reads the files");
    }
  } // namespace

  void start_importers(char **argv)
  {
    std::string       path    = package_folder();
    const char *const earlier = std::getenv("PYTHONPATH");
    path += earlier != nullptr ? std::string(":") + earlier : "";
    setenv("PYTHONPATH", path.c_str(), 1);
    setenv("PYTHONSAFEPATH", "1", 1); // no modules of the working directory
    std::vector<const char *> words = {python, "-m", "diptych.importers"};
    for (char **word = argv + 2; *word != nullptr; ++word)
      words.push_back(*word);
    words.push_back(nullptr);
    block_stop_signals(); // until Python takes them
    leave_if_stopped("import");
    execv(python, const_cast<char **>(words.data()));
    unblock_stop_signals();
    throw std::runtime_error(std::string("cannot start ") + python + ": " + std::strerror(errno));
  }
} // namespace diptych::coupling
