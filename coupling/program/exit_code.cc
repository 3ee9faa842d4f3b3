// diptych: how the program ends on what is thrown
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/exit_code.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "coupling/processes/stop_signal.h"
#include "discrete/files/out_of_memory.h"

namespace diptych::coupling
{
  std::string text_of_end(const std::exception &error)
  {
    return "diptych: " + discrete::text_of(error);
  }

  namespace
  {
    // Names that no file can have: no machine would take them.
    bool is_impossible_name(const std::exception &error)
    {
      const auto *of_path = dynamic_cast<const std::filesystem::filesystem_error *>(&error);
      return of_path != nullptr &&
             (of_path->code() == std::errc::filename_too_long || of_path->code() == std::errc::not_a_directory ||
              of_path->code() == std::errc::too_many_symbolic_link_levels);
    }
  } // namespace

  int code_of(const std::exception &error)
  {
    if (is_impossible_name(error))
      return wrong_input;
    if (discrete::is_out_of_memory(error))
      return system_failure;
    if (dynamic_cast<const StoppedOnRequest *>(&error) != nullptr)
      return not_converged;
    return dynamic_cast<const std::invalid_argument *>(&error) != nullptr ? wrong_input
           : dynamic_cast<const std::logic_error *>(&error) != nullptr    ? invariant
                                                                          : system_failure;
  }
} // namespace diptych::coupling
