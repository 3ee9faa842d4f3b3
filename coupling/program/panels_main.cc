// diptych: the commands that need the continuum's libraries; `diptych` starts this program for them
// SPDX-License-Identifier: LGPL-2.1-or-later

#include <algorithm>

#include <deal.II/base/mpi.h>

#include "coupling/panels/processes.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/commands.h"
#include "coupling/program/continuum_command.h"
#include "coupling/program/discrete_command.h"
#include "coupling/scene/scene_error.h"
#include "coupling/store/file_names.h"

namespace
{
  using namespace diptych::coupling;
  namespace discrete = diptych::discrete;

  // Blocks of fewer grains are not cut.
  void require_work_for(const int n_processes, const Scene &scene)
  {
    constexpr int least  = discrete::rows_of_a_block / 2; // dense grains have about two contacts each
    const int     grains = int(discrete::expected_grains(scene.sample));
    const int     useful = std::clamp(grains / least, 1, discrete::most_blocks);
    if (scene.sample.file.empty() && n_processes > useful)
      throw SceneError("mpirun -np " + std::to_string(n_processes) + ": a sample of " + std::to_string(grains) +
                       " grains is shared by at most " + std::to_string(useful) + " processes: one per " + std::to_string(least) +
                       " grains, and " + std::to_string(discrete::most_blocks) + " in all");
  }

  // The first process runs the command, and the others do the part of its work that they share.
  int run_together(CommandLine line, const Scene &scene)
  {
    discrete::Processes &processes = mpi_processes();
    require_work_for(processes.size(), scene);
    if (is_first_process())
      {
        Followers followers(processes);
        line.followers = &followers;
        return line.command == Command::run ? run_both(line, scene) : run_discrete(line, scene);
      }
    FollowedGrains grains{scene, processes};
    for (int task = processes.of_first(0); task != Followers::end; task = processes.of_first(0))
      if (task < Followers::run_continuum)
        grains.follow(Followers::Task(task));
      else
        {
          const std::string &directory = scene.output.directory;
          (void)continuum_beside_grains(line, scene, task == Followers::run_continuum ? directory : next_continuum(directory),
                                        {});
        }
    return done;
  }

  int execute(const CommandLine &line)
  {
    const bool has_grains = line.command == Command::discrete || line.command == Command::run;
    if (any_process(stop_requested()))
      throw StoppedOnRequest(name_of(line.command) + ": stopped on request");
    if (n_processes() > 1 && has_grains && !line.checks_only)
      return run_together(line, scene_of(line));
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
