// diptych: the in-plane Mohr-Coulomb law on single points
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "continuum/laws/mohr_coulomb.h"

namespace
{
  using namespace diptych::continuum;
  using Strain = dealii::SymmetricTensor<2, 2>;

  Strain tensor(const double xx, const double yy, const double xy)
  {
    Strain e;
    e[0][0] = xx, e[1][1] = yy, e[0][1] = xy;
    return e;
  }

  // Isotropic compression by `pressure`; mechanics sign inside the law.
  MaterialState compressed(const double pressure, const double equivalent_plastic_strain = 0)
  {
    MaterialState state;
    state.stress                    = tensor(-pressure, -pressure, 0);
    state.stress_zz                 = -pressure;
    state.equivalent_plastic_strain = equivalent_plastic_strain;
    return state;
  }

  double sine(const double degrees)
  {
    return std::sin(degrees * M_PI / 180);
  }

  MohrCoulombOptions softening_law()
  {
    MohrCoulombOptions options;
    options.cohesion         = 0.1;
    options.softening_strain = 0.05;
    return options;
  }

  // Directions spread over the circle, each scaled to the given size; the generator is seeded.
  std::vector<Strain> random_strains(const int n, const double size)
  {
    std::mt19937        random(11);
    std::vector<Strain> strains;
    for (int k = 0; k < n; ++k)
      {
        const auto   number = [&] { return 2. * double(random()) / double(random.max()) - 1; };
        const Strain e      = tensor(number(), number(), number());
        strains.push_back(size / e.norm() * e);
      }
    return strains;
  }

  // Central differences with a step of 1e-6 of the strain; relative to the elastic modulus.
  double tangent_error(const MohrCoulomb &law, const MaterialState &state, const Strain &strain)
  {
    const MaterialUpdate answer = law.update(state, strain);
    const double         step   = 1e-6 * strain.norm();
    double               worst  = 0;
    for (int k = 0; k < 2; ++k)
      for (int l = k; l < 2; ++l)
        {
          Strain up = strain, down = strain;
          up[k][l] += step, down[k][l] -= step;
          const Strain difference = (law.update(state, up).state.stress - law.update(state, down).state.stress) / (2 * step);
          for (int i = 0; i < 2; ++i)
            for (int j = i; j < 2; ++j)
              {
                // Moving the shared off-diagonal entry moves both of its places.
                const double expected = answer.tangent[i][j][k][l] * (k == l ? 1 : 2);
                worst                 = std::max(worst, std::abs(difference[i][j] - expected) / 500);
              }
        }
    return worst;
  }

  struct Case
  {
    const char   *name;
    Regime        regime;
    MaterialState state;
    double        size; // of the strain increments
  };

  TEST(MohrCoulomb, TangentAgreesWithDifferencesInEveryRegime)
  {
    const MohrCoulomb law(softening_law());
    const Case        cases[] = {{"elastic", Regime::elastic, compressed(1), 1e-5},
                                 {"plastic", Regime::plastic, compressed(1), 5e-3},
                                 {"softened", Regime::plastic, compressed(1, 0.06), 5e-3},
                                 {"apex", Regime::apex, compressed(0.01, 0.02), 5e-3}};
    for (const Case &c : cases)
      {
        int seen = 0;
        for (const Strain &strain : random_strains(60, c.size))
          {
            const MaterialUpdate answer = law.update(c.state, strain);
            if (answer.regime != c.regime)
              continue;
            ++seen;
            EXPECT_LT(tangent_error(law, c.state, strain), 1e-6) << c.name << ", strain " << strain;
          }
        EXPECT_GE(seen, 10) << c.name << " must have been met";
      }
  }

  TEST(MohrCoulomb, PlasticStatesLieOnTheSoftenedYieldSurface)
  {
    const MohrCoulomb law(softening_law());
    int               plastic = 0;
    for (const Strain &strain : random_strains(50, 5e-3))
      {
        const MaterialUpdate answer = law.update(compressed(1), strain);
        if (answer.regime == Regime::elastic)
          continue;
        ++plastic;
        EXPECT_NEAR(law.yield_function(answer.state.stress, answer.state.equivalent_plastic_strain), 0, 1e-11);
        EXPECT_GT(answer.state.equivalent_plastic_strain, 0);
      }
    EXPECT_GT(plastic, 20);
  }

  // Turning the strain turns the stress.
  TEST(MohrCoulomb, KnowsNoDirection)
  {
    const MohrCoulomb law(softening_law());
    const double      c = std::cos(0.7), s = std::sin(0.7);
    const auto        turned = [&](const Strain &a) {
      const double xx = c * c * a[0][0] - 2 * c * s * a[0][1] + s * s * a[1][1];
      const double yy = s * s * a[0][0] + 2 * c * s * a[0][1] + c * c * a[1][1];
      return tensor(xx, yy, c * s * (a[0][0] - a[1][1]) + (c * c - s * s) * a[0][1]);
    };
    for (const Strain &strain : random_strains(20, 4e-3))
      {
        const Strain a = turned(law.update(compressed(1), strain).state.stress);
        const Strain b = law.update(compressed(1), turned(strain)).state.stress;
        EXPECT_NEAR((a - b).norm(), 0, 1e-12);
      }
  }

  // d eps_v / d gamma = -sin psi, dilation negative in compression-positive volume: measured on the plastic strain of a
  // shear increment without hardening change (softening strain very long). G = E/(2(1+nu)), plane bulk K + G/3.
  TEST(MohrCoulomb, DilatesByTheSineOfItsAngle)
  {
    MohrCoulombOptions options;
    options.softening_strain = 1e5;
    const MohrCoulomb    law(options);
    const Strain         strain = tensor(0.004, -0.004, 0); // vertical shortening, no volume change
    const MaterialUpdate answer = law.update(compressed(1), strain);
    ASSERT_EQ(answer.regime, Regime::plastic);
    const PlaneModuli moduli         = plane_moduli(options.elastic);
    const double      elastic_volume = (trace(answer.state.stress) + 2) / (2 * moduli.bulk); // tension positive
    const double      plastic_volume = trace(strain) - elastic_volume;
    EXPECT_NEAR(plastic_volume / answer.state.equivalent_plastic_strain, sine(12), 1e-6);
  }

  // c = 0.1, phi = 20.5: stretched beyond the cone the state is its tip, s = -c cot(phi), no shear.
  TEST(MohrCoulomb, ReturnsToTheApexUnderTension)
  {
    MohrCoulombOptions options = softening_law();
    options.softening_strain   = 1e5;
    const MohrCoulomb    law(options);
    const MaterialUpdate answer = law.update(compressed(0.1), tensor(0.01, 0.012, 0.001));
    EXPECT_EQ(answer.regime, Regime::apex);
    const double tension = 0.1 / std::tan(20.5 * M_PI / 180);
    EXPECT_NEAR((answer.state.stress - tensor(tension, tension, 0)).norm(), 0, 1e-6);
  }

  TEST(MohrCoulomb, DissipationIsNeverNegative)
  {
    const MohrCoulomb law(softening_law());
    const PlaneModuli moduli = plane_moduli({});
    for (const Strain &strain : random_strains(100, 5e-3))
      {
        const MaterialState  start    = compressed(0.3, 0.01);
        const MaterialUpdate answer   = law.update(start, strain);
        const Strain         d_stress = answer.state.stress - start.stress;
        // Elastic strain of the stress increment: volume over 2 bulk, deviator over 2 G.
        const Strain elastic = trace(d_stress) / (4 * moduli.bulk) * dealii::unit_symmetric_tensor<2>() +
                               1 / (2 * moduli.shear) * deviator(d_stress);
        EXPECT_GE(answer.state.stress * (strain - elastic), -1e-14);
      }
  }

  TEST(MohrCoulomb, LeavesTheCommittedStateAlone)
  {
    const MohrCoulomb   law(softening_law());
    const MaterialState state = compressed(1, 0.01), before = state;
    (void)law.update(state, tensor(0.01, -0.02, 0.003));
    EXPECT_EQ(state.stress, before.stress);
    EXPECT_EQ(state.equivalent_plastic_strain, before.equivalent_plastic_strain);
  }

  TEST(MohrCoulomb, ContradictoryOptionsAreRefusedByName)
  {
    MohrCoulombOptions options;
    options.friction_angle_peak = 10;
    try
      {
        validate(options);
        FAIL() << "no error";
      }
    catch (const std::invalid_argument &error)
      {
        EXPECT_NE(std::string(error.what()).find("friction_angle_peak"), std::string::npos);
      }
  }
} // namespace
