// diptych: displacement increments at points, and the strain increment around a point
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/strain_increment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

#include "coupling/cells/point_bins.h"
#include "coupling/cells/principal_axes.h"
#include "coupling/fields/node_transfer.h"

namespace diptych::coupling
{
  namespace
  {
    // G minimises sum w |u - c - G (x - x_0)|^2. With u' and x' the differences from the means, G = (sum w u' (x) x') (sum w x'
    // (x) x')^-1.
    Eigen::Matrix2d gradient_around(const DisplacementField &field,
                                    const PointBins         &bins,
                                    const Eigen::Vector2d   &centre,
                                    const double             radius)
    {
      double          sum_w = 0;
      int             n     = 0;
      Eigen::Vector2d sum_x = Eigen::Vector2d::Zero(), sum_u = Eigen::Vector2d::Zero();
      const auto      for_each_inside = [&](const auto &action) {
        // The search radius is slightly larger, so that rounding loses no point on the circle.
        bins.for_each_near(centre, radius * (1 + 1e-9), [&](const unsigned int i) {
          if (field.weight[i] > 0 && (field.position[i] - centre).squaredNorm() <= radius * radius)
            action(i);
        });
      };
      for_each_inside([&](const unsigned int i) {
        ++n;
        sum_w += field.weight[i];
        sum_x += field.weight[i] * (field.position[i] - centre);
        sum_u += field.weight[i] * field.increment[i];
      });
      if (n < 4)
        return Eigen::Matrix2d::Constant(NAN);

      const Eigen::Vector2d mean_x = centre + sum_x / sum_w, mean_u = sum_u / sum_w;
      Eigen::Matrix2d       xx = Eigen::Matrix2d::Zero(), ux = Eigen::Matrix2d::Zero();
      for_each_inside([&](const unsigned int i) {
        const Eigen::Vector2d x = field.position[i] - mean_x;
        xx += field.weight[i] * x * x.transpose();
        ux += field.weight[i] * (field.increment[i] - mean_u) * x.transpose();
      });
      // 4 det / trace^2 is 1 for an isotropic cloud and 0 for points on a line.
      if (!(4 * xx.determinant() > 1e-3 * xx.trace() * xx.trace()))
        return Eigen::Matrix2d::Constant(NAN);
      return ux * xx.inverse();
    }

    DisplacementField increments(const discrete::Snapshot &from, const discrete::Snapshot &to)
    {
      if (from.displacement.size() != to.displacement.size())
        throw std::invalid_argument("displacement increments need snapshots of the same grains at both instants");
      DisplacementField field;
      field.position = to.position;
      field.increment.resize(to.displacement.size());
      for (std::size_t i = 0; i < to.displacement.size(); ++i)
        field.increment[i] = to.displacement[i] - from.displacement[i];
      for (std::size_t i = 0; i < std::min(from.rotation.size(), to.rotation.size()); ++i)
        field.rotation.push_back(to.rotation[i] - from.rotation[i]);
      return field;
    }
  } // namespace

  DisplacementField displacement_field(const discrete::Snapshot &from, const discrete::Snapshot &to)
  {
    DisplacementField field   = increments(from, to);
    const auto        rattles = [](const discrete::Snapshot &s, const std::size_t i) {
      return i < s.rattler.size() && s.rattler[i] != 0;
    };
    bool counts_earlier = false;
    for (std::size_t i = 0; i < field.position.size(); ++i)
      counts_earlier = counts_earlier || !rattles(from, i);
    field.weight.resize(field.position.size());
    for (std::size_t i = 0; i < field.weight.size(); ++i)
      field.weight[i] = (counts_earlier && rattles(from, i)) || rattles(to, i) ? 0 : M_PI * to.radius[i] * to.radius[i];
    return field;
  }

  DisplacementField displacement_field(const continuum::Snapshot &from, const continuum::Snapshot &to)
  {
    DisplacementField field;
    field.position                             = to.position;
    field.weight                               = to.weight;
    const std::vector<Eigen::Vector2d> earlier = displacement_at_nodes_of(from, to);
    for (std::size_t k = 0; k < earlier.size(); ++k)
      field.increment.emplace_back(to.displacement[k] - earlier[k]);
    if (from.rotation.empty() || to.rotation.empty())
      return field;
    const std::vector<double> earlier_rotation = rotation_at_nodes_of(from, to);
    for (std::size_t k = 0; k < to.rotation.size(); ++k)
      field.rotation.push_back(to.rotation[k] - earlier_rotation[k]);
    return field;
  }

  std::vector<Eigen::Matrix2d> displacement_gradient(const DisplacementField            &field,
                                                     const std::vector<Eigen::Vector2d> &sample_points,
                                                     const double                        radius)
  {
    if (!(radius > 0))
      throw std::invalid_argument("the radius of the affine fits must be positive");
    if (field.increment.size() != field.position.size() || field.weight.size() != field.position.size())
      throw std::invalid_argument("a displacement field needs one increment and one weight per point");
    if (field.position.empty())
      return std::vector<Eigen::Matrix2d>(sample_points.size(), Eigen::Matrix2d::Constant(NAN));

    const PointBins              bins(field.position, radius);
    std::vector<Eigen::Matrix2d> gradient(sample_points.size());
    for (std::size_t k = 0; k < sample_points.size(); ++k)
      gradient[k] = gradient_around(field, bins, sample_points[k], radius);
    return gradient;
  }

  std::vector<double> mean_rotation(const DisplacementField            &field,
                                    const std::vector<Eigen::Vector2d> &sample_points,
                                    const double                        radius)
  {
    std::vector<double> means(sample_points.size(), NAN);
    if (field.rotation.empty())
      return means;
    const PointBins bins(field.position, radius);
    for (std::size_t k = 0; k < sample_points.size(); ++k)
      {
        double sum = 0, weight = 0;
        bins.for_each_near(sample_points[k], radius, [&](const unsigned int i) {
          const double share = radius * radius - (field.position[i] - sample_points[k]).squaredNorm();
          sum += std::max(0., share) * field.weight[i] * field.rotation[i];
          weight += std::max(0., share) * field.weight[i];
        });
        means[k] = weight > 0 ? sum / weight : NAN;
      }
    return means;
  }

  LocalMotion local_motion(const DisplacementField &field, const std::vector<Eigen::Vector2d> &sample_points, const double radius)
  {
    LocalMotion motion{displacement_gradient(field, sample_points, radius), {}, {}, mean_rotation(field, sample_points, radius)};
    for (std::size_t k = 0; k < sample_points.size(); ++k)
      {
        const Eigen::Matrix2d &g = motion.gradient[k];
        motion.shear.push_back(principal_difference(g));
        motion.spin.push_back(0.5 * (g(1, 0) - g(0, 1)));
        motion.relative_rotation[k] -= motion.spin[k];
      }
    return motion;
  }

  std::vector<double> shear_strain_increment(const DisplacementField            &field,
                                             const std::vector<Eigen::Vector2d> &sample_points,
                                             const double                        radius)
  {
    std::vector<double> shear;
    shear.reserve(sample_points.size());
    for (const Eigen::Matrix2d &g : displacement_gradient(field, sample_points, radius))
      shear.push_back(principal_difference(g));
    return shear;
  }
} // namespace diptych::coupling
