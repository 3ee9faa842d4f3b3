// diptych: quadrilateral meshes of a sample's outline, of a rectangle or from a file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/mesh/quad_mesh.h"
#include "continuum/snapshot.h"
#include "continuum/stopping.h"

namespace diptych::continuum
{
  // Every mesh returned here has passed check(). `check_stop` is called while gmsh works (mesh_child.h).

  // Meshes the polygon left side - upper platen - right side - lower platen with quadrilaterals whose edges are about
  // `element_size` [length] long. The sides are resampled at the element size along the given polylines; the platens are
  // straight. Sides that are both straight and vertical get vertices at equal heights, as periodic sides need. Throws
  // std::invalid_argument for too few points, points not upward, crossing sides or inclined platens. Throws std::runtime_error
  // if no all-quadrilateral mesh is found.
  QuadMesh outline_mesh(const Outline &outline, double element_size, const CheckStop &check_stop = {});

  // A rectangle with its lower left corner at the origin. [length]
  struct Rectangle
  {
    double width        = 0;
    double height       = 0;
    double platen_width = 0; // of the strip in the middle of the upper edge that is the upper platen; 0: the whole edge
    double element_size = 0; // about, in both directions; at most the width and the height
  };

  // Structured mesh with rows of equal height. Columns have equal width below the platen and below each free part of the upper
  // edge. So the platen's ends are vertices, its width is exact, and the sides match. Throws std::invalid_argument naming the
  // member and what is allowed.
  QuadMesh rectangle_mesh(const Rectangle &rectangle);

  // The user's mesh: a .msh file, or a .geo script, which gmsh meshes first. gmsh opens the file in a child process with two
  // minutes of CPU time. A .geo script is a program and may do what the user may do. Physical lines are recognised by name,
  // those without a name by number; every boundary edge must lie on exactly one of them.
  // Throws std::invalid_argument naming the file and the fault.
  QuadMesh read_mesh(const std::string &file, const CheckStop &check_stop = {});

  // Writes MSH 2.2 for deal.II's GridIn and gmsh, with the ids and names of BoundaryId and all digits, to a temporary name,
  // then renames it. Throws std::runtime_error naming the file.
  void write_mesh(const QuadMesh &mesh, const std::string &msh_file);
} // namespace diptych::continuum
