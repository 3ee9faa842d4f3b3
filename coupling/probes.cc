// diptych: rectangular probes in the zone and in the packs on either side: stress and fabric (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/homogenisation/cell_cover.h"

namespace diptych::coupling
{
  namespace
  {
    using Polygon = std::vector<Eigen::Vector2d>;

    constexpr double degree = M_PI / 180;

    struct Rectangle
    {
      Eigen::Vector2d centre = Eigen::Vector2d::Zero();
      Eigen::Vector2d along  = Eigen::Vector2d::UnitX();
      double          length = 0, thickness = 0;
    };

    Polygon corners(const Rectangle &r)
    {
      const Eigen::Vector2d a = 0.5 * r.length * r.along;
      const Eigen::Vector2d b = 0.5 * r.thickness * Eigen::Vector2d(-r.along.y(), r.along.x());
      return {r.centre - a - b, r.centre + a - b, r.centre + a + b, r.centre - a + b};
    }

    // Corners first: they reject most. Points along the edges then see dents of the outline.
    bool fits_inside(Rectangle rectangle, const double gap, const Polygon &outline)
    {
      rectangle.length += 2 * gap;
      rectangle.thickness += 2 * gap;
      const Polygon corner = corners(rectangle);
      const auto    inside = [&](const Eigen::Vector2d &x) { return inside_polygon(x, outline); };
      if (!std::all_of(corner.begin(), corner.end(), inside))
        return false;
      for (int k = 0; k < 4; ++k)
        for (int step = 1; step < 16; ++step)
          if (!inside(corner[k] + step / 16. * (corner[(k + 1) % 4] - corner[k])))
            return false;
      return true;
    }

    double polygon_area(const Polygon &polygon)
    {
      double area = 0;
      for (std::size_t k = 0; k < polygon.size(); ++k)
        {
          const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
          area += 0.5 * (a.x() * b.y() - a.y() * b.x());
        }
      return area;
    }

    // Angle of the major axis of the symmetric part from the horizontal, in (-90, 90].
    double major_direction(const Eigen::Matrix2d &t)
    {
      const double angle = 0.5 * std::atan2(t(0, 1) + t(1, 0), t(0, 0) - t(1, 1)) / degree;
      return angle <= -90 ? angle + 180 : angle;
    }

    double principal_difference(const Eigen::Matrix2d &t)
    {
      return std::hypot(t(0, 0) - t(1, 1), t(0, 1) + t(1, 0));
    }

    // Oblique rectangle on the middle of the band's chord through the sample, shrunk until it lies inside.
    Rectangle zone_rectangle(const Polygon &outline, const SampleFrame &frame, const Band &band, const ProbeOptions &options)
    {
      const Eigen::Vector2d along = band.direction(), normal = band.normal();
      double                first = INFINITY, last = -INFINITY;
      for (std::size_t k = 0; k < outline.size(); ++k)
        {
          const Eigen::Vector2d a = outline[k] - frame.centre, b = outline[(k + 1) % outline.size()] - frame.centre;
          const double          above_a = a.dot(normal) - band.offset, above_b = b.dot(normal) - band.offset;
          if ((above_a < 0) == (above_b < 0))
            continue;
          const double position = (a + above_a / (above_a - above_b) * (b - a)).dot(along);
          first                 = std::min(first, position);
          last                  = std::max(last, position);
        }
      if (!(first < last))
        return {};

      const double smallest = options.minimum_side * frame.mean_diameter;
      Rectangle    zone{frame.centre + band.offset * normal + 0.5 * (first + last) * along, along,
                     options.zone_length * (last - first),
                     std::clamp(band.width_10_90, smallest, std::max(smallest, 0.3 * (last - first)))};
      for (; zone.length > smallest; zone.length *= 0.95)
        if (fits_inside(zone, 0, outline))
          return zone;
      return {};
    }

    // The largest horizontal rectangle on one side of the zone, not larger than the zone's, as far from the zone as it goes.
    Rectangle pack_rectangle(const Polygon      &outline,
                             const SampleFrame  &frame,
                             const Band         &band,
                             const Rectangle    &zone,
                             const ProbeOptions &options,
                             const double        side)
    {
      const double    d     = frame.mean_diameter;
      Eigen::Vector2d lower = outline[0], upper = outline[0];
      for (const auto &x : outline)
        {
          lower = lower.cwiseMin(x);
          upper = upper.cwiseMax(x);
        }
      const auto beyond_zone = [&](const Eigen::Vector2d &x) {
        return side * ((x - frame.centre).dot(band.normal()) - band.offset) - 0.5 * zone.thickness;
      };

      Rectangle pack{frame.centre, {1, 0}, std::sqrt(zone.length * zone.thickness * options.aspect), 0};
      for (; pack.length / options.aspect >= options.minimum_side * d; pack.length *= 0.9)
        {
          pack.thickness     = pack.length / options.aspect;
          double    farthest = -INFINITY;
          Rectangle best;
          for (double y = lower.y(); y <= upper.y(); y += 2 * d)
            for (double x = lower.x(); x <= upper.x(); x += 2 * d)
              {
                pack.centre          = {x, y};
                const Polygon corner = corners(pack);
                if (beyond_zone(pack.centre) > farthest &&
                    std::all_of(corner.begin(), corner.end(), [&](const auto &c) { return beyond_zone(c) >= 0; }) &&
                    fits_inside(pack, options.platen_gap * d, outline))
                  {
                    farthest = beyond_zone(pack.centre);
                    best     = pack;
                  }
              }
          if (best.length > 0)
            return best;
        }
      return {};
    }

    Polygon polygon_or_none(const Rectangle &rectangle)
    {
      return rectangle.length > 0 ? corners(rectangle) : Polygon{};
    }

    std::vector<ProbeRegion> stacked_probes(const Polygon &outline, const SampleFrame &frame, const ProbeOptions &options)
    {
      std::vector<ProbeRegion> probes = {{"upper", {}}, {"zone", {}}, {"lower", {}}};
      for (int k = 0; k < 3; ++k)
        {
          Rectangle part{
            frame.centre + Eigen::Vector2d(0, 0.3 * (1 - k) * frame.height), {1, 0}, 0.7 * frame.width, 0.2 * frame.height};
          while (part.length > options.minimum_side * frame.mean_diameter && !fits_inside(part, 0, outline))
            part.length *= 0.9;
          if (fits_inside(part, 0, outline))
            probes[k].polygon = corners(part);
        }
      return probes;
    }
  } // namespace

  std::vector<Eigen::Vector2d> outline_polygon(const discrete::Outline &outline)
  {
    std::vector<Eigen::Vector2d> polygon(outline.left.rbegin(), outline.left.rend());
    polygon.insert(polygon.end(), outline.right.begin(), outline.right.end());
    return polygon;
  }

  // Crossings of a ray to the right; half-open edges, so that a corner counts once.
  bool inside_polygon(const Eigen::Vector2d &point, const std::vector<Eigen::Vector2d> &polygon)
  {
    bool inside = false;
    for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        if ((a.y() > point.y()) != (b.y() > point.y()) &&
            point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
          inside = !inside;
      }
    return inside;
  }

  std::vector<ProbeRegion> place_probes(const std::vector<Eigen::Vector2d> &outline,
                                        const SampleFrame                  &frame,
                                        const std::vector<Band>            &bands,
                                        const ProbeOptions                 &options)
  {
    if (outline.size() < 3 || !(frame.width > 0) || !(frame.height > 0))
      throw std::invalid_argument("probes need an outline of three points or more and an extent of the sample");
    if (bands.empty())
      return stacked_probes(outline, frame, options);

    const Rectangle zone = zone_rectangle(outline, frame, bands[0], options);
    if (!(zone.length > 0))
      return stacked_probes(outline, frame, options);
    return {{"upper", polygon_or_none(pack_rectangle(outline, frame, bands[0], zone, options, 1))},
            {"zone", corners(zone)},
            {"lower", polygon_or_none(pack_rectangle(outline, frame, bands[0], zone, options, -1))}};
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

  // Moments are attributed to whole grains, the rectangle cuts through grains. Dividing by the area of the grains counted, and
  // multiplying by the solid fraction measured exactly in the rectangle, removes the rim's scatter of order perimeter * d / area.
  ProbeStress grain_probe_stress(const ProbeRegion                  &probe,
                                 const std::vector<Eigen::Vector2d> &position,
                                 const std::vector<double>          &radius,
                                 const std::vector<Eigen::Matrix2d> &moment)
  {
    if (radius.size() != position.size() || moment.size() != position.size())
      throw std::invalid_argument("one radius and one moment a grain are needed");
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
    // beyond 90 degrees an axis is not known at all
    result.direction_error_deg = std::min(90., 1 / (result.anisotropy * std::sqrt(2 * n)) / degree);
    return result;
  }

  ProbeStress cell_probe_stress(const ProbeRegion &probe, const QuadMesh &mesh, const std::vector<Eigen::Matrix2d> &stress)
  {
    if (stress.size() != mesh.cell.size())
      throw std::invalid_argument("one stress a cell is needed");
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
