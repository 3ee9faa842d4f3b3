// diptych: what a geometry of the user's must not say
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/mesh/geo_script.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <stdexcept>

#include "continuum/mesh/geo_words.h"

namespace diptych::continuum
{
  namespace
  {
    // gmsh's lexer cuts a text after 1023 characters and takes the rest for commands; it reads at most 8192 characters of a line
    // at once, and a loop begins anew behind those that it has read.
    constexpr std::size_t longest_text = 1023, longest_line = 8000;

    struct Script
    {
      std::string file;
      std::string plain; // without comments
      std::string code;  // and without texts; both with all lines and columns of the file

      [[noreturn]] void refuse(const std::size_t at, const std::string &what) const
      {
        const auto line = 1 + std::count(plain.begin(), plain.begin() + std::ptrdiff_t(at), '\n');
        throw std::invalid_argument(file + ", line " + std::to_string(line) + ": " + what);
      }
    };

    bool begins_a_word(const char c)
    {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    }

    bool is_digit_of_geo(const char c)
    {
      return c >= '0' && c <= '9';
    }

    std::size_t end_of_word(const std::string &code, std::size_t k)
    {
      while (k < code.size() && (begins_a_word(code[k]) || is_digit_of_geo(code[k])))
        ++k;
      return k;
    }

    // As gmsh's lexer has it: 1SystemCall is a number and a word.
    std::size_t end_of_number(const std::string &code, std::size_t k)
    {
      const auto past_digits = [&](std::size_t from) {
        while (from < code.size() && is_digit_of_geo(code[from]))
          ++from;
        return from;
      };
      k = past_digits(k);
      if (k < code.size() && code[k] == '.')
        k = past_digits(k + 1);
      if (k < code.size() && (code[k] == 'e' || code[k] == 'E'))
        {
          const std::size_t first = k + 1 + (k + 1 < code.size() && (code[k + 1] == '+' || code[k + 1] == '-') ? 1 : 0);
          if (past_digits(first) > first)
            k = past_digits(first);
        }
      return k;
    }

    void blank(std::string &text, const std::size_t from, const std::size_t to)
    {
      std::replace_if(
        text.begin() + std::ptrdiff_t(from), text.begin() + std::ptrdiff_t(to), [](const char c) { return c != '\n'; }, ' ');
    }

    // Ends of a comment or of a text that begins at k; k where none does.
    std::size_t end_of_comment(const Script &script, const std::size_t k)
    {
      const std::string &text = script.plain;
      if (text.compare(k, 2, "//") == 0)
        return std::min(text.size(), text.find('\n', k));
      if (text.compare(k, 2, "/*") != 0)
        return k;
      const std::size_t end = text.find("*/", k + 2);
      if (end == std::string::npos)
        script.refuse(k, "a comment begins that does not end");
      return end + 2;
    }

    std::size_t end_of_text(const Script &script, const std::size_t k)
    {
      const std::string &text = script.plain;
      if (text[k] != '"' && text[k] != '\'')
        return k;
      const std::size_t end = text.find(text[k], k + 1);
      if (end == std::string::npos || std::min(text.size(), text.find('\n', k)) < end)
        script.refuse(k, "a text between quotes must end on its line");
      if (end - k - 1 > longest_text)
        script.refuse(k, "a text between quotes has " + std::to_string(end - k - 1) + " characters; gmsh takes at most " +
                           std::to_string(longest_text));
      return end + 1;
    }

    void check_characters(const Script &script)
    {
      const std::string &text = script.plain;
      std::size_t        line = 0;
      for (std::size_t k = 0; k < text.size(); ++k)
        {
          const auto c = static_cast<unsigned char>(text[k]);
          if (c == '\r' ? text.compare(k, 2, "\r\n") != 0 : (c < ' ' && c != '\t' && c != '\n' && c != '\f') || c == 127)
            script.refuse(k, "a control character (number " + std::to_string(c) + ") is no part of a geometry");
          line = c == '\n' ? 0 : line + 1;
          if (line > longest_line)
            script.refuse(k, "the line is longer than " + std::to_string(longest_line) + " characters; break it");
        }
    }

    Script script_of(const std::string &file, const std::string &text)
    {
      Script script{file, text, {}};
      check_characters(script);
      for (std::size_t k = 0; k < text.size();)
        {
          std::size_t end = end_of_comment(script, k);
          blank(script.plain, k, end);
          if (end == k)
            end = std::max(k + 1, end_of_text(script, k));
          k = end;
        }
      script.code = script.plain;
      for (std::size_t k = 0; k < text.size();)
        {
          const std::size_t end = end_of_text(script, k);
          blank(script.code, k + (end > k ? 1 : 0), end - (end > k ? 1 : 0)); // the quotes stay
          k = std::max(k + 1, end);
        }
      return script;
    }

    std::size_t past_blanks(const std::string &code, const std::size_t k)
    {
      return std::min(code.size(), code.find_first_not_of(" \t\r\n\f", k));
    }

    std::size_t past_brackets(const std::string &code, std::size_t k)
    {
      for (int depth = 0; k < code.size() && code[k] != ';'; ++k)
        {
          depth += code[k] == '(' || code[k] == '[' ? 1 : code[k] == ')' || code[k] == ']' ? -1 : 0;
          if (depth <= 0)
            return past_blanks(code, k + (code[k] == ')' || code[k] == ']' ? 1 : 0));
        }
      return k;
    }

    // `Word =`, `Word() +=`, `For Word In`, from the end of the word on.
    bool is_set(const std::string &code, const std::size_t end)
    {
      const std::size_t k = past_brackets(code, past_blanks(code, end));
      if (k + 1 >= code.size())
        return false;
      const std::string two = code.substr(k, 2);
      return (two[0] == '=' && two[1] != '=') || two == "+=" || two == "-=" || two == "*=" || two == "/=" ||
             (two == "In" && end_of_word(code, k) == k + 2);
    }

    // A variable is followed by an operator or a bracket, a command by what it works on.
    bool stands_as_a_value(const std::string &code, const std::size_t end)
    {
      const std::size_t k = past_blanks(code, end);
      if (k >= code.size() || code.compare(k, 2, "In") == 0)
        return true;
      return !begins_a_word(code[k]) && !is_digit_of_geo(code[k]) && code[k] != '"' && code[k] != '\'';
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

    template <class Action> void for_each_word(const std::string &code, const Action &action)
    {
      char before = ' '; // the last character that is no blank
      for (std::size_t k = 0; k < code.size();)
        {
          std::size_t end = k + 1;
          if (begins_a_word(code[k]))
            action(k, end = end_of_word(code, k), before == '.');
          else if (is_digit_of_geo(code[k]))
            end = end_of_number(code, k);
          if (past_blanks(code, k) == k)
            before = begins_a_word(code[k]) || is_digit_of_geo(code[k]) ? 'a' : code[k];
          k = end;
        }
    }
  } // namespace

  std::string checked_geo_script(const std::string &file, const std::string &text)
  {
    const Script          script = script_of(file, text);
    const std::string    &code   = script.code;
    std::set<std::string> variables;
    for_each_word(code, [&](const std::size_t k, const std::size_t end, bool) {
      if (is_set(code, end))
        variables.insert(code.substr(k, end - k));
    });
    for_each_word(code, [&](const std::size_t k, const std::size_t end, const bool is_member) {
      const std::string word       = code.substr(k, end - k);
      const bool        is_capital = word[0] >= 'A' && word[0] <= 'Z';
      const bool        is_own     = !is_capital || is_member || (variables.count(word) > 0 && stands_as_a_value(code, end));
      if (is_never_allowed(word) || !(makes_shapes(word) || is_own))
        script.refuse(k, "'" + word +
                           "' is not allowed in a geometry; allowed are shapes, physical groups, sizes, options of "
                           "Geometry and Mesh and variables that the file sets; or let gmsh make the .msh file");
      if ((word == "Printf" || word == "Error" || word == "Warning") && goes_to_a_file(code, end))
        script.refuse(k, "'" + word + "' to a file is not allowed in a geometry");
    });
    return script.plain;
  }
} // namespace diptych::continuum
