// diptych: meshes out of gmsh's open model, and into the files that deal.II reads
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>

#include "continuum/quad_mesh.h"

namespace diptych::continuum
{
  // gmsh is a global: it lives as long as one call of ours, and is closed on every way out. Without messages.
  struct GmshSession
  {
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession &)            = delete;
    GmshSession &operator=(const GmshSession &) = delete;
  };

  // Do `action` and put `what: ` in front of the message of every error. gmsh throws ints, strings or exceptions, depending
  // on the place.
  template <class Action> auto guarded(const std::string &what, Action &&action)
  {
    try
      {
        return action();
      }
    catch (const std::exception &error)
      {
        throw std::runtime_error(what + ": " + error.what());
      }
    catch (const std::string &error)
      {
        throw std::runtime_error(what + ": gmsh says " + error);
      }
    catch (const int code)
      {
        throw std::runtime_error(what + ": gmsh failed with code " + std::to_string(code));
      }
  }

  enum class LineNumbers
  {
    any,     // a physical line with a name counts by its name
    required // ... and must carry the number of BoundaryId, too
  };

  // Mesh of gmsh's open model, not yet checked. Points that carry nothing (centres of arcs) and physical lines of other
  // names are left out. Throws std::runtime_error for elements other than four-node quadrilaterals and two-node lines, for
  // two lines of one name, and for vertices that are not finite or not in the plane z = 0.
  QuadMesh mesh_of_open_model(LineNumbers numbers);

  // All two-dimensional elements of gmsh's open model are four-node quadrilaterals, and there is one.
  bool all_quadrilaterals();

  // Write MSH 2.2 under the temporary name file + ".part", then rename. Throws std::runtime_error naming the file.
  void write_msh(const QuadMesh &mesh, const std::string &file);
} // namespace diptych::continuum
