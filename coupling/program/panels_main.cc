// diptych: the commands that need the continuum's libraries; `diptych` starts this program for them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdlib>
#include <iostream>
#include <stdexcept>

#include <deal.II/base/mpi.h>

#include "coupling/panels/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
#include "coupling/program/continuum_command.h"
#include "coupling/program/discrete_command.h"
#include "coupling/program/worker_command.h"
#include "coupling/scene/scene_error.h"

namespace
{
  using namespace diptych::coupling;

  int execute(const CommandLine &line)
  {
    if (n_processes() > 1 && line.command != Command::continuum)
      throw SceneError(
        "mpirun: diptych " + name_of(line.command) +
        " runs on one process; use several for `diptych continuum`, `diptych run` with --seeds, `diptych study` or "
        "`diptych calibrate`");
    if (any_process(stop_requested()))
      throw StoppedOnRequest(name_of(line.command) + ": stopped on request");
    switch (line.command)
      {
      case Command::run:
        return line.checks_only ? check_run(line) : run_both(line);
      case Command::discrete: // as a task of a study
        return run_discrete(line);
      case Command::continuum:
        return run_continuum(line);
      case Command::material_point:
        return run_material_point(line);
      case Command::check_law:
        return check_law_of(line);
      default:
        throw SceneError("diptych-panels: " + name_of(line.command) + " is a command of `diptych`");
      }
  }
} // namespace

// Where its memory ends, Trilinos (ML) has MPI end the process, with exit code 1 and nothing kept or said. Alone, this process
// goes on from there as from what any library throws.
extern "C" int MPI_Abort(MPI_Comm communicator, int)
{
  if (n_processes() == 1)
    throw std::runtime_error("a library of the continuum gave up, as where memory is short; its words stand above");
  PMPI_Abort(communicator, system_failure);
  std::abort();
}

int main(int argc, char **argv)
{
  install_signals(); // those that came while the program began, too
  avoid_mpi_daemon();
  if (argc == 2 && std::string(argv[1]) == worker_word)
    {
      constexpr unsigned int most_seconds = 60; // of a worker that nobody waits for any more: a step and its checkpoint
      end_after_parent(most_seconds);
      block_stop_signals();
      dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
      install_signals(); // once more: the libraries that begin with MPI give signals their default actions
      return run_and_report([] { return work_for_parent(execute); }, code_of, text_of_end);
    }
  // Words of the command line, before there is any other process to answer to.
  ParsedLine parsed = parse_command_line({argv + 1, argv + argc});
  if (parsed.exit_code)
    return *parsed.exit_code;
  block_stop_signals(); // MPI takes signals to itself, and its threads must not get these
  // One thread: deal.II's pool would change nothing but the clock.
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  parsed.line.quiet           = parsed.line.quiet || !is_first_process();
  parsed.line.prints_warnings = is_first_process();
  install_signals();
  return run_and_report([&] { return execute(parsed.line); }, code_of, text_of_end);
}
