// diptych: the program
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <functional>
#include <iostream>
#include <map>

#include <deal.II/base/mpi.h>

#include "coupling/commands.h"
#include "coupling/ensembles/ensemble_command.h"
#include "coupling/ensembles/ensemble_folder.h"
#include "coupling/processes.h"
#include "coupling/scene.h"
#include "coupling/solve_command.h"
#include "coupling/stop_signal.h"
#include "coupling/version.h"

namespace
{
  using namespace diptych::coupling;

  constexpr char usage[] = R"(diptych: one granular sample twice, every grain beside a continuum

  diptych run SCENE        both panels, homogenisation, comparison, report
  diptych discrete SCENE   the grains alone
  diptych continuum SCENE  the continuum alone (continuum/mesh = outline prepares the grains); also under mpirun
  diptych material-point SCENE  the continuum's law on one point along the biaxial path: material_point.csv
  diptych solve PROBLEM.h5 one stored contact problem (FCLIB layout): sweeps, residual, seconds
  diptych compare DIR      homogenise and compare again from a result folder
  diptych report DIR       draw report.html again
  diptych explain [SECTION] every key of a scene: default, unit, range, meaning

  --output DIR             result folder (default: results/<scene name>)
  --set section/key=value  change one key of the scene; may be repeated
  --threads N              for the contact solver; the same bits for every N (default 1)
  --resume                 go on from the checkpoint of an interrupted run, grains or continuum
  --seeds LIST             run: the scene on every sample of a list like 1-8 or 1,3,5-7, each in DIR/seed_K, then means, intervals
                           and verdicts over them (default folder: results/<scene name>_ensemble; also under mpirun)
  --jobs N                 how many of them at once, on each process (default: cores it may use / threads; under mpirun 1)
  --study step             discrete: run with step h, h/2 and h/4 and compare energy and stress ratio
  --solver NAME            solve: psor or nsgs (psor)
  --tolerance T            solve: natural map relative to |r| (1e-8)
  --max-sweeps N           solve: (1000000)
  --form F                 solve: body or local (default: body where the file has one); --output names a file
  --quiet                  no progress
  --version, --help

Exit codes: 0 done, 1 a stated invariant failed, 2 wrong input, 3 did not converge or was stopped (what was reached is kept)
)";

  int run_one_or_many(const CommandLine &line)
  {
    return line.seeds.empty() ? run_both(line) : run_ensemble(line);
  }

  int compare_one_or_many(const CommandLine &line)
  {
    return is_ensemble_folder(line.target) ? compare_ensemble_again(line) : compare_again(line);
  }

  int report_one_or_many(const CommandLine &line)
  {
    return is_ensemble_folder(line.target) ? report_ensemble_again(line) : report_again(line);
  }

  // What each command is called and whether it needs a target.
  struct Command
  {
    std::function<int(const CommandLine &)> execute;
    bool                                    needs_target;
    bool                                    on_several_processes = false;
  };

  const std::map<std::string, Command> commands = {
    {"run", {run_one_or_many, true}},           {"discrete", {run_discrete, true}},
    {"continuum", {run_continuum, true, true}}, {"material-point", {run_material_point, true}},
    {"solve", {solve_stored_problem, true}},    {"compare", {compare_one_or_many, true}},
    {"report", {report_one_or_many, true}},     {"explain", {explain_keys, false}}};

  int positive_number(const std::string &option, const std::string &text)
  {
    std::size_t end   = 0;
    int         value = 0;
    try
      {
        value = std::stoi(text, &end);
      }
    catch (const std::exception &)
      {}
    if (end != text.size() || value < 1)
      throw SceneError(option + " " + text + ": must be a whole number from 1 on");
    return value;
  }

  double positive_real(const std::string &option, const std::string &text)
  {
    char        *end   = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != '\0' || !(value > 0) || !std::isfinite(value))
      throw SceneError(option + " " + text + ": must be a positive number");
    return value;
  }

  CommandLine parse(const std::vector<std::string> &words)
  {
    CommandLine line;
    line.text = "diptych";
    for (const std::string &word : words)
      line.text += " " + word;
    for (std::size_t k = 0; k < words.size(); ++k)
      {
        const auto argument = [&]() {
          if (k + 1 >= words.size())
            throw SceneError(words[k] + ": its value is missing");
          return words[++k];
        };
        if (words[k] == "--output")
          line.output = argument();
        else if (words[k] == "--set")
          line.overrides.push_back(argument());
        else if (words[k] == "--threads")
          line.threads = positive_number("--threads", argument());
        else if (words[k] == "--resume")
          line.resume = true;
        else if (words[k] == "--study")
          line.study = argument();
        else if (words[k] == "--seeds")
          {
            line.seeds = argument();
            if (line.seeds.empty())
              throw SceneError("--seeds: the list is empty; a list like 1-8 or 1,3,5-7");
          }
        else if (words[k] == "--jobs")
          line.jobs = positive_number("--jobs", argument());
        else if (words[k] == "--solver")
          line.solver = argument();
        else if (words[k] == "--tolerance")
          line.tolerance = positive_real("--tolerance", argument());
        else if (words[k] == "--max-sweeps")
          line.max_sweeps = positive_number("--max-sweeps", argument());
        else if (words[k] == "--form")
          line.form = argument();
        else if (words[k] == "--quiet")
          line.quiet = true;
        else if (words[k].rfind("--", 0) == 0)
          throw SceneError("unknown option '" + words[k] + "'; see diptych --help");
        else if (line.command.empty())
          line.command = words[k];
        else if (line.target.empty())
          line.target = words[k];
        else
          throw SceneError("'" + words[k] + "': one scene, problem, folder or section is enough");
      }
    const auto found = commands.find(line.command);
    if (found == commands.end())
      throw SceneError("unknown command '" + line.command + "'; see diptych --help");
    if (found->second.needs_target && line.target.empty())
      throw SceneError("diptych " + line.command + ": a scene file, problem file or result folder is missing");
    if (!line.seeds.empty() && line.command != "run")
      throw SceneError("--seeds " + line.seeds + ": only `diptych run` runs a list of seeds");
    if (line.jobs > 0 && line.seeds.empty())
      throw SceneError("--jobs " + std::to_string(line.jobs) + ": only with --seeds");
    return line;
  }

  int execute(int argc, char **argv)
  {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.empty() || words[0] == "--help" || words[0] == "-h" || words[0] == "help")
      {
        std::cout << usage;
        return words.empty() ? wrong_input : done;
      }
    if (words[0] == "--version")
      {
        std::cout << "diptych " << version << " (" << git_revision << ")\n";
        return done;
      }
    CommandLine line = parse(words);
    // One thread: deal.II's pool would change nothing but the clock.
    dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    const Command                           &command = commands.at(line.command);
    line.quiet                                       = line.quiet || !is_first_process();
    install_stop_signals();
    return answer_for([&] {
      if (n_processes() > 1 && !command.on_several_processes && line.seeds.empty())
        throw SceneError("mpirun: diptych " + line.command +
                         " runs on one process; several may run `diptych continuum` alone or `diptych run` with --seeds");
      return command.execute(line);
    });
  }
} // namespace

int main(int argc, char **argv)
{
  // Words of the command line, before there is any other process to answer to.
  try
    {
      return execute(argc, argv);
    }
  catch (const std::exception &error)
    {
      std::cerr << "diptych: " << error.what() << std::endl;
      return code_of(error);
    }
}
