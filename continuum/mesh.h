// diptych: all-quadrilateral mesh of a sample's outline
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // Ids of the physical lines of every mesh the continuum panel reads; a mesh of the user's own carries the same ids.
  enum BoundaryId : unsigned int
  {
    lower_platen = 1,
    upper_platen = 2,
    left_side    = 3,
    right_side   = 4
  };

  struct MeshSummary
  {
    unsigned int n_cells       = 0;
    unsigned int n_vertices    = 0;
    double       area          = 0; // [length^2]
    double       shortest_edge = 0; // [length]
    double       longest_edge  = 0; // [length]
    std::string  algorithm;         // what gmsh used, empty for a mesh that was read
  };

  // Mesh the polygon left side - upper platen - right side - lower platen with quadrilaterals whose edges are about
  // `element_size` [length] long, and write it as MSH 2.2 under a temporary name that is then renamed to `msh_file`.
  // The sides are resampled at the element size along the given polylines; the platens are straight.
  // Throws std::invalid_argument for an outline that is no sample (too few points, points not upward, sides crossing,
  // platens not horizontal) and std::runtime_error when no all-quadrilateral mesh is found or the file cannot be written.
  MeshSummary make_mesh(const Outline &outline, double element_size, const std::string &msh_file);

  // Read a .msh file with gmsh and check what the panel needs: quadrilaterals only, every boundary edge on one of the
  // four physical lines of BoundaryId, each of them present. Throws std::runtime_error naming the file and what is wrong.
  MeshSummary check_mesh(const std::string &msh_file);
} // namespace diptych::continuum
