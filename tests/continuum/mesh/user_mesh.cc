// diptych: meshes of the user's own and the templates: read by name, or refused with the reason
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <gmsh.h>
#include <gtest/gtest.h>

#include "tests/continuum/mesh/grid_of_file.h"
#include "tests/continuum/mesh/refused_mesh.h"

namespace
{
  using namespace diptych::continuum;
  namespace fs = std::filesystem;

  std::string template_file(const std::string &name)
  {
    return (fs::path(DIPTYCH_SOURCE_DIR) / "meshes" / name).string();
  }

  // A user's own file in MSH 2.2: two unit squares side by side, 4-5-6 above 1-2-3. An element is its type, physical group,
  // entity and vertices.
  struct UserMesh
  {
    using Words = std::vector<std::string>;
    Words names, vertices{"0 0 0", "1 0 0", "2 0 0", "0 1 0", "1 1 0", "2 1 0"};
    Words elements{"1 1 1 1 2", "1 1 1 2 3", "1 2 2 4 5",     "1 2 2 5 6",
                   "1 3 3 1 4", "1 4 4 3 6", "3 1 1 1 2 5 4", "3 1 1 2 3 6 5"};

    void write(const std::string &file) const
    {
      std::ofstream out(file);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
      if (!names.empty())
        {
          out << "$PhysicalNames\n" << names.size() << "\n";
          for (const auto &name : names)
            out << "1 " << name << "\n";
          out << "$EndPhysicalNames\n";
        }
      out << "$Nodes\n" << vertices.size() << "\n";
      for (std::size_t i = 0; i < vertices.size(); ++i)
        out << i + 1 << " " << vertices[i] << "\n";
      out << "$EndNodes\n$Elements\n" << elements.size() << "\n";
      for (std::size_t i = 0; i < elements.size(); ++i)
        {
          const auto space = elements[i].find(' '); // between the type and the rest stands the number of tags, 2
          out << i + 1 << " " << elements[i].substr(0, space) << " 2" << elements[i].substr(space) << "\n";
        }
      out << "$EndElements\n";
    }
  };

  TEST(Mesh, OfTheUserCountsByNumberWhereLinesHaveNoNames)
  {
    const Folder folder;
    UserMesh().write(folder.file("user.msh"));
    const QuadMesh    mesh    = read_mesh(folder.file("user.msh"));
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(summary.n_cells, 2u);
    EXPECT_EQ(summary.area, 2);
    EXPECT_TRUE(summary.sides_match);
    expect_that_deal_ii_reads(mesh);
    EXPECT_EQ(Grid(mesh).n_edges, (std::map<unsigned int, unsigned int>{{1, 2}, {2, 2}, {3, 1}, {4, 1}}));
  }

  // Left and right side have one edge each, from 0 to 1 and from 0 to `top`; the tolerance is 1e-9 of the height.
  TEST(Mesh, SidesMatchWhereTheirHeightsAreEqual)
  {
    const Folder folder;
    UserMesh     mesh;
    for (const auto &[top, match] :
         {std::pair{"1.0000000001", true}, {"0.9999999999", true}, {"1.00000001", false}, {"1.5", false}})
      {
        mesh.vertices[5] = std::string("2 ") + top + " 0";
        mesh.write(folder.file("user.msh"));
        EXPECT_EQ(summarise(read_mesh(folder.file("user.msh"))).sides_match, match) << top;
      }
  }

  // The numbers are those of other lines on purpose, and a line inside with a name of its own is left out.
  UserMesh named_mesh()
  {
    UserMesh mesh;
    mesh.names    = {"2 \"lower_platen\"", "11 \"upper_platen\"", "1 \"left_side\"",
                     "5 \"right_side\"",   "9 \"free\"",          "6 \"gauge\""};
    mesh.elements = {"1 2 1 1 2", "1 2 1 2 3", "1 9 5 4 5",     "1 11 2 5 6",   "1 1 3 1 4",
                     "1 5 4 3 6", "1 6 6 2 5", "3 1 1 1 2 5 4", "3 1 1 2 3 6 5"};
    return mesh;
  }

  void write_as_msh_4_1(const std::string &from, const std::string &to)
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::open(from);
    gmsh::option::setNumber("Mesh.MshFileVersion", 4.1);
    gmsh::option::setNumber("Mesh.SaveAll", 1);
    gmsh::write(to);
    gmsh::finalize();
  }

  TEST(Mesh, OfTheUserCountsByNameInBothVersionsOfTheFormat)
  {
    const Folder folder;
    named_mesh().write(folder.file("v2.msh"));
    write_as_msh_4_1(folder.file("v2.msh"), folder.file("v4.msh"));
    std::ifstream v4(folder.file("v4.msh"));
    std::string   line;
    std::getline(v4, line), std::getline(v4, line);
    ASSERT_EQ(line.substr(0, 3), "4.1");
    for (const char *name : {"v2.msh", "v4.msh"})
      {
        const QuadMesh mesh = read_mesh(folder.file(name));
        expect_that_deal_ii_reads(mesh);
        EXPECT_EQ(Grid(mesh).n_edges, (std::map<unsigned int, unsigned int>{{1, 2}, {2, 1}, {3, 1}, {4, 1}, {5, 1}}));
      }
  }

  TEST(Mesh, OfTheUserIsRefusedWithTheReason)
  {
    const Folder folder;
    const auto   refused = [&](const std::string &reason, const auto &spoil) {
      UserMesh mesh;
      spoil(mesh);
      mesh.write(folder.file("user.msh"));
      expect_refused(folder.file("user.msh"), reason);
    };
    refused("Triangle 3", [](UserMesh &m) { m.elements.back() = "2 1 1 2 3 6", m.elements.push_back("2 1 1 2 6 5"); });
    refused("Line 3", [](UserMesh &m) { m.elements[0] = "8 1 1 1 2 5"; });
    refused("Quadrilateral 8", [](UserMesh &m) { m.elements[6] = "16 1 1 1 2 5 4 3 6 2 1"; });
    refused("no quadrilateral", [](UserMesh &m) { m.elements.resize(6); });
    refused("line right_side (number 4", [](UserMesh &m) { m.elements.erase(m.elements.begin() + 5); });
    refused("1 boundary edges lie on no physical line, one of them at (1.5, 1)",
            [](UserMesh &m) { m.elements[3] = "1 77 7 5 6"; });
    refused("clockwise (reverse the surface in gmsh) at (0, 0)", [](UserMesh &m) { m.elements[6] = "3 1 1 1 4 5 2"; });
    refused("folded", [](UserMesh &m) { m.elements[6] = "3 1 1 1 5 2 4"; });
    refused("folded", [](UserMesh &m) { m.vertices[0] = "0.9 0.95 0"; }); // concave
    refused("folded", [](UserMesh &m) { m.vertices[0] = "0.5 0.5 0"; });  // a triangle in disguise
    refused("two cells overlap", [](UserMesh &m) { m.elements.push_back("3 1 1 1 2 5 4"); });
    refused("not finite", [](UserMesh &m) { m.vertices[4] = "1 nan 0"; });
    refused("not finite", [](UserMesh &m) { m.vertices[4] = "inf 1 0"; });
    refused("z = 0.1", [](UserMesh &m) { m.vertices[4] = "1 1 0.1"; });
    refused("two physical lines, upper_platen and right_side at (2, 0.5)",
            [](UserMesh &m) { m.elements.push_back("1 2 8 3 6"); });
    refused("physical line left_side leaves the boundary of the mesh at (1, 0.5)",
            [](UserMesh &m) { m.elements.push_back("1 3 3 2 5"); });
    refused("two physical lines stand for left_side", [](UserMesh &m) { m.names = {"4 \"left_side\""}; });
    refused("more than one piece", [](UserMesh &m) { // the right square moves away
      m.vertices.insert(m.vertices.end(), {"3 0 0", "4 0 0", "4 1 0", "3 1 0"});
      m.elements.back() = "3 1 1 7 8 9 10";
    });
    refused("more than one piece", [](UserMesh &m) { // two squares that share the corner 5 only
      m.vertices.insert(m.vertices.end(), {"2 2 0", "1 2 0"});
      m.elements.back() = "3 1 1 5 6 7 8";
    });
  }

  // Of MSH 2.2 gmsh itself leaves a vertex out that no element names; of MSH 4.1 it keeps it.
  TEST(Mesh, WithAVertexOfNoCellIsRefused)
  {
    const Folder folder;
    std::ofstream(folder.file("v4.msh")) << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                                            "$Entities\n0 4 1 0\n1 0 0 0 1 0 0 1 1 0\n2 0 1 0 1 1 0 1 2 0\n3 0 0 0 0 1 0 1 3 0\n"
                                            "4 1 0 0 1 1 0 1 4 0\n1 0 0 0 1 1 0 1 1 4 1 2 3 4\n$EndEntities\n"
                                            "$Nodes\n1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.25 0\n"
                                            "$EndNodes\n$Elements\n5 5 1 5\n1 1 1 1\n1 1 2\n1 2 1 1\n2 4 3\n1 3 1 1\n3 1 4\n"
                                            "1 4 1 1\n4 2 3\n2 1 3 1\n5 1 2 3 4\n$EndElements\n";
    expect_refused(folder.file("v4.msh"), "a vertex belongs to no cell at (0.5, 0.25)");

    UserMesh mesh;
    mesh.vertices.push_back("0 5 0");
    mesh.elements.push_back("1 3 3 4 7"); // a line that sticks out
    mesh.write(folder.file("v2.msh"));
    expect_refused(folder.file("v2.msh"), "a vertex belongs to no cell at (0, 5)");

    mesh.elements.back() = "15 9 9 7"; // a mere point, such as the centre of an arc, is left out
    mesh.write(folder.file("v2.msh"));
    EXPECT_EQ(read_mesh(folder.file("v2.msh")).vertices.size(), 6u);
  }

  TEST(Mesh, FilesThatAreNoneAreRefused)
  {
    const Folder folder;
    expect_refused(folder.file("missing.msh"), "no such mesh file");
    std::ofstream(folder.file("picture.png")) << "x";
    expect_refused(folder.file("picture.png"), ".msh or .geo");
    std::ofstream(folder.file("empty.msh")) << "";
    expect_refused(folder.file("empty.msh"), "the file is empty");
    std::ofstream(folder.file("nothing.msh")) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    expect_refused(folder.file("nothing.msh"), "no quadrilateral");
    std::ofstream(folder.file("text.msh")) << "this is no mesh\n";
    expect_refused(folder.file("text.msh"), "line 1: a .msh file must begin with $MeshFormat");
    UserMesh mesh;
    mesh.elements.back() = "3 1 1 2 3 6 99";
    mesh.write(folder.file("lost.msh"));
    expect_refused(folder.file("lost.msh"), "99");
  }

  TEST(Mesh, TemplateOfASampleIsMeshed)
  {
    const QuadMesh    mesh    = read_mesh(template_file("sample.geo"));
    const MeshSummary summary = summarise(mesh);
    EXPECT_NEAR(summary.area, 52 * 75, 1e-9);
    EXPECT_TRUE(summary.sides_match);
    expect_that_deal_ii_reads(mesh);
  }

  // 20 x 10 under a strip of 2, elements of 0.5: 40 x 20 cells.
  TEST(Mesh, TemplateOfAFootingHasAStripInTheMiddle)
  {
    const QuadMesh    mesh    = read_mesh(template_file("footing.geo"));
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(summary.n_cells, 800u);
    EXPECT_TRUE(summary.sides_match);
    expect_that_deal_ii_reads(mesh);
    Grid grid(mesh);
    EXPECT_EQ(grid.n_edges, (std::map<unsigned int, unsigned int>{{1, 40}, {2, 4}, {3, 20}, {4, 20}, {5, 36}}));
    EXPECT_NEAR(grid.length[upper_platen], 2, 1e-12);
  }

  // A sector of the angle pi/40 between chords: area sin(pi/40)/2 (b^2 - a^2), chord 2 r sin(pi/80); 20 of them, a = 1, b = 2.
  TEST(Mesh, TemplateOfAThickCylinderIsAQuarterOfIt)
  {
    const QuadMesh    mesh    = read_mesh(template_file("thick_cylinder.geo"));
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(summary.n_cells, 200u);
    EXPECT_EQ(summary.n_vertices, 231u); // without the centre of the arcs
    EXPECT_NEAR(summary.area, 20 * std::sin(M_PI / 40) / 2 * 3, 1e-9);
    expect_that_deal_ii_reads(mesh);
    Grid grid(mesh);
    EXPECT_NEAR(grid.length[lower_platen], 1, 1e-9);
    EXPECT_NEAR(grid.length[left_side], 1, 1e-9);
    EXPECT_NEAR(grid.length[right_side], 20 * 2 * std::sin(M_PI / 80), 1e-9);
    EXPECT_NEAR(grid.length[upper_platen], 20 * 4 * std::sin(M_PI / 80), 1e-9);
  }

  TEST(Mesh, AFileOfCommandsIsNoMeshFile)
  {
    const Folder folder;
    std::ofstream(folder.file("script.msh")) << "SystemCall \"touch " << folder.file("X") << "\";\n";
    expect_refused(folder.file("script.msh"), "line 1: a .msh file must begin with $MeshFormat");
    EXPECT_FALSE(fs::exists(folder.file("X")));
  }

  // What the two squares say in MSH 2.2, line by line: the nodes are lines 6 to 11, the elements 15 to 22.
  TEST(Mesh, FilesOfMsh22AreRefusedWithTheLine)
  {
    const Folder folder;
    UserMesh().write(folder.file("whole.msh"));
    std::ifstream            in(folder.file("whole.msh"));
    std::vector<std::string> whole;
    for (std::string line; std::getline(in, line);)
      whole.push_back(line);
    ASSERT_EQ(whole.size(), 23u);
    const auto refused = [&](const std::size_t line, const std::string &text, const std::string &reason) {
      auto lines      = whole;
      lines[line - 1] = text;
      std::ofstream out(folder.file("user.msh"));
      for (const auto &one : lines)
        out << one << "\n";
      out.close();
      expect_refused(folder.file("user.msh"), reason);
    };
    refused(2, "2.2 1 8", "line 2: binary mesh files are not read");
    refused(2, "4 0 8", "line 2: the version");
    refused(1, "x = 1;", "line 1: a .msh file must begin");
    refused(4, "SystemCall \"x\";", "line 4: belongs to no section");
    refused(5, "2000000000", "line 5: the count 2000000000");
    refused(5, "7", "line 12: holds 1 words");
    refused(5, "5", "line 11: $EndNodes must stand here");
    for (const char *tag : {"0", "-6", "nan", "6.5", "2147483648", "4294967302", "18446744073709551622"})
      refused(11, std::string(tag) + " 2 1 0", std::string("line 11: the tag of a node is '") + tag + "'");
    refused(11, "5 2 1 0", "line 11: node 5 is given twice, first in line 10");
    for (const char *number : {"nan", "inf", "1e400", "x"})
      refused(11, std::string("6 2 ") + number + " 0", std::string("line 11: a coordinate of node 6 is '") + number + "'");
    refused(14, "-5", "line 14: the number of elements is '-5'");
    refused(14, "9", "line 23: holds 1 words");
    refused(22, "7 3 2 1 1 2 3 6 5", "line 22: element 7 is given twice, first in line 21");
    refused(22, "9 3 2 1 1 1 2 5 4", "line 22: two cells overlap: element 9 has the nodes of the element in line 21");
    refused(22, "9 3 2 1 1 4 5 2 1", "line 22: two cells overlap: element 9 has the nodes of the element in line 21");
    refused(16, "2 1 2 1 1 2 1", "line 16: element 2 has the nodes of the element in line 15");
    refused(22, "8 3 2 1 1 2 3 6 99", "line 22: element 8 names node 99");
    refused(22, "8 3 2 1 1 2 3 6 0", "line 22: a node is '0'");
    refused(22, "8 3 2 1 1 2 3 6", "line 22: an element of type 3 does not have 3 nodes");
    refused(22, "8 16 2 1 1 2 3 6 5", "line 22: an element of type 16 does not have 4 nodes");
    refused(22, "8 99 2 1 1 2 3 6 5", "line 22: an element of type 99");
    refused(22, "8 3 1000000000 1 1 2 3 6 5", "line 22: the number of attributes");
    refused(22, "8 100000 2 1 1 2 3 6 5", "line 22: the type of an element");
    refused(22, "8 3 2 1 1 2 6 3 5", "line 22: the quadrilateral 8 is folded");
    refused(22, "8 3 2 1 1 2 2 2 2", "line 22: the quadrilateral 8 is folded");
    refused(23, "", "line 23: the file ends within");
  }

  // One square of MSH 4.1 with its four lines; the nodes 1 to 4 are lines 5 to 14, the elements 15 to 26.
  TEST(Mesh, FilesOfMsh41AreRefusedWithTheLine)
  {
    const Folder      folder;
    const std::string whole = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n"
                              "0 1 0\n$EndNodes\n$Elements\n2 3 1 3\n1 1 1 2\n1 1 2\n2 2 3\n2 1 3 1\n3 1 2 3 4\n$EndElements\n";
    const auto        refused = [&](const std::string &part, const std::string &spoilt, const std::string &reason) {
      std::string text = whole;
      ASSERT_NE(text.find(part), std::string::npos) << part;
      text.replace(text.find(part), part.size(), spoilt);
      std::ofstream(folder.file("user.msh")) << text;
      expect_refused(folder.file("user.msh"), reason);
    };
    refused("1 4 1 4", "1 4 1 4294967300", "line 5: the largest tag");
    refused("1 4 1 4", "1 5 1 4", "line 14: the blocks hold 1 nodes fewer");
    refused("2 1 0 4", "2 1 0 5", "line 6: the number of what the block holds is '5'");
    refused("\n4\n0 0 0", "\n3\n0 0 0", "line 10: node 3 is given twice, first in line 9");
    refused("\n4\n0 0 0", "\n5\n0 0 0", "line 10: the tag of a node is '5'");
    refused("1 1 0\n0 1 0", "1 1 0\n0 nan 0", "line 14: a coordinate of node 4 is 'nan'");
    refused("2 2 3\n", "2 2 1\n", "line 20: element 2 has the nodes of the element in line 19");
    refused("2 2 3\n", "1 2 3\n", "line 20: element 1 is given twice, first in line 19");
    refused("3 1 2 3 4", "3 1 3 2 4", "line 22: the quadrilateral 3 is folded");
    refused("3 1 2 3 4", "3 1 2 3 9", "line 22: element 3 names node 9");
    refused("$EndElements\n", "", "line 22: the file ends within");
  }

  TEST(Mesh, SectionsThatThePanelDoesNotNeedAreNotGivenToGmsh)
  {
    const Folder folder;
    UserMesh().write(folder.file("user.msh"));
    std::ofstream(folder.file("user.msh"), std::ios::app)
      << "$Comments\nSystemCall \"x\";\n$EndComments\n$Periodic\n1000000000\n1 1 1\n$EndPeriodic\n";
    EXPECT_EQ(read_mesh(folder.file("user.msh")).cells.size(), 2u);
  }
} // namespace
