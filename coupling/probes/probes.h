// diptych: mean stress and fabric of rectangular probes (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "coupling/cells/mesh_cells.h"
#include "coupling/probes/probe_regions.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  // Positive in compression. s1 >= s2 are the principal values of the symmetric part.
  struct ProbeStress
  {
    Eigen::Matrix2d stress = Eigen::Matrix2d::Constant(NAN); // [pressure]
    double          s1 = NAN, s2 = NAN;
    double          direction_deg = NAN; // angle of s1 from the horizontal, in (-90, 90]
    double          t_over_s      = NAN; // (s1 - s2) / (s1 + s2)
    int             count         = 0;   // number of grains or cells in the mean
  };

  // Fabric of the contacts that transmit force and have their point in the probe. F = mean of n (x) n.
  struct ProbeFabric
  {
    Eigen::Matrix2d     fabric              = Eigen::Matrix2d::Constant(NAN);
    double              direction_deg       = NAN; // direction of F's major axis, in (-90, 90]
    double              direction_error_deg = NAN; // 1 / (a sqrt(2 N)) for independent contacts: a lower bound
    double              anisotropy          = NAN; // a = 2 (F1 - F2)
    double              anisotropy_error    = NAN; // sqrt(2 / N)
    std::array<int, 24> normals_24          = {};  // both directions of each normal; sector k extends from 15 k to 15 (k + 1)
                                                   // degrees
    int contacts = 0;                              // N
  };

  ProbeStress probe_stress(const Eigen::Matrix2d &stress, int count);

  // Stress = (sum of moments) / (sum of disc areas) * (solid fraction of the probe), over the grains with their centre inside.
  ProbeStress grain_probe_stress(const ProbeRegion                  &probe,
                                 const std::vector<Eigen::Vector2d> &position,
                                 const std::vector<double>          &radius,
                                 const std::vector<Eigen::Matrix2d> &moment);

  ProbeFabric probe_fabric(const ProbeRegion &probe, const std::vector<discrete::ContactForce> &contacts);

  // Area-weighted mean over the cells with their centre inside. `stress`: n_cells [pressure].
  ProbeStress cell_probe_stress(const ProbeRegion &probe, const QuadMesh &mesh, const std::vector<Eigen::Matrix2d> &stress);
} // namespace diptych::coupling
