// diptych: brings the mean stress of a sample to that of its sides by a uniform strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/samples/uniform_strain.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "discrete/bodies/outline.h"

namespace diptych::discrete
{
  bool is_large(const State &state)
  {
    return state.grains.size() > 10000;
  }

  bool has_far_sides(const State &state, const StepSetting &setting)
  {
    return is_large(state) && setting.pressure > 0 && !std::holds_alternative<NoSides>(setting.lateral) &&
           setting.stepping.gravity_x == 0 && setting.stepping.gravity_y == 0;
  }

  Eigen::AlignedBox2d box_around(const Grains &grains)
  {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d &x : grains.position)
      box.extend(x);
    return box;
  }

  namespace
  {
    constexpr double largest_error = 0.05; // of a stress that is reached

    // From the centre of a grain to that of the other grain, or to a wall, without overlap. [length]
    double branch_length(const State &state, const Contact &contact)
    {
      const std::vector<double> &radius = state.grains.radius;
      return radius[contact.i] + (std::size_t(contact.j) < radius.size() ? radius[contact.j] : 0.);
    }

    Eigen::Vector2d sum_of_moments(const State &state, const StepResult &step)
    {
      Eigen::Vector2d moment(0, 0);
      for (std::size_t k = 0; k < step.contacts.size(); ++k)
        {
          const Eigen::Vector2d n = step.contacts[k].normal, t(-n.y(), n.x());
          const Impulse        &r = step.impulses[k];
          moment += branch_length(state, step.contacts[k]) * n.cwiseProduct(r.normal * n + r.tangential * t);
        }
      return moment;
    }

    double evenness(const State &state, const StepResult &step)
    {
      constexpr int             n_parts = 3;
      const Grains             &g       = state.grains;
      const Eigen::AlignedBox2d box     = box_around(g);
      Eigen::ArrayXXd           moment = Eigen::ArrayXXd::Zero(n_parts, n_parts), area = moment;
      const auto                at = [&](Eigen::ArrayXXd &sums, const std::size_t i) -> double                &{
        const Eigen::Vector2d place = (g.position[i] - box.min()).cwiseQuotient(box.sizes()) * n_parts;
        return sums(std::min(int(place.x()), n_parts - 1), std::min(int(place.y()), n_parts - 1));
      };
      for (std::size_t i = 0; i < g.size(); ++i)
        at(area, i) += g.radius[i] * g.radius[i];
      for (std::size_t k = 0; k < step.contacts.size(); ++k)
        at(moment, step.contacts[k].i) += step.impulses[k].normal * branch_length(state, step.contacts[k]);
      const Eigen::ArrayXXd share = (area > 0).select(moment * area.sum() / (area * moment.sum()).max(1e-300), 1);
      return share.min(1 / share.max(1e-300)).minCoeff();
    }

    Eigen::Vector2d stress_of_sides(const State &state, const StepResult &step, const StepSetting &setting, const double area)
    {
      if (state.lattice())
        return {setting.pressure, setting.pressure};
      Eigen::Vector2d stress(0, 0);
      if (std::holds_alternative<EndGrains>(setting.lateral)) // the forces act at the centres of several grains
        for (std::size_t i = 0; i < state.grains.size(); ++i)
          stress.x() -= step.applied_force[i].x() * state.grains.position[i].x() / area;
      else if ((state.width() && state.width()->pressure) || (state.walls.size() >= 4 && is_free(state.walls[3].drive_x)))
        stress.x() = setting.pressure;
      if (is_free(state.walls[1].drive_y))
        stress.y() = std::abs(applied_wall_force(state, 1, state.time).y()) * sample_height(state) / area;
      return stress;
    }

    void slow_down(State &state)
    {
      constexpr double slower = 0.9;
      for (Eigen::Vector2d &v : state.grains.velocity)
        v *= slower;
      for (double &spin : state.grains.spin)
        spin *= slower;
      for (Wall &wall : state.walls)
        wall.velocity *= slower;
      if (PeriodicWidth *periodic = state.width())
        periodic->velocity *= slower;
      if (Lattice *lattice = state.lattice())
        lattice->rate *= slower;
    }
  } // namespace

  SideStress side_stress(const State &state, const StepResult &step, const StepSetting &setting)
  {
    constexpr double play = 0.2;
    const double     area = outline_area(make_outline(state, setting.mean_diameter));
    return {sum_of_moments(state, step) / setting.step / area, stress_of_sides(state, step, setting, area),
            setting.law.platen_friction > 0 && !state.lattice() ? play : 0, evenness(state, step),
            6 / std::sqrt(double(state.grains.size()))};
  }

  Eigen::Array2d SideStress::missing() const
  {
    const Eigen::Array2d difference = wanted - mean, far = (difference.abs() - play * wanted.array()).max(0);
    return (wanted.array() > 0).select(difference.sign() * far, 0);
  }

  double SideStress::error() const
  {
    return (missing().abs() / wanted.array().max(1e-300)).maxCoeff();
  }

  bool SideStress::is_reached(const double least_evenness) const
  {
    constexpr double least = 0.25; // with less, forces have not reached all grains yet
    return error() <= largest_error && evenness >= (play > 0 ? least : std::max(least, least_evenness - chance));
  }

  Eigen::Array2d elastic_strain(const SideStress &stress, const double stiffness)
  {
    constexpr double modulus = 0.4; // of a dense packing / stiffness of its springs; strains in both directions add up
    const double     axes    = double((stress.wanted.array() > 0).count());
    return stress.missing() / (std::max(axes, 1.) * modulus * stiffness);
  }

  void strain_sample(const Eigen::Array2d &strain, State &state, StepCache &cache)
  {
    const std::vector<Eigen::Vector2d> &x = state.grains.position;
    UniformStrain whole{strain, std::accumulate(x.begin(), x.end(), Eigen::Vector2d(0, 0)) / double(x.size())};
    if (!state.walls.empty())
      whole.centre.y() = state.walls[0].point.y();
    if (state.walls.size() >= 4)
      whole.centre.x() = state.walls[2].point.x();
    deform(state, whole);
    cache.neighbours.follow(whole);
  }

  void StressServo::approach(const SideStress &stress, const double stiffness, State &state, StepCache &cache)
  {
    constexpr double largest = 4e-4; // strain; grains need time to find their places

    // Grains on the way to new places take up more strain than their springs do. While the stress stays behind, the gain grows.
    const Eigen::Array2d missing = stress.missing();
    for (int axis = 0; axis < 2; ++axis)
      {
        const double share  = missing[axis] / std::max(stress.wanted[axis], 1e-300);
        const bool   behind = std::abs(share) > largest_error && share * before_[axis] > 0.7 * before_[axis] * before_[axis];
        gain_[axis]         = behind ? std::min(1.3 * gain_[axis], 30.) : std::max(gain_[axis] / 2, 1.);
        before_[axis]       = share;
      }
    strain_sample((gain_ * elastic_strain(stress, stiffness)).max(-largest).min(largest), state, cache);
    slow_down(state);
  }
} // namespace diptych::discrete
