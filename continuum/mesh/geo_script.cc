// diptych: what a geometry of the user's must not say
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/geo_script.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

namespace diptych::continuum
{
  namespace
  {
    // Keywords of the language (gmsh's reference manual, "General commands", "Other plugins", "Options").
    const std::set<std::string> refused = {
      "SystemCall", "NonBlockingSystemCall", "OnelabRun", "OnelabAction", "Exit",  "Abort",     "Save", "Print", "Merge",
      "Include",    "ShapeFromFile",         "Plugin",    "CreateDir",    "Sleep", "UnlinkFile"};
    const std::set<std::string> families = {"General", "Solver", "Print", "PostProcessing", "View", "Plugin"};

    // The text with comments, and what stands between quotes, as blanks; lines stay.
    std::string code_of(std::string text)
    {
      const auto ends_at = [&](const std::size_t from, const std::string &mark) {
        return std::min(text.size(),
                        text.find(mark, from) == std::string::npos ? text.size() : text.find(mark, from) + mark.size());
      };
      for (std::size_t k = 0; k < text.size(); ++k)
        {
          std::size_t end = k;
          if (text.compare(k, 2, "//") == 0)
            end = std::min(text.size(), text.find('\n', k));
          else if (text.compare(k, 2, "/*") == 0)
            end = ends_at(k + 2, "*/");
          else if (text[k] == '"' || text[k] == '\'')
            end = ends_at(k + 1, std::string(1, text[k]));
          for (; k < end; ++k)
            text[k] = text[k] == '\n' ? '\n' : ' ';
        }
      return text;
    }

    bool is_letter(const char c)
    {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    // `Printf(...) > FILE`, from the end of the word on.
    bool goes_to_a_file(const std::string &code, std::size_t k)
    {
      for (int depth = 0; k < code.size() && code[k] != ';'; ++k)
        {
          depth += code[k] == '(' || code[k] == '[' ? 1 : code[k] == ')' || code[k] == ']' ? -1 : 0;
          if (depth == 0 && code[k] == '>')
            return true;
        }
      return false;
    }
  } // namespace

  void check_geo_script(const std::string &file, const std::string &text)
  {
    const std::string code   = code_of(text);
    const auto        refuse = [&](const std::size_t at, const std::string &what) {
      throw std::invalid_argument(
               file + ", line " + std::to_string(1 + std::count(code.begin(), code.begin() + std::ptrdiff_t(at), '\n')) + ": " + what +
               " in a geometry; allowed are shapes, physical groups and options of Geometry and "
                      "Mesh; or let gmsh make the .msh file");
    };
    for (std::size_t k = 0; k < code.size(); ++k)
      {
        if (!is_letter(code[k]))
          continue;
        std::size_t end = k;
        while (end < code.size() && is_letter(code[end]))
          ++end;
        const std::string word = code.substr(k, end - k);
        if (refused.count(word) > 0 || (families.count(word) > 0 && end < code.size() && (code[end] == '.' || code[end] == '[')))
          refuse(k, "'" + word + "' is not allowed");
        if (word == "Printf" && goes_to_a_file(code, end))
          refuse(k, "'Printf' to a file is not allowed");
        k = end - 1;
      }
  }
} // namespace diptych::continuum
