// diptych: the arrows of the house, read from the #include lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include <unistd.h>

namespace
{
  namespace fs = std::filesystem;

  // What each folder may include of the project, and which libraries it must not know.
  const std::map<std::string, std::set<std::string>> allowed             = {{"discrete", {"discrete"}},
                                                                            {"continuum", {"continuum"}},
                                                                            {"coupling", {"discrete", "continuum", "coupling"}}};
  const std::map<std::string, std::set<std::string>> forbidden_libraries = {
    {"discrete", {"deal.II", "gmsh", "Trilinos", "Epetra"}}};

  std::vector<std::string> includes_of(const fs::path &file)
  {
    std::vector<std::string> includes;
    std::ifstream            in(file);
    const std::regex         include("^\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
    std::smatch              match;
    for (std::string line; std::getline(in, line);)
      if (std::regex_match(line, match, include))
        includes.push_back(match[1]);
    return includes;
  }

  // Text of every violation below `root`; empty when the house stands.
  std::vector<std::string> violations(const fs::path &root)
  {
    std::vector<std::string> found;
    for (const auto &[folder, may_include] : allowed)
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(root / folder))
        if (entry.path().extension() == ".h" || entry.path().extension() == ".cc")
          for (const std::string &include : includes_of(entry.path()))
            {
              const std::string target = include.substr(0, include.find('/'));
              const bool        ours   = allowed.count(target) > 0 && include.find('/') != std::string::npos;
              if (ours && may_include.count(target) == 0)
                found.push_back(entry.path().string() + " includes " + include);
              if (forbidden_libraries.count(folder) > 0)
                for (const std::string &library : forbidden_libraries.at(folder))
                  if (include.rfind(library, 0) == 0)
                    found.push_back(entry.path().string() + " includes " + include);
            }
    return found;
  }

  TEST(House, ArrowsRunFromCouplingToThePanelsAndNoOtherWay)
  {
    int files = 0;
    for (const auto &[folder, may_include] : allowed)
      for (const fs::directory_entry &entry : fs::recursive_directory_iterator(fs::path(DIPTYCH_SOURCE_DIR) / folder))
        files += entry.path().extension() == ".cc";
    EXPECT_GT(files, 20) << "the test must have read the sources";
    for (const std::string &violation : violations(DIPTYCH_SOURCE_DIR))
      ADD_FAILURE() << violation;
  }

  // The test itself must be able to fail: a house with one wrong arrow and one wrong library.
  TEST(House, AWrongArrowIsSeen)
  {
    const fs::path root = fs::path(testing::TempDir()) / ("house" + std::to_string(::getpid()));
    for (const auto &[folder, may_include] : allowed)
      fs::create_directories(root / folder);
    std::ofstream(root / "continuum" / "a.cc") << "#include \"discrete/state.h\"\n#include \"continuum/mesh.h\"\n";
    std::ofstream(root / "discrete" / "b.h") << "#include <deal.II/base/tensor.h>\n#include <vector>\n";
    EXPECT_EQ(violations(root).size(), 2u);
    fs::remove_all(root);
  }
} // namespace
