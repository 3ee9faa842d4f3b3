// diptych: reads lines of words and numbers from other codes' text files
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/import/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupling/processes/stop_signal.h"
#include "coupling/scene/scene_error.h"
#include "discrete/files/words.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr char        blanks[]                = " \t\r\f\v";
    constexpr std::size_t lines_between_questions = 4096; // checks for a stop request this often

    std::string content_of(const std::string &path)
    {
      std::error_code none;
      if (std::filesystem::exists(path, none) && !std::filesystem::is_regular_file(path, none))
        throw SceneError(path + ": is not a file but a " + (std::filesystem::is_directory(path, none) ? "folder" : "device") +
                         "; a file is needed");
      std::ifstream in(path, std::ios::binary);
      if (!in)
        throw SceneError(path + ": cannot be opened; is it there and readable?");
      std::ostringstream out;
      out << in.rdbuf();
      std::string text = out.str();
      if (text.empty())
        throw SceneError(path + ": is empty");
      if (const std::size_t zero = text.find('\0'); zero != std::string::npos)
        throw SceneError(path + ": byte " + std::to_string(zero) + " is 0; a text file is needed");
      if (text.back() != '\n')
        throw SceneError(path + ", line " + std::to_string(1 + std::count(text.begin(), text.end(), '\n')) +
                         ": has no line end; is the file truncated? If not, add a line end");
      return text;
    }

    std::string shown(std::string_view word)
    {
      std::string text;
      for (const char c : word.substr(0, 60))
        text += c >= ' ' && c < 127 ? c : '?';
      return "'" + text + (word.size() > 60 ? "..." : "") + "'";
    }
  } // namespace

  TextLines::TextLines(const std::string &path)
      : path_(path),
        text_(content_of(path))
  {
    for (std::size_t start = 0; start < text_.size();)
      {
        starts_.push_back(start);
        const std::size_t end = text_.find('\n', start);
        start                 = end == std::string::npos ? text_.size() : end + 1;
      }
  }

  std::string_view TextLines::peek() const
  {
    if (at_end())
      return {};
    const std::size_t end = next_ + 1 < starts_.size() ? starts_[next_ + 1] : text_.size();
    std::string_view  line(text_.data() + starts_[next_], end - starts_[next_]);
    while (!line.empty() && (line.back() == '\n' || line.back() == '\r'))
      line.remove_suffix(1);
    return line;
  }

  std::string_view TextLines::take(const std::string &expected)
  {
    if (at_end())
      throw SceneError(path_ + ", line " + std::to_string(starts_.size() + 1) + ": the file ends; expected " + expected);
    if (next_ % lines_between_questions == 0)
      leave_if_stopped("import");
    const std::string_view line = peek();
    ++next_;
    return line;
  }

  void TextLines::refuse(const std::string &why) const
  {
    throw SceneError(path_ + ", line " + std::to_string(line()) + ": " + why);
  }

  double TextLines::number(std::string_view word, const std::string &what) const
  {
    // Fortran writes 0.1D+02, and std::from_chars does not accept a plus sign.
    char        buffer[64];
    std::size_t n = 0;
    for (const char c : word)
      if (n < sizeof buffer - 1)
        buffer[n++] = c == 'D' || c == 'd' ? 'e' : c;
    const char *first = buffer, *last = buffer + n;
    if (n > 1 && *first == '+' && first[1] != '-')
      ++first;
    double     value  = 0;
    const auto result = std::from_chars(first, last, value);
    if (word.size() >= sizeof buffer || result.ptr != last || result.ec == std::errc::invalid_argument)
      refuse(what + " = " + shown(word) + " is not a number");
    if (result.ec == std::errc::result_out_of_range)
      refuse(what + " = " + shown(word) + " is beyond double precision");
    if (!std::isfinite(value))
      refuse(what + " = " + shown(word) + " is not finite");
    return value;
  }

  long TextLines::whole(std::string_view word, const std::string &what) const
  {
    long       value  = 0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || result.ptr != word.data() + word.size() || result.ec != std::errc())
      {
        const double as_number = number(word, what); // Python loops write ids as 12.0
        if (as_number != std::floor(as_number) || std::abs(as_number) > 9e15)
          refuse(what + " = " + shown(word) + " is not a whole number");
        return long(as_number);
      }
    return value;
  }

  double TextLines::positive(std::string_view word, const std::string &what) const
  {
    const double value = number(word, what);
    if (!(value > 0))
      refuse(what + " = " + shown(word) + " must be positive");
    return value;
  }

  std::vector<std::string_view> words_of(std::string_view line)
  {
    std::vector<std::string_view> words;
    if (const char mark = line.find(';') != std::string_view::npos ? ';' : ','; line.find(mark) != std::string_view::npos)
      {
        for (std::size_t start = 0; start != std::string_view::npos;)
          {
            const std::size_t comma = line.find(mark, start);
            words.push_back(discrete::trimmed(line.substr(start, comma == std::string_view::npos ? comma : comma - start)));
            start = comma == std::string_view::npos ? comma : comma + 1;
          }
        return words;
      }
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;)
      {
        const std::size_t end = line.find_first_of(blanks, at);
        words.push_back(line.substr(at, end == std::string_view::npos ? end : end - at));
        at = end == std::string_view::npos ? end : line.find_first_not_of(blanks, end);
      }
    return words;
  }

  long number_in_name(const std::string &path)
  {
    const std::string name = std::filesystem::path(path).filename().string();
    std::size_t       end  = name.find_last_of("0123456789");
    if (end == std::string::npos)
      return -1;
    std::size_t first = end;
    while (first > 0 && name[first - 1] >= '0' && name[first - 1] <= '9')
      --first;
    long value = -1;
    std::from_chars(name.data() + first, name.data() + end + 1, value);
    return value;
  }
} // namespace diptych::coupling
