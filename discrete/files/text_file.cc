// diptych: text files that are complete or absent, and files to which lines are appended
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/text_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace diptych::discrete
{
  namespace
  {
    // 0, or the error number.
    int write_all(const int file, const std::string &text)
    {
      for (std::size_t done = 0; done < text.size();)
        {
          const ssize_t n = ::write(file, text.data() + done, text.size() - done);
          if (n < 0 && errno != EINTR)
            return errno;
          done += n > 0 ? std::size_t(n) : 0;
        }
      return 0;
    }

    [[noreturn]] void fail(const std::string &path, const int error)
    {
      throw std::runtime_error("cannot write " + path + ": " + std::strerror(error));
    }

    struct OpenFile
    {
      const int id;
      ~OpenFile() { ::close(id); }
    };

    std::string whole_text(const std::string &path, const std::size_t most_bytes, const CheckStop &check_stop)
    {
      const OpenFile file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
      if (file.id < 0)
        throw std::invalid_argument(path + ": cannot be read: " + std::strerror(errno));
      std::string text, piece(1 << 16, '\0');
      for (ssize_t n = 1; n != 0 && text.size() <= most_bytes;)
        {
          call(check_stop);
          n = ::read(file.id, piece.data(), piece.size());
          if (n < 0 && errno != EINTR)
            throw std::invalid_argument(path + ": cannot be read: " + std::strerror(errno));
          text.append(piece, 0, n > 0 ? std::size_t(n) : 0);
        }
      return text;
    }
  } // namespace

  std::string read_text(const std::string &path)
  {
    std::error_code none;
    if (!std::filesystem::is_regular_file(path, none))
      return {};
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::size_t first_non_utf8(const std::string &text)
  {
    const auto byte = [&](const std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
    for (std::size_t k = 0; k < text.size();)
      {
        const unsigned int lead   = byte(k);
        const std::size_t  length = lead < 0x80 ? 1 : lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
        // The second byte of the longest forms has a narrower range: no overlong one, no surrogate, nothing beyond U+10FFFF.
        const unsigned int low  = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
        const unsigned int high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
        if (lead == 0 || length == 0 || (length > 1 && (byte(k + 1) < low || byte(k + 1) > high)))
          return k;
        for (std::size_t more = 2; more < length; ++more)
          if ((byte(k + more) & 0xC0) != 0x80)
            return k;
        k += length;
      }
    return std::string::npos;
  }

  void require_regular_file(const std::string &path)
  {
    std::error_code none;
    const auto      kind = std::filesystem::status(path, none).type(); // follows links
    if (kind == std::filesystem::file_type::directory)
      throw std::invalid_argument(path + ": cannot be read: " + std::strerror(EISDIR));
    if (std::filesystem::exists(std::filesystem::file_status(kind)) && kind != std::filesystem::file_type::regular)
      throw std::invalid_argument(path + ": is not a regular file");
  }

  std::string read_input(const std::string &path, const std::size_t most_bytes, const CheckStop &check_stop)
  {
    require_regular_file(path);
    std::string text = whole_text(path, most_bytes, check_stop);
    if (const std::size_t bad = first_non_utf8(text); bad < most_bytes && bad != std::string::npos)
      throw std::invalid_argument(
        path + ", line " + std::to_string(1 + std::count(text.begin(), text.begin() + off_t(bad), '\n')) +
        ": contains a byte of value " + std::to_string(static_cast<unsigned char>(text[bad])) + ", which is not UTF-8 text");
    if (text.size() > most_bytes)
      throw std::invalid_argument(path + ": is longer than the " + std::to_string(most_bytes) +
                                  " bytes that such a file may have");
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
      text.erase(0, 3);
    return text;
  }

  std::string temporary_for(const std::string &path)
  {
    std::string     temporary = path + ".part";
    std::error_code none;
    if (std::filesystem::is_symlink(temporary, none))
      std::filesystem::remove(temporary, none); // we must not write to the target of a link
    return temporary;
  }

  void write_text(const std::string &path, const std::string &text)
  {
    const std::string temporary = temporary_for(path);
    const int         file      = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file < 0)
      fail(path, errno);
    int error = write_all(file, text);
    if (::close(file) != 0 && error == 0)
      error = errno;
    if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0)
      error = errno;
    if (error != 0)
      {
        std::remove(temporary.c_str());
        fail(path, error);
      }
  }

  void append_text(const std::string &path, const std::string &lines)
  {
    const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file < 0)
      fail(path, errno);
    const off_t before = ::lseek(file, 0, SEEK_END);
    const int   error  = write_all(file, lines);
    if (error != 0 && ::ftruncate(file, before) != 0)
      {} // readers ignore an incomplete line
    ::close(file);
    if (error != 0)
      fail(path, error);
  }

  void keep_lines(const std::string &path, const std::size_t n)
  {
    require_regular_file(path);
    std::ifstream in(path, std::ios::binary);
    if (!in)
      fail(path, errno);
    std::size_t kept = 0, read = 0, lines = 0; // a last line without its end is incomplete
    for (char c; lines < n && in.get(c);)
      {
        ++read;
        if (c == '\n')
          {
            ++lines;
            kept = read;
          }
      }
    if (::truncate(path.c_str(), off_t(kept)) != 0)
      fail(path, errno);
  }
} // namespace diptych::discrete
