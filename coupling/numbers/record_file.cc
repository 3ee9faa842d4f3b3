// diptych: reads the JSON files of this program, with checks
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/numbers/record_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <unistd.h>

#include "discrete/files/text_file.h"

namespace diptych::coupling
{
  using nlohmann::json;

  json read_record_file(const std::string &path)
  {
    constexpr int most_levels = 64; // because the values are visited recursively
    const auto    not_endless = [](const int depth, json::parse_event_t, const json &) {
      if (depth > most_levels)
        throw std::invalid_argument("nests more than " + std::to_string(most_levels) + " levels");
      return true;
    };
    if (access(path.c_str(), R_OK) != 0 && errno != ENOENT)
      throw std::runtime_error(path + ": cannot be read: " + std::strerror(errno));
    try
      {
        json record = json::parse(discrete::read_text(path), not_endless);
        if (record.is_object())
          return record;
        throw std::invalid_argument("is not a JSON object");
      }
    catch (const json::exception &error)
      {
        throw std::invalid_argument(path + (std::filesystem::exists(path) ? ": no JSON: " + plain_text(error) : ": is missing"));
      }
    catch (const std::invalid_argument &error)
      {
        throw std::invalid_argument(path + ": " + error.what());
      }
  }

  std::string plain_text(const json::exception &error)
  {
    const std::string what = error.what(); // the library's name and number precede the text in brackets
    const std::size_t end  = what.find("] ");
    return end == std::string::npos ? what : what.substr(end + 2);
  }
} // namespace diptych::coupling
