// diptych: text files that are whole or absent, and tables that grow at their end
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/text_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
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
  } // namespace

  std::string read_text(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void write_text(const std::string &path, const std::string &text)
  {
    const std::string temporary = path + ".part";
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
      {} // the line that is left half is no line: readers want its end
    ::close(file);
    if (error != 0)
      fail(path, error);
  }

  void keep_lines(const std::string &path, const std::size_t n)
  {
    std::ifstream in(path, std::ios::binary);
    if (!in)
      fail(path, errno);
    std::size_t kept = 0, read = 0, lines = 0; // a last line without its end is none
    for (char c; lines < n && in.get(c);)
      {
        ++read;
        if (c == '\n')
          ++lines, kept = read;
      }
    if (::truncate(path.c_str(), off_t(kept)) != 0)
      fail(path, errno);
  }
} // namespace diptych::discrete
