// diptych: completion of command lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/completion.h"

#include <sstream>

#include <CLI/App.hpp>

#include "coupling/program/option_values.h"
#include "coupling/scene/scene_file.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    std::string assignments(const std::vector<KeyDescription> &keys)
    {
      std::vector<std::string> words;
      for (const KeyDescription &key : keys)
        words.push_back(key.section + "/" + key.name + "=");
      return discrete::joined(words);
    }

    std::string offer(const std::string &pattern, const std::string &words)
    {
      return "    \"" + pattern + "\") COMPREPLY=($(compgen -W \"" + words + "\" -- \"$word\")); return ;;\n";
    }

    // After `--set section/key=`, which bash divides at the sign.
    std::string values_of_keys(const std::vector<KeyDescription> &keys)
    {
      std::string lines;
      for (const KeyDescription &key : keys)
        if (!key.choices.empty())
          lines += offer(key.section + "/" + key.name, discrete::joined(key.choices));
      return lines;
    }

    std::string words_of(CLI::App &command)
    {
      std::string words;
      for (const CLI::Option *option : command.get_options())
        if (option->get_lnames().empty())
          words += values_of(*option);
      return words;
    }

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

    // Commands and options with their meanings, the keys of a scene behind --set (those of few values with each of them), files
    // else.
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
              "complete -c diptych -n __fish_use_subcommand -l version -d 'version and libraries'\n";
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
  } // namespace

  std::vector<std::string> option_names(CLI::App &command)
  {
    std::vector<std::string> names;
    for (const CLI::Option *option : command.get_options())
      for (const std::string &name : option->get_lnames())
        names.push_back("--" + name);
    return names;
  }

  std::string completion_script(CLI::App &app, const std::string &shell)
  {
    const std::vector<KeyDescription> keys = described_keys();
    if (shell == "fish")
      return fish_completion(app, keys);
    std::ostringstream       out;
    std::vector<std::string> commands;
    std::string              choices; // a line for each option that has a few
    out << (shell == "zsh" ? "#compdef diptych\n" : "") << "# diptych: completion, made by `diptych completion " << shell
        << "`\n";
    if (shell == "zsh")
      out << "autoload -U +X bashcompinit && bashcompinit\n";
    out << "_diptych()\n{\n  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options=\"\" words=\"\" "
           "key=\"\"\n"
        << "  case ${COMP_WORDS[1]} in\n";
    for (CLI::App *command : app.get_subcommands({}))
      {
        commands.push_back(command->get_name());
        out << "    " << command->get_name() << ") options=\"" << discrete::joined(option_names(*command)) << "\" words=\""
            << words_of(*command) << "\" ;;\n";
        for (const CLI::Option *option : command->get_options())
          if (const std::string values = values_of(*option); !values.empty() && !option->get_lnames().empty())
            choices += offer(command->get_name() + " --" + option->get_lnames().front(), values);
      }
    out << "  esac\n  case \"${COMP_WORDS[1]} $before\" in\n"
        << choices << "  esac\n  if [ \"$before\" = = ]; then\n    key=${COMP_WORDS[COMP_CWORD-2]}\n"
        << "  elif [ \"$word\" = = ]; then\n    key=$before word=\"\"\n  fi\n  case \"$key\" in\n"
        << values_of_keys(keys) << "  esac\n  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    COMPREPLY=($(compgen -W \""
        << discrete::joined(commands) << " --help --version\" -- \"$word\"))\n"
        << "  elif [ \"$before\" = --set ]; then\n    compopt -o nospace 2>/dev/null\n    COMPREPLY=($(compgen -W \""
        << assignments(keys) << "\" -- \"$word\"))\n"
        << "  elif [ \"${word#-}\" != \"$word\" ]; then\n    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
        << "  elif [ -n \"$words\" ]; then\n    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
        << "  else\n    compopt -o filenames 2>/dev/null\n    COMPREPLY=($(compgen -f -- \"$word\"))\n  fi\n}\n"
        << "complete -F _diptych diptych\n";
    if (shell == "zsh") // from a folder of functions: it is called once as what it then defines
      out << "if [ \"$funcstack[1]\" = _diptych ]; then _bash_complete -F _diptych; fi\n";
    return out.str();
  }
} // namespace diptych::coupling
