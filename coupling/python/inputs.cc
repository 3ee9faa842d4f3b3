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
    const auto optional = [&](const char *name) {
      const py::object    given = entry(contacts, name);
      std::vector<double> values(i.size(), 0.);
      if (!given.is_none())
        demand_size(name, (values = numbers_of(given.cast<Numbers>(), name)).size(), i.size());
      return values;
    };
    const std::vector<double> shift = optional("shift"), shift_y = optional("shift_y"), couple = optional("couple");

    std::vector<discrete::ContactForce> list;
    for (std::size_t k = 0; k < i.size(); ++k)
      {
        if (i[k] < 0 || i[k] >= int(grains.position.size()) || j[k] < 0)
          throw std::invalid_argument("contact " + std::to_string(k) + " joins bodies " + std::to_string(i[k]) + " and " +
                                      std::to_string(j[k]) + "; i must be one of the grains 0 ... " +
                                      std::to_string(grains.position.size() - 1) + ", walls j count on from their number");
        const Eigen::Vector2d n = normal.empty() ? (grains.position[std::size_t(i[k])] - point[k]).normalized() : normal[k];
        list.push_back({i[k], j[k], point[k], n, force[k], shift[k], couple[k], shift_y[k]});
      }
    return list;
  }

  coupling::Period period_of(const Numbers &rows)
  {
    const auto vectors = vectors_of(rows, "period");
    if (vectors.size() < 2)
      return vectors.empty() ? 0. : vectors[0].x();
    const Eigen::Matrix2d lattice = (Eigen::Matrix2d() << vectors[0], vectors[1]).finished();
    if (!(lattice.determinant() > 0))
      throw std::invalid_argument("period: the two vectors must span an area, the second one to the left of the first");
    return coupling::Period(lattice);
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
