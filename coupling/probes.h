// diptych: rectangular probes in the zone and in the packs on either side: stress and fabric (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/band.h"
#include "coupling/mesh_cells.h"
#include "discrete/snapshot.h"

namespace diptych::coupling
{
  struct ProbeRegion
  {
    std::string                  name;    // "upper", "zone", "lower"
    std::vector<Eigen::Vector2d> polygon; // four corners, counter-clockwise [length]
  };

  // Positive in compression; of the symmetric part s1 >= s2.
  struct ProbeStress
  {
    Eigen::Matrix2d stress = Eigen::Matrix2d::Constant(NAN); // [pressure]
    double          s1 = NAN, s2 = NAN;
    double          direction_deg = NAN; // of s1 from the horizontal, in (-90, 90]
    double          t_over_s      = NAN; // (s1 - s2) / (s1 + s2)
    int             count         = 0;   // grains or cells averaged over
  };

  // Of the contacts that transmit force, contact point in the probe. F = mean of n (x) n.
  struct ProbeFabric
  {
    Eigen::Matrix2d     fabric              = Eigen::Matrix2d::Constant(NAN);
    double              direction_deg       = NAN; // of F's major axis, in (-90, 90]
    double              direction_error_deg = NAN; // 1 / (a sqrt(2 N)): a lower bound, contacts taken as independent
    double              anisotropy          = NAN; // a = 2 (F1 - F2)
    double              anisotropy_error    = NAN; // sqrt(2 / N)
    std::array<int, 24> normals_24          = {};  // both directions of each normal; sector k covers 15 k .. 15 (k + 1) degrees
    int                 contacts            = 0;   // N
  };

  struct ProbeOptions
  {
    double zone_length  = 0.6; // of the band's chord through the sample
    double aspect       = 1.5; // length / thickness of the packs' rectangles
    double platen_gap   = 1.5; // mean diameters kept clear of platens and sides
    double minimum_side = 5;   // mean diameters
  };

  template <class Visitor> void visit_parameters(ProbeOptions &o, Visitor &&visitor)
  {
    visitor("zone_length", o.zone_length, "-", {0.1, 1.},
            "length of the zone's probe, as a share of the band's chord through the sample");
    visitor("aspect", o.aspect, "-", {0.2, 5.}, "length / thickness of the probes in the packs");
    visitor("platen_gap", o.platen_gap, "mean diameters", {0., 100.},
            "kept clear of platens and sides by the probes in the packs");
    visitor("minimum_side", o.minimum_side, "mean diameters", {1., 100.}, "smallest side of a probe");
  }

  // Closed outline, counter-clockwise: left side downward, right side upward.
  std::vector<Eigen::Vector2d> outline_polygon(const discrete::Outline &outline);

  // upper, zone, lower, in this order, inside the outline. The zone's is oblique, centred on the middle of the first band's
  // chord, as thick as the band's 10-90 % width up to 0.3 of the chord; the packs' are horizontal, the largest up to the zone's
  // area that clear it, as far from it as they go. bands empty: three horizontal rectangles one above another. A pack for which
  // no rectangle of the minimum side fits has an empty polygon.
  std::vector<ProbeRegion> place_probes(const std::vector<Eigen::Vector2d> &outline,
                                        const SampleFrame                  &frame,
                                        const std::vector<Band>            &bands,
                                        const ProbeOptions                 &options = {});

  bool inside_polygon(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon);

  ProbeStress probe_stress(const Eigen::Matrix2d &stress, int count);

  // sum of the moments of the grains with their centre inside / sum of their disc areas * solid fraction of the probe.
  ProbeStress grain_probe_stress(const ProbeRegion                  &probe,
                                 const std::vector<Eigen::Vector2d> &position,
                                 const std::vector<double>          &radius,
                                 const std::vector<Eigen::Matrix2d> &moment);

  ProbeFabric probe_fabric(const ProbeRegion &probe, const std::vector<discrete::ContactForce> &contacts);

  // Area-weighted mean over the cells with their centre inside. stress: n_cells [pressure].
  ProbeStress cell_probe_stress(const ProbeRegion &probe, const QuadMesh &mesh, const std::vector<Eigen::Matrix2d> &stress);
} // namespace diptych::coupling
