// diptych: mean stress and fabric of rectangular probes (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/probes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/averaging/cell_cover.h"
#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
  }

  ProbeStress probe_stress(const Eigen::Matrix2d &stress, const int count)
  {
    ProbeStress result;
    result.count  = count;
    result.stress = stress;
    if (!stress.allFinite())
      return result;
    const double difference = principal_difference(stress);
    result.s1               = 0.5 * (stress.trace() + difference);
    result.s2               = 0.5 * (stress.trace() - difference);
    result.direction_deg    = major_direction(stress);
    result.t_over_s         = difference / stress.trace();
    return result;
  }

  // Moments belong to whole grains, but the rectangle cuts grains. Division by the area of the counted grains removes the
  // scatter at the rim, of order perimeter * d / area. The exact solid fraction restores the stress.
  ProbeStress grain_probe_stress(const ProbeRegion                  &probe,
                                 const std::vector<Eigen::Vector2d> &position,
                                 const std::vector<double>          &radius,
                                 const std::vector<Eigen::Matrix2d> &moment)
  {
    if (radius.size() != position.size() || moment.size() != position.size())
      throw std::invalid_argument("the stress of a probe needs one radius and one moment per grain");
    if (probe.polygon.empty())
      return {};

    Eigen::Matrix2d sum  = Eigen::Matrix2d::Zero();
    double          area = 0, solid_area = 0;
    int             count = 0;
    for (std::size_t i = 0; i < position.size(); ++i)
      {
        solid_area += disc_polygon_area(position[i], radius[i], probe.polygon);
        if (!inside_polygon(position[i], probe.polygon))
          continue;
        ++count;
        sum += moment[i];
        area += M_PI * radius[i] * radius[i];
      }
    if (count == 0)
      return {};
    return probe_stress(sum / area * solid_area / polygon_area(probe.polygon), count);
  }

  ProbeFabric probe_fabric(const ProbeRegion &probe, const std::vector<discrete::ContactForce> &contacts)
  {
    ProbeFabric     result;
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const auto &contact : contacts)
      {
        if (contact.force.isZero(0) || !inside_polygon(contact.point, probe.polygon))
          continue;
        ++result.contacts;
        sum += contact.normal * contact.normal.transpose();
        const double angle  = std::atan2(contact.normal.y(), contact.normal.x()) / degree;
        const int    sector = std::min(23, static_cast<int>((angle < 0 ? angle + 360 : angle) / 15));
        ++result.normals_24[sector];
        ++result.normals_24[(sector + 12) % 24];
      }
    if (result.contacts == 0)
      return result;

    const double n          = result.contacts;
    result.fabric           = sum / n;
    result.direction_deg    = major_direction(result.fabric);
    result.anisotropy       = 2 * principal_difference(result.fabric);
    result.anisotropy_error = std::sqrt(2 / n);
    // Beyond 90 degrees the direction of an axis is unknown.
    result.direction_error_deg = std::min(90., 1 / (result.anisotropy * std::sqrt(2 * n)) / degree);
    return result;
  }

  ProbeStress cell_probe_stress(const ProbeRegion &probe, const QuadMesh &mesh, const std::vector<Eigen::Matrix2d> &stress)
  {
    if (stress.size() != mesh.cell.size())
      throw std::invalid_argument("the stress of a probe needs one stress per cell");
    const std::vector<double> areas = cell_areas(mesh);
    Eigen::Matrix2d           sum   = Eigen::Matrix2d::Zero();
    double                    area  = 0;
    int                       count = 0;
    for (unsigned int c = 0; c < areas.size(); ++c)
      if (inside_polygon(cell_centre(mesh, c), probe.polygon) && stress[c].allFinite())
        {
          ++count;
          sum += areas[c] * stress[c];
          area += areas[c];
        }
    return count > 0 ? probe_stress(sum / area, count) : ProbeStress{};
  }
} // namespace diptych::coupling
