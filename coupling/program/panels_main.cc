// diptych: the commands that need the continuum's libraries; `diptych` starts this program for them
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <deal.II/base/mpi.h>

#include "coupling/panels/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
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
        return line.checks_only ? check_run(line, scene_of(line)) : run_both(line, scene_of(line));
      case Command::continuum:
        return run_continuum(line, scene_of(line));
      case Command::material_point:
        return run_material_point(line, scene_of(line));
      case Command::check_law:
        return check_law_of(line);
      default:
        throw SceneError("diptych-panels: " + name_of(line.command) + " is a command of `diptych`");
      }
  }
} // namespace

extern "C" int MPI_Abort(MPI_Comm, int)
{
  leave_for_mpi_abort(system_failure);
}

int main(int argc, char **argv)
{
  install_signals(); // those that came while the program began, too
  avoid_mpi_daemon();
  // Words of the command line, before there is any other process to answer to.
  ParsedLine parsed = parse_command_line({argv + 1, argv + argc});
  if (parsed.exit_code)
    return *parsed.exit_code;
  block_stop_signals(); // MPI takes signals to itself, and its threads must not get these
  argc = 1;             // the Kokkos of deal.II 9.6 would take --threads for its own
  // One thread: deal.II's pool would change nothing but the clock.
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  parsed.line.quiet           = parsed.line.quiet || !is_first_process();
  parsed.line.prints_warnings = is_first_process();
  install_signals();
  return run_and_report([&] { return execute(parsed.line); }, code_of, text_of_end);
}
