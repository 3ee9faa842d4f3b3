// diptych: the user's meshes and the templates: read by name, or refused with the reason
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

  TEST(Mesh, PhysicalLinesWithoutNamesAreRecognisedByNumber)
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

  // The numbers are those of other lines on purpose. The line "gauge" inside the mesh is ignored.
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

  TEST(Mesh, PhysicalLinesAreRecognisedByNameInMsh22AndMsh41)
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

  TEST(Mesh, AnUnsoundMeshIsRefusedWithTheReason)
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
  TEST(Mesh, AMeshWithAVertexOfNoCellIsRefused)
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

  TEST(Mesh, UnreadableMeshFilesAreRefused)
  {
    const Folder folder;
    expect_refused(folder.file("missing.msh"), "no such mesh file");
    std::ofstream(folder.file("picture.png")) << "x";
    expect_refused(folder.file("picture.png"), ".msh or .geo");
    std::ofstream(folder.file("empty.msh")) << "";
    expect_refused(folder.file("empty.msh"), "no quadrilateral");
    std::ofstream(folder.file("nothing.msh")) << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    expect_refused(folder.file("nothing.msh"), "no quadrilateral");
    std::ofstream(folder.file("text.msh")) << "this is no mesh\n";
    expect_refused(folder.file("text.msh"), "line 1");
    UserMesh mesh;
    mesh.elements.back() = "3 1 1 2 3 6 99"; // node 99 does not exist
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

  // gmsh itself skips sections that it does not know.
  TEST(Mesh, UnknownSectionsAreSkipped)
  {
    const Folder folder;
    UserMesh().write(folder.file("user.msh"));
    std::ofstream(folder.file("user.msh"), std::ios::app) << "$Comments\nmine\n$EndComments\n";
    EXPECT_EQ(read_mesh(folder.file("user.msh")).cells.size(), 2u);
  }

  TEST(Mesh, BinaryMshFilesAreRead)
  {
    const Folder folder;
    UserMesh().write(folder.file("text.msh"));
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::open(folder.file("text.msh"));
    gmsh::option::setNumber("Mesh.Binary", 1);
    gmsh::option::setNumber("Mesh.SaveAll", 1);
    gmsh::write(folder.file("binary.msh"));
    gmsh::finalize();
    EXPECT_EQ(read_mesh(folder.file("binary.msh")).cells.size(), 2u);
  }

  // gmsh reports the place of a syntax error in a script.
  TEST(Mesh, ASyntaxErrorInAScriptIsReportedWithItsLine)
  {
    const Folder folder;
    std::ofstream(folder.file("user.geo")) << "Point(1) = {0, 0, 0};\nPoint(2) = {1, 2;\n";
    expect_refused(folder.file("user.geo"), "line 2: syntax error");
  }

  TEST(Mesh, AScriptThatEndsGmshIsReported)
  {
    const Folder folder;
    std::ofstream(folder.file("user.geo")) << "Exit;\n";
    expect_refused(folder.file("user.geo"), "gmsh ended before there was a mesh");
  }
} // namespace
