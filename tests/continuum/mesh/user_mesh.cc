// diptych: meshes of the user, and the child process that makes them
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <unistd.h>
#include <iterator>
#include <csignal>
#include <gmsh.h>

#include "continuum/mesh/mesh_child.h"
#include "continuum/mesh/mesh.h"
#include "tests/continuum/mesh/grid_of_file.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::continuum;

  QuadMesh mesh_of_template(const std::string &name)
  {
    const QuadMesh mesh = read_mesh(DIPTYCH_SOURCE_DIR "/meshes/" + name);
    expect_that_deal_ii_reads(mesh);
    return mesh;
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
    UserMesh().write(folder / "user.msh");
    const QuadMesh    mesh    = read_mesh(folder / "user.msh");
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
        mesh.write(folder / "user.msh");
        EXPECT_EQ(summarise(read_mesh(folder / "user.msh")).sides_match, match) << top;
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

  // Lets gmsh write a mesh anew with one option changed.
  void rewrite(const std::string &from, const std::string &to, const std::string &option, const double value)
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::open(from);
    gmsh::option::setNumber(option, value);
    gmsh::option::setNumber("Mesh.SaveAll", 1);
    gmsh::write(to);
    gmsh::finalize();
  }

  TEST(Mesh, PhysicalLinesAreRecognisedByNameInMsh22AndMsh41)
  {
    const Folder folder;
    named_mesh().write(folder / "v2.msh");
    rewrite(folder / "v2.msh", folder / "v4.msh", "Mesh.MshFileVersion", 4.1);
    std::ifstream v4(folder / "v4.msh");
    std::string   line;
    std::getline(v4, line), std::getline(v4, line);
    ASSERT_EQ(line.substr(0, 3), "4.1");
    for (const char *name : {"v2.msh", "v4.msh"})
      {
        const QuadMesh mesh = read_mesh(folder / name);
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
      mesh.write(folder / "user.msh");
      expect_mesh_refused(folder / "user.msh", reason);
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

  // gmsh keeps a vertex that no element names if the file is MSH 4.1, and leaves it out if the file is MSH 2.2.
  TEST(Mesh, AMeshWithAVertexOfNoCellIsRefused)
  {
    const Folder folder;
    std::ofstream(folder / "v4.msh") << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
                                        "$Entities\n0 4 1 0\n1 0 0 0 1 0 0 1 1 0\n2 0 1 0 1 1 0 1 2 0\n3 0 0 0 0 1 0 1 3 0\n"
                                        "4 1 0 0 1 1 0 1 4 0\n1 0 0 0 1 1 0 1 1 4 1 2 3 4\n$EndEntities\n"
                                        "$Nodes\n1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 0.25 0\n"
                                        "$EndNodes\n$Elements\n5 5 1 5\n1 1 1 1\n1 1 2\n1 2 1 1\n2 4 3\n1 3 1 1\n3 1 4\n"
                                        "1 4 1 1\n4 2 3\n2 1 3 1\n5 1 2 3 4\n$EndElements\n";
    expect_mesh_refused(folder / "v4.msh", "a vertex belongs to no cell at (0.5, 0.25)");

    UserMesh mesh;
    mesh.vertices.push_back("0 5 0");
    mesh.elements.push_back("1 3 3 4 7"); // a line that sticks out
    mesh.write(folder / "v2.msh");
    expect_mesh_refused(folder / "v2.msh", "a vertex belongs to no cell at (0, 5)");

    mesh.elements.back() = "15 9 9 7"; // a mere point, such as the centre of an arc, is left out
    mesh.write(folder / "v2.msh");
    EXPECT_EQ(read_mesh(folder / "v2.msh").vertices.size(), 6u);
  }

  TEST(Mesh, UnreadableMeshFilesAreRefused)
  {
    const Folder folder;
    expect_mesh_refused(folder / "missing.msh", "no such mesh file");
    for (const auto &[name, text, reason] : {std::tuple{"picture.png", "x", ".msh or .geo"},
                                             {"empty.msh", "", "no quadrilateral"},
                                             {"nothing.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "no quadrilateral"},
                                             {"text.msh", "this is no mesh\n", "line 1"},
                                             {"error.geo", "Point(1) = {0, 0, 0};\nPoint(2) = {1, 2;\n", "line 2: syntax error"},
                                             {"exit.geo", "Exit;\n", "gmsh ended before there was a mesh"}})
      {
        std::ofstream(folder / name) << text;
        expect_mesh_refused(folder / name, reason);
      }
    UserMesh mesh;
    mesh.elements.back() = "3 1 1 2 3 6 99"; // node 99 does not exist
    mesh.write(folder / "lost.msh");
    expect_mesh_refused(folder / "lost.msh", "99");
  }

  TEST(Mesh, TemplateOfASampleIsMeshed)
  {
    const MeshSummary summary = summarise(mesh_of_template("sample.geo"));
    EXPECT_NEAR(summary.area, 52 * 75, 1e-9);
    EXPECT_TRUE(summary.sides_match);
  }

  // 20 x 10 under a strip of 2, elements of 0.5: 40 x 20 cells.
  TEST(Mesh, TemplateOfAFootingHasAStripInTheMiddle)
  {
    const QuadMesh    mesh    = mesh_of_template("footing.geo");
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(summary.n_cells, 800u);
    EXPECT_TRUE(summary.sides_match);
    Grid grid(mesh);
    EXPECT_EQ(grid.n_edges, (std::map<unsigned int, unsigned int>{{1, 40}, {2, 4}, {3, 20}, {4, 20}, {5, 36}}));
    EXPECT_NEAR(grid.length[upper_platen], 2, 1e-12);
  }

  // A sector of the angle pi/40 between chords: area sin(pi/40)/2 (b^2 - a^2), chord 2 r sin(pi/80); 20 of them, a = 1, b = 2.
  TEST(Mesh, TemplateOfAThickCylinderIsAQuarterOfIt)
  {
    const QuadMesh    mesh    = mesh_of_template("thick_cylinder.geo");
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(summary.n_cells, 200u);
    EXPECT_EQ(summary.n_vertices, 231u); // without the centre of the arcs
    EXPECT_NEAR(summary.area, 20 * std::sin(M_PI / 40) / 2 * 3, 1e-9);
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
    UserMesh().write(folder / "user.msh");
    std::ofstream(folder / "user.msh", std::ios::app) << "$Comments\nmine\n$EndComments\n";
    EXPECT_EQ(read_mesh(folder / "user.msh").cells.size(), 2u);
  }

  TEST(Mesh, BinaryMshFilesAreRead)
  {
    const Folder folder;
    UserMesh().write(folder / "text.msh");
    rewrite(folder / "text.msh", folder / "binary.msh", "Mesh.Binary", 1);
    EXPECT_EQ(read_mesh(folder / "binary.msh").cells.size(), 2u);
  }

  // Process numbers of the children of this thread; MPI may have one.
  std::string children()
  {
    std::ifstream file("/proc/thread-self/children");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TEST(MeshChild, ReturnsTheMeshUnchanged)
  {
    const QuadMesh mesh = rectangle_mesh({10, 6.2, 1.3, 0.5});
    const QuadMesh same = made_in_child([&] { return mesh; }, {});
    EXPECT_EQ(same.vertices, mesh.vertices);
    EXPECT_EQ(same.cells, mesh.cells);
    EXPECT_EQ(same.boundary.size(), mesh.boundary.size());
  }

  TEST(MeshChild, ExceptionsCrashesAndExitsAreReported)
  {
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { throw std::invalid_argument("no"); }, {}), std::invalid_argument);
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { throw std::runtime_error("no"); }, {}), std::runtime_error);
    const auto crash = []() -> QuadMesh {
      std::raise(SIGSEGV);
      return {};
    };
    EXPECT_THROW((void)made_in_child(crash, {}), GmshEnded);
    EXPECT_THROW((void)made_in_child([]() -> QuadMesh { _exit(0); }, {}), GmshEnded);
  }

  TEST(MeshChild, EndsOnRequestAndAtItsTimeLimit)
  {
    const auto endless = []() -> QuadMesh {
      for (volatile int k = 0;; k = k + 1)
        {}
    };
    struct Stopped
    {};
    const std::string before = children();
    EXPECT_THROW((void)made_in_child(endless, [] { throw Stopped(); }), Stopped);
    EXPECT_EQ(children(), before) << "the child is still there";
    EXPECT_THROW((void)made_in_child(endless, {}, 1), GmshEnded);
    const auto waiting = []() -> QuadMesh { // uses no CPU time
      pause();
      return {};
    };
    EXPECT_THROW((void)made_in_child(waiting, {}, 1), GmshEnded);
  }
} // namespace
