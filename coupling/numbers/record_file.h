// diptych: files in JSON that this program wrote, read back with doubt
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace diptych::coupling
{
  // Throws std::invalid_argument naming the file where it is missing or no JSON object.
  nlohmann::json read_record_file(const std::string &path);

  // What the library says, without its own name and number.
  std::string plain_text(const nlohmann::json::exception &error);

  // What `take` makes of a record of the file. An entry that is missing or of another type is std::invalid_argument naming the
  // file.
  template <class Take> auto from_record(const std::string &path, Take &&take)
  {
    try
      {
        return take();
      }
    catch (const nlohmann::json::exception &error)
      {
        throw std::invalid_argument(path + ": holds what this version does not write: " + plain_text(error));
      }
  }
} // namespace diptych::coupling
