// diptych: meshes, samples and methods for the tests of averaging
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupling/averaging/averaging.h"
#include "discrete/choices.h"
#include "tests/coupling/synthetic_samples.h"

namespace diptych::coupling::synthetic
{
  inline const std::vector<AveragingOptions> averaging_methods = {
    {AveragingMethod::segments, KernelShape::gauss, 1.5}, {AveragingMethod::centroid, KernelShape::gauss, 1.5},
    {AveragingMethod::laguerre, KernelShape::gauss, 1.5}, {AveragingMethod::kernel, KernelShape::gauss, 1.5},
    {AveragingMethod::kernel, KernelShape::lucy, 0.8},    {AveragingMethod::projection, KernelShape::gauss, 1.5}};

  inline std::string name_of(const AveragingOptions &o)
  {
    const std::string method = discrete::name_of(o.method);
    return o.method == AveragingMethod::kernel ? method + " " + discrete::name_of(o.kernel) : method;
  }

  struct NamedMesh
  {
    std::string name;
    QuadMesh    mesh;
  };

  // Meshes over the box [0, 20] x [0, 30].
  inline std::vector<NamedMesh> averaging_meshes()
  {
    const QuadMesh quads = box_mesh({0, 0}, {20, 30}, 11, 16, 0.25);
    return {{"quads", quads},
            {"hanging nodes", refined(quads, [](const Eigen::Vector2d &x) { return x.x() > 8 && x.y() < x.x(); }).mesh},
            {"regular grid", regular_grid({0, 0}, {20, 30}, 2.4)}};
  }

  // Calls action(method, mesh) for every method on every mesh.
  template <class Action> void for_each_case(const Action &action)
  {
    for (const NamedMesh &mesh : averaging_meshes())
      for (const AveragingOptions &options : averaging_methods)
        {
          SCOPED_TRACE(name_of(options) + " on " + mesh.name);
          action(options, mesh.mesh);
        }
  }

  // Adds shifts across the sides of a cell of the given width to the network's contacts, and moves grains out of it by whole
  // periods.
  inline Network made_periodic(Network network, const double width, const std::uint64_t seed)
  {
    std::mt19937_64     random(seed);
    std::vector<double> shift;
    for (Eigen::Vector2d &x : network.position)
      {
        shift.push_back(width * std::floor(uniform(random, -1, 2)));
        x.x() += shift.back();
      }
    for (discrete::ContactForce &c : network.contacts)
      {
        // The whole contact moves with i. A grain j has its own shift.
        c.point.x() += shift[c.i];
        if (c.j < int(shift.size()))
          c.shift = shift[c.i] - shift[c.j];
      }
    return network;
  }

  // Random quantities of every kind. Grains have a mass, a momentum and a number of either sign.
  inline Carriers random_carriers(const Network &network, const std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    Carriers        c = moment_carriers(network.position, network.radius, network.contacts);
    c.of_grains.resize(Eigen::Index(network.position.size()), 3);
    for (Eigen::Index i = 0; i < c.of_grains.rows(); ++i)
      for (Eigen::Index k = 0; k < 3; ++k)
        c.of_grains(i, k) = k == 0 ? uniform(random, 0.3, 1) : normal(random);
    c.tapered.resize(Eigen::Index(c.half.size()), 2);
    for (Eigen::Index h = 0; h < c.tapered.rows(); ++h)
      c.tapered.row(h) << normal(random), normal(random);
    return c;
  }

  // Largest difference between two sets of sums, relative to the largest sum of the first. The three kinds of columns are
  // compared separately.
  inline double difference(const CellSums &a, const CellSums &b)
  {
    const auto relative = [](const Columns &x, const Columns &y) {
      return x.size() == 0 ? 0. : (x - y).cwiseAbs().maxCoeff() / x.cwiseAbs().maxCoeff();
    };
    return std::max({relative(a.of_grains, b.of_grains), relative(a.uniform, b.uniform), relative(a.tapered, b.tapered)});
  }
} // namespace diptych::coupling::synthetic
