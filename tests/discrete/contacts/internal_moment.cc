// diptych: Moreau's internal moment is additive, symmetric and independent of the origin
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/internal_moment.h"
#include "discrete/stepping/step_problem.h"
#include "discrete/panel/window_forces.h"
#include "tests/discrete/small_scenes.h"

namespace
{
  using namespace diptych::tests;

  Eigen::Matrix2d symmetric(const Eigen::Matrix2d &m)
  {
    return 0.5 * (m + m.transpose());
  }

  // A real step with all its forces, at the positions of mid-step, where contacts and couples balance.
  struct Step
  {
    ShearedSample                sheared;
    std::vector<Eigen::Vector2d> position;
    std::vector<ContactForce>    forces;

    explicit Step(const double rolling_friction = 0)
        : sheared(sheared_sample(rolling_friction))
    {
      const double h = sheared.setting.step;
      for (std::size_t i = 0; i < sheared.before.grains.size(); ++i)
        position.push_back(sheared.before.grains.position[i] + 0.5 * h * sheared.before.grains.velocity[i]);
      for (std::size_t k = 0; k < sheared.result.contacts.size(); ++k)
        {
          const Contact &c      = sheared.result.contacts[k];
          const Impulse &r      = sheared.result.impulses[k];
          const double   couple = r.rolling * effective_radius(sheared.state.grains, c.i, c.j) / h;
          forces.push_back({c.i, c.j, c.point, c.normal, impulse_vector(c, r) / h, 0, couple});
        }
    }

    Eigen::Vector2d acceleration_force(const std::size_t i) const
    {
      return sheared.state.grains.mass[i] * (sheared.state.grains.velocity[i] - sheared.before.grains.velocity[i]) /
             sheared.setting.step;
    }
  };

  // For any set S of grains, virtual power with an affine field gives (Moreau 1997, eq. 5)
  //   sum_S M_i = -sym sum (forces from outside S) x (x) f + sym sum_S x_i (x) m_i a_i - spin terms.
  // Here S is first all grains and then the lower half, whose outside forces come from the platen and from the upper half.
  TEST(InternalMoment, IsAdditiveOverAnyPartition)
  {
    const Step                         step;
    const std::size_t                  n      = step.position.size();
    const std::vector<double>          spin   = spin_terms(step.sheared.state.grains);
    const std::vector<Eigen::Matrix2d> moment = internal_moments(step.position, step.forces, spin);
    double                             scale  = 0;
    for (const Eigen::Matrix2d &m : moment)
      scale += m.norm();

    for (const double part : {1., 0.5, 0.13})
      {
        const auto      inside = [&](const int i) { return i < part * double(n); };
        Eigen::Matrix2d sum = Eigen::Matrix2d::Zero(), expected = Eigen::Matrix2d::Zero();
        for (std::size_t i = 0; i < n; ++i)
          if (inside(int(i)))
            {
              sum += moment[i];
              const Eigen::Vector2d force = step.sheared.result.applied_force[i] - step.acceleration_force(i);
              expected -= symmetric(step.position[i] * force.transpose()) + spin[i] * Eigen::Matrix2d::Identity();
            }
        for (const ContactForce &c : step.forces)
          {
            const bool i_in = inside(c.i), j_in = std::size_t(c.j) < n && inside(c.j);
            if (i_in != j_in)
              expected -= symmetric(c.point * (i_in ? c.force : Eigen::Vector2d(-c.force)).transpose());
          }
        EXPECT_NEAR((sum - expected).norm() / scale, 0, 1e-12) << "part " << part;
      }
  }

  TEST(InternalMoment, DoesNotDependOnTheOrigin)
  {
    const Step            step;
    const Eigen::Vector2d shift(123.4, -56.7);
    auto                  position = step.position;
    auto                  forces   = step.forces;
    for (Eigen::Vector2d &x : position)
      x += shift;
    for (ContactForce &c : forces)
      c.point += shift;
    const std::vector<double> no_spin(position.size(), 0.);
    const auto a = internal_moments(step.position, step.forces, no_spin), b = internal_moments(position, forces, no_spin);
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_NEAR((a[i] - b[i]).norm(), 0, 1e-12 * (1 + a[i].norm()));
  }

  // The skew part of the raw moment, couples of contacts included, is half the couple that turns the grain: M_xy - M_yx = -I
  // d(omega)/dt.
  TEST(InternalMoment, SkewPartIsTheUnbalancedCouple)
  {
    for (const double rolling_friction : {0., 0.3})
      {
        const Step step(rolling_friction);
        const auto raw = raw_contact_moments(step.position, step.forces);
        for (std::size_t i = 0; i < raw.size(); ++i)
          {
            const double couple = step.sheared.state.grains.moment_of_inertia(i) *
                                  (step.sheared.state.grains.spin[i] - step.sheared.before.grains.spin[i]) /
                                  step.sheared.setting.step;
            // Contact points are midway between the surfaces, so they are off by half a gap times the tangential force.
            EXPECT_NEAR(-(raw[i](0, 1) - raw[i](1, 0)), couple, 0.02 * raw[i].norm() + 1e-12);
          }
      }
  }

  // Two discs pressed together along x with force 3, centres 1 apart: each has M_xx = 3 * 0.5, positive in compression.
  TEST(InternalMoment, CompressionIsPositive)
  {
    const std::vector<Eigen::Vector2d> position = {{1, 0}, {0, 0}};
    const auto                         m        = internal_moments(position, {{0, 1, {0.5, 0}, {1, 0}, {3, 0}}}, {0, 0});
    EXPECT_NEAR(m[0](0, 0), 1.5, 1e-15);
    EXPECT_NEAR(m[1](0, 0), 1.5, 1e-15);
    EXPECT_NEAR(m[0](1, 1), 0, 1e-15);
  }
} // namespace
