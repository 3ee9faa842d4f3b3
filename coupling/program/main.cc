// diptych: the program; commands that need deal.II run in a second one, diptych-panels, so that the others start at once
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/command_line.h"
#include "coupling/program/commands.h"
#include "coupling/program/discrete_command.h"
#include "coupling/program/explain_command.h"
#include "coupling/program/python_commands.h"
#include "coupling/program/python_package.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/result_folder.h"
#include "discrete/files/out_of_memory.h"
#ifdef DIPTYCH_CONTINUUM
#include "coupling/program/compare_command.h"
#include "coupling/version.h"
#endif

namespace
{
  using namespace diptych::coupling;

#ifdef DIPTYCH_CONTINUUM
  constexpr bool                                 has_panels   = true;
  const std::vector<std::function<ResultList()>> result_lists = {discrete_result_entries, comparison_result_entries,
                                                                 python_result_entries};

  int compare(const CommandLine &line)
  {
    return compare_again(line);
  }

  // MPI keeps files there. Where it cannot, it ends the process with exit code 1 and a message about its own parts.
  void require_temporary_folder()
  {
    std::error_code none;
    const auto      folder = std::filesystem::temp_directory_path(none);
    std::string     path   = (folder / "diptych_XXXXXX").string();
    const int       file   = none ? -1 : mkstemp(path.data());
    const int       error  = none ? 0 : file < 0 ? errno : posix_fallocate(file, 0, 1 << 20); // 0: there is room
    if (file >= 0)
      {
        close(file);
        unlink(path.c_str());
      }
    if (none || error != 0)
      throw std::runtime_error("temporary files of 1 MB cannot be written in '" + folder.string() +
                               "' (TMPDIR): " + (none ? none.message() : std::strerror(error)));
  }

  // diptych-panels beside this program, or in PREFIX/libexec where it is installed.
  [[noreturn]] void start_the_panels(char **argv)
  {
    require_temporary_folder();
    namespace fs             = std::filesystem;
    const fs::path    folder = fs::path(own_path()).parent_path();
    const std::string name   = "diptych-panels";
    for (const fs::path &program : {folder / name, folder.parent_path() / "libexec/diptych" / name})
      if (fs::exists(program))
        {
          argv[0] = const_cast<char *>(program.c_str());
          become(argv[1], program.string(), argv);
        }
    throw std::runtime_error(name + " is not beside " + own_path() + "; the installation is broken");
  }
#else
  constexpr bool                                 has_panels   = false;
  const std::vector<std::function<ResultList()>> result_lists = {discrete_result_entries, python_result_entries};

  [[noreturn]] void refuse_without_continuum(const std::string &command)
  {
    throw SceneError(command + ": this program was built without the continuum; it has discrete, homogenise, solve, report, " +
                     "import, export, explain, new, and study, plan and calibrate for grains");
  }

  int compare(const CommandLine &)
  {
    refuse_without_continuum("compare");
  }

  [[noreturn]] void start_the_panels(char **argv)
  {
    refuse_without_continuum(argv[1]);
  }
#endif

  // Number of processes of an MPI job; 1 without one.
  int n_processes()
  {
    for (const char *variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
      if (const char *size = std::getenv(variable))
        return std::atoi(size);
    return 1;
  }

  bool is_first_process()
  {
    for (const char *variable : {"OMPI_COMM_WORLD_RANK", "PMI_RANK"})
      if (const char *rank = std::getenv(variable))
        return std::atoi(rank) == 0;
    return true;
  }

  // Commands of many runs and importers are written in Python, which alone parses their words.
  bool is_for_python(const std::vector<std::string> &words)
  {
    const auto has = [&](const std::string &option) {
      return std::any_of(words.begin(), words.end(),
                         [&](const std::string &word) { return word == option || word.rfind(option + "=", 0) == 0; });
    };
    const auto is_named = [&](const PythonCommand &command) { return words[0] == command.name; };
    return !words.empty() &&
           (std::any_of(std::begin(python_commands), std::end(python_commands), is_named) ||
            (words[0] == "run" && has("--seeds")) ||
            (words[0] == "compare" && (has("--measured") || std::any_of(words.begin(), words.end(), is_ensemble_folder))));
  }

  int execute_command(const CommandLine &line, char **argv)
  {
    const bool is_shared = has_panels && (line.command == Command::run || line.command == Command::discrete ||
                                          line.command == Command::continuum);
    if (n_processes() > 1 && !is_shared)
      throw SceneError("mpirun: diptych " + name_of(line.command) +
                       " runs on one process; several share `run`, `discrete`, `continuum`, `study` and `calibrate`");
    switch (line.command)
      {
      case Command::run:
      case Command::continuum:
      case Command::material_point:
      case Command::check_law:
        start_the_panels(argv);
      default:
        break;
      }
    if (n_processes() > 1)
      start_the_panels(argv); // there is MPI
    leave_if_stopped(name_of(line.command));
    switch (line.command)
      {
      case Command::discrete:
        return run_discrete(line, scene_of(line));
      case Command::solve:
        return solve_stored_problem(line);
      case Command::compare:
        return compare(line);
      case Command::new_scene:
        return print_template(line);
      case Command::completion:
        return print_completion();
      default:
        return explain(line, result_lists);
      }
  }

  // Names the files whose contents asked for more memory than there is.
  int execute(const CommandLine &line, char **argv)
  {
    try
      {
        return execute_command(line, argv);
      }
    catch (const std::bad_alloc &error)
      {
        throw diptych::discrete::OutOfMemory(line.target + ": " + diptych::discrete::text_of(error));
      }
  }

  // Relative names of the command line start there.
  void require_working_directory()
  {
    std::error_code none;
    (void)std::filesystem::current_path(none);
    if (none)
      throw std::runtime_error("the working directory cannot be found: " + none.message());
  }

  // Commands whose only result is their output.
  bool prints_only(const CommandLine &line)
  {
    return line.command == Command::explain || line.command == Command::new_scene || line.command == Command::completion ||
           (line.command == Command::solve && line.output.empty());
  }

  // A full disk is an error, a closed pipe is not.
  void require_output()
  {
    if (std::cout.flush())
      return;
    const int error = write(STDOUT_FILENO, "\n", 1) < 0 ? errno : 0; // the stream keeps none
    if (error != EPIPE && error != EBADF)
      throw std::runtime_error("standard output cannot be written" +
                               (error == 0 ? "" : ": " + std::string(std::strerror(error))));
  }
} // namespace

int main(int argc, char **argv)
{
  install_signals();
  try
    {
      require_working_directory();
      const std::vector<std::string> words(argv + 1, argv + argc);
      require_text(words);
      if (is_for_python(words))
        become_python(argv + 1);
      const ParsedLine parsed = parse_command_line(words);
      const int        code   = parsed.exit_code ? *parsed.exit_code : execute(parsed.line, argv);
      if (code == done && (parsed.exit_code || prints_only(parsed.line)))
        require_output();
      return code;
    }
  catch (const std::exception &error)
    {
      if (is_first_process())
        std::cerr << text_of_end(error) << std::endl;
      return code_of(error);
    }
}
