// diptych: describes keys and sets a key from a text
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/scene/keys.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "discrete/files/csv_file.h"

namespace diptych::coupling
{
  namespace
  {
    template <class Number> std::optional<Number> parsed(std::string text)
    {
      const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
      text = first == std::string::npos ? "" : text.substr(first, last - first + 1);
      if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.erase(0, 1);
      Number     value{};
      const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
      return !text.empty() && end.ec == std::errc() && end.ptr == text.data() + text.size() ? std::optional<Number>(value)
                                                                                            : std::nullopt;
    }
  } // namespace

  std::string text_of(const double value)
  {
    return discrete::exact_text(value);
  }

  std::string text_of(const std::optional<double> &value)
  {
    return value ? text_of(*value) : "auto";
  }

  std::string text_of(const std::vector<double> &values)
  {
    std::string text;
    for (const double value : values)
      text += (text.empty() ? "" : ", ") + text_of(value);
    return text;
  }

  std::string allowed_number(const Range &range)
  {
    return "a number from " + text_of(range[0]) + " to " + text_of(range[1]);
  }

  std::optional<double> read_number(const std::string &text, const Range &range)
  {
    const std::optional<double> value = parsed<double>(text);
    return value && *value >= range[0] && *value <= range[1] ? value : std::nullopt; // false for NaN
  }

  std::optional<int> read_whole(const std::string &text, const Range &range)
  {
    const std::optional<int> value = parsed<int>(text);
    return value && *value >= range[0] && *value <= range[1] ? value : std::nullopt;
  }

  std::optional<std::vector<double>> read_list(const std::string &text, const Range &range)
  {
    std::vector<double> values;
    if (text.find_first_not_of(" \t") == std::string::npos)
      return values;
    for (std::size_t begin = 0; begin <= text.size();)
      {
        const std::size_t           end   = std::min(text.find(',', begin), text.size());
        const std::optional<double> value = read_number(text.substr(begin, end - begin), range);
        if (!value)
          return std::nullopt;
        values.push_back(*value);
        begin = end + 1;
      }
    return values;
  }

  std::string resolved(const std::string &path, const std::string &folder)
  {
    if (path.empty())
      return path;
    const std::filesystem::path base = folder.empty() ? std::filesystem::path(".") : std::filesystem::path(folder);
    return std::filesystem::absolute(base / path).lexically_normal().string();
  }
} // namespace diptych::coupling
