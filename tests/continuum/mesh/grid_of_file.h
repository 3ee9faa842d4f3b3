// diptych: what deal.II's reader makes of a mesh file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <unistd.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <gtest/gtest.h>

#include "continuum/mesh/mesh.h"

namespace diptych::continuum
{
  // A folder of its own that lives as long as the test.
  struct Folder
  {
    std::filesystem::path path;

    Folder()
    {
      static int n = 0;
      path         = std::filesystem::path(testing::TempDir()) /
             ("diptych_mesh" + std::to_string(::getpid()) + "_" + std::to_string(n++));
      std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string file(const std::string &name) const { return (path / name).string(); }
  };

  // A mesh as deal.II's reader finds it in a file that write_mesh wrote.
  struct Grid
  {
    dealii::Triangulation<2>             triangulation;
    std::map<unsigned int, unsigned int> n_edges; // by boundary id
    std::map<unsigned int, double>       length;  // by boundary id

    explicit Grid(const QuadMesh &mesh)
    {
      const Folder folder;
      write_mesh(mesh, folder.file("mesh.msh"));
      EXPECT_FALSE(std::filesystem::exists(folder.file("mesh.msh.part")));
      dealii::GridIn<2> reader(triangulation);
      std::ifstream     file(folder.file("mesh.msh"));
      reader.read_msh(file);
      for (const auto &face : triangulation.active_face_iterators())
        if (face->at_boundary())
          {
            ++n_edges[face->boundary_id()];
            length[face->boundary_id()] += face->measure();
          }
      for (const auto &cell : triangulation.active_cell_iterators())
        EXPECT_EQ(cell->material_id(), 1u);
    }
  };

  inline void expect_that_deal_ii_reads(const QuadMesh &mesh)
  {
    const Grid        grid(mesh);
    const MeshSummary summary = summarise(mesh);
    EXPECT_EQ(grid.triangulation.n_active_cells(), summary.n_cells);
    EXPECT_EQ(grid.triangulation.n_used_vertices(), summary.n_vertices);
    EXPECT_NEAR(dealii::GridTools::volume(grid.triangulation), summary.area, 1e-12 * summary.area);
    for (const auto &[id, n] : grid.n_edges)
      EXPECT_TRUE(id >= lower_platen && id <= free_edge) << n << " edges have the id " << id;
    for (const unsigned int id : {lower_platen, upper_platen, left_side, right_side})
      EXPECT_EQ(grid.n_edges.count(id), 1u) << id;
  }
} // namespace diptych::continuum
