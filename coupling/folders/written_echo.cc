// diptych: the echo of a scene beside its results, with what was in the files that the scene names
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/folders/written_echo.h"

#include <filesystem>
#include <map>
#include <sstream>

#include "coupling/folders/provenance.h"
#include "coupling/scene/identity.h"
#include "coupling/scene/scene_error.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    const std::string beginning = "# ", middle = " held ";

    std::map<std::string, std::string> told_inputs(const std::string &echo_file)
    {
      std::map<std::string, std::string> told;
      if (!is_echo(echo_file))
        return told;
      std::istringstream in(discrete::read_text(echo_file));
      for (std::string line; std::getline(in, line);)
        if (const std::size_t at = line.find(middle); line.rfind(beginning, 0) == 0 && at != std::string::npos)
          told[line.substr(beginning.size(), at - beginning.size())] = line.substr(at + middle.size());
      return told;
    }

    void write_echo(const std::string &file, const Scene &scene, const std::map<std::string, std::string> &told)
    {
      std::string text = echo(scene);
      for (const auto &[key, path] : input_files(scene))
        if (const auto found = told.find(key); found != told.end())
          text += beginning + key + middle + found->second + '\n';
      const std::string directory = std::filesystem::path(file).parent_path().string();
      forget_files(directory, "echo");
      discrete::write_text(file, text);
      remember_echo(directory, text);
    }
  } // namespace

  void write_echo(const std::string &file, const Scene &scene)
  {
    std::map<std::string, std::string> told = told_inputs(file);
    for (const auto &[key, path] : input_files(scene))
      if (const std::string sum = sum_over(path); !sum.empty())
        told[key] = sum;
    write_echo(file, scene, told);
  }

  void change_echo(const std::string &file, const Scene &scene)
  {
    write_echo(file, scene, told_inputs(file));
  }

  void refuse_folder_of_an_echo(const std::string &file, const Scene &scene, const bool resume)
  {
    namespace fs                 = std::filesystem;
    const std::string &directory = scene.output.directory;
    std::error_code    none;
    if (is_echo(file) && (resume || fs::exists(directory, none)) && directory != "results/" + scene.name &&
        !fs::equivalent(fs::absolute(file).parent_path(), directory, none))
      throw SceneError(file + ": output/directory = '" + directory +
                       "' is not where this echo of a run lies, which it names; --output says where this run is to go");
  }

  std::string changed_input(const Scene &scene, const std::string &echo_file, const std::string &key)
  {
    const std::map<std::string, std::string> told = told_inputs(echo_file);
    for (const auto &[name, path] : input_files(scene))
      if (const auto found = told.find(name); found != told.end() && name.rfind(key, 0) == 0)
        if (const std::string sum = sum_over(path); !sum.empty() && sum != found->second)
          return name + ": '" + path + "' is not what it was";
    return "";
  }
} // namespace diptych::coupling
