// diptych: arguments of the operators, from Python
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "coupling/bands/band.h"
#include "coupling/cells/period.h"
#include "coupling/python/arrays.h"
#include "coupling/scene/keys.h"
#include "coupling/scene/scene_error.h"
#include "coupling/statistics/interval.h"
#include "discrete/snapshot.h"

namespace diptych::python
{
  // {"position": (n, 2), "radius": (n)} with n > 0 positive radii, which the Python package checks
  struct GrainInput
  {
    std::vector<Eigen::Vector2d> position;
    std::vector<double>          radius;
    double                       mean_diameter = 1;
  };
  GrainInput grains_of(const py::dict &grains);

  // {"i": (c), "j": (c), "point": (c, 2), "force": (c, 2), "normal": (c, 2) or None, "shift", "shift_y" and "couple": (c) or
  // None}. Without "normal", normals point from the contact point to the centre of i.
  std::vector<discrete::ContactForce> contacts_of(const py::dict &contacts, const GrainInput &grains);

  // Rows: none, (width, 0), or the two vectors of a cell. Throws std::invalid_argument for vectors that span no area.
  coupling::Period period_of(const Numbers &rows);

  // {"nodes": (m, 2), "cells": (k, 4)}, corners anticlockwise.
  coupling::QuadMesh mesh_of(const py::dict &mesh);

  // (value, low, high)
  py::tuple interval(const coupling::Interval &interval);

  // Sets keys of a scene in options that have a visit_parameters. Throws SceneError with the key.
  template <class Options> void set_options(const std::string &section, const py::dict &given, Options &options)
  {
    for (const auto &[name, value] : given)
      {
        const auto       key = name.template cast<std::string>();
        coupling::SetKey set{key, value.template cast<std::string>(), ""};
        visit_parameters(options, set);
        if (set.found && set.good)
          continue;
        std::vector<coupling::KeyDescription> known;
        visit_parameters(options, coupling::DescribeKeys{section, known});
        std::string allowed;
        for (const coupling::KeyDescription &one : known)
          if (!set.found)
            allowed += (allowed.empty() ? "one of " : ", ") + one.name;
          else if (one.name == key)
            allowed = one.allowed + " [" + one.unit + "]";
        throw coupling::SceneError((set.found ? section + "/" + key + " = '" + set.text + "' is not allowed: "
                                              : "unknown key '" + section + "/" + key + "': ") +
                                   allowed + " is");
      }
  }
} // namespace diptych::python
