// diptych: what deal.II's reader makes of a mesh file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include "continuum/mesh/mesh.h"
#include "tests/common.h"

namespace diptych::continuum
{
  using diptych::tests::Folder;

  // A mesh as deal.II's reader finds it in a file that write_mesh wrote.
  struct Grid
  {
    dealii::Triangulation<2>             triangulation;
    std::map<unsigned int, unsigned int> n_edges; // by boundary id
    std::map<unsigned int, double>       length;  // by boundary id

    explicit Grid(const QuadMesh &mesh)
    {
      const Folder folder;
      write_mesh(mesh, folder / "mesh.msh");
      EXPECT_FALSE(std::filesystem::exists(folder / "mesh.msh.part"));
      dealii::GridIn<2> reader(triangulation);
      std::ifstream     file(folder / "mesh.msh");
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

  // read_mesh names the file first, and says `reason`.
  inline void expect_mesh_refused(const std::string &user_file, const std::string &reason)
  {
    const std::string message = diptych::tests::refusal([&] { (void)read_mesh(user_file); });
    EXPECT_TRUE(message.find(user_file + ": ") == 0 || message.find(user_file + ", line ") == 0) << message;
    diptych::tests::expect_words(message, {reason});
  }
} // namespace diptych::continuum
