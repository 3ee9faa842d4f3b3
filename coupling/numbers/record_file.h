// diptych: reads the JSON files of this program, with checks
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace diptych::coupling
{
  // Throws std::invalid_argument with the file's name if it is missing or not a JSON object.
  nlohmann::json read_record_file(const std::string &path);

  std::string plain_text(const nlohmann::json::exception &error);

  // The result of `take` for a record of the file. Throws std::invalid_argument with the file's name if an entry is missing or
  // has another type.
  template <class Take> auto from_record(const std::string &path, Take &&take)
  {
    try
      {
        return take();
      }
    catch (const nlohmann::json::exception &error)
      {
        throw std::invalid_argument(path + ": has entries that this version does not write: " + plain_text(error));
      }
  }
} // namespace diptych::coupling
