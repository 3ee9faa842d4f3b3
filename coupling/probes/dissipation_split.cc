// diptych: energy dissipated inside and outside the band, beside the share of the area that the band covers
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/dissipation_split.h"

#include <cmath>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    double largest_distance(const Eigen::Vector2d &from, const std::vector<Eigen::Vector2d> &points)
    {
      double largest = 0;
      for (const Eigen::Vector2d &x : points)
        largest = std::max(largest, (x - from).norm());
      return largest;
    }

    DissipationSplit with_shares(DissipationSplit split, const double area_inside, const double area)
    {
      if (const double all = split.inside + split.outside; all != 0)
        split.share_inside = split.inside / all;
      if (area > 0)
        split.area_share = area_inside / area;
      if (split.area_share > 0 && split.area_share < 1 && split.share_inside < 1)
        split.density_ratio = (split.share_inside / split.area_share) / ((1 - split.share_inside) / (1 - split.area_share));
      return split;
    }
  } // namespace

  DissipationSplit contact_dissipation_split(const BandZone                     &zone,
                                             const std::vector<Eigen::Vector2d> &outline,
                                             const std::vector<Eigen::Vector2d> &points,
                                             const std::vector<double>          &dissipation)
  {
    if (dissipation.size() != points.size())
      throw std::invalid_argument("the split of the dissipation needs one dissipated energy per contact");
    if (outline.size() < 3)
      throw std::invalid_argument("the outline of the sample needs at least three points");
    DissipationSplit split;
    for (std::size_t k = 0; k < points.size(); ++k)
      (zone.holds(points[k]) ? split.inside : split.outside) += dissipation[k];
    const std::vector<Eigen::Vector2d> strip = zone.rectangle(largest_distance(zone.on_band, outline));
    return with_shares(split, polygon_area(clipped(outline, strip)), polygon_area(outline));
  }

  DissipationSplit cell_dissipation_split(const BandZone &zone, const QuadMesh &mesh, const std::vector<double> &dissipation)
  {
    if (dissipation.size() != mesh.cell.size())
      throw std::invalid_argument("the split of the dissipation needs one value per cell");
    const std::vector<Eigen::Vector2d> strip = zone.rectangle(largest_distance(zone.on_band, mesh.node));
    DissipationSplit                   split;
    double                             area_inside = 0, area = 0;
    for (const CellTriangle &triangle : mesh.triangle)
      {
        const double density = dissipation[triangle.cell];
        if (std::isnan(density))
          continue;
        const std::vector<Eigen::Vector2d> corners = {mesh.node[triangle.node[0]], mesh.node[triangle.node[1]],
                                                      mesh.node[triangle.node[2]]};
        const double                       whole = polygon_area(corners), inside = polygon_area(clipped(corners, strip));
        split.inside += density * inside;
        split.outside += density * (whole - inside);
        area_inside += inside;
        area += whole;
      }
    return with_shares(split, area_inside, area);
  }
} // namespace diptych::coupling
