// diptych: what every C++ test uses: the library, files that live as long as a test, and what a refusal says
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace diptych::tests
{
  // A folder of its own, removed with the files in it.
  struct Folder
  {
    std::string path = testing::TempDir() + "diptych_XXXXXX";

    Folder() { EXPECT_NE(::mkdtemp(path.data()), nullptr); }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder &) = delete;
    std::string operator/(const std::string &name) const { return path + "/" + name; }
  };

  // The message with which an action refuses its input; empty if it does not.
  template <class Error = std::invalid_argument, class Action> std::string refusal(const Action &action)
  {
    try
      {
        action();
      }
    catch (const Error &error)
      {
        return error.what();
      }
    return "";
  }

  // The message of a refusal without the name of the file at its beginning.
  template <class Action> std::string complaint(const std::string &path, const Action &action)
  {
    const std::string what = refusal(action);
    return what.rfind(path, 0) == 0 ? what.substr(path.size()) : what;
  }

  inline void expect_words(const std::string &text, const std::vector<std::string> &words)
  {
    EXPECT_NE(text, "") << "nothing was refused";
    for (const std::string &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing in: " << text;
  }

  template <class Error = std::invalid_argument, class Action>
  void expect_refused(const std::vector<std::string> &words, const Action &action)
  {
    expect_words(refusal<Error>(action), words);
  }
} // namespace diptych::tests
