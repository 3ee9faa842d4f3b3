// diptych: displacement increments and velocity fluctuations of grains, also in periodic samples
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/grain_kinematics.h"

#include <cmath>

#include <Eigen/LU>

#include "coupling/cells/point_bins.h"

namespace diptych::coupling
{
  namespace
  {
    // Wrapped centres, then images within reach of the mesh. `grain` is the number of the grain of each.
    struct Images
    {
      std::vector<Eigen::Vector2d> position;
      std::vector<unsigned int>    grain;
    };

    Images images_of(const TargetCells &target, const std::vector<Eigen::Vector2d> &position, const double reach)
    {
      Images images;
      for (unsigned int i = 0; i < position.size(); ++i)
        {
          images.position.push_back(target.wrapped(position[i]));
          images.grain.push_back(i);
        }
      for (const Eigen::Vector2d &shift : target.period.neighbours())
        for (unsigned int i = 0; i < position.size(); ++i)
          {
            const Eigen::Vector2d x = images.position[i] + shift;
            if (x.x() >= target.lower.x() - reach && x.x() <= target.upper.x() + reach)
              {
                images.position.push_back(x);
                images.grain.push_back(i);
              }
          }
      return images;
    }

    // Squared residual of grain i in the affine least squares fit around it, divided by 1 - h. The leverage is h = 1/n + mean_x .
    // (sum x' (x) x')^-1 mean_x with x' = x - mean_x and grain i at x = 0.
    double squared_residual(const Images &images, const PointBins &bins, const discrete::Snapshot &s, const unsigned int i)
    {
      const double           radius = strain_radius(s.mean_diameter);
      const Eigen::Vector2d &centre = images.position[i];
      int                    n      = 0;
      Eigen::Vector2d        sum_x = Eigen::Vector2d::Zero(), sum_v = sum_x;
      Eigen::Matrix2d        xx = Eigen::Matrix2d::Zero(), vx = xx;
      bins.for_each_near(centre, radius, [&](const unsigned int k) {
        const Eigen::Vector2d x = images.position[k] - centre;
        if (x.squaredNorm() > radius * radius)
          return;
        const Eigen::Vector2d v = s.velocity[images.grain[k]] - s.velocity[i]; // relative to grain i, because a common velocity
                                                                               // would cost digits
        ++n;
        sum_x += x;
        sum_v += v;
        xx += x * x.transpose();
        vx += v * x.transpose();
      });
      if (n < 4)
        return NAN;
      const Eigen::Vector2d mean_x = sum_x / n, mean_v = sum_v / n;
      xx -= n * mean_x * mean_x.transpose();
      vx -= n * mean_v * mean_x.transpose();
      if (!(4 * xx.determinant() > 1e-3 * xx.trace() * xx.trace()))
        return NAN;
      const Eigen::Vector2d lever    = xx.inverse() * mean_x;
      const double          leverage = 1. / n + mean_x.dot(lever);
      // The fit at x = 0, relative to the velocity of grain i. A grain apart from the others fits itself.
      return leverage < 1 - 1e-9 ? (mean_v - vx * lever).squaredNorm() / (1 - leverage) : NAN;
    }
  } // namespace

  DisplacementField periodic_displacement_field(const TargetCells        &target,
                                                const discrete::Snapshot &from,
                                                const discrete::Snapshot &to,
                                                const double              reach)
  {
    const DisplacementField grains = displacement_field(from, to);
    const Images            images = images_of(target, grains.position, reach);
    DisplacementField       field;
    field.position = images.position;
    // A free width moves an image relative to its grain.
    const double stretch = to.cell_width > 0 ? 1 - from.cell_width / to.cell_width : 0.;
    for (std::size_t k = 0; k < images.grain.size(); ++k)
      {
        const unsigned int    i    = images.grain[k];
        const Eigen::Vector2d away = images.position[k] - grains.position[i];
        field.increment.emplace_back(grains.increment[i] + stretch * away);
        field.weight.push_back(grains.weight[i]);
        field.rotation.push_back(grains.rotation[i]);
      }
    return field;
  }

  std::vector<double> fluctuation_energy(const TargetCells &target, const discrete::Snapshot &grains)
  {
    const double        radius = strain_radius(grains.mean_diameter);
    const Images        images = images_of(target, grains.position, radius);
    const PointBins     bins(images.position, radius);
    std::vector<double> energy;
    for (unsigned int i = 0; i < grains.position.size(); ++i)
      energy.push_back(0.5 * squared_residual(images, bins, grains, i));
    return energy;
  }
} // namespace diptych::coupling
