// diptych: resultant forces across the diameters of a circle, compared with those from the circle's mean stress (Moreau 1997)
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

  // A diameter at the angle a runs along s = (cos a, sin a) and has the normal n = (-sin a, cos a). Its traction is the mean
  // force per length that the side behind n exerts on the side to which n points. The normal part acts along n (positive in
  // compression), the tangential part along s. The mean stress predicts the traction sigma.n (rows of sigma: components of
  // force). All lists have n_angles entries [pressure].
  struct CircularProbe
  {
    Circle              circle;
    Eigen::Matrix2d     stress = Eigen::Matrix2d::Constant(NAN); // mean over the circle, unsymmetric [pressure]
    std::vector<double> angles_deg;                              // angles of the diameters from the horizontal, in [0, 180)
    std::vector<double> normal, tangential;
    std::vector<double> predicted_normal, predicted_tangential;
    std::vector<double> normal_error, tangential_error; // grains: standard errors from blocks along the diameter; continuum:
                                                        // empty
    Interval relative_l2;                               // sqrt(sum |traction - predicted|^2 / sum |predicted|^2)
    double   independent_blocks = NAN;                  // sqrt(sum |standard error|^2 / sum |predicted|^2)
  };

  // The circle of options.probe_circle, reduced where the sample ends. Without it, the largest circle about the middle of the
  // first band (or of the sample), platen_gap away from the outline. Radius 0 if less than minimum_side / 2 is left. Throws as
  // check_probe_options() does.
  Circle place_circle(const std::vector<Eigen::Vector2d> &outline,
                      const SampleFrame                  &frame,
                      const std::vector<Band>            &bands,
                      const ProbeOptions                 &options);

  // Uses the mean forces, since the preceding snapshot, of contacts whose branch crosses the diameter. The mean stress is -sum
  // f (x) (branch within the circle) / area. It equals the mean of the tractions over all parallel chords, so no grain is cut.
  // The interval of relative_l2 comes from blocks of neighbouring angles, options.block long at the rim. It is rather too
  // narrow, because nearer to the centre all diameters share contacts. The errors treat blocks along the diameter as
  // independent; in equilibrium they are not, so relative_l2 stays below independent_blocks.
  CircularProbe grain_circular_probe(const Circle           &circle,
                                     const GrainNetwork     &network,
                                     const BootstrapOptions &options,
                                     int                     n_angles = 36);

  // Tractions of a stress that is constant on cells, n_cells entries [pressure]. The means leave out cells without a value (NaN)
  // and parts of the circle outside the mesh. There are no errors and no interval.
  CircularProbe cell_circular_probe(const Circle                       &circle,
                                    const QuadMesh                     &mesh,
                                    const TriangleSearch               &search,
                                    const std::vector<Eigen::Matrix2d> &stress,
                                    int                                 n_angles = 36);
} // namespace diptych::coupling
