// diptych: repetition of the grain sample along x or in both directions
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/bodies/periodicity.h"

namespace diptych::discrete
{
  namespace
  {
    // Exponential of a symmetric matrix.
    Eigen::Matrix2d exponential(const Eigen::Matrix2d &a)
    {
      const double          mean = 0.5 * a.trace(), d = 0.5 * (a(0, 0) - a(1, 1)), s = std::hypot(d, a(0, 1));
      const Eigen::Matrix2d deviator = a - mean * Eigen::Matrix2d::Identity();
      return std::exp(mean) * (std::cosh(s) * Eigen::Matrix2d::Identity() + (s > 0 ? std::sinh(s) / s : 1.) * deviator);
    }

    // Takes the shorter of the equivalent lattice vectors (Lagrange), so that the heights of the parallelogram stay large.
    void reduce(Eigen::Matrix2d &a)
    {
      for (const int k : {0, 1})
        if (const double times = std::round(a.col(0).dot(a.col(1)) / a.col(k).squaredNorm()); times != 0)
          a.col(1 - k) -= times * a.col(k);
    }
  } // namespace

  double Lattice::least_extent() const
  {
    return area() / std::sqrt(std::max(vectors.col(0).squaredNorm(), vectors.col(1).squaredNorm()));
  }

  void Lattice::drift(const double duration, std::vector<Eigen::Vector2d> &position)
  {
    const Eigen::Matrix2d map = exponential(duration * velocity_gradient(rate));
    for (Eigen::Vector2d &x : position)
      x = map * x;
    vectors = map * vectors;
    strain += duration * rate;
    reduce(vectors);
  }

  void Lattice::stop()
  {
    rate.setZero();
    strain.setZero();
  }
} // namespace diptych::discrete
