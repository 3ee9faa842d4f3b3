// diptych: Python binding of whole runs, for the workers of campaigns
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/run_binding.h"

#include <fstream>
#include <iostream>

#include <pybind11/stl.h>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"

namespace diptych::python
{
  namespace
  {
    constexpr unsigned int most_seconds = 60; // of a worker that nobody waits for any more: a step and its checkpoint

    // So that the peak memory of a run is its own, and not that of one before it.
    void forget_peak_memory()
    {
      std::ofstream("/proc/self/clear_refs") << 5;
    }

    // The exit code; an error is a message on standard error.
    int reported(const RunnableCommand &command, const coupling::CommandLine &line, const coupling::Scene &scene)
    {
      try
        {
          coupling::leave_if_stopped(coupling::name_of(line.command));
          const int code = command.run(line, coupling::with_options(line, scene));
          std::cout.flush();
          return code;
        }
      catch (const std::exception &error)
        {
          std::cerr << coupling::text_of_end(error) << std::endl;
          return coupling::code_of(error);
        }
    }
  } // namespace

  void bind_runs(pybind11::module_ &m, const std::map<std::string, RunnableCommand> &commands, void (*begin)())
  {
    namespace py = pybind11;
    // Writes the results of a scene to a folder and returns the exit code. options: file (of the scene), text (the command for
    // provenance.json), threads, resume
    m.def("run", [commands](const std::string &command, const coupling::Scene &scene, const std::string &folder,
                            const py::dict &options) {
      const RunnableCommand &chosen = commands.at(command);
      coupling::CommandLine  line;
      line.command = chosen.command;
      line.output  = folder;
      line.target  = options["file"].cast<std::string>();
      line.text    = options["text"].cast<std::string>();
      line.threads = options["threads"].cast<int>();
      line.resume  = options["resume"].cast<bool>();
      line.quiet   = true;
      forget_peak_memory();
      return reported(chosen, line, scene);
    });
    // program: path of `diptych`
    m.def("become_worker", [begin](const std::string &program) {
      coupling::end_after_parent(most_seconds);
      coupling::set_own_path(program);
      coupling::block_stop_signals(); // MPI takes signals to itself, and its threads must not get these
      begin();
      coupling::install_signals();
    });
  }
} // namespace diptych::python
