// diptych: what a geometry of the user's may not do, and what keeps it from that
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <unistd.h>

#include "continuum/mesh/mesh_child.h"
#include "tests/continuum/mesh/grid_of_file.h"
#include "tests/continuum/mesh/refused_mesh.h"

namespace
{
  using namespace diptych::continuum;
  namespace fs = std::filesystem;

  std::string geometry(const Folder &folder, const std::string &text)
  {
    const std::string file = folder.file("hostile.geo");
    std::ofstream(file) << text;
    return file;
  }

  TEST(Mesh, AGeometryThatDoesMoreThanMakeShapesIsRefusedWithItsLine)
  {
    const Folder folder;
    for (const char *command : {"SystemCall \"touch X\";",
                                "NonBlockingSystemCall \"touch X\";",
                                "OnelabRun(\"a\", \"b\");",
                                "Exit;",
                                "Abort;",
                                "Save \"X\";",
                                "Print \"X\";",
                                "Merge \"a.msh\";",
                                "Include \"a.geo\";",
                                "Printf(\"x\") > \"X\";",
                                "CreateDir \"X\";",
                                "Sleep 1000;",
                                "Printf(\"%g\", 1 > 0) >> \"X\";",
                                "Plugin(Skin).Run;",
                                "General.ErrorFileName = \"X\";",
                                "Solver.AutoMesh = 1;",
                                "x = 1; /* */ Exit;",
                                "System \"touch X\";",
                                "System = 1; System \"touch X\";",
                                "x = 1SystemCall \"touch X\";",
                                "Field[1] = ExternalProcess;",
                                "Field[1].CommandLine = \"touch X\";",
                                "Field[1] = Structured;",
                                "Field[1] = PostView;",
                                "z = GetValue(\"how much\", 3);",
                                "z = GetEnv(\"HOME\");",
                                "Macro m",
                                "S2N(\"SystemCall\") \"touch X\";",
                                "SetString(\"General.ErrorFileName\", \"X\");",
                                "Foo;",
                                "Foo = 1; Foo \"X\";",
                                "// \rSystemCall \"touch X\";",
                                "a = \"x\ny\";",
                                "/* without end",
                                "a = \"without end;"})
      try
        {
          (void)read_mesh(geometry(folder, std::string("// a geometry\n\n") + command + "\n"));
          ADD_FAILURE() << command;
        }
      catch (const std::invalid_argument &error)
        {
          EXPECT_NE(std::string(error.what()).find("hostile.geo, line 3: "), std::string::npos) << error.what();
        }
    // Harmless: in comments, in texts, as part of a word, as a comparison, to the terminal.
    for (const char *command :
         {"// Exit;", "/* Save \"X\"; */", "Printf(\"Exit; > SystemCall\");", "Exit_width = 3 > 2;", "Mesh.Algorithm = 6;",
          "Wide = 2; X() = {0, Wide}; For I In {0:1}\nPoint(newp) = {X(I), 0, 0};\nEndFor", "a = 1.5e-3; b = .5;\r\n",
          "Field[1] = MathEval;\nField[1].F = \"1\";\nBackground Field = 1;", "DefineConstant[ Wide = {2, Name \"a\", Min 1} ];"})
      expect_refused(geometry(folder, command), "quadrilateral");
    expect_refused(geometry(folder, "Point(1) = {0, 0, 0};\nPoint(2) = {1, 2;\n"), "line 2: syntax error");
    EXPECT_FALSE(std::filesystem::exists("X"));
  }

  // gmsh's lexer takes at most 1023 characters of a text and reads the rest as commands.
  TEST(Mesh, ATextThatGmshCutsIsRefused)
  {
    const Folder folder;
    expect_refused(geometry(folder, "a = \"" + std::string(1023, 'x') + "\";"), "quadrilateral");
    expect_refused(geometry(folder, "a = \"" + std::string(1024, 'x') + "\";"), "line 1: a text between quotes has 1024");
    expect_refused(geometry(folder, "a = 1;\nb = 1" + std::string(8000, ' ') + ";"), "line 2: the line is longer than 8000");
  }

  // At the end of the loop gmsh goes back to the line after its head, whether or not that lies within a comment.
  TEST(Mesh, ALoopBeginsAgainBehindACommentNotWithinIt)
  {
    const Folder      folder;
    const std::string command = "SystemCall \"touch " + folder.file("X") + "\"; ";
    expect_refused(geometry(folder, "For i In {1:2} /*\n" + command + "*/\na = i;\nEndFor\n"), "quadrilateral");
    EXPECT_FALSE(fs::exists(folder.file("X")));
  }

  // gmsh reads FILE.opt beside a FILE that it opens, and does what it says.
  TEST(Mesh, WhatLiesBesideAMeshFileIsNotRead)
  {
    const Folder folder;
    fs::create_directory(folder.file("temporary"));
    const char *before = std::getenv("TMPDIR");
    setenv("TMPDIR", folder.file("temporary").c_str(), 1);
    fs::copy_file(fs::path(DIPTYCH_SOURCE_DIR) / "meshes" / "sample.geo", folder.file("mine.geo"));
    write_mesh(rectangle_mesh({2, 1, 0, 1}), folder.file("mine.msh"));
    for (const char *name : {"mine.geo", "mine.msh"})
      {
        std::ofstream(folder.file(name) + ".opt") << "SystemCall \"touch " << folder.file("X") << "\";\nExit;\n";
        EXPECT_GT(read_mesh(folder.file(name)).cells.size(), 0u);
      }
    expect_refused(geometry(folder, "Point(2) = {1, 2;\n"), "'" + folder.file("hostile.geo") + "', line 1: syntax error");
    EXPECT_THROW((void)read_mesh(folder.file("mine.geo"), [] { return true; }), MeshingStopped);
    EXPECT_FALSE(fs::exists(folder.file("X")));
    EXPECT_TRUE(fs::is_empty(folder.file("temporary"))); // the copies are gone
    before == nullptr ? unsetenv("TMPDIR") : setenv("TMPDIR", before, 1);
  }

  TEST(Mesh, NothingThatHappensInItsOwnProcessEndsThisOne)
  {
    const QuadMesh mesh = rectangle_mesh({10, 6.2, 1.3, 0.5});
    const QuadMesh same = made_in_child([&] { return mesh; }, {});
    EXPECT_EQ(same.vertices, mesh.vertices);
    EXPECT_EQ(same.cells, mesh.cells);
    EXPECT_EQ(same.boundary.size(), mesh.boundary.size());
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { throw std::invalid_argument("no"); }, {}), std::invalid_argument);
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { throw std::runtime_error("no"); }, {}), std::runtime_error);
    EXPECT_THROW((void)made_in_child(
                   []() -> QuadMesh {
                     std::raise(SIGSEGV);
                     return {};
                   },
                   {}),
                 GmshEnded);
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { _exit(0); }, {}), GmshEnded);
    const auto endless = []() -> QuadMesh {
      for (volatile int k = 0;; k = k + 1)
        {}
    };
    EXPECT_THROW((void)made_in_child(endless, [] { return true; }), MeshingStopped);
    EXPECT_THROW((void)made_in_child(endless, {}, 1), GmshEnded);
    const auto waiting = []() -> QuadMesh { return pause(), QuadMesh(); }; // uses no CPU time
    EXPECT_THROW((void)made_in_child(waiting, {}, 1), GmshEnded);
  }

  // Without a limit the work is our own and may; with one it is a user's. Whatever asks a question finds no answer.
  TEST(Mesh, AUsersFileStartsNoProgramAndRemovesNoFile)
  {
    const Folder folder;
    std::ofstream(folder.file("victim")) << "x";
    const std::string command = "touch " + folder.file("X");
    for (const unsigned int limit : {20u, 0u})
      {
        const auto hostile = [&]() -> QuadMesh {
          const bool started = std::system(command.c_str()) == 0;
          const bool removed = unlink(folder.file("victim").c_str()) == 0;
          char       answer  = 0;
          const bool asked   = read(STDIN_FILENO, &answer, 1) != 0;
          throw std::invalid_argument(std::to_string(started) + std::to_string(removed) + std::to_string(asked));
        };
        try
          {
            (void)made_in_child(hostile, {}, limit);
            ADD_FAILURE();
          }
        catch (const std::invalid_argument &error)
          {
            EXPECT_STREQ(error.what(), limit > 0 ? "000" : "110");
          }
        EXPECT_EQ(fs::exists(folder.file("X")), limit == 0);
        EXPECT_EQ(fs::exists(folder.file("victim")), limit > 0);
      }
  }
} // namespace
