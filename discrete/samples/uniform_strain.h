// diptych: brings the mean stress of a sample to that of its sides by a uniform strain
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <Eigen/Geometry>

#include "discrete/stepping/time_stepping.h"

namespace diptych::discrete
{
  // More than 10000 grains: forces have far to go, and neighbours should be near in memory.
  bool is_large(const State &state);

  // True if a large sample is under the pressure of its sides, and under nothing else.
  bool has_far_sides(const State &state, const StepSetting &setting);

  Eigen::AlignedBox2d box_around(const Grains &grains);

  // Stresses (s_xx, s_yy), positive in compression [pressure].
  struct SideStress
  {
    Eigen::Vector2d mean;   // of the sample: contact forces times branches, over the area
    Eigen::Vector2d wanted; // of the sides, a free upper platen or a free lattice; 0 along an axis in which nothing is free

    double play;     // share of `wanted` that friction on the platens may add or carry
    double evenness; // smallest ratio, below 1, of the pressure in a ninth of the sample and the mean pressure
    double chance;   // by which the evenness of few grains differs from 1

    Eigen::Array2d missing() const; // from `mean` to `wanted`, beyond the play
    double         error() const;   // the larger one, relative to `wanted`

    // True if the error is at most 0.05 and the evenness large enough. Friction on the platens leaves a sample uneven.
    bool is_reached(double least_evenness) const;
  };

  // `step` is the last step of `state`.
  SideStress side_stress(const State &state, const StepResult &step, const StepSetting &setting);

  // Strain (xx, yy) that leads springs of this stiffness [pressure] from the mean stress to the wanted one, along the free axes.
  Eigen::Array2d elastic_strain(const SideStress &stress, double stiffness);

  // Strains the whole sample; walls 0 and 2 stay. `cache` is that of the steps of `state`.
  void strain_sample(const Eigen::Array2d &strain, State &state, StepCache &cache);

  // Brings the stress of a sample to that of its sides, which alone load the middle of a large sample late.
  class StressServo
  {
  public:
    // To be called after each step. Takes a tenth of all velocities, too, so that the sample does not swing.
    void approach(const SideStress &stress, double stiffness, State &state, StepCache &cache);

  private:
    Eigen::Array2d gain_{1, 1}, before_{0, 0};
  };
} // namespace diptych::discrete
