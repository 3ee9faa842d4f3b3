// diptych: the assignments in the text of a scene
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/scene_text.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include <strings.h>

#include "coupling/scene/scene_error.h"
#include "discrete/files/text_file.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    // Up to the first # without a \ before it; \# becomes #.
    std::string without_comment(const std::string &line)
    {
      std::string kept;
      for (const char c : line)
        {
          const bool escaped = !kept.empty() && kept.back() == '\\';
          if (c == '#' && !escaped)
            break;
          if (c == '#')
            kept.pop_back();
          kept += c;
        }
      return std::string(discrete::trimmed(kept));
    }

    std::size_t n_last_backslashes(const std::string &text)
    {
      const std::size_t other = text.find_last_not_of('\\');
      return text.size() - (other == std::string::npos ? 0 : other + 1);
    }

    // The text after a keyword (in letters of either case) and at least one blank; empty if the line begins otherwise.
    std::optional<std::string> after(const std::string &keyword, const std::string &line)
    {
      if (line.size() <= keyword.size() || strncasecmp(line.c_str(), keyword.c_str(), keyword.size()) != 0 ||
          (line[keyword.size()] != ' ' && line[keyword.size()] != '\t'))
        return std::nullopt;
      return std::string(discrete::trimmed(line.substr(keyword.size())));
    }
    // An empty file, as a full disk leaves it, is not the scene of defaults. A lone carriage return would hide all lines but
    // the first.
    void demand_text(const std::string &file, const std::string &text)
    {
      if (text.find_first_not_of(" \t\r\n") == std::string::npos)
        throw SceneError(file + ": is empty; a scene that leaves every key at its default says so in a comment, '# ...'");
      for (std::size_t at = text.find('\r'); at != std::string::npos; at = text.find('\r', at + 1))
        if (at + 1 < text.size() && text[at + 1] != '\n')
          throw SceneError(file + ", line " + std::to_string(1 + std::count(text.begin(), text.begin() + long(at), '\n')) +
                           ": contains a lone carriage return; end lines with a line feed or with both");
    }
  } // namespace

  std::istringstream scene_input(const std::string &file)
  {
    constexpr std::size_t most_bytes = 16 << 20;
    std::string           text;
    try
      {
        text = discrete::read_input(file, most_bytes);
      }
    catch (const std::invalid_argument &error)
      {
        throw SceneError(error.what());
      }
    demand_text(file, text);
    return std::istringstream(text);
  }

  std::vector<Entry> entries_of_prm(const std::string &file, std::istream &in)
  {
    const std::string            folder = std::filesystem::path(file).parent_path().string();
    std::vector<Entry>           entries;
    std::map<std::string, Place> places; // of the keys
    std::string                  section, raw;
    int                          number = 0;
    while (std::getline(in, raw))
      {
        const Place place(file, ++number);
        std::string line = without_comment(raw);
        while (n_last_backslashes(line) % 2 == 1 && std::getline(in, raw))
          {
            line = std::string(discrete::trimmed(line.substr(0, line.size() - 1))) + " " + without_comment(raw);
            ++number;
          }
        if (n_last_backslashes(line) % 2 == 1)
          throw SceneError({place}, "the line ends with \\, which continues it on the next one, but the file ends");
        line.resize(line.size() - n_last_backslashes(line) / 2);
        if (line.empty())
          continue;
        if (const auto name = after("subsection", line))
          {
            if (!section.empty())
              throw SceneError({place, section}, "is not closed by 'end' before subsection '" + *name + "'");
            demand_section(place, *name);
            section = *name;
          }
        else if (strcasecmp(line.c_str(), "end") == 0)
          {
            if (section.empty())
              throw SceneError({place}, "'end' without a subsection");
            section.clear();
          }
        else if (const auto set = after("set", line); set && set->find('=') != std::string::npos && set->find('=') > 0)
          {
            const std::string key(discrete::trimmed(set->substr(0, set->find('='))));
            const auto [first, is_first] = places.try_emplace(section + "/" + key, place);
            if (!is_first)
              throw SceneError({place, section + "/" + key}, "is set twice, first in " + text_of(first->second));
            entries.push_back({section, key, std::string(discrete::trimmed(set->substr(set->find('=') + 1))), place, folder});
          }
        else
          throw SceneError({place}, "'" + line + "' is neither 'subsection NAME', 'set KEY = VALUE' nor 'end'");
      }
    if (!section.empty())
      throw SceneError({{file, number}, section}, "has no 'end'");
    return entries;
  }

  std::string prm_value(const std::string &value)
  {
    if (value.find_first_of("\n\r") != std::string::npos)
      throw SceneError("'" + value + "' holds a line break");
    std::string text;
    for (const char c : value)
      text += c == '#' ? "\\#" : std::string(1, c);
    return text + std::string(n_last_backslashes(value), '\\');
  }

  Entry entry_of_override(const std::string &text)
  {
    const std::size_t slash = text.find('/'), equals = text.find('=');
    if (slash == std::string::npos || equals == std::string::npos || slash == 0 || equals <= slash + 1 ||
        text.substr(slash + 1, equals - slash - 1).find('/') != std::string::npos)
      {
        const std::string keys = slash == std::string::npos && equals > 0 ? keys_with(text.substr(0, equals)) : "";
        throw SceneError("--set " + text + ": not of the form section/key=value" + (keys.empty() ? "" : "; " + keys));
      }
    return {text.substr(0, slash), text.substr(slash + 1, equals - slash - 1),
            std::string(discrete::trimmed(text.substr(equals + 1))), Place("--set " + text), ""};
  }
} // namespace diptych::coupling
