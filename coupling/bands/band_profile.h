// diptych: profiles across a band: rotation, couple stress, solid fraction and fluctuation over the distance from the band
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/statistics/block_bootstrap.h"

namespace diptych::coupling
{
  // Strips parallel to a band, each cut into blocks along it. Every matrix is n_strips x n_blocks, NaN where a block lies outside
  // the sample or a panel has no value. `sense` is that of the band's shear: rotations and couples are positive if they turn as
  // the shear turns the material. Mirror images of a band then have the same profiles.
  struct ProfileBlocks
  {
    std::vector<double> distance; // of the middle of each strip from the band's centre line along its normal [mean diameters]
    Eigen::MatrixXd     relative_rotation;   // rotation of grains (or Cosserat rotation) minus spin of the material [radians]
    Eigen::MatrixXd     spin;                // of the material: half the curl of the displacement increment [radians]
    Eigen::MatrixXd     couple_stress;       // component along the band's normal [pressure * length]
    Eigen::MatrixXd     solid_fraction;      // [-]
    Eigen::MatrixXd     squared_fluctuation; // |v'|^2 / (velocity of the upper platen)^2; see fluctuation_energy()
  };

  // Mean of each strip over its blocks, with the ends of its 95 % interval.
  struct ProfileCurve
  {
    std::vector<double> value, low, high;
  };

  struct BandProfile
  {
    double              angle_deg = 0, offset = 0; // of the centre line, as in Band [degrees], [length]
    std::vector<double> distance;                  // as in ProfileBlocks
    ProfileCurve        relative_rotation, spin, couple_stress, solid_fraction;
    ProfileCurve        velocity_fluctuation; // root mean square |v'| / velocity of the upper platen

    // From least squares fits a + b shape(x / delta) to the curves, x the distance and delta the half width of the band.
    // Rotations and solid fraction have the shape of the strain in a band, the derivative sech^2 of its tanh. The couple stress
    // has that of the gradient of such a rotation, sech^2 tanh, scaled to the largest value 1.
    Interval spin_amplitude;       // b of the spin [radians]
    Interval rotation_amplitude;   // b of the relative rotation [radians]
    Interval rotation_width_10_90; // 2.197 delta of the fit to the relative rotation with its own delta [mean diameters]; NaN if
                                   // it is at an end of its range (0.5 to 12), or if the interval of the amplitude contains 0
    Interval couple_stress_peak;   // b of the couple stress [pressure * length]
    Interval loosening;            // -b of the solid fraction [-]
    int      blocks = 0;           // along the band
  };

  // half_width: delta of the band [mean diameters]. The intervals come from blocks drawn with replacement, the same for all
  // strips and all quantities, for at least minimum_blocks blocks. Blocks count as independent.
  BandProfile band_profile(const ProfileBlocks &blocks, double half_width, const BootstrapOptions &bootstrap);
} // namespace diptych::coupling
