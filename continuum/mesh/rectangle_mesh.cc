// diptych: structured mesh of a rectangle with a platen in the middle of its upper edge
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "continuum/mesh/mesh.h"

namespace diptych::continuum
{
  namespace
  {
    void require_size(const bool condition, const char *member, const double value, const std::string &allowed)
    {
      if (condition)
        return;
      std::ostringstream message;
      message << "rectangle: " << member << " = " << value << " must be " << allowed;
      throw std::invalid_argument(message.str());
    }

    void validate(const Rectangle &r)
    {
      constexpr double most_cells = 1e7;
      require_size(std::isfinite(r.width) && r.width > 0, "width", r.width, "positive");
      require_size(std::isfinite(r.height) && r.height > 0, "height", r.height, "positive");
      require_size(r.platen_width >= 0 && r.platen_width <= r.width, "platen_width", r.platen_width,
                   "between 0 (whole edge) and the width");
      require_size(r.element_size > 0 && r.element_size <= 1.0001 * std::min(r.width, r.height), "element_size", r.element_size,
                   "positive and at most the width and the height");
      require_size(r.width / r.element_size * r.height / r.element_size <= most_cells, "element_size", r.element_size,
                   "so large that the mesh has at most 10 million cells");
    }

    // Append the points that cut [points.back(), end] into about `size` long pieces; the last one is `end` itself.
    void append_pieces(std::vector<double> &points, const double end, const double size)
    {
      const double       start = points.back();
      const unsigned int n     = std::max(1L, std::lround((end - start) / size));
      for (unsigned int k = 1; k < n; ++k)
        points.push_back(start + (end - start) * k / n);
      points.push_back(end);
    }

    // Vertices (i, j) in rows from below; the platen lies on the columns [first, last).
    QuadMesh grid(const std::vector<double> &x, const std::vector<double> &y, const unsigned int first, const unsigned int last)
    {
      const unsigned int nx = x.size() - 1, ny = y.size() - 1;
      const auto         vertex = [&](const unsigned int i, const unsigned int j) { return j * (nx + 1) + i; };
      QuadMesh           mesh;
      for (const double height : y)
        for (const double along : x)
          mesh.vertices.emplace_back(along, height);
      for (unsigned int j = 0; j < ny; ++j)
        for (unsigned int i = 0; i < nx; ++i)
          mesh.cells.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
      for (unsigned int i = 0; i < nx; ++i)
        {
          mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, lower_platen});
          mesh.boundary.push_back({{vertex(i, ny), vertex(i + 1, ny)}, first <= i && i < last ? upper_platen : free_edge});
        }
      for (unsigned int j = 0; j < ny; ++j)
        {
          mesh.boundary.push_back({{vertex(0, j), vertex(0, j + 1)}, left_side});
          mesh.boundary.push_back({{vertex(nx, j), vertex(nx, j + 1)}, right_side});
        }
      return mesh;
    }
  } // namespace

  QuadMesh rectangle_mesh(const Rectangle &rectangle)
  {
    validate(rectangle);
    const auto &[width, height, platen_width, element_size] = rectangle;
    const bool          whole_edge                          = platen_width == 0 || platen_width == width;
    std::vector<double> x{0.}, y{0.};
    if (!whole_edge)
      append_pieces(x, (width - platen_width) / 2, element_size);
    const unsigned int first = x.size() - 1;
    append_pieces(x, whole_edge ? width : (width + platen_width) / 2, element_size);
    const unsigned int last = x.size() - 1;
    if (!whole_edge)
      append_pieces(x, width, element_size);
    append_pieces(y, height, element_size);

    QuadMesh mesh = grid(x, y, first, last);
    check(mesh);
    return mesh;
  }
} // namespace diptych::continuum
