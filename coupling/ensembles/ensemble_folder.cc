// diptych: the folder of an ensemble: what is in it, what of it may stay
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/ensembles/ensemble_folder.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "coupling/result_folder.h"
#include "discrete/text_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::json;
    namespace fs = std::filesystem;

    constexpr double largest_error_of_the_total = 1e-12; // beyond it `diptych run` ends with exit code 1

    std::string text_of_file(const std::string &path)
    {
      std::ifstream      file(path);
      std::ostringstream text;
      text << file.rdbuf();
      return text.str();
    }

    bool may_differ(const std::string &key)
    {
      return key == "sample/seed" || key.rfind("output/", 0) == 0 || key.rfind("comparison/margin_", 0) == 0 ||
             key == "discrete/checkpoint_minutes" || key == "continuum/checkpoint_minutes";
    }

    // Value by section/key of an echoed scene, of all that decides the result of one member.
    std::map<std::string, std::string> settings_of(const std::string &echoed)
    {
      std::map<std::string, std::string> settings;
      std::istringstream                 in(echoed);
      const std::string                  begin = "subsection ", set = "  set ", equals = " = ";
      std::string                        section;
      for (std::string line; std::getline(in, line);)
        if (line.rfind(begin, 0) == 0)
          section = line.substr(begin.size());
        else if (const auto at = line.find(equals); line.rfind(set, 0) == 0 && at != std::string::npos)
          {
            const std::string key = section + "/" + line.substr(set.size(), at - set.size());
            if (!may_differ(key))
              settings[key] = line.substr(at + equals.size());
          }
      return settings;
    }

    // Names the first key with two values.
    void demand_same_scene(const Scene &scene)
    {
      const auto earlier = settings_of(text_of_file(scene.output.directory + "/ensemble.prm")), now = settings_of(echo(scene));
      for (const auto &[key, value] : now)
        if (const auto found = earlier.find(key); found == earlier.end() || found->second != value)
          throw SceneError("--resume: " + key + " = '" + value + "' is not that of " + scene.output.directory + "/ensemble.prm" +
                           (found == earlier.end() ? "" : ", '" + found->second + "'") +
                           "; resume with the same scene or start without --resume");
    }

    // Only in a folder that holds a result of diptych: `diptych run` refuses any other, too.
    void forget_member(const std::string &folder)
    {
      if (earlier_echo(folder).find(echo_title) == std::string::npos)
        return;
      remove_results(folder, comparison_files);
      remove_results(folder, {"provenance.json", "checkpoint.h5", "continuum_checkpoint.h5", "coarse"});
    }
  } // namespace

  std::string member_folder(const std::string &directory, const int seed)
  {
    return directory + "/seed_" + std::to_string(seed);
  }

  std::string member_log(const std::string &directory, const int seed)
  {
    return member_folder(directory, seed) + ".log";
  }

  bool is_ensemble_folder(const std::string &directory)
  {
    return text_of_file(directory + "/ensemble.prm").find(echo_title) != std::string::npos;
  }

  void open_ensemble_folder(const Scene &scene, const std::vector<int> &seeds, const bool resume)
  {
    const std::string &directory = scene.output.directory;
    std::error_code    error;
    fs::create_directories(directory, error);
    if (error || access(directory.c_str(), W_OK) != 0)
      throw SceneError("output/directory = '" + directory + "' cannot be made or written to");
    const bool is_ensemble = is_ensemble_folder(directory);
    if (!is_ensemble && !fs::is_empty(directory))
      throw SceneError("output/directory = '" + directory +
                       "' holds other files and no ensemble of diptych; name a new or an empty folder");
    if (resume && is_ensemble)
      demand_same_scene(scene);
    // Killed before its end, this run must not leave the statistics of an earlier one.
    remove_results(directory, {"ensemble.json", "ensemble.csv", "report.html"});
    for (const int seed : seeds)
      if (!resume)
        {
          forget_member(member_folder(directory, seed));
          fs::remove(member_log(directory, seed));
        }
    discrete::write_text(directory + "/ensemble.prm", echo(scene));
  }

  bool is_finished_member(const Scene &scene, const int seed)
  {
    const std::string folder = member_folder(scene.output.directory, seed);
    if (settings_of(earlier_echo(folder)) != settings_of(echo(scene)))
      return false;
    if (scene.output.report && !fs::exists(folder + "/report.html"))
      return false;
    const json comparison = json::parse(text_of_file(folder + "/comparison.json"), nullptr, /* exceptions */ false);
    if (!comparison.is_object() || comparison.value("seed", -1) != seed)
      return false;
    for (const json &stage : comparison.value("stages", json::array()))
      if (!(stage.value("/mapping/total_relative_error"_json_pointer, 1.) < largest_error_of_the_total))
        return false;
    return true;
  }

  std::string last_words(const std::string &log)
  {
    std::ifstream file(log);
    std::string   last;
    for (std::string line; std::getline(file, line);)
      if (line.find_first_not_of(" \t\r") != std::string::npos)
        last = line;
    return last;
  }
} // namespace diptych::coupling
