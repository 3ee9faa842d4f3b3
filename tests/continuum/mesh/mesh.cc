// diptych: meshes that are made
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/elements/discretisation.h"
#include "tests/continuum/continuum_scenes.h"
#include "tests/continuum/mesh/grid_of_file.h"

namespace
{
  using namespace diptych::continuum;
  using tests::wavy_outline;

  double polygon_area(const Outline &outline)
  {
    auto   polygon = outline.right;
    double twice   = 0;
    polygon.insert(polygon.end(), outline.left.rbegin(), outline.left.rend());
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += a.x() * b.y() - a.y() * b.x();
      }
    return twice / 2;
  }

  TEST(Mesh, OfAWavyOutlineFillsItWithQuadrilaterals)
  {
    const Outline     outline = wavy_outline(20, 30, 16, 0.4);
    const QuadMesh    mesh    = outline_mesh(outline, 2.);
    const MeshSummary summary = summarise(mesh);
    EXPECT_NEAR(summary.area, polygon_area(outline), 0.005 * polygon_area(outline));
    EXPECT_GT(summary.n_cells, 100u);
    EXPECT_LT(summary.n_cells, 260u); // 600 / 4 = 150
    expect_that_deal_ii_reads(mesh);
  }

  // Coordinates survive a file to the last bit, and nothing is numbered anew.
  TEST(Mesh, ComesBackFromAFileAsItWas)
  {
    const Folder   folder;
    const QuadMesh mesh = outline_mesh(wavy_outline(20, 30, 16, 0.4), 2.);
    write_mesh(mesh, folder / "wavy.msh");
    const QuadMesh read = read_mesh(folder / "wavy.msh");
    EXPECT_EQ(read.vertices, mesh.vertices);
    EXPECT_EQ(read.cells, mesh.cells);
    const auto edges = [](const QuadMesh &m) {
      std::map<std::set<unsigned int>, BoundaryId> ids;
      for (const auto &edge : m.boundary)
        ids[{edge.vertices[0], edge.vertices[1]}] = edge.id;
      return ids;
    };
    EXPECT_EQ(edges(read), edges(mesh));
  }

  // The panel's mesh in memory is what deal.II's reader would have made of the file: cells in one order, corners in one order,
  // vertices with one number each, ids of the edges.
  TEST(Mesh, InMemoryIsTheTriangulationOfItsFile)
  {
    for (const QuadMesh &mesh : {outline_mesh(wavy_outline(20, 30, 16, 0.4), 2.), rectangle_mesh({10, 6.2, 1.3, 0.5})})
      {
        const Grid           grid(mesh);
        const Discretisation ours(mesh, ElementKind::q2, MPI_COMM_SELF);
        auto                 theirs = grid.triangulation.begin_active();
        ASSERT_EQ(ours.triangulation.n_active_cells(), grid.triangulation.n_active_cells());
        for (const auto &cell : ours.triangulation.active_cell_iterators())
          {
            for (const unsigned int v : cell->vertex_indices())
              {
                EXPECT_EQ(cell->vertex(v), theirs->vertex(v));
                EXPECT_EQ(cell->vertex_index(v), theirs->vertex_index(v));
              }
            for (const unsigned int f : cell->face_indices())
              {
                ASSERT_EQ(cell->face(f)->at_boundary(), theirs->face(f)->at_boundary());
                if (cell->face(f)->at_boundary())
                  {
                    EXPECT_EQ(cell->face(f)->boundary_id(), theirs->face(f)->boundary_id());
                  }
              }
            ++theirs;
          }
      }
  }

  TEST(Mesh, OfAnOutlineThatIsNoSampleIsRefused)
  {
    Outline outline = wavy_outline(2, 3, 2, 0);
    std::swap(outline.left, outline.right);
    EXPECT_THROW((void)outline_mesh(outline, 1.), std::invalid_argument);
  }

  // Sides of 10.5 and 10.5 - 1e-9 elements get 11 edges both, where each by itself would get 11 and 10.
  TEST(Mesh, StraightSidesCarryVerticesAtEqualHeights)
  {
    Outline outline = wavy_outline(5, 10.5, 12, 0);
    outline.left    = {outline.left.front(), outline.left.back()};
    outline.right.back().y() -= 1e-9;
    const QuadMesh mesh = outline_mesh(outline, 1.);
    Grid           grid(mesh);
    EXPECT_TRUE(summarise(mesh).sides_match);
    EXPECT_EQ(grid.n_edges[left_side], 11u);
    EXPECT_EQ(grid.n_edges[right_side], 11u);
  }

  // Platens of 5.5 and 5.5 - 1e-9 elements get 6 and 5 edges; the edge that makes the number even goes to a platen.
  TEST(Mesh, StraightSidesStayEqualWhereTheNumberOfEdgesWouldBeOdd)
  {
    Outline outline          = wavy_outline(5.5, 7, 2, 0);
    outline.right.back().x() = 5.5 - 1e-9;
    const QuadMesh mesh      = outline_mesh(outline, 1.);
    Grid           grid(mesh);
    EXPECT_TRUE(summarise(mesh).sides_match);
    EXPECT_EQ(grid.n_edges, (std::map<unsigned int, unsigned int>{{1, 6}, {2, 6}, {3, 7}, {4, 7}}));
  }

  // Platen 1.3 on a width of 10 with elements of 0.5: 4.35 = 9 edges, 1.3 = 3 edges, 4.35 = 9 edges; height 6.2 = 12 edges.
  TEST(Mesh, OfARectangleHasAPlatenOfExactWidth)
  {
    const QuadMesh    mesh    = rectangle_mesh({10, 6.2, 1.3, 0.5});
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(summary.n_cells, 21u * 12u);
    EXPECT_EQ(summary.n_vertices, 22u * 13u);
    EXPECT_NEAR(summary.area, 62, 1e-12);
    EXPECT_NEAR(summary.shortest_edge, 1.3 / 3, 1e-14);
    EXPECT_NEAR(summary.longest_edge, 6.2 / 12, 1e-14);
    EXPECT_TRUE(summary.sides_match);
    EXPECT_NEAR(summary.platen_width, 1.3, 1e-14);
    EXPECT_NEAR(summary.height, 6.2, 1e-14);
    expect_that_deal_ii_reads(mesh);
    Grid grid(mesh);
    EXPECT_NEAR(grid.length[upper_platen], 1.3, 1e-14);
    EXPECT_NEAR(grid.length[free_edge], 8.7, 1e-13);
    EXPECT_NEAR(grid.length[lower_platen], 10, 1e-13);
    EXPECT_EQ(grid.n_edges, (std::map<unsigned int, unsigned int>{{1, 21}, {2, 3}, {3, 12}, {4, 12}, {5, 18}}));
    for (const auto &face : grid.triangulation.active_face_iterators())
      if (face->at_boundary() && face->boundary_id() == upper_platen)
        {
          EXPECT_EQ(face->center()[1], 6.2);
          EXPECT_LT(std::abs(face->center()[0] - 5), 0.5);
        }
  }

  TEST(Mesh, OfARectangleUnderOnePlatenHasNoFreeEdge)
  {
    for (const double platen : {0., 4.})
      {
        const QuadMesh mesh = rectangle_mesh({4, 3, platen, 1});
        expect_that_deal_ii_reads(mesh);
        const Grid grid(mesh);
        EXPECT_EQ(grid.n_edges, (std::map<unsigned int, unsigned int>{{1, 4}, {2, 4}, {3, 3}, {4, 3}}));
      }
  }

  TEST(Mesh, ARectangleThatIsNoneIsRefusedByItsMember)
  {
    const double nan = std::nan("");
    for (const auto &[rectangle, member] : {std::pair{Rectangle{0, 1, 0, 0.1}, "width"},
                                            {Rectangle{1, -1, 0, 0.1}, "height"},
                                            {Rectangle{1, nan, 0, 0.1}, "height"},
                                            {Rectangle{1, 1, 1.1, 0.1}, "platen_width"},
                                            {Rectangle{1, 1, -0.1, 0.1}, "platen_width"},
                                            {Rectangle{1, 1, 0, 0}, "element_size"},
                                            {Rectangle{1, 3, 0, 2}, "element_size"},
                                            {Rectangle{1, 1, 0, 1e-5}, "element_size"}})
      diptych::tests::expect_refused({std::string("rectangle: ") + member + " = "}, [&] { (void)rectangle_mesh(rectangle); });
  }

  TEST(Mesh, ThatCannotBeWrittenIsAnErrorThatNamesTheFile)
  {
    const Folder folder;
    diptych::tests::expect_refused<std::runtime_error>({"no_such_folder/a.msh"}, [&] {
      write_mesh(rectangle_mesh({1, 1, 0, 1}), folder / "no_such_folder/a.msh");
    });
  }
} // namespace
