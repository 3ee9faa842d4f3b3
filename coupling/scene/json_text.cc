// diptych: JSON with the line of each member
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/json_text.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "coupling/numbers/record_file.h"

namespace diptych::coupling
{
  namespace
  {
    using nlohmann::ordered_json;

    constexpr int most_levels = 32;    // of objects and lists in each other; values are walked recursively
    constexpr int most_keys   = 10000; // an object finds its keys one after the other

    // The keys of the open objects. The parser silently drops one of two equal keys.
    struct UniqueKeys
    {
      std::vector<std::set<std::string>> open; // by depth

      void begin(const int depth)
      {
        open.resize(std::max(open.size(), std::size_t(depth) + 2));
        open[std::size_t(depth) + 1].clear();
      }
      bool take(const int depth, const std::string &key) { return open.at(std::size_t(depth)).insert(key).second; }
    };

    // The parser gives no lines, so texts are found again in the order of the file.
    struct FindLines
    {
      const std::string          &text;
      std::map<std::string, int> &lines;
      std::size_t                 at   = 0;
      int                         line = 1; // line of `at`

      void pass(const std::string &quoted)
      {
        const std::size_t found = text.find(quoted, at);
        if (found == std::string::npos)
          return;
        line += int(std::count(text.begin() + std::ptrdiff_t(at), text.begin() + std::ptrdiff_t(found + quoted.size()), '\n'));
        at = found + quoted.size();
      }

      void walk(const ordered_json &value, const std::string &pointer)
      {
        if (value.is_string())
          pass(value.dump());
        if (value.is_object())
          for (const auto &[key, member] : value.items())
            {
              pass(ordered_json(key).dump());
              std::string name = key;
              for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 2))
                name.replace(slash, 1, "~1");
              lines[pointer + "/" + name] = line;
              walk(member, pointer + "/" + name);
            }
        else if (value.is_array())
          for (std::size_t k = 0; k < value.size(); ++k)
            {
              walk(value[k], pointer + "/" + std::to_string(k));
              lines.emplace(pointer + "/" + std::to_string(k), line);
            }
      }
    };

    long line_reached(const std::string &text, std::istringstream &in)
    {
      const auto at = std::streamoff(in.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in));
      return 1 + std::count(text.begin(), text.begin() + std::clamp(at, std::streamoff(0), std::streamoff(text.size())), '\n');
    }
  } // namespace

  Place JsonText::place(const std::string &pointer) const
  {
    // A member without a line has that of the member that holds it.
    for (std::string name = pointer; !name.empty(); name.erase(name.rfind('/')))
      if (const auto found = lines.find(name); found != lines.end())
        return {file, found->second};
    return {file, 1};
  }

  JsonText read_json_text(const std::string &file, std::istream &in)
  {
    std::ostringstream buffer;
    buffer << in.rdbuf();
    const std::string text = buffer.str();
    JsonText          result{file, {}, {}};
    try
      {
        using Event = ordered_json::parse_event_t;
        std::istringstream in_text(text); // says how far the parser is
        int                n_keys = 0;
        UniqueKeys         keys;
        const auto         check = [&](const int depth, const Event event, const ordered_json &value) {
          n_keys += event == Event::key;
          if (depth > most_levels)
            throw SceneError(file + ": nests more than " + std::to_string(most_levels) + " levels");
          if (n_keys > most_keys)
            throw SceneError(file + ": holds more than " + std::to_string(most_keys) + " keys");
          if (event == Event::object_start)
            keys.begin(depth);
          if (event == Event::key && !keys.take(depth, value.get<std::string>()))
            throw SceneError(file + ", line " + std::to_string(line_reached(text, in_text)) + ": key '" +
                                     value.get<std::string>() + "' occurs twice in one object");
          return true;
        };
        result.root = ordered_json::parse(in_text, check, true, /* comments */ true);
      }
    catch (const nlohmann::json::parse_error &error)
      {
        const auto line = 1 + std::count(text.begin(), text.begin() + std::min(text.size(), std::size_t(error.byte)), '\n');
        throw SceneError(file + ", line " + std::to_string(line) + ": is not valid JSON: " + plain_text(error));
      }
    catch (const nlohmann::json::exception &error) // a number beyond all, which it quotes
      {
        const std::string what = plain_text(error);
        const std::size_t from = what.find('\''), to = what.rfind('\'');
        const std::size_t at  = from < to ? text.find(what.substr(from + 1, to - from - 1)) : std::string::npos;
        const auto        end = text.begin() + std::ptrdiff_t(at == std::string::npos ? 0 : at);
        throw SceneError(file + ", line " + std::to_string(1 + std::count(text.begin(), end, '\n')) +
                         ": is not valid JSON: " + what);
      }
    if (!result.root.is_object())
      throw SceneError(file + ", line 1: an object is needed, { ... }");
    FindLines{text, result.lines}.walk(result.root, "");
    return result;
  }

  std::string value_text(const ordered_json &value)
  {
    if (value.is_string())
      return value.get<std::string>();
    if (!value.is_array())
      return value.dump();
    std::string list;
    for (const ordered_json &item : value)
      list += (list.empty() ? "" : ", ") + value_text(item);
    return list;
  }
} // namespace diptych::coupling
