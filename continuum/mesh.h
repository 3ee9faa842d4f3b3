// diptych: all-quadrilateral meshes: of a sample's outline, of a rectangle, or the user's own
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Ids of the physical lines of every mesh the continuum panel reads. The physical names are those of the enumerators,
  // and "free" for free_edge, the only one that a mesh may lack.
  enum BoundaryId : unsigned int
  {
    lower_platen = 1,
    upper_platen = 2,
    left_side    = 3,
    right_side   = 4,
    free_edge    = 5 // neither platen nor side: no force, no prescribed motion
  };

  struct MeshSummary
  {
    unsigned int n_cells       = 0;
    unsigned int n_vertices    = 0;
    double       area          = 0;     // [length^2]
    double       shortest_edge = 0;     // [length]
    double       longest_edge  = 0;     // [length]
    bool         sides_match   = false; // both sides carry vertices at equal heights (within 1e-9 of the mesh's height)
    std::string  algorithm;             // what gmsh used, empty for a mesh that was read or is structured
  };

  // A rectangle with its lower left corner at the origin. [length]
  struct Rectangle
  {
    double width        = 0;
    double height       = 0;
    double platen_width = 0; // of the strip in the middle of the upper edge that is the upper platen; 0: the whole edge
    double element_size = 0; // about, in both directions; at most the width and the height
  };

  // All functions below write MSH 2.2 as deal.II's GridIn reads it, with the ids and names of BoundaryId, under a temporary
  // name (.part) that is then renamed to `msh_file`, and throw std::runtime_error when that cannot be written.

  // Mesh the polygon left side - upper platen - right side - lower platen with quadrilaterals whose edges are about
  // `element_size` [length] long. The sides are resampled at the element size along the given polylines; the platens are
  // straight. Sides that are both straight and vertical get vertices at equal heights, as periodic sides need.
  // Throws std::invalid_argument for an outline that is no sample (too few points, points not upward, sides crossing,
  // platens not horizontal) and std::runtime_error when no all-quadrilateral mesh is found.
  MeshSummary make_mesh(const Outline &outline, double element_size, const std::string &msh_file);

  // Structured mesh: rows of equal height, columns of equal width below the platen and below each free part of the upper
  // edge, so that the platen's ends are vertices and its width is exact; sides_match holds.
  // Throws std::invalid_argument naming the member and what is allowed.
  MeshSummary make_rectangle_mesh(const Rectangle &rectangle, const std::string &msh_file);

  // Read the user's own mesh (.msh of any version gmsh knows; or a .geo, which gmsh meshes first), check it and write it to
  // `msh_file`. Its physical lines count by NAME whatever their numbers; a line without a name counts by its number. Every
  // boundary edge must lie on exactly one of them. Throws std::runtime_error naming the file and what is wrong.
  MeshSummary prepare_mesh(const std::string &user_file, const std::string &msh_file);

  // Check a mesh that deal.II is about to read as it stands: as prepare_mesh(), and the physical lines must carry the NUMBERS
  // of BoundaryId. Throws std::runtime_error naming the file and what is wrong.
  MeshSummary check_mesh(const std::string &msh_file);
} // namespace diptych::continuum
