// diptych: tests of the derivatives of the projected least squares problem, by differences
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/band_projection.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/coupling/synthetic_samples.h"

namespace
{
  using namespace diptych::coupling;

  BandData noisy_data()
  {
    const SampleFrame frame = synthetic::frame_52_75();
    const auto        field = synthetic::grain_field(frame, {{-46, 6, 2, 0.9, 8}, {40, 5, -3, -0.4, 3}}, 0.2, 3, 500);
    return synthetic::band_data(field, frame);
  }

  // The shapes with parameter k (angle, offset, log half width of each band) changed by `step`.
  std::vector<BandShape> moved(std::vector<BandShape> shape, const int k, const double step)
  {
    BandShape &band = shape[k / 3];
    if (k % 3 == 0)
      band.angle += step;
    else if (k % 3 == 1)
      band.offset += step;
    else
      band.half_width *= std::exp(step);
    return shape;
  }

  // Away from the minimum and with noise of a fifth of the platen increment, so that the misfit matters. Central differences with
  // steps of 1e-4 have an error of (step^2/6) x third derivative. 1e-6 of the largest entry leaves a margin of a hundred.
  TEST(BandProjection, DerivativesAgreeWithDifferencesOfTheSumOfSquares)
  {
    const BandData data = noisy_data();
    for (const int n_bands : {1, 2})
      {
        std::vector<BandShape> shape = {{-0.7, 3, 5}, {0.8, -1, 7}};
        shape.resize(n_bands);
        const BandProjection p    = project_bands(data, data.w, shape);
        const double         step = 1e-4, scale = p.hessian.cwiseAbs().maxCoeff();
        for (int k = 0; k < 3 * n_bands; ++k)
          {
            const BandProjection up   = project_bands(data, data.w, moved(shape, k, step));
            const BandProjection down = project_bands(data, data.w, moved(shape, k, -step));
            EXPECT_NEAR(p.descent[k], -(up.sum_of_squares - down.sum_of_squares) / (4 * step), 1e-6 * scale) << k;
            for (int l = 0; l < 3 * n_bands; ++l)
              EXPECT_NEAR(p.hessian(l, k), -(up.descent[l] - down.descent[l]) / (2 * step), 1e-6 * scale) << k << l;
          }
      }
  }

  // Without a misfit both forms of the second derivative are equal.
  TEST(BandProjection, GaussNewtonIsExactWithoutMisfit)
  {
    BandData                     data  = noisy_data();
    const std::vector<BandShape> shape = {{-0.7, 3, 5}};
    for (std::size_t i = 0; i < data.x.size(); ++i)
      data.u[i] = Eigen::Vector2d(0.3, -0.2) * shape[0].profile(data.x[i]) + 0.01 * data.x[i];
    const BandProjection p = project_bands(data, data.w, shape);
    EXPECT_LT((p.hessian - p.gauss_newton).norm(), 1e-10 * p.hessian.norm());
    EXPECT_LT(p.descent.norm(), 1e-10 * p.hessian.norm());
    EXPECT_NEAR(p.coefficient(3, 0), 0.3, 1e-12);
    EXPECT_NEAR(p.coefficient(3, 1), -0.2, 1e-12);
  }
} // namespace
