// diptych: resultant force across the diameters of a circle against what the circle's mean stress predicts (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "coupling/statistics/block_bootstrap.h"
#include "coupling/probes/grain_network.h"
#include "coupling/statistics/interval.h"
#include "coupling/cells/mesh_cells.h"
#include "coupling/probes/probe_regions.h"
#include "coupling/cells/triangle_search.h"

namespace diptych::coupling
{
  struct Circle
  {
    Eigen::Vector2d centre = Eigen::Vector2d::Zero(); // [length]
    double          radius = 0;                       // 0: there is no circle [length]
  };

  // A diameter at the angle a runs along s = (cos a, sin a), its normal is n = (-sin a, cos a). Traction: mean force per length
  // that the side behind n exerts on the side n points to; normal part along n (positive in compression), tangential along s.
  // The mean stress predicts sigma.n (rows of sigma: components of force). All n_angles entries [pressure].
  struct CircularProbe
  {
    Circle              circle;
    Eigen::Matrix2d     stress = Eigen::Matrix2d::Constant(NAN); // mean over the circle, as it is: not made symmetric [pressure]
    std::vector<double> angles_deg;                              // of the diameters from the horizontal, in [0, 180)
    std::vector<double> normal, tangential;
    std::vector<double> predicted_normal, predicted_tangential;
    std::vector<double> normal_error, tangential_error; // grains: standard errors from blocks along the diameter; else empty
    Interval            relative_l2;                    // sqrt(sum |traction - predicted|^2 / sum |predicted|^2)
    double              independent_blocks = NAN;       // the same norm of the standard errors
  };

  // options.probe_circle, made smaller where the sample ends; without it the largest about the middle of the first band (none:
  // of the sample) that keeps platen_gap clear of the outline. Radius 0 where less than minimum_side / 2 is left. Throws as
  // check_probe_options().
  Circle place_circle(const std::vector<Eigen::Vector2d> &outline,
                      const SampleFrame                  &frame,
                      const std::vector<Band>            &bands,
                      const ProbeOptions                 &options);

  // Contacts whose branch crosses the diameter, mean forces of the window. The mean stress is -sum f (x) (branch within the
  // circle) / area: the mean of the tractions over all parallel chords, so that both sides speak of the same forces and no
  // grain is cut. The interval of relative_l2 comes from blocks of neighbouring angles, wide enough to be options.block apart at
  // the rim: nearer to the centre all diameters share contacts, so it is rather too narrow. The errors take blocks along the
  // diameter as independent; in equilibrium what one block lacks its neighbours carry, so that relative_l2 stays below
  // independent_blocks.
  // Throws std::invalid_argument for n_angles < 2.
  CircularProbe grain_circular_probe(const Circle           &circle,
                                     const GrainNetwork     &network,
                                     const BootstrapOptions &options,
                                     int                     n_angles = 36);

  // The same of a stress that is constant on cells, n_cells entries [pressure]; cells without a value (NaN) and what lies
  // outside the mesh are left out of the means. No errors, no interval.
  CircularProbe cell_circular_probe(const Circle                       &circle,
                                    const QuadMesh                     &mesh,
                                    const TriangleSearch               &search,
                                    const std::vector<Eigen::Matrix2d> &stress,
                                    int                                 n_angles = 36);
} // namespace diptych::coupling
