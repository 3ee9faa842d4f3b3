// diptych: the program; what needs the continuum's libraries is done by another one beside it, so that the rest starts at once
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include <sys/resource.h>
#include <unistd.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/command_line.h"
#include "coupling/program/discrete_command.h"
#include "coupling/program/export_command.h"
#include "coupling/program/import_command.h"
#include "coupling/program/explain_command.h"
#include "coupling/program/report_command.h"
#include "coupling/program/solve_command.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/out_of_memory.h"
#ifdef DIPTYCH_CONTINUUM
#include "coupling/program/compare_command.h"
#endif

namespace
{
  using namespace diptych::coupling;

#ifdef DIPTYCH_CONTINUUM
  const std::vector<std::function<ResultList()>> result_lists = {discrete_result_entries, comparison_result_entries};

  int compare(const CommandLine &line)
  {
    return compare_again(line);
  }

  // Where MPI cannot open what it needs it ends the process by itself, with exit code 1.
  void require_open_files()
  {
    constexpr rlim_t least = 32;
    rlimit           limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur < least)
      throw std::runtime_error("this process may open " + std::to_string(limit.rlim_cur) +
                               " files (ulimit -n); the libraries of the continuum need " + std::to_string(least) +
                               "; nothing was written");
  }

  // Where they are not all mapped, MPI goes on without some and ends the process in any way, by a signal too.
  void require_address_space()
  {
    constexpr rlim_t megabyte = 1 << 20, least = 512 * megabyte; // measured: 464 for a continuum of 24 cells
    rlimit           limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < least)
      throw std::runtime_error("this process may use " + std::to_string(limit.rlim_cur / megabyte) +
                               " MB of memory (ulimit -v); the libraries of the continuum need " +
                               std::to_string(least / megabyte) + "; nothing was written");
  }

  // With 128 kB it ended by SIGSEGV, with 256 kB it did not.
  void require_stack()
  {
    constexpr rlim_t kilobyte = 1 << 10, least = 512 * kilobyte;
    rlimit           limit{};
    if (getrlimit(RLIMIT_STACK, &limit) == 0 && limit.rlim_cur < least)
      throw std::runtime_error("this process may have a stack of " + std::to_string(limit.rlim_cur / kilobyte) +
                               " kB (ulimit -s); the libraries of the continuum need " + std::to_string(least / kilobyte) +
                               "; nothing was written");
  }

  // MPI keeps files of its own there, and where it cannot it ends the process by itself, with exit code 1.
  void require_temporary_room()
  {
    std::error_code   none;
    const auto        folder = std::filesystem::temp_directory_path(none);
    const char *const named  = std::getenv("TMPDIR");
    std::string       path   = (folder / "diptych_XXXXXX").string();
    const int         file   = none ? -1 : mkstemp(path.data());
    std::string       why    = none ? none.message() : file < 0 ? std::strerror(errno) : "";
    const std::string zeros(1 << 16, '\0');
    for (int k = 0; why.empty() && k < 16; ++k)
      if (const ssize_t n = write(file, zeros.data(), zeros.size()); n < ssize_t(zeros.size()))
        why = n < 0 ? std::strerror(errno) : "no room for a file of a megabyte";
    if (file >= 0)
      close(file), unlink(path.c_str());
    if (!why.empty())
      throw std::runtime_error("temporary files cannot be written in '" + (none && named ? named : folder.string()) +
                               "' (TMPDIR): " + why + "; nothing was written");
  }

  // diptych-panels beside this program, or in PREFIX/libexec where it is installed.
  [[noreturn]] void become_the_panels(char **argv)
  {
    require_open_files();
    require_address_space();
    require_stack();
    require_temporary_room();
    namespace fs             = std::filesystem;
    const fs::path    folder = fs::path(own_path()).parent_path();
    const std::string name   = "diptych-panels";
    for (const fs::path &program : {folder / name, folder.parent_path() / "libexec/diptych" / name})
      if (fs::exists(program))
        {
          argv[0] = const_cast<char *>(program.c_str());
          block_stop_signals(); // until the other program takes them
          leave_if_stopped(argv[1]);
          execv(program.c_str(), argv);
          unblock_stop_signals();
          throw std::runtime_error("cannot start " + program.string() + ": " + std::strerror(errno));
        }
    throw std::runtime_error(name + " is not beside " + own_path() + "; the installation is broken");
  }
#else
  const std::vector<std::function<ResultList()>> result_lists = {discrete_result_entries};

  int compare(const CommandLine &)
  {
    throw SceneError("diptych compare: this program was built without the continuum; it has discrete, solve, report, import, "
                     "export and explain");
  }

  [[noreturn]] void become_the_panels(char **argv)
  {
    throw SceneError(
      std::string("diptych ") + argv[1] +
      ": this program was built without the continuum; it has discrete, solve, report, import, export and explain");
  }
#endif

  // Of an MPI job; 1 without one.
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

  int execute_command(const CommandLine &line, char **argv)
  {
    switch (line.command)
      {
      case Command::run:
      case Command::study:
      case Command::plan:
      case Command::calibrate:
      case Command::continuum:
      case Command::material_point:
        become_the_panels(argv);
      default:
        break;
      }
    if (n_processes() > 1)
      throw SceneError(
        "mpirun: diptych " + name_of(line.command) +
        " runs on one process; several may run `diptych continuum` alone, `diptych run` with --seeds, `diptych study` or "
        "`diptych calibrate`");
    leave_if_stopped(name_of(line.command));
    switch (line.command)
      {
      case Command::discrete:
        return run_discrete(line);
      case Command::solve:
        return solve_stored_problem(line);
      case Command::compare:
        return compare(line);
      case Command::report:
        return report_again(line);
      case Command::import_sample:
        return import_sample(line);
      case Command::export_sample:
        return export_sample(line);
      default:
        return explain(line, result_lists);
      }
  }

  // What asked for more memory than there is, by the files that it was given.
  int execute(const CommandLine &line, char **argv)
  {
    try
      {
        return execute_command(line, argv);
      }
    catch (const std::bad_alloc &error)
      {
        std::string about = line.target;
        for (const std::string &file : line.foreign.files)
          about += (about.empty() ? "" : ", ") + file;
        throw diptych::discrete::OutOfMemory(about + ": " + diptych::discrete::text_of(error));
      }
  }
} // namespace

namespace
{
  // Every relative name of the command line starts there.
  void require_working_directory()
  {
    std::error_code none;
    (void)std::filesystem::current_path(none);
    if (none)
      throw std::runtime_error("the working directory cannot be found: " + none.message() + "; nothing was written");
  }

  // What they find is written to standard output and nowhere else.
  bool is_said(const CommandLine &line)
  {
    return line.command == Command::explain || (line.command == Command::solve && line.output.empty());
  }

  // Nobody who reads is no fault, a full disk is one.
  void require_output()
  {
    if (std::cout.flush())
      return;
    const int error = write(STDOUT_FILENO, "\n", 1) < 0 ? errno : 0; // the stream keeps none
    if (error != EPIPE && error != EBADF)
      throw std::runtime_error("standard output cannot be written" +
                               (error == 0 ? "" : ": " + std::string(std::strerror(error))) + "; nothing was written to a file");
  }
} // namespace

int main(int argc, char **argv)
{
  install_signals();
  try
    {
      require_working_directory();
      const ParsedLine parsed = parse_command_line({argv + 1, argv + argc});
      const int        code   = parsed.exit_code ? *parsed.exit_code : execute(parsed.line, argv);
      if (code == done && (parsed.exit_code || is_said(parsed.line)))
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
