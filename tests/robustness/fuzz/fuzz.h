// diptych: what the fuzzers have in common
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <unistd.h>

namespace diptych::fuzz
{
  // A folder in memory where the system has one, removed at the end of the process.
  class Folder
  {
  public:
    Folder()
    {
      const std::filesystem::path memory = "/dev/shm";
      std::string                 name =
        ((is_directory(memory) ? memory : std::filesystem::temp_directory_path()) / "diptych_fuzz_XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr)
        std::abort();
      path = name;
    }
    ~Folder()
    {
      std::error_code none;
      std::filesystem::remove_all(path, none);
    }
    Folder(const Folder &)            = delete;
    Folder &operator=(const Folder &) = delete;

    std::string put(const std::string &name, const std::string_view bytes) const
    {
      const std::string file = path + "/" + name;
      std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
      return file;
    }

    std::string path;
  };

  [[noreturn]] inline void finding(const std::string &text)
  {
    std::fprintf(stderr, "FINDING: %s\n", text.c_str());
    std::abort();
  }

  // Wrong input is std::invalid_argument that names what lies in the folder or, where a file is missing, the format or the frame:
  // no library's exception does. Whatever else is thrown is a finding. True where nothing was.
  template <class Read> bool is_taken(const std::string &folder, Read &&read)
  {
    try
      {
        read();
        return true;
      }
    catch (const std::invalid_argument &error)
      {
        const std::string what = error.what();
        if (what.find(folder) == std::string::npos && what.rfind("import ", 0) != 0 && what.rfind("frame ", 0) != 0)
          finding("names no file: " + what);
        return false;
      }
    catch (const std::exception &error)
      {
        finding(std::string("not the user's fault by its type: ") + error.what());
      }
  }

  // The first byte chooses one of n ways, the rest is content.
  struct Choice
  {
    Choice(const std::uint8_t *data, const std::size_t size, const unsigned n)
        : way(size > 0 ? data[0] % n : 0),
          content(size > 0 ? std::string_view(reinterpret_cast<const char *>(data) + 1, size - 1) : std::string_view())
    {}

    unsigned         way;
    std::string_view content;
  };
} // namespace diptych::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);
