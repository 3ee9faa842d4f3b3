// diptych: arguments of the operators, from Python
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/inputs.h"

#include <numeric>

namespace diptych::python
{
  namespace
  {
    py::object entry(const py::dict &dict, const char *name)
    {
      return dict.contains(name) ? py::object(dict[name]) : py::none();
    }

    void demand_size(const std::string &name, const std::size_t found, const std::size_t wanted)
    {
      if (found != wanted)
        throw std::invalid_argument(name + ": " + std::to_string(wanted) + " entries are needed, not " + std::to_string(found));
    }
  } // namespace

  GrainInput grains_of(const py::dict &grains)
  {
    GrainInput input{vectors_of(grains["position"].cast<Numbers>(), "position"),
                     numbers_of(grains["radius"].cast<Numbers>(), "radius")};
    input.mean_diameter = 2 * std::accumulate(input.radius.begin(), input.radius.end(), 0.) / double(input.radius.size());
    return input;
  }

  std::vector<discrete::ContactForce> contacts_of(const py::dict &contacts, const GrainInput &grains)
  {
    const auto i = indices_of(contacts["i"].cast<Indices>(), "i"), j = indices_of(contacts["j"].cast<Indices>(), "j");
    const auto point = vectors_of(contacts["point"].cast<Numbers>(), "point");
    const auto force = vectors_of(contacts["force"].cast<Numbers>(), "force");
    demand_size("j", j.size(), i.size());
    demand_size("point", point.size(), i.size());
    demand_size("force", force.size(), i.size());
    std::vector<Eigen::Vector2d> normal;
    if (const py::object given = entry(contacts, "normal"); !given.is_none())
      demand_size("normal", (normal = vectors_of(given.cast<Numbers>(), "normal")).size(), i.size());
    std::vector<double> shift;
    if (const py::object given = entry(contacts, "shift"); !given.is_none())
      demand_size("shift", (shift = numbers_of(given.cast<Numbers>(), "shift")).size(), i.size());

    std::vector<double> couple;
    if (const py::object given = entry(contacts, "couple"); !given.is_none())
      demand_size("couple", (couple = numbers_of(given.cast<Numbers>(), "couple")).size(), i.size());

    std::vector<discrete::ContactForce> list;
    for (std::size_t k = 0; k < i.size(); ++k)
      {
        if (i[k] < 0 || i[k] >= int(grains.position.size()) || j[k] < 0)
          throw std::invalid_argument("contact " + std::to_string(k) + " joins bodies " + std::to_string(i[k]) + " and " +
                                      std::to_string(j[k]) + "; i must be one of the grains 0 ... " +
                                      std::to_string(grains.position.size() - 1) + ", walls j count on from their number");
        const Eigen::Vector2d n = normal.empty() ? (grains.position[std::size_t(i[k])] - point[k]).normalized() : normal[k];
        list.push_back({i[k], j[k], point[k], n, force[k], shift.empty() ? 0 : shift[k], couple.empty() ? 0 : couple[k]});
      }
    return list;
  }

  coupling::QuadMesh mesh_of(const py::dict &mesh)
  {
    coupling::QuadMesh result;
    result.node         = vectors_of(mesh["nodes"].cast<Numbers>(), "nodes");
    const Indices cells = mesh["cells"].cast<Indices>();
    if (cells.ndim() != 2 || cells.shape(1) != 4)
      refuse_shape(cells, "cells", "(k, 4)");
    for (py::ssize_t k = 0; k < cells.shape(0); ++k)
      {
        std::array<unsigned int, 4> cell;
        for (int corner = 0; corner < 4; ++corner)
          {
            const int node = cells.data()[4 * k + corner];
            if (node < 0 || node >= int(result.node.size()))
              throw std::invalid_argument("cells[" + std::to_string(k) + "] names node " + std::to_string(node) + " of " +
                                          std::to_string(result.node.size()));
            cell[std::size_t(corner)] = unsigned(node);
          }
        result.cell.push_back(cell);
      }
    coupling::triangulate(result);
    return result;
  }

  py::tuple interval(const coupling::Interval &interval)
  {
    return py::make_tuple(interval.value, interval.low, interval.high);
  }
} // namespace diptych::python
