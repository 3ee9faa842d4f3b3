// diptych: message for a wrong command line
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/refused_line.h"

#include "coupling/scene/keys.h"
#include "discrete/files/nearest_name.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    std::vector<std::string> command_names(CLI::App &app)
    {
      std::vector<std::string> names;
      for (const CLI::App *command : app.get_subcommands({}))
        names.push_back(command->get_name());
      return names;
    }

    // Options of a command in their typed form: --set, --help.
    std::vector<std::string> option_names(CLI::App &command)
    {
      std::vector<std::string> names;
      for (const CLI::Option *option : command.get_options())
        for (const std::string &name : option->get_lnames())
          names.push_back("--" + name);
      return names;
    }

    // Message for a line that names no command.
    std::string refused_command(CLI::App &app, const std::vector<std::string> &words, const std::string &error)
    {
      const std::vector<std::string> names     = command_names(app);
      const std::string             &first     = words.front();
      const bool                     is_option = first.rfind('-', 0) == 0;
      return "diptych: " +
             (is_option ? error
                        : "'" + first + "' is not a command; the nearest is '" + discrete::nearest_name(first, names) + "'") +
             "; the commands are " + discrete::joined(names) + "; see diptych --help";
    }

    // "; it is an option of diptych run" for an option that only other commands have.
    std::string owners_of(CLI::App &app, const std::string &option)
    {
      std::vector<std::string> owners;
      for (CLI::App *command : app.get_subcommands({}))
        for (const std::string &name : option_names(*command))
          if (name == option)
            owners.push_back("diptych " + command->get_name());
      return owners.empty() ? "" : "; it is an option of " + discrete::listed(owners);
    }

    // "; the nearest option is '--output'" for an option, as --outptu=FOLDER, that no command has. "; write --set B=2" for B=2.
    std::string way_out_of(CLI::App &asked, const std::string &option)
    {
      if (option.rfind("--", 0) != 0)
        return option.find('=') != std::string::npos && asked.get_option_no_throw("--set") != nullptr
                 ? "; write --set before every key: --set " + option
                 : "";
      return "; the nearest option is '" + discrete::nearest_name(option.substr(0, option.find('=')), option_names(asked)) + "'" +
             (asked.get_name() == "run" ? "; with --seeds there are more: diptych run --seeds 1-2 --help" : "");
    }
  } // namespace

  std::string refusal(CLI::App &app, const std::vector<std::string> &words, const CLI::ParseError &error)
  {
    const std::vector<CLI::App *> found = app.get_subcommands();
    if (found.empty())
      return refused_command(app, words, error.what());
    CLI::App   &asked = *found.front();
    std::string text  = error.what();
    if (const std::vector<std::string> extra = asked.remaining(true); !extra.empty())
      {
        const std::string owners = owners_of(app, extra.front());
        text                     = "unexpected argument '" + discrete::joined(extra) + "'" +
               (owners.empty() ? way_out_of(asked, extra.front()) : owners);
      }
    else if (error.get_name() == "ValidationError")
      return "diptych " + asked.get_name() + ": " + text;
    else if (text.find("At Most 1") != std::string::npos)
      return "diptych " + asked.get_name() + ": " + text.substr(0, text.find(':')) + " is given more than once";
    return "diptych " + asked.get_name() + ": " + text + "; options: " + discrete::joined(option_names(asked));
  }
} // namespace diptych::coupling
