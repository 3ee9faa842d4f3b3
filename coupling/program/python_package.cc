// diptych: files that come with the program, and its parts that are written in Python
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/python_package.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/scene/scene_error.h"
#include "coupling/version.h"

namespace diptych::coupling
{
  namespace fs = std::filesystem;

  void become(const char *command, const std::string &program, char *const *words)
  {
    block_stop_signals(); // until the other program takes them
    leave_if_stopped(command);
    execv(program.c_str(), words);
    unblock_stop_signals();
    throw std::runtime_error("cannot start " + program + ": " + std::strerror(errno));
  }

  std::string shared_file(const std::string &name)
  {
    fs::path folder = fs::path(own_path()).parent_path();
    for (int level = 0; level < 3; ++level, folder = folder.parent_path())
      if (const fs::path file = folder / "share/diptych" / name; fs::exists(file))
        return file.string();
    throw std::runtime_error("share/diptych/" + name + " is not beside " + own_path() + "; the installation is broken");
  }

  std::string python_package()
  {
    const fs::path folder = fs::path(own_path()).parent_path(), built = folder / "python";
    return (fs::exists(built / "diptych") ? built : folder.parent_path() / "lib/python3/dist-packages").string();
  }

  void use_python_package(const char *command)
  {
    const std::string package = python_package();
    if (!fs::exists(package + "/diptych"))
      throw SceneError(std::string("diptych ") + command +
                       ": this program was built without its Python package; build all targets");
    const char *others = std::getenv("PYTHONPATH");
    setenv("PYTHONPATH", (package + (others != nullptr ? ":" + std::string(others) : "")).c_str(), 1);
    setenv("PYTHONSAFEPATH", "1", 1); // no modules of the working directory
    setenv("DIPTYCH_PROGRAM", own_path().c_str(), 1);
  }

  void become_python(char *const *words)
  {
    use_python_package(words[0]);
    std::vector<const char *> all = {python, "-m", "diptych"};
    for (char *const *word = words; *word != nullptr; ++word)
      all.push_back(*word);
    all.push_back(nullptr);
    become(words[0], python, const_cast<char *const *>(all.data()));
  }
} // namespace diptych::coupling
