// diptych: meshes from gmsh's open model
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "continuum/mesh/quad_mesh.h"

namespace diptych::continuum
{
  // gmsh is a global: a session lasts for one call of ours, prints no messages and closes on every way out.
  struct GmshSession
  {
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession &)            = delete;
    GmshSession &operator=(const GmshSession &) = delete;
  };

  // Runs `action`. An error of any type (gmsh throws ints, strings or exceptions) becomes an `Error` with `what: ` before it.
  template <class Error, class Action> auto guarded(const std::string &what, Action &&action)
  {
    try
      {
        return action();
      }
    catch (const std::bad_alloc &)
      {
        throw std::runtime_error(what + ": not enough memory");
      }
    catch (const std::exception &error)
      {
        throw Error(what + ": " + error.what());
      }
    catch (const std::string &error)
      {
        throw Error(what + ": gmsh reports: " + error);
      }
    catch (const int code)
      {
        throw Error(what + ": gmsh failed with code " + std::to_string(code));
      }
  }

  // Mesh of gmsh's open model, not yet checked. Points that carry nothing (centres of arcs) and physical lines of other names
  // are left out. Throws std::invalid_argument for elements other than four-node quadrilaterals and two-node lines and for two
  // lines of one name. Vertices must be finite and in the plane z = 0.
  QuadMesh mesh_of_open_model();

  // True if gmsh's open model has at least one two-dimensional element, and all are four-node quadrilaterals.
  bool all_quadrilaterals();
} // namespace diptych::continuum
