// diptych: wrong input, as data and as a message
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace diptych::coupling
{
  // Place of an input: a file with its line (0: no line), or an option of the command line.
  struct Place
  {
    Place() = default;
    Place(const char *file)
        : file(file)
    {}
    Place(std::string file, const int line = 0)
        : file(std::move(file)),
          line(line)
    {}

    std::string file;
    int         line = 0;
  };

  inline std::string text_of(const Place &place)
  {
    return place.file + (place.line > 0 ? ", line " + std::to_string(place.line) : "");
  }

  // The parts of a message; members that do not apply are empty.
  struct Refusal
  {
    Place       place;
    std::string key     = {}; // section/key of a scene, or a section
    std::string value   = {}; // as the user gave it
    std::string allowed = {}; // the range or the choices
    std::string hint    = {}; // what to do
  };

  // "scene.prm, line 12: discrete/friction = '-0.3' is not allowed; give a number from 0 to 100 [-]"
  inline std::string worded(const Refusal &r, const std::string &problem)
  {
    const std::string place = text_of(r.place);
    return place + (place.empty() ? "" : ": ") + r.key + (r.value.empty() ? "" : " = '" + r.value + "'") +
           (r.key.empty() ? "" : " ") + problem + (r.allowed.empty() ? "" : "; give " + r.allowed) +
           (r.hint.empty() ? "" : "; " + r.hint);
  }

  // Exit code 2. The message gives file, line, key, value, allowed values and a way out, as far as they are known.
  struct SceneError : std::invalid_argument
  {
    using std::invalid_argument::invalid_argument;
    SceneError(Refusal refused, const std::string &problem)
        : std::invalid_argument(worded(refused, problem)),
          refusal(std::move(refused))
    {}

    Refusal refusal;
  };
} // namespace diptych::coupling
