// diptych: the page of a result folder, drawn by the Python package
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/report_page.h"

#include <filesystem>
#include <stdexcept>

#include "coupling/processes/child_process.h"
#include "coupling/processes/stop_signal.h"
#include "coupling/program/exit_code.h"
#include "coupling/program/python_package.h"
#include "coupling/store/file_names.h"
#include "coupling/version.h"

namespace diptych::coupling
{
  namespace fs = std::filesystem;

  std::string report_file(const std::string &directory)
  {
    return fs::absolute(report_html(directory)).lexically_normal().string();
  }

  void draw_page(const std::string &directory, const std::string &next)
  {
    const std::string part = report_html(next) + ".part"; // stays if the process is killed
    int               code = 0;
    use_python_package("report");
    try
      {
        code = run_program({python, "-m", "diptych.report", "page", directory, next});
      }
    catch (const StoppedOnRequest &)
      {
        fs::remove(part);
        throw StoppedOnRequest("drawing the report: stopped on request; to draw it: diptych compare " + directory);
      }
    if (code != 0)
      fs::remove(part);
    if (code == wrong_input)
      throw std::invalid_argument(directory + ": the report could not be drawn");
    if (code != 0)
      throw std::runtime_error("the report could not be drawn: " + std::string(python) + " -m diptych.report page " + directory +
                               " ended with exit code " + std::to_string(code));
  }
} // namespace diptych::coupling
