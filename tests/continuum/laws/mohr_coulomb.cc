// diptych: Mohr-Coulomb in principal space, against independent solutions
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <Eigen/Dense>

#include "continuum/laws/plastic_flow.h"
#include "tests/continuum/laws/law_states.h"

namespace
{
  using namespace diptych::continuum::tests;

  // Principal stresses along the axes. Plane (i, j) is (s_i - s_j)/2 + (s_i + s_j)/2 sin phi - c cos phi = 0; there are six.
  struct Plane
  {
    unsigned int    major, minor;
    Eigen::Vector3d normal;
  };

  std::vector<Plane> planes(const double angle)
  {
    std::vector<Plane> all;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        if (i != j)
          {
            Eigen::Vector3d n = Eigen::Vector3d::Zero();
            n[i] = (1 + sine(angle)) / 2, n[j] = -(1 - sine(angle)) / 2;
            all.push_back({i, j, n});
          }
    return all;
  }

  Eigen::Matrix3d principal_stiffness(const ElasticModuli &m)
  {
    return 2 * m.shear * Eigen::Matrix3d::Identity() + m.lateral * Eigen::Matrix3d::Ones();
  }

  // Closest point to `trial` in the energy norm, among the points of every face, edge and corner of the yield surface.
  Eigen::Vector3d closest_point(const Eigen::Vector3d &trial,
                                const double           friction,
                                const double           cohesion,
                                const ElasticModuli   &m)
  {
    const auto            all = planes(friction);
    const double          b   = cohesion * std::cos(friction * degree);
    const Eigen::Matrix3d D   = principal_stiffness(m);
    Eigen::Vector3d       best;
    double                least = INFINITY;
    for (unsigned int subset = 0; subset < 64; ++subset)
      {
        Eigen::MatrixXd A(0, 3);
        for (unsigned int k = 0; k < 6; ++k)
          if (subset & (1u << k))
            {
              A.conservativeResize(A.rows() + 1, 3);
              A.row(A.rows() - 1) = all[k].normal;
            }
        if (A.rows() > 3)
          continue;
        // A (trial - D A^T x) = b.
        const Eigen::VectorXd right = A * trial - Eigen::VectorXd::Constant(A.rows(), b);
        const Eigen::VectorXd x     = A.rows() > 0 ? Eigen::VectorXd((A * D * A.transpose()).fullPivLu().solve(right)) : right;
        const Eigen::Vector3d point = trial - D * A.transpose() * x;
        double                worst = 0;
        for (const Plane &plane : all)
          worst = std::max(worst, plane.normal.dot(point) - b);
        const double energy = (trial - point).dot(D.inverse() * (trial - point));
        if (worst < 1e-9 && energy < least)
          {
            least = energy;
            best  = point;
          }
      }
    return best;
  }

  Eigen::Vector3d principal(const MaterialState &state)
  {
    return {state.stress[xx], state.stress[yy], state.stress_zz};
  }

  std::vector<MaterialState> random_states(const int n)
  {
    std::mt19937               random(5);
    std::vector<MaterialState> states;
    const auto                 number = [&] { return 2 * double(random()) / double(random.max()) - 1; };
    for (int k = 0; k < n; ++k)
      {
        const double a = number() / 2, b = number() / 2, c = number() / 2;
        const double mean = number() - .3;
        states.push_back(state_of(mean + a, mean + b, mean + c));
      }
    return states;
  }

  // Associated flow without hardening is the closest point. The random trial states lie in every region.
  TEST(MohrCoulomb, AssociatedReturnIsTheClosestPoint)
  {
    for (const double friction : {0., 20., 35.})
      {
        const MohrCoulomb     law(constant(friction, friction, 0.1));
        std::map<Regime, int> seen;
        int                   other_plane = 0;
        for (const MaterialState &trial : random_states(300))
          {
            const MaterialUpdate  answer   = law.update(trial, {}, 0);
            const Eigen::Vector3d expected = closest_point(principal(trial), friction, 0.1, law.moduli());
            EXPECT_NEAR((principal(answer.state) - expected).norm(), 0, 1e-9) << principal(trial).transpose();
            ++seen[answer.regime];
            const auto   stress = principal(answer.state);
            const double middle = stress.sum() - stress.maxCoeff() - stress.minCoeff();
            other_plane += answer.regime == Regime::plastic && middle != stress[2];
          }
        EXPECT_GT(seen[Regime::plastic], 30);
        EXPECT_GT(seen[Regime::edge], 20);
        EXPECT_GT(seen[Regime::elastic], 3);
        EXPECT_GT(other_plane, 20) << "sigma_zz outer, one plane";
        EXPECT_EQ(seen[Regime::apex] > 5, friction > 0);
      }
  }

  // Koiter: plastic strain is a sum of the flow directions of the planes that are active at the end. No share is negative, and
  // kappa grows by the sum of the shares. Least squares on the active flow directions give the shares.
  TEST(MohrCoulomb, FlowIsThatOfActivePlanesWithHardeningAndFadingDilatancy)
  {
    for (const std::string kind : {"exponential", "table, viscous"})
      {
        const LawOptions   options = hardenings()[kind];
        const MohrCoulomb  law(options);
        std::map<int, int> seen;
        for (MaterialState trial : random_states(300))
          {
            trial.equivalent_plastic_strain = 0.01;
            MaterialUpdate answer           = law.update(trial, {}, 1e-2);
            ASSERT_EQ(answer.verdict, Verdict::reliable);
            if (answer.regime == Regime::elastic || answer.regime == Regime::apex)
              continue;
            add_plastic_flow(law.moduli(), trial, {}, answer.state);
            const PlasticStrain  &p = answer.state.plastic_strain;
            const Eigen::Vector3d flow(p.xx, p.yy, p.zz);
            const Strength        end   = Hardening(options).at(answer.state.equivalent_plastic_strain);
            const auto            yield = planes(end.friction.value / degree), direction = planes(end.dilatancy.value / degree);
            Eigen::MatrixXd       active(3, 0);
            for (unsigned int k = 0; k < 6; ++k)
              {
                const double F = yield[k].normal.dot(principal(answer.state)) - end.cohesion.value * std::cos(end.friction.value);
                EXPECT_LT(F, answer.state.overstress + 1e-11);
                if (F < answer.state.overstress - 1e-9)
                  continue;
                active.conservativeResize(3, active.cols() + 1);
                active.col(active.cols() - 1) = direction[k].normal;
              }
            ASSERT_EQ(active.cols(), answer.regime == Regime::edge ? 2 : 1);
            const Eigen::VectorXd shares = active.colPivHouseholderQr().solve(flow);
            EXPECT_NEAR((active * shares - flow).norm(), 0, 1e-14);
            EXPECT_GE(shares.minCoeff(), -1e-12);
            EXPECT_NEAR(shares.sum(), answer.state.equivalent_plastic_strain - 0.01, 1e-13);
            ++seen[active.cols()];
          }
        EXPECT_GT(seen[1], 50) << kind;
        EXPECT_GT(seen[2], 20) << kind;
      }
  }

  // Stress is continuous where regimes meet. Along a straight line of trial states no jump exceeds the limit of the elastic
  // moduli and the step: |D| h = 2 (K + 4 G/3) h.
  TEST(MohrCoulomb, StressIsContinuousAcrossRegimes)
  {
    const MohrCoulomb law(hardenings()["exponential, viscous"]);
    const double      h            = 1e-5;
    const Strain      directions[] = {strain_of(1, 1.001), strain_of(1, -.2, .3), strain_of(-.3, 1, .1), strain_of(-1, -.9)};
    std::set<Regime>  seen;
    for (const Strain &direction : directions)
      for (const double szz : {-1., -.5, -1.6, .1})
        {
          Stress last = state_of(-.5, -.4, szz).stress;
          for (int k = 1; k < 1000; ++k)
            {
              const MaterialUpdate answer = law.update(state_of(-.5, -.4, szz), k * h * direction, 1e-2);
              if (k > 1)
                {
                  EXPECT_LT((answer.state.stress - last).norm(), 3 * law.moduli().plane_bulk * h * direction.norm());
                }
              last = answer.state.stress;
              seen.insert(answer.regime);
            }
        }
    EXPECT_EQ(seen.size(), 4u);
  }

  // Equal in-plane principal stresses at an edge: the tangent must not divide by their difference.
  TEST(MohrCoulomb, TangentHoldsWithEqualStressesInThePlane)
  {
    const Law law = make_law(LawKind::mohr_coulomb, hardenings()["exponential"]);
    for (const auto &[size, szz] : {std::pair(-3e-3, -.5), std::pair(1e-3, -1.5)})
      {
        const MaterialState  s0     = state_of(-1, -1, szz);
        const MaterialUpdate answer = update(law, s0, strain_of(size, size));
        EXPECT_EQ(answer.regime, Regime::edge);
        EXPECT_LT(tangent_error(law, s0, strain_of(size, size)).value_or(1), 1e-6);
      }
  }
} // namespace
