// diptych: the command line: commands and their options
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/command_line.h"

#include <iostream>
#include <map>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "coupling/program/built_with.h"
#include "coupling/program/command_examples.h"
#include "coupling/program/option_values.h"
#include "coupling/program/python_commands.h"
#include "coupling/program/refused_line.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/nearest_name.h"
#include "discrete/files/text_file.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr char footer[] =
      "Exit codes: 0 done; 1 an internal check failed (please report it); 2 wrong input; 3 not converged, or stopped (results\n"
      "are kept); 4 the system failed: disk, folder, library, script (the message lists the kept files)";

    // The commands, each with only those options that it uses.
    class Commands
    {
    public:
      explicit Commands(CommandLine &line)
          : line(line),
            app("Computes one granular sample twice, as grains and as a continuum, and compares both", "diptych")
      {
        app.require_subcommand(1);
        app.set_version_flag("--version", built_with());
        add_run();
        for (const auto &[name, description] : python_commands)
          app.add_subcommand(name, description);
        add_panels();
        add_solve();
        add_results();
        add_others();
        for (CLI::App *command : app.get_subcommands({}))
          command->footer(example_of(command->get_name()) + "\n\n" + command->get_footer());
        std::string examples = "Examples:\n";
        for (const auto &[name, group, example] : command_examples)
          {
            app.get_subcommand(name)->group(group);
            if (const std::string command = name; command == "new" || command == "run" || command == "calibrate")
              examples += "    " + std::string(example) + "\n";
          }
        app.footer(examples + "\n" + footer);
      }

      CLI::App &parser() { return app; }

      Command chosen() const
      {
        for (const auto &[subcommand, command] : by_parser)
          if (subcommand->parsed())
            return command;
        throw std::logic_error("a command line without a command");
      }

    private:
      CLI::App *add(const Command command, const std::string &description)
      {
        CLI::App *added  = app.add_subcommand(name_of(command), description);
        by_parser[added] = command;
        return added;
      }

      // clang-format off
      void add_scene(CLI::App *to) { to->add_option("SCENE", line.target, "scene file, .prm or .json")->required()->type_name(""); }
      void add_output(CLI::App *to, const char *what = "result folder (default: results/<scene name>)") { to->add_option("--output", line.output, what)->type_name("DIR")->check(is_filled); }
      void add_set(CLI::App *to)
      {
        to->add_option("--set", line.overrides, "section/key=value: change one key of the scene; may be repeated")
          ->allow_extra_args(false)->type_name("KEY=VALUE");
        to->add_option("--set-file", line.set_files, "file of keys as calibrate writes it (.prm); if a key is in both, --set wins")
          ->allow_extra_args(false)->type_name("FILE");
      }
      void add_scene_output_set(CLI::App *to) { add_scene(to); add_output(to); add_set(to); }
      void add_threads(CLI::App *to) { to->add_option("--threads", line.threads, "threads of the contact solver, 1 to 1024; every number gives the same bits")->check(in_range(1, 1024))->type_name("N"); }
      void add_resume(CLI::App *to, const std::string &what) { to->add_flag("--resume", line.resume, "continue the results in the folder: " + what); }
      void add_quiet(CLI::App *to) { to->add_flag("--quiet", line.quiet, "print neither progress nor notes"); }
      // clang-format on

      // An option with which Python parses the words.
      void add_for_python(CLI::App *to, const char *option, const char *type, const char *meaning)
      {
        to->add_option_function<std::string>(
            option, [](const std::string &) {}, meaning)
          ->type_name(type);
      }

      // To be called after add_resume().
      void add_overwrite(CLI::App *to)
      {
        CLI::Option *overwrite = to->add_flag("--overwrite", line.overwrite,
                                              "rename results in the folder to DIR.1 and begin again");
        if (CLI::Option *resume = to->get_option_no_throw("--resume"))
          overwrite->excludes(resume);
      }

      // A value of an enum that has a table of names.
      template <class Choice, class Take> void add_choice(CLI::App *to, const char *option, const char *meaning, const Take &take)
      {
        to->add_option_function<std::string>(
            option, [take](const std::string &name) { take(*discrete::value_of<Choice>(name)); }, meaning)
          ->check(one_of(choices_of(Choice())))
          ->type_name("{" + discrete::joined(choices_of(Choice()), ",") + "}");
      }

      void add_run()
      {
        CLI::App *run = add(Command::run, "compute grains and continuum, compare them and draw the report");
        add_scene_output_set(run);
        add_threads(run);
        add_resume(run, "an interrupted run, or other keys of the continuum or the comparison");
        add_overwrite(run);
        add_for_python(run, "--seeds", "LIST", "compute many samples: a list like 1-8 or 1,3,5-7");
        run->footer("Other options of many samples, such as --jobs and --levels: diptych run --seeds 1-8 --help");
        run->add_flag("--check", line.checks_only, "check the scene and print the resources; computes nothing");
        add_quiet(run);
      }

      void add_panels()
      {
        CLI::App *grains = add(Command::discrete, "compute only the grains");
        add_scene_output_set(grains);
        add_threads(grains);
        add_resume(grains, "an interrupted run");
        add_overwrite(grains);
        add_quiet(grains);

        CLI::App *continuum = add(Command::continuum, "compute only the continuum; also under mpirun");
        add_scene_output_set(continuum);
        add_resume(continuum, "an interrupted run");
        add_overwrite(continuum);
        add_quiet(continuum);

        CLI::App *point = add(Command::material_point, "compute the continuum's law at one point: material_point.csv");
        add_scene_output_set(point);
        point->add_option("--path", line.path, path_help())->check(path_or_table)->type_name("PATH");
        add_overwrite(point);
        add_quiet(point);

        CLI::App *law = add(Command::check_law, "check tangent, objectivity, dissipation, repeatability of a law of your own");
        law->add_option("SCENE", line.target, "scene file, or a shared library, .so, with its usual parameters")
          ->required()
          ->type_name("");
        add_set(law);
        add_quiet(law);
      }

      void add_solve()
      {
        CLI::App *solve = add(Command::solve,
                              "solve one stored contact problem (FCLIB layout) and print sweeps, residual, seconds");
        solve->add_option("PROBLEM", line.target, "problem file, .h5 or .hdf5")->required()->type_name("");
        solve->add_option("--output", line.output, "file for the problem with its solution")->check(is_filled)->type_name("FILE");
        add_choice<discrete::ContactSolver>(solve, "--solver", "psor (default): over-relaxed; nsgs: plain Gauss-Seidel",
                                            [this](const auto chosen) { line.solve.options.solver = chosen; });
        solve
          ->add_option(
            "--tolerance", line.solve.options.tolerance,
            "largest residual: natural map relative to |r|; velocities to 100 times that, relative to |q| (default: 1e-8)")
          ->check(in_range(1e-300, 0.999999))
          ->type_name("NUMBER");
        solve->add_option("--max-sweeps", line.solve.options.max_sweeps, "largest number of sweeps (default: 1000000)")
          ->check(in_range(1, 2147483647))
          ->type_name("N");
        add_choice<discrete::ProblemForm>(solve, "--form", "default: body if the file has one",
                                          [this](const auto chosen) { line.solve.form = chosen; });
        add_threads(solve);
      }

      void add_results()
      {
        CLI::App *compare = add(Command::compare, "compare the panels of a result folder again, or evaluate an ensemble again");
        compare->add_option("DIR", line.target, "result folder")->required()->type_name("");
        add_set(compare);
        add_for_python(compare, "--measured", "DIR",
                       "put the measurement in a folder of `diptych import field` beside the panels");
        add_quiet(compare);
      }

      void add_others()
      {
        add(Command::new_scene, "print a commented scene to begin with: diptych new biaxial > my.prm")
          ->add_option("TEMPLATE", line.target, "name of the template (default: list them)")
          ->type_name("");
        CLI::App *explain = add(Command::explain, "print every key of a scene (default, unit, range, meaning) or the content of "
                                                  "result files");
        explain
          ->add_option(
            "SECTION", line.target,
            "a section, a key or a word in names of keys; results: the content of result files (default: all sections)")
          ->type_name("{" + discrete::joined(section_names(), ",") + ",results}");
        explain->add_option("WORD", line.word, "after results: only entries whose file, name or meaning contains this word")
          ->type_name("");
        explain->add_flag("--json", line.prints_json, "all keys and entries of result files as JSON");
        add(Command::completion,
            "print a script that completes command lines; zsh loads it, too: source <(diptych completion bash)")
          ->add_option("SHELL", line.target, "the script also serves zsh")
          ->required()
          ->check(one_of({"bash"}))
          ->type_name("{bash}");
      }

      CommandLine                  &line;
      CLI::App                      app;
      std::map<CLI::App *, Command> by_parser;
    };
  } // namespace

  void require_text(const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      if (discrete::first_non_utf8(word) != std::string::npos || word.find('\n') != std::string::npos)
        throw SceneError("an argument contains a line break or is not valid UTF-8: '" + word + "'");
  }

  ParsedLine parse_command_line(const std::vector<std::string> &words)
  {
    ParsedLine parsed;
    Commands   commands(parsed.line);
    CLI::App  &app   = commands.parser();
    parsed.line.text = "diptych";
    for (const std::string &word : words)
      parsed.line.text += " " + word;
    if (words.empty() || words[0] == "help")
      {
        std::cout << app.help();
        parsed.exit_code = words.empty() ? wrong_input : done;
        return parsed;
      }
    try
      {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        parsed.line.command = commands.chosen();
        take_set_files(parsed.line);
      }
    catch (const CLI::Success &asked) // for help or the version
      {
        parsed.exit_code = app.exit(asked);
      }
    catch (const CLI::ParseError &error)
      {
        std::cerr << refusal(app, words, error) << std::endl;
        parsed.exit_code = wrong_input;
      }
    catch (const SceneError &error)
      {
        std::cerr << "diptych: " << error.what() << std::endl;
        parsed.exit_code = wrong_input;
      }
    return parsed;
  }
} // namespace diptych::coupling
