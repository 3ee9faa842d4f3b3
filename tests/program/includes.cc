// diptych: the arrows of the house, read from the #include lines
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
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

  // The folders of the project that each folder may include, and the libraries that it must not know.
  const std::map<std::string, std::set<std::string>> allowed             = {{"discrete", {"discrete"}},
                                                                            {"continuum", {"continuum"}},
                                                                            {"coupling", {"discrete", "continuum", "coupling"}}};
  const std::map<std::string, std::set<std::string>> forbidden_libraries = {
    {"discrete", {"deal.II", "gmsh", "Trilinos", "Epetra"}}};

  // The rooms of each folder from the ground up: a room may include itself and those before it. Headers beside the rooms are the
  // folder's public ones: any room may include them, but may not reach a room above its own through them.
  const std::map<std::string, std::vector<std::string>> rooms = {
    {"discrete", {"files", "bodies", "contacts", "solvers", "stepping", "problem_files", "samples", "panel"}},
    {"continuum", {"laws", "mesh", "elements", "equilibrium", "panel"}},
    {"coupling",
     {"cells", "statistics", "numbers", "processes", "averaging", "fields", "bands", "probes", "scene", "store", "comparison",
      "grains", "panels", "program", "python"}}};

  std::vector<std::string> includes_of(const fs::path &file)
  {
    std::vector<std::string> includes;
    std::ifstream            in(file);
    const std::regex         include("\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
    std::smatch              match;
    for (std::string line; std::getline(in, line);)
      if (line.find("include") != std::string::npos && std::regex_match(line, match, include))
        includes.push_back(match[1]);
    return includes;
  }

  // Path below the root -> what it includes, of every source of a folder.
  std::map<std::string, std::vector<std::string>> sources(const fs::path &root, const std::string &folder)
  {
    std::map<std::string, std::vector<std::string>> found;
    for (const fs::directory_entry &entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cc")
        found[fs::relative(entry.path(), root).string()] = includes_of(entry.path());
    return found;
  }

  std::string folder_of(const std::string &path)
  {
    return path.substr(0, path.find('/'));
  }

  // "contacts" of discrete/contacts/law.h; "" of discrete/snapshot.h.
  std::string room_of(const std::string &path)
  {
    const std::size_t first = path.find('/'), second = path.find('/', first + 1);
    return second == std::string::npos ? "" : path.substr(first + 1, second - first - 1);
  }

  // Text of every violation below `root`; empty when the house stands.
  std::vector<std::string> violations(const fs::path &root)
  {
    std::vector<std::string> found;
    for (const auto &[folder, may_include] : allowed)
      for (const auto &[file, includes] : sources(root, folder))
        for (const std::string &include : includes)
          {
            const std::string target = folder_of(include);
            if (allowed.count(target) > 0 && include.find('/') != std::string::npos && may_include.count(target) == 0)
              found.push_back(file + " includes " + include);
            if (forbidden_libraries.count(folder) > 0)
              for (const std::string &library : forbidden_libraries.at(folder))
                if (include.rfind(library, 0) == 0)
                  found.push_back(file + " includes " + include);
          }
    return found;
  }

  using Sources = std::map<std::string, std::vector<std::string>>;

  // Rooms that `file` includes, directly or through headers beside the rooms.
  void reach_rooms(const Sources &all, const std::string &file, std::set<std::string> &followed, std::set<std::string> &reached)
  {
    const auto found = all.find(file);
    if (found == all.end())
      return;
    for (const std::string &include : found->second)
      if (folder_of(include) == folder_of(file) && !room_of(include).empty())
        reached.insert(include);
      else if (folder_of(include) == folder_of(file) && followed.insert(include).second)
        reach_rooms(all, include, followed, reached);
  }

  // Arrows between rooms that run upward, and rooms that have no place in the order.
  std::vector<std::string> upward_arrows(const fs::path &root)
  {
    std::vector<std::string> found;
    for (const auto &[folder, order] : rooms)
      {
        const auto floor = [&order = order](const std::string &room) {
          return std::find(order.begin(), order.end(), room) - order.begin();
        };
        const Sources all = sources(root, folder);
        for (const auto &[file, includes] : all)
          {
            const std::string room = room_of(file);
            if (room.empty())
              continue;
            if (floor(room) == long(order.size()))
              found.push_back(file + " is in a room that has no place in the order");
            std::set<std::string> followed, reached;
            reach_rooms(all, file, followed, reached);
            for (const std::string &include : reached)
              if (floor(room_of(include)) > floor(room))
                found.push_back(file + " includes " + include + " of a room above its own");
          }
      }
    return found;
  }

  // A header and its source are one unit. The first circle of units, as text; empty where there is none.
  std::string circle(const fs::path &root, const std::string &folder)
  {
    const auto                                   unit = [](const std::string &path) { return path.substr(0, path.rfind('.')); };
    std::map<std::string, std::set<std::string>> arrows;
    for (const auto &[file, includes] : sources(root, folder))
      for (const std::string &include : includes)
        if (folder_of(include) == folder && unit(include) != unit(file))
          arrows[unit(file)].insert(unit(include));
    // Units without arrows to remaining units are removed. Those that remain are part of a circle or depend on one.
    bool changed = true;
    while (changed)
      {
        changed = false;
        for (auto it = arrows.begin(); it != arrows.end();)
          {
            const bool free = std::none_of(it->second.begin(), it->second.end(),
                                           [&](const auto &to) { return arrows.count(to) > 0; });
            changed         = changed || free;
            it              = free ? arrows.erase(it) : std::next(it);
          }
      }
    if (arrows.empty())
      return "";
    std::vector<std::string> path = {arrows.begin()->first};
    while (std::count(path.begin(), path.end(), path.back()) < 2)
      path.push_back(*std::find_if(arrows[path.back()].begin(), arrows[path.back()].end(),
                                   [&](const auto &to) { return arrows.count(to) > 0; }));
    std::string text;
    for (auto it = std::find(path.begin(), path.end(), path.back()); it != path.end(); ++it)
      text += (text.empty() ? "" : " -> ") + *it;
    return text;
  }

  // Headers that the section "Public headers" of a panel's README lists.
  std::set<std::string> public_headers(const fs::path &root, const std::string &panel)
  {
    std::ifstream         in(root / panel / "README.md");
    std::set<std::string> found;
    const std::regex      header("`([a-z0-9_/]+\\.h)`");
    bool                  inside = false;
    for (std::string line; std::getline(in, line);)
      {
        if (line.rfind("## ", 0) == 0)
          inside = line == "## Public headers";
        if (inside)
          for (std::sregex_iterator match(line.begin(), line.end(), header), end; match != end; ++match)
            found.insert(panel + "/" + (*match)[1].str());
      }
    return found;
  }

  TEST(House, ArrowsRunFromCouplingToThePanelsAndNoOtherWay)
  {
    std::size_t files = 0;
    for (const auto &[folder, may_include] : allowed)
      files += sources(DIPTYCH_SOURCE_DIR, folder).size();
    EXPECT_GT(files, 200u) << "the test must have read the sources";
    for (const std::string &violation : violations(DIPTYCH_SOURCE_DIR))
      ADD_FAILURE() << violation;
  }

  TEST(House, ArrowsBetweenRoomsRunDownward)
  {
    for (const std::string &arrow : upward_arrows(DIPTYCH_SOURCE_DIR))
      ADD_FAILURE() << arrow;
  }

  TEST(House, NoUnitsIncludeEachOtherInACircle)
  {
    for (const auto &[folder, order] : rooms)
      EXPECT_EQ(circle(DIPTYCH_SOURCE_DIR, folder), "");
  }

  // coupling/ includes of a panel what the panel's README calls public, and all of that is there.
  TEST(House, OnlyPublicHeadersOfAPanelAreIncludedFromOutside)
  {
    for (const std::string panel : {"discrete", "continuum"})
      {
        const std::set<std::string> listed = public_headers(DIPTYCH_SOURCE_DIR, panel);
        EXPECT_GT(listed.size(), 5u);
        for (const std::string &header : listed)
          EXPECT_TRUE(fs::exists(fs::path(DIPTYCH_SOURCE_DIR) / header)) << header;
        for (const auto &[file, includes] : sources(DIPTYCH_SOURCE_DIR, "coupling"))
          for (const std::string &include : includes)
            if (folder_of(include) == panel)
              {
                EXPECT_EQ(listed.count(include), 1u) << file << " includes " << include;
              }
      }
  }

  // Lines below `root` that match `pattern`, outside the rooms of coupling/ that may hold them.
  std::vector<std::string> lines_outside(const fs::path &root, const std::set<std::string> &may, const std::string &pattern)
  {
    std::vector<std::string> found;
    const std::regex         searched(pattern);
    for (const auto &[file, includes] : sources(root, "coupling"))
      {
        std::ifstream in(root / file);
        for (std::string line; may.count(room_of(file)) == 0 && std::getline(in, line);)
          if (std::regex_search(line, searched))
            found.push_back(file + ": " + line);
      }
    return found;
  }

  // Only store/ knows where a result folder has which file.
  const std::string path_in_a_folder = R"x("/[a-z_]+\.(h5|csv|json|prm|vtu|pvd|html|msh|png)")x";

  TEST(House, OnlyTheStoreNamesFilesOfAResultFolder)
  {
    EXPECT_EQ(lines_outside(DIPTYCH_SOURCE_DIR, {"store"}, path_in_a_folder), std::vector<std::string>());
  }

  // A function takes the options that it uses. Only the reader of scenes, the commands and the Python binding know
  // the whole scene.
  TEST(House, TheWholeSceneIsPassedToFewFunctions)
  {
    const std::set<std::string> may = {"scene", "program", "python"};
    EXPECT_LE(lines_outside(DIPTYCH_SOURCE_DIR, may, R"x(const\s+(coupling::)?Scene\s*&)x").size(), 40u);
    EXPECT_GT(lines_outside(DIPTYCH_SOURCE_DIR, {}, R"x(const\s+(coupling::)?Scene\s*&)x").size(), 40u);
  }

  // The library or program of CMake that each source of `folder` belongs to, by its path below the folder.
  std::multimap<std::string, std::string> targets_of(const fs::path &root, const std::string &folder)
  {
    std::ifstream     in(root / folder / "CMakeLists.txt");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::regex  command(R"x((add_library|add_executable|target_sources)\((\S+)([^)]*)\))x"), source(R"x(\S+\.cc)x");
    const auto        end = std::sregex_iterator();
    std::multimap<std::string, std::string> found;
    for (auto one = std::sregex_iterator(text.begin(), text.end(), command); one != end; ++one)
      {
        const std::string sources = (*one)[3];
        for (auto file = std::sregex_iterator(sources.begin(), sources.end(), source); file != end; ++file)
          found.emplace(file->str(), (*one)[2]);
      }
    return found;
  }

  // Rooms whose sources are in more than one target, as text, and sources that are in none.
  std::vector<std::string> divided_rooms(const fs::path &root, const std::string &folder)
  {
    const auto                                   targets = targets_of(root, folder);
    std::map<std::string, std::set<std::string>> of_room;
    std::vector<std::string>                     found;
    for (const auto &[file, includes] : sources(root, folder))
      if (const std::string name = file.substr(folder.size() + 1);
          fs::path(file).extension() == ".cc" && room_of(file) != "python")
        {
          const auto [first, last] = targets.equal_range(name);
          if (first == last)
            found.push_back(file + " is in no target");
          for (auto target = first; target != last; ++target)
            of_room[room_of(file)].insert(target->second);
        }
    for (const auto &[room, of] : of_room)
      if (of.size() > 1 && !room.empty())
        found.push_back(room);
    return found;
  }

  // Sources of program/ go with the programs that need them. A program without deal.II reads the options of laws.
  TEST(House, LibrariesConsistOfWholeRooms)
  {
    EXPECT_EQ(divided_rooms(DIPTYCH_SOURCE_DIR, "discrete"), std::vector<std::string>());
    EXPECT_EQ(divided_rooms(DIPTYCH_SOURCE_DIR, "continuum"), std::vector<std::string>{"laws"});
    EXPECT_EQ(divided_rooms(DIPTYCH_SOURCE_DIR, "coupling"), std::vector<std::string>{"program"});
  }

  // The tests themselves must be able to fail: a house with one wrong arrow of each kind and one wrong library.
  TEST(House, AWrongArrowIsSeen)
  {
    const fs::path root = fs::path(testing::TempDir()) / ("house" + std::to_string(::getpid()));
    for (const auto &[folder, may_include] : allowed)
      fs::create_directories(root / folder);
    fs::create_directories(root / "discrete" / "files");
    fs::create_directories(root / "discrete" / "panel");
    std::ofstream(root / "continuum" / "a.cc") << "#include \"discrete/state.h\"\n#include \"continuum/mesh.h\"\n";
    std::ofstream(root / "discrete" / "b.h") << "#include <deal.II/base/tensor.h>\n#include <vector>\n";
    std::ofstream(root / "discrete" / "panel" / "c.h") << "#include \"discrete/files/d.h\"\n";
    std::ofstream(root / "discrete" / "files" / "d.h") << "#include <vector>\n";
    EXPECT_EQ(violations(root).size(), 2u);
    EXPECT_EQ(upward_arrows(root).size(), 0u);
    EXPECT_EQ(circle(root, "discrete"), "");
    std::ofstream(root / "discrete" / "files" / "d.cc") << "#include \"discrete/panel/c.h\"\n";
    EXPECT_EQ(upward_arrows(root).size(), 1u);
    EXPECT_EQ(circle(root, "discrete"), "discrete/files/d -> discrete/panel/c -> discrete/files/d");
    std::ofstream(root / "discrete" / "files" / "d.cc") << "#include \"discrete/public.h\"\n";
    std::ofstream(root / "discrete" / "public.h") << "#include \"discrete/panel/c.h\"\n";
    EXPECT_EQ(upward_arrows(root).size(), 1u) << "through a header beside the rooms";
    std::ofstream(root / "discrete" / "README.md") << "`x.h`\n## Public headers\n`panel/c.h`, `files/d.h`\n## More\n`y.h`\n";
    EXPECT_EQ(public_headers(root, "discrete"), (std::set<std::string>{"discrete/files/d.h", "discrete/panel/c.h"}));
    fs::create_directories(root / "coupling" / "panels");
    std::ofstream(root / "coupling" / "panels" / "e.cc") << "read(folder + \"/scene.prm\");\nread(folder + \"/a/b\");\n";
    EXPECT_EQ(lines_outside(root, {"store"}, path_in_a_folder).size(), 1u);
    EXPECT_EQ(lines_outside(root, {"panels"}, path_in_a_folder).size(), 0u);
    std::ofstream(root / "discrete" / "CMakeLists.txt") << "add_library(a STATIC\n  b.cc\n  files/d.cc\n  panel/e.cc)\n";
    EXPECT_EQ(divided_rooms(root, "discrete"), std::vector<std::string>());
    std::ofstream(root / "discrete" / "panel" / "e.cc") << "";
    std::ofstream(root / "discrete" / "panel" / "f.cc") << "";
    EXPECT_EQ(divided_rooms(root, "discrete"), std::vector<std::string>{"discrete/panel/f.cc is in no target"});
    std::ofstream(root / "discrete" / "CMakeLists.txt", std::ios::app) << "add_executable(g panel/f.cc)\n";
    EXPECT_EQ(divided_rooms(root, "discrete"), std::vector<std::string>{"panel"});
    fs::remove_all(root);
  }
} // namespace
