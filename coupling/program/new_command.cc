// diptych: new TEMPLATE, a commented scene to begin with; completion bash
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/commands.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "coupling/program/python_package.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/nearest_name.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace fs = std::filesystem;

  int print_template(const CommandLine &line)
  {
    const std::string        folder = shared_file("templates");
    std::vector<std::string> names;
    for (const fs::directory_entry &file : fs::directory_iterator(folder))
      if (file.path().extension() == ".prm")
        names.push_back(file.path().stem().string());
    std::sort(names.begin(), names.end());
    const auto stream = [&](const std::string &name) { return std::ifstream(folder + "/" + name + ".prm"); };
    if (line.target.empty())
      for (const std::string &name : names)
        {
          std::string   title; // the first line: "# biaxial: what it computes"
          std::ifstream file = stream(name);
          std::getline(file, title);
          std::cout << title.substr(2) << '\n';
        }
    else if (std::count(names.begin(), names.end(), line.target) == 0)
      throw SceneError("new " + line.target + ": there is no such template; the nearest of " + discrete::listed(names) + " is '" +
                       discrete::nearest_name(line.target, names) + "'");
    else
      std::cout << stream(line.target).rdbuf();
    return done;
  }

  int print_completion()
  {
    std::cout << std::ifstream(shared_file("completion.bash")).rdbuf();
    return done;
  }
} // namespace diptych::coupling
