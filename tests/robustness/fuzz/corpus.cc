// diptych: a fuzzer's kept inputs, one after the other, where there is no fuzzer
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <iostream>
#include <vector>

#include "discrete/files/text_file.h"
#include "fuzz.h"

int main(const int argc, char **argv)
{
  std::vector<std::string> files;
  for (int k = 1; k < argc; ++k)
    for (const auto &entry : std::filesystem::directory_iterator(argv[k]))
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  for (const std::string &file : files)
    {
      std::cout << file << std::endl; // the last one named is the one that a finding is about
      const std::string bytes = diptych::discrete::read_text(file);
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size());
    }
  std::cout << files.size() << " inputs" << std::endl;
  return files.empty() ? 1 : 0;
}
