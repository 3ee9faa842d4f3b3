// diptych: meshes, contact networks and displacement fields of known truth for tests of coupling/
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Core>

#include "continuum/snapshot.h"
#include "coupling/averaging/segments.h"
#include "coupling/bands/band.h"
#include "coupling/bands/band_projection.h"
#include "coupling/cells/mesh_cells.h"
#include "coupling/fields/strain_increment.h"
#include "discrete/snapshot.h"
#include "discrete/files/text_file.h"
#include "tests/common.h"

namespace diptych::coupling::synthetic
{
  using namespace diptych;
  using namespace diptych::coupling;

  inline double uniform(std::mt19937_64 &random, const double low, const double high)
  {
    return low + (high - low) * ((random() >> 11) * 0x1p-53); // gives the same on every standard library
  }

  inline double normal(std::mt19937_64 &random)
  {
    return std::sqrt(-2 * std::log(1 - uniform(random, 0, 1))) * std::cos(2 * M_PI * uniform(random, 0, 1));
  }

  // columns x rows cells over a box. Inner nodes are moved at random by up to the given share of a cell.
  inline QuadMesh box_mesh(const Eigen::Vector2d &lower,
                           const Eigen::Vector2d &upper,
                           const unsigned int     columns,
                           const unsigned int     rows,
                           const double           distortion = 0)
  {
    std::mt19937_64       random(7);
    const Eigen::Vector2d size((upper.x() - lower.x()) / columns, (upper.y() - lower.y()) / rows);
    QuadMesh              mesh;
    for (unsigned int r = 0; r <= rows; ++r)
      for (unsigned int c = 0; c <= columns; ++c)
        {
          Eigen::Vector2d node = lower + Eigen::Vector2d(c * size.x(), r * size.y());
          if (r > 0 && c > 0 && r < rows && c < columns)
            for (int k = 0; k < 2; ++k)
              node[k] += distortion * size[k] * uniform(random, -1, 1);
          mesh.node.push_back(node);
        }
    const auto number = [columns](const unsigned int r, const unsigned int c) { return r * (columns + 1) + c; };
    for (unsigned int r = 0; r < rows; ++r)
      for (unsigned int c = 0; c < columns; ++c)
        mesh.cell.push_back({{number(r, c), number(r, c + 1), number(r + 1, c + 1), number(r + 1, c)}});
    triangulate(mesh);
    return mesh;
  }

  // Cuts every cell whose centre satisfies `chosen` into four, by the middles of its edges and its centre. Its neighbours then
  // have hanging nodes. children[c]: the cells that replace cell c.
  struct Refined
  {
    QuadMesh                               mesh;
    std::vector<std::vector<unsigned int>> children;
  };
  inline Refined refined(const QuadMesh &coarse, const std::function<bool(const Eigen::Vector2d &)> &chosen)
  {
    Refined result;
    result.mesh.node = coarse.node;
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> middle;
    const auto                                                    middle_of = [&](const unsigned int a, const unsigned int b) {
      const auto [place, is_new] = middle.insert({std::minmax(a, b), result.mesh.node.size()});
      if (is_new)
        result.mesh.node.push_back(0.5 * (coarse.node[a] + coarse.node[b]));
      return place->second;
    };
    for (unsigned int c = 0; c < coarse.cell.size(); ++c)
      {
        const auto &n = coarse.cell[c];
        result.children.emplace_back();
        const auto add = [&](const std::array<unsigned int, 4> &cell) {
          result.children.back().push_back(result.mesh.cell.size());
          result.mesh.cell.push_back(cell);
        };
        if (!chosen(cell_centre(coarse, c)))
          {
            add(n);
            continue;
          }
        const unsigned int centre = result.mesh.node.size();
        result.mesh.node.push_back(cell_centre(coarse, c));
        for (unsigned int k = 0; k < 4; ++k)
          add({{n[k], middle_of(n[k], n[(k + 1) % 4]), centre, middle_of(n[(k + 3) % 4], n[k])}});
      }
    triangulate(result.mesh);
    return result;
  }

  // columns x rows cells over a box, of which the `divided` ones are cut into four, and then every node moves. A displacement
  // that is not linear moves a hanging node off the chord.
  inline QuadMesh refined_mesh(const Eigen::Vector2d                                         &lower,
                               const Eigen::Vector2d                                         &upper,
                               const std::array<unsigned int, 2>                             &cells,
                               const std::function<bool(const Eigen::Vector2d &)>            &divided,
                               const std::function<Eigen::Vector2d(const Eigen::Vector2d &)> &displacement)
  {
    QuadMesh                           mesh    = refined(box_mesh(lower, upper, cells[0], cells[1]), divided).mesh;
    const std::vector<Eigen::Vector2d> initial = mesh.node;
    for (Eigen::Vector2d &x : mesh.node)
      x += displacement(x);
    triangulate(mesh, initial);
    return mesh;
  }

  // Nine-node cells of a regular grid whose nodes are numbered row by row, as in the continuum's snapshots.
  inline auto nine_node_cells(const unsigned int columns, const unsigned int rows)
  {
    decltype(continuum::Snapshot::cells) cells;
    for (unsigned int r = 0; r < rows; ++r)
      for (unsigned int c = 0; c < columns; ++c)
        {
          const unsigned int m = 2 * columns + 1, a = 2 * r * m + 2 * c, b = a + m, d = b + m;
          cells.push_back({{a, a + 2, d + 2, d, a + 1, b + 2, d + 1, b, b + 1}});
        }
    return cells;
  }

  struct Network
  {
    std::vector<Eigen::Vector2d>        position;
    std::vector<double>                 radius;
    std::vector<discrete::ContactForce> contacts;
  };

  // n grains at random in a box, each with two contacts at random points between it and nearby grains. Every tenth contact is
  // with a platen. The forces are random, so nothing is in equilibrium.
  inline Network random_network(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, const int n, const std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    const auto      point = [&] {
      const double x = uniform(random, lower.x(), upper.x());
      return Eigen::Vector2d(x, uniform(random, lower.y(), upper.y()));
    };
    Network network;
    // The list follows a random walk, so that neighbours in the list are neighbours in space.
    Eigen::Vector2d x = point();
    for (int i = 0; i < n; ++i)
      {
        const Eigen::Vector2d step(uniform(random, -1, 1), uniform(random, -1, 1));
        x = (x + step).cwiseMax(lower).cwiseMin(upper);
        if (i % 50 == 0)
          x = point();
        network.position.push_back(x);
        network.radius.push_back(uniform(random, 0.3, 0.7));
      }
    for (int k = 0; k < 2 * n; ++k)
      {
        discrete::ContactForce contact;
        contact.i                   = k % n;
        contact.j                   = k % 10 == 0 ? n + 1 : (contact.i + 1 + k / n) % n;
        contact.force               = {normal(random), normal(random)};
        const Eigen::Vector2d other = contact.j < n ? network.position[contact.j] : point();
        const Eigen::Vector2d nudge(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1));
        contact.point  = (0.5 * (network.position[contact.i] + other) + nudge).cwiseMax(lower).cwiseMin(upper);
        contact.normal = (network.position[contact.i] - other).normalized();
        network.contacts.push_back(contact);
      }
    return network;
  }

  // |sum over triangles - total| / |total|.
  inline double loss(const MappedMoment &mapped)
  {
    Eigen::Matrix2d rest = mapped.total;
    for (const Eigen::Matrix2d &moment : mapped.triangle_moment)
      rest -= moment;
    return rest.norm() / mapped.total.norm();
  }

  // True values of a band, defined as in struct Band, with lengths in units of the mean diameter 1.
  struct Truth
  {
    double angle_deg, half_width, offset, jump, dilation_deg;
  };

  inline SampleFrame frame_52_75()
  {
    SampleFrame frame;
    frame.centre           = {26, 37.5};
    frame.width            = 52;
    frame.height           = 75;
    frame.platen_increment = {0.5, -0.5};
    return frame;
  }

  inline const std::vector<Eigen::Vector2d> box_52_75 = {{0, 0}, {52, 0}, {52, 75}, {0, 75}};

  // The lower left corner is at the origin.
  inline SampleFrame frame_of(const double width, const double height, const Eigen::Vector2d &platen_increment)
  {
    SampleFrame frame;
    frame.centre           = {0.5 * width, 0.5 * height};
    frame.width            = width;
    frame.height           = height;
    frame.platen_increment = platen_increment;
    return frame;
  }

  inline Eigen::Vector2d band_displacement(const Truth &truth, const SampleFrame &frame, const Eigen::Vector2d &x)
  {
    Band axes;
    axes.angle_deg                   = truth.angle_deg;
    const double          dilation   = truth.dilation_deg * M_PI / 180;
    const double          coordinate = (x - frame.centre).dot(axes.normal());
    const Eigen::Vector2d jump       = truth.jump * std::cos(dilation) * axes.direction() +
                                 std::abs(truth.jump) * std::sin(dilation) * axes.normal();
    return 0.5 * frame.platen_increment.norm() * std::tanh((coordinate - truth.offset) / truth.half_width) * jump;
  }

  // Bands on an affine background with normal noise. The noise's deviation is a share of the platen increment.
  inline DisplacementField grain_field(const SampleFrame        &frame,
                                       const std::vector<Truth> &bands,
                                       const double              noise,
                                       const std::uint64_t       seed,
                                       const int                 n = 4000)
  {
    std::mt19937_64 random(seed);
    Eigen::Matrix2d gradient;
    gradient << 0.2, 0.1, -0.15, -0.3;
    gradient *= frame.platen_increment.norm() / frame.height;
    DisplacementField field;
    for (int i = 0; i < n; ++i)
      {
        const double          across = uniform(random, -0.5, 0.5) * frame.width;
        const Eigen::Vector2d x      = frame.centre + Eigen::Vector2d(across, uniform(random, -0.5, 0.5) * frame.height);
        Eigen::Vector2d       u      = Eigen::Vector2d(0.01, -0.02) + gradient * (x - frame.centre);
        for (const auto &band : bands)
          u += band_displacement(band, frame, x);
        for (int k = 0; k < 2; ++k)
          u[k] += noise * frame.platen_increment.norm() * normal(random);
        field.position.push_back(x);
        field.increment.push_back(u);
        const double radius = uniform(random, 0.3, 0.7);
        field.weight.push_back(M_PI * radius * radius);
      }
    return field;
  }

  // A field as the fit takes it: about the frame's middle, in units of the platen increment.
  inline BandData band_data(const DisplacementField &field, const SampleFrame &frame)
  {
    BandData data;
    for (std::size_t i = 0; i < field.position.size(); ++i)
      {
        data.x.push_back(field.position[i] - frame.centre);
        data.u.push_back(field.increment[i] / frame.platen_increment.norm());
      }
    data.w = field.weight;
    return data;
  }

  // Adds noise that is smooth over a length L: correlation exp(-pi r^2/L^2), whose integral over the plane is L^2 (one
  // independent sample per L x L). White noise on a grid of spacing w = L/sqrt(4 pi) is smoothed with exp(-r^2/(2 w^2)). The
  // squares of these weights add up to pi. The deviation is a share of the platen increment.
  inline void add_correlated_noise(DisplacementField  &field,
                                   const SampleFrame  &frame,
                                   const double        length,
                                   const double        deviation,
                                   const std::uint64_t seed)
  {
    constexpr int         reach = 4;
    const double          w = length / std::sqrt(4 * M_PI), scale = deviation * frame.platen_increment.norm() / std::sqrt(M_PI);
    const Eigen::Vector2d low     = frame.centre - Eigen::Vector2d(0.5 * frame.width + reach * w, 0.5 * frame.height + reach * w);
    const int             columns = int(frame.width / w) + 2 * reach + 2, rows = int(frame.height / w) + 2 * reach + 2;
    std::mt19937_64       random(seed);
    std::vector<Eigen::Vector2d> white(columns * rows);
    for (Eigen::Vector2d &value : white)
      {
        value.x() = normal(random);
        value.y() = normal(random);
      }
    for (std::size_t i = 0; i < field.position.size(); ++i)
      {
        const Eigen::Vector2d place = (field.position[i] - low) / w;
        for (int c = std::max(0, int(place.x()) - reach); c <= std::min(columns - 1, int(place.x()) + reach + 1); ++c)
          for (int r = std::max(0, int(place.y()) - reach); r <= std::min(rows - 1, int(place.y()) + reach + 1); ++r)
            field.increment[i] += scale * std::exp(-0.5 * (place - Eigen::Vector2d(c, r)).squaredNorm()) * white[c + columns * r];
      }
  }

  // Gives a share of the points an increment of 0.5 to 3 platen increments in any direction, as rattlers may have.
  inline void add_outliers(DisplacementField &field, const SampleFrame &frame, const double share, const std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    for (Eigen::Vector2d &u : field.increment)
      if (uniform(random, 0, 1) < share)
        {
          const double angle = uniform(random, 0, 2 * M_PI), length = uniform(random, 0.5, 3) * frame.platen_increment.norm();
          u += length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        }
  }

  // Nodes of a regular grid over the frame, weighted by area, without background and noise.
  inline DisplacementField node_field(const SampleFrame        &frame,
                                      const std::vector<Truth> &bands,
                                      const int                 columns,
                                      const int                 rows)
  {
    DisplacementField field;
    for (int r = 0; r <= rows; ++r)
      for (int c = 0; c <= columns; ++c)
        {
          const Eigen::Vector2d share(double(c) / columns - 0.5, double(r) / rows - 0.5);
          const Eigen::Vector2d x = frame.centre + Eigen::Vector2d(share.x() * frame.width, share.y() * frame.height);
          Eigen::Vector2d       u = Eigen::Vector2d::Zero();
          for (const Truth &band : bands)
            u += band_displacement(band, frame, x);
          field.position.push_back(x);
          field.increment.push_back(u);
          field.weight.push_back((r % rows == 0 ? 0.5 : 1) * (c % columns == 0 ? 0.5 : 1));
        }
    return field;
  }
} // namespace diptych::coupling::synthetic
