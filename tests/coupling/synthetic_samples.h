// diptych: meshes, contact networks and displacement fields of known truth for the tests of coupling/
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "coupling/band.h"
#include "coupling/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::coupling::synthetic
{
  inline double uniform(std::mt19937_64 &random, const double low, const double high)
  {
    return low + (high - low) * ((random() >> 11) * 0x1p-53); // the same on every standard library
  }

  inline double normal(std::mt19937_64 &random)
  {
    return std::sqrt(-2 * std::log(1 - uniform(random, 0, 1))) * std::cos(2 * M_PI * uniform(random, 0, 1));
  }

  // columns x rows cells over a box; inner nodes moved at random by up to the given share of a cell.
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

  struct Network
  {
    std::vector<Eigen::Vector2d>        position;
    std::vector<double>                 radius;
    std::vector<discrete::ContactForce> contacts;
  };

  // n grains at random in a box, each with two contacts at random points between it and others nearby; every tenth contact is
  // with a platen. Forces are random: nothing is in equilibrium.
  inline Network random_network(const Eigen::Vector2d &lower, const Eigen::Vector2d &upper, const int n, const std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    const auto      point = [&] {
      const double x = uniform(random, lower.x(), upper.x());
      return Eigen::Vector2d(x, uniform(random, lower.y(), upper.y()));
    };
    Network network;
    // neighbours in the list are neighbours in space: the list runs along a random walk
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

  // Truth of a band as struct Band reports it, lengths in units of the mean diameter 1.
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

  // Bands on an affine background with normal noise, its deviation a share of the platen increment.
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
} // namespace diptych::coupling::synthetic
