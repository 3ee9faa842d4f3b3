// diptych: sheared samples and their meshes
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "benchmarks/homogenisation/samples.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "discrete/panel/snapshot_file.h"
#include "discrete/panel/panel.h"

namespace diptych::benchmarks
{
  namespace
  {
    // Abscissa of a side at a height. The points of the side ascend.
    double abscissa(const std::vector<Eigen::Vector2d> &side, const double y)
    {
      const auto             above = std::lower_bound(side.begin() + 1, side.end() - 1, y,
                                                      [](const Eigen::Vector2d &p, const double height) { return p.y() < height; });
      const Eigen::Vector2d &a = *(above - 1), &b = *above;
      return b.y() > a.y() ? a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) : a.x();
    }

    template <class Value> void repeat(std::vector<Value> &values, const int n)
    {
      const std::vector<Value> once = values;
      for (int k = 1; k < n * n; ++k)
        values.insert(values.end(), once.begin(), once.end());
    }
  } // namespace

  std::vector<discrete::Snapshot> sheared_sample(const std::string &folder)
  {
    const std::string path = folder + "/sheared_4000";
    if (!folder.empty() && std::filesystem::exists(path + ".h5"))
      return discrete::read_snapshots(path + ".h5");
    std::cerr << "shearing 4000 discs to 4 %" << std::endl;
    discrete::Loading loading;
    loading.inertial_number = 1e-4;
    loading.stages          = {0.02, 0.025, 0.03, 0.035, 0.04};
    discrete::Options options;
    options.stepping.step = 0.5;
    discrete::Panel                 panel({}, loading, options);
    discrete::Status                status = panel.prepare();
    std::vector<discrete::Snapshot> snapshots{panel.snapshot()};
    for (int stage = 1; stage <= int(loading.stages.size()) && status == discrete::Status::finished; ++stage)
      {
        status = panel.advance_to(stage);
        snapshots.push_back(panel.snapshot());
      }
    if (status != discrete::Status::finished)
      throw std::runtime_error("the sheared sample: " + panel.report().message);
    if (!folder.empty())
      {
        std::filesystem::create_directories(folder);
        discrete::write_snapshots(path, snapshots);
      }
    return snapshots;
  }

  coupling::QuadMesh outline_mesh(const discrete::Outline &outline, const unsigned int columns, const unsigned int rows)
  {
    coupling::QuadMesh mesh;
    const double       low = outline.left.front().y(), high = outline.left.back().y();
    for (unsigned int r = 0; r <= rows; ++r)
      {
        const double y = low + (high - low) * r / rows, left = abscissa(outline.left, y), right = abscissa(outline.right, y);
        for (unsigned int c = 0; c <= columns; ++c)
          mesh.node.emplace_back(left + (right - left) * c / columns, y);
      }
    for (unsigned int r = 0; r < rows; ++r)
      for (unsigned int c = 0; c < columns; ++c)
        {
          const unsigned int first = r * (columns + 1) + c;
          mesh.cell.push_back({{first, first + 1, first + columns + 2, first + columns + 1}});
        }
    triangulate(mesh);
    return mesh;
  }

  discrete::Snapshot copies(const discrete::Snapshot &sample, const int n)
  {
    discrete::Snapshot s      = sample;
    const int          n_once = int(sample.position.size());
    Eigen::Vector2d    lower = sample.position.front(), upper = lower;
    for (const Eigen::Vector2d &x : sample.position)
      lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
    const Eigen::Vector2d spacing = upper - lower + Eigen::Vector2d::Constant(2 * sample.mean_diameter);
    repeat(s.position, n);
    repeat(s.displacement, n), repeat(s.velocity, n), repeat(s.rotation, n), repeat(s.spin, n), repeat(s.radius, n);
    repeat(s.mass, n), repeat(s.rattler, n), repeat(s.mean_internal_moment, n), repeat(s.mean_spin_term, n);
    repeat(s.window_forces, n), repeat(s.contacts, n), repeat(s.window_dissipation, n);
    const auto move = [&](std::vector<discrete::ContactForce> &contacts) {
      for (std::size_t k = 0; k < contacts.size(); ++k)
        {
          const int copy = int(k / (contacts.size() / (n * n)));
          contacts[k].point += Eigen::Vector2d(copy % n * spacing.x(), copy / n * spacing.y());
          // The numbers of the platens follow those of all grains.
          contacts[k].j += contacts[k].j < n_once ? copy * n_once : (n * n - 1) * n_once;
          contacts[k].i += copy * n_once;
        }
    };
    move(s.window_forces), move(s.contacts);
    for (std::size_t i = 0; i < s.position.size(); ++i)
      s.position[i] += Eigen::Vector2d(int(i) / n_once % n * spacing.x(), int(i) / n_once / n * spacing.y());
    return s;
  }
} // namespace diptych::benchmarks
