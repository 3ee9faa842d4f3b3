// diptych: completion of command lines for fish
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/fish_completion.h"

#include <CLI/App.hpp>

#include "coupling/program/option_values.h"

namespace diptych::coupling
{
  namespace
  {
    // In single quotes, in which fish knows two escapes.
    std::string quoted(const std::string &text)
    {
      std::string out = "'";
      for (const char c : text)
        out += (c == '\'' || c == '\\' ? std::string("\\") : std::string()) + c;
      return out + "'";
    }

    std::string under(const std::string &command)
    {
      return "complete -c diptych -n '__fish_seen_subcommand_from " + command + "'";
    }

    std::string option_line(const std::string &command, const CLI::Option &option)
    {
      const std::string values = values_of(option);
      std::string       line   = under(command) + " -l " + option.get_lnames().front();
      if (option.get_lnames().front() == "set")
        line += " -x -a '(__diptych_keys)'";
      else if (!values.empty())
        line += " -x -a " + quoted(values);
      else if (option.get_expected_max() > 0)
        line += " -r";
      return line + " -d " + quoted(option.get_description()) + "\n";
    }
  } // namespace

  std::string fish_completion(CLI::App &app, const std::vector<KeyDescription> &keys)
  {
    std::string text = "# diptych: completion, made by `diptych completion fish`\nfunction __diptych_keys\n";
    for (const KeyDescription &key : keys)
      {
        const std::string name = key.section + "/" + key.name + "=";
        text += "  printf '%s\\t%s\\n' " + quoted(name) + " " + quoted(key.meaning) + "\n";
        for (const std::string &choice : key.choices)
          text += "  echo " + quoted(name + choice) + "\n";
      }
    text += "end\ncomplete -c diptych -n __fish_use_subcommand -f\n"
            "complete -c diptych -n __fish_use_subcommand -l help -d 'the commands'\n"
            "complete -c diptych -n __fish_use_subcommand -l version -d 'what it was built with'\n";
    for (CLI::App *command : app.get_subcommands({}))
      {
        const std::string name = command->get_name();
        text += "complete -c diptych -n __fish_use_subcommand -a " + name + " -d " + quoted(command->get_description()) + "\n";
        for (const CLI::Option *option : command->get_options())
          if (!option->get_lnames().empty())
            text += option_line(name, *option);
          else if (const std::string values = values_of(*option); !values.empty())
            text += under(name) + " -f -a " + quoted(values) + "\n";
      }
    return text;
  }
} // namespace diptych::coupling
