// diptych: loss of ellipticity against the closed form of in-plane Mohr-Coulomb and against a search over directions
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <Eigen/Dense>

#include "continuum/laws/localisation.h"
#include "tests/common.h"

namespace
{
  using namespace diptych::continuum;

  constexpr double degree = M_PI / 180;

  // Plane strain with G and kappa = K + G/3: C_xxxx = kappa + G, C_xxyy = kappa - G.
  constexpr double G = 200, kappa = 350;

  Tangent tangent_of(const Eigen::Matrix3d &d)
  {
    Tangent result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        result[i][j] = d(i, j);
    return result;
  }

  Eigen::Matrix3d elastic_matrix()
  {
    Eigen::Matrix3d d;
    d << kappa + G, kappa - G, 0, kappa - G, kappa + G, 0, 0, 0, G;
    return d;
  }

  // Derivative of t - s sin(angle) by (s_xx, s_yy, s_xy), tension positive. The less compressive principal stress points at
  // `direction` from the x axis. t has the derivative (cos 2d, -cos 2d, 2 sin 2d)/2, and s = -(s_xx + s_yy)/2.
  Eigen::Vector3d gradient(const double sine, const double direction)
  {
    return {(std::cos(2 * direction) + sine) / 2, (-std::cos(2 * direction) + sine) / 2, std::sin(2 * direction)};
  }

  // C_ep = C - (C P)(F C)/(H + F C P). phi and psi in degrees; H is the hardening modulus -dF/d lambda.
  Eigen::Matrix3d plastic_matrix(const double phi, const double psi, const double hardening, const double direction)
  {
    const Eigen::Matrix3d c = elastic_matrix();
    const Eigen::Vector3d f = gradient(std::sin(phi * degree), direction), p = gradient(std::sin(psi * degree), direction);
    return c - (c * p) * (c * f).transpose() / (hardening + f.dot(c * p));
  }

  Localisation of(const Eigen::Matrix3d &d)
  {
    return localisation(tangent_of(d), tangent_of(elastic_matrix()));
  }

  // Smallest difference of two line angles [degrees].
  double between(const double a, const double b)
  {
    return std::abs(std::remainder(a - b, 180.));
  }

  // Closed form (Rudnicki & Rice 1975 in two dimensions). n lies at theta from the less compressive principal stress; x = cos 2
  // theta. The elastic acoustic tensor is Q_e = G 1 + kappa n n, and C:P = kappa sin psi 1 + G diag(1, -1). The plastic one is
  // singular at
  //   H(x) = kappa G/(kappa + G) (x - sin phi)(sin psi - x),  largest at x = (sin phi + sin psi)/2:
  //   H_critical = kappa G/(kappa + G) ((sin phi - sin psi)/2)^2.
  // For any H: det Q / det Q_e = (H - H(x))/(H + G + kappa sin phi sin psi). The line is perpendicular to n. It lies at the
  // angle b from the direction of the less compressive (minor) principal stress with sin(2 b - 90) = x; approximately b = 45 +
  // (phi + psi)/4.
  struct ClosedForm
  {
    double sum, critical, denominator, line; // line [degrees]

    ClosedForm(const double phi, const double psi)
    {
      const double f = std::sin(phi * degree), p = std::sin(psi * degree);
      sum         = (f + p) / 2;
      critical    = kappa * G / (kappa + G) * (f - p) * (f - p) / 4;
      denominator = G + kappa * f * p;
      line        = 45 + std::asin(sum) / degree / 2;
    }
  };

  TEST(Localisation, MohrCoulombLosesEllipticityAtTheCriticalHardeningModulus)
  {
    for (const auto &[phi, psi] : {std::pair{40., 10.}, {30., 0.}, {35., 35.}, {20.5, 12.}})
      {
        const ClosedForm exact(phi, psi);
        for (const double direction : {0., 0.3, 1.2, 2.5})
          {
            const Localisation onset = of(plastic_matrix(phi, psi, exact.critical, direction));
            EXPECT_NEAR(onset.determinant, 0, 1e-13) << phi << " " << psi;
            for (const double hardening : {-20., 0., 3., 100.})
              {
                const Localisation l = of(plastic_matrix(phi, psi, hardening, direction));
                EXPECT_NEAR(l.determinant, (hardening - exact.critical) / (hardening + exact.denominator), 1e-13);
              }
          }
      }
  }

  TEST(Localisation, TheLineFollowsArthurAndVardoulakis)
  {
    for (const auto &[phi, psi] : {std::pair{40., 10.}, {30., 0.}, {35., 35.}})
      {
        const ClosedForm   exact(phi, psi);
        const Localisation l = of(plastic_matrix(phi, psi, exact.critical, 0.));
        // Less compression along x. Of the lines at +b and -b the function returns the larger angle.
        EXPECT_NEAR(l.angle_deg, exact.line, 1e-5);
        EXPECT_NEAR(l.angle_deg, 45 + (phi + psi) / 4, 0.5); // sin is concave: 0.35 degrees at 40 and 10
        // Less compression along y: the lines lie at 90 - b and b - 90.
        EXPECT_NEAR(of(plastic_matrix(phi, psi, 0., M_PI / 2)).angle_deg, 90 - exact.line, 1e-5);
      }
  }

  // The two lines of a coaxial state lie at `direction` + b and `direction` - b. The function returns the larger angle in (-90,
  // 90].
  TEST(Localisation, TurnsWithTheState)
  {
    const ClosedForm exact(38, 8);
    for (double direction = -85; direction < 90; direction += 7)
      {
        const double angle  = of(plastic_matrix(38, 8, 1., direction * degree)).angle_deg;
        double       larger = -90;
        for (const double line : {direction + exact.line, direction - exact.line})
          larger = std::max(larger, std::remainder(line, 180.));
        EXPECT_NEAR(angle, larger, 1e-5) << direction;
      }
  }

  // An isotropic tangent of half the elastic one has a quarter of its determinant.
  TEST(Localisation, ElasticTangentHasTheDeterminantOneAndNoDirection)
  {
    EXPECT_NEAR(of(elastic_matrix()).determinant, 1, 1e-14);
    EXPECT_EQ(of(elastic_matrix()).angle_deg, 0);
    EXPECT_NEAR(of(elastic_matrix() / 2).determinant, 0.25, 1e-14);
  }

  // A symmetric positive definite tangent is strongly elliptic (Hill). Associated flow with hardening therefore never
  // localises.
  TEST(Localisation, AssociatedFlowWithHardeningNeverLocalises)
  {
    for (double phi = 0; phi <= 50; phi += 5)
      {
        EXPECT_GT(of(plastic_matrix(phi, phi, 0.01, 0.4)).determinant, 1e-6) << phi;
        EXPECT_NEAR(of(plastic_matrix(phi, phi, 0., 0.4)).determinant, 0, 1e-13) << phi;
        EXPECT_LT(of(plastic_matrix(phi, phi, -1., 0.4)).determinant, -1e-6) << phi;
      }
  }

  // det of Q_jk = n_i C_ijkl n_l, summed index by index.
  double determinant_in(const Eigen::Matrix3d &d, const double theta)
  {
    const double n[2]        = {std::cos(theta), std::sin(theta)};
    const int    voigt[2][2] = {{0, 2}, {2, 1}};
    double       q[2][2]     = {};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l)
            q[j][k] += n[i] * d(voigt[i][j], voigt[k][l]) * n[l];
    return (q[0][0] * q[1][1] - q[0][1] * q[1][0]) / ((kappa + G) * G);
  }

  // For unsymmetric tangents without structure the function finds the least of 3600 directions at the right normal. Between two
  // of them (spacing d = 0.05 degrees) a determinant of size s is at most 2 s d^2 lower.
  TEST(Localisation, FindsTheLeastDeterminantOfAnyTangent)
  {
    std::mt19937                           generator(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int sample = 0; sample < 300; ++sample)
      {
        const Eigen::Matrix3d d     = elastic_matrix() + 300 * Eigen::Matrix3d::NullaryExpr([&] { return uniform(generator); });
        double                least = std::numeric_limits<double>::max(), size = 0;
        for (int k = 0; k < 3600; ++k)
          {
            const double value = determinant_in(d, k * M_PI / 3600);
            least              = std::min(least, value);
            size               = std::max(size, std::abs(value));
          }
        const Localisation l = of(d);
        EXPECT_LE(l.determinant, least + 1e-12 * size) << sample;
        EXPECT_GE(l.determinant, least - 1e-5 * size) << sample;
        EXPECT_NEAR(determinant_in(d, (l.angle_deg - 90) * degree), l.determinant, 1e-12 * size) << sample;
      }
  }

  // Two minima that merge at an axis: f = c1 cos(phi) + c2 cos(2 phi) has them at cos(phi) = -c1/(4 c2), with a maximum between
  // them at phi = 180 degrees. Here an orthotropic tangent has such an f, with n near the y axis.
  TEST(Localisation, TwoMinimaNearAnAxisAreFoundBesideTheMaximum)
  {
    Eigen::Matrix3d d;
    d << 800, 100, 0, 100, 300, 0, 0, 0, 100;
    double least = std::numeric_limits<double>::max(), at = 0;
    for (double shear = 90; shear < 300; shear += 0.25)
      {
        d(2, 2) = shear;
        least   = std::numeric_limits<double>::max();
        for (int k = 0; k < 3600; ++k)
          if (const double value = determinant_in(d, k * M_PI / 3600); value < least)
            least = value, at = k * M_PI / 3600;
        EXPECT_LE(of(d).determinant, least + 1e-13) << shear;
        EXPECT_LT(std::min(between(of(d).angle_deg, at / degree + 90), between(of(d).angle_deg, 90 - at / degree)), 1) << shear;
      }
  }

  TEST(Localisation, OnlyTheClassicalBlockCounts)
  {
    Tangent plain = tangent_of(plastic_matrix(35, 5, 2., 0.7)), cosserat = plain;
    for (unsigned int i = 0; i < n_components; ++i)
      for (unsigned int j = n_classical; j < n_components; ++j)
        cosserat[i][j] = cosserat[j][i] = 50. + i + j;
    const Tangent elastic = tangent_of(elastic_matrix());
    EXPECT_EQ(localisation(cosserat, elastic).determinant, localisation(plain, elastic).determinant);
    EXPECT_EQ(localisation(cosserat, elastic).angle_deg, localisation(plain, elastic).angle_deg);
  }

  TEST(Localisation, ATangentThatIsNotFiniteHasNoDeterminant)
  {
    for (unsigned int i = 0; i < n_classical; ++i)
      for (unsigned int j = 0; j < n_classical; ++j)
        {
          Eigen::Matrix3d d = elastic_matrix();
          d(i, j)           = std::nan("");
          EXPECT_TRUE(std::isnan(of(d).determinant)) << i << " " << j;
        }
  }
} // namespace
