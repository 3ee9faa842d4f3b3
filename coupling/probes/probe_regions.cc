// diptych: places of the rectangular probes: in the band and in the packs on either side (Moreau 1997), or as given by the scene
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/probe_regions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::coupling
{
  namespace
  {
    using Polygon = std::vector<Eigen::Vector2d>;

    struct Rectangle
    {
      Eigen::Vector2d centre = Eigen::Vector2d::Zero();
      Eigen::Vector2d along  = Eigen::Vector2d::UnitX();
      double          length = 0, thickness = 0;
    };

    Polygon corners(const Rectangle &r)
    {
      return rectangle_corners(r.centre, r.along, r.length, r.thickness);
    }

    // Checks the corners first, because they reject most rectangles. Points along the edges then find dents of the outline.
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

    // Oblique rectangle at the middle of the band's chord through the sample, reduced until it lies inside.
    Rectangle zone_rectangle(const Polygon &outline, const SampleFrame &frame, const Band &band, const ProbeOptions &options)
    {
      const Eigen::Vector2d along = band.direction(), on_band = frame.centre + band.offset * band.normal();
      const auto            span = line_span(outline, on_band, along);
      if (!span)
        return {};

      const double chord = (*span)[1] - (*span)[0], smallest = options.minimum_side * frame.mean_diameter;
      Rectangle    zone{on_band + 0.5 * ((*span)[0] + (*span)[1]) * along, along, options.zone_length * chord,
                     std::clamp(band.width_10_90, smallest, std::max(smallest, 0.3 * chord))};
      for (; zone.length > smallest; zone.length *= 0.95)
        if (fits_inside(zone, 0, outline))
          return zone;
      return {};
    }

    // The largest horizontal rectangle on one side of the zone's, not larger than it and as far from it as possible.
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
      constexpr double most_places = 1e8;
      if (const double places = (1 + (upper.x() - lower.x()) / (2 * d)) * (1 + (upper.y() - lower.y()) / (2 * d));
          !(places <= most_places))
        throw std::invalid_argument("the outline of the sample has room for " + std::to_string(places) +
                                    " places of a probe; at most 1e8 are possible");
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
      std::vector<ProbeRegion> probes = {{"upper", {}, 0}, {"zone", {}, 0, true}, {"lower", {}, 0}};
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

    std::vector<ProbeRegion> given_probes(const Polygon &outline, const SampleFrame &frame, const std::vector<double> &numbers)
    {
      std::vector<ProbeRegion> probes;
      for (std::size_t k = 0; k < numbers.size(); k += 5)
        {
          const double    d = frame.mean_diameter, angle = numbers[k + 4] * M_PI / 180;
          const Rectangle rectangle{frame.centre + d * Eigen::Vector2d(numbers[k], numbers[k + 1]),
                                    {std::cos(angle), std::sin(angle)},
                                    d * numbers[k + 2],
                                    d * numbers[k + 3]};
          ProbeRegion     probe{"probe " + std::to_string(k / 5 + 1), corners(rectangle), numbers[k + 4]};
          if (!fits_inside(rectangle, 0, outline))
            probe.polygon = clipped(outline, probe.polygon);
          if (probe.polygon.size() < 3 || !(polygon_area(probe.polygon) > 0))
            probe.polygon.clear();
          probes.push_back(probe);
        }
      return probes;
    }
  } // namespace

  std::optional<Eigen::Vector2d> band_middle(const std::vector<Eigen::Vector2d> &outline,
                                             const SampleFrame                  &frame,
                                             const Band                         &band)
  {
    const Eigen::Vector2d on_band = frame.centre + band.offset * band.normal();
    const auto            span    = line_span(outline, on_band, band.direction());
    if (!span)
      return std::nullopt;
    return on_band + 0.5 * ((*span)[0] + (*span)[1]) * band.direction();
  }

  std::vector<Eigen::Vector2d> outline_polygon(const discrete::Outline &outline)
  {
    std::vector<Eigen::Vector2d> polygon(outline.left.rbegin(), outline.left.rend());
    polygon.insert(polygon.end(), outline.right.begin(), outline.right.end());
    return polygon;
  }

  std::vector<ProbeRegion> place_probes(const std::vector<Eigen::Vector2d> &outline,
                                        const SampleFrame                  &frame,
                                        const std::vector<Band>            &bands,
                                        const ProbeOptions                 &options)
  {
    if (outline.size() < 3 || !(frame.width > 0) || !(frame.height > 0))
      throw std::invalid_argument("probes need an outline of at least three points and a sample of positive size");
    check_probe_options(options);
    if (!options.probe_rectangles.empty())
      return given_probes(outline, frame, options.probe_rectangles);
    if (bands.empty())
      return stacked_probes(outline, frame, options);

    const Rectangle zone = zone_rectangle(outline, frame, bands[0], options);
    if (!(zone.length > 0))
      return stacked_probes(outline, frame, options);
    return {{"upper", polygon_or_none(pack_rectangle(outline, frame, bands[0], zone, options, 1)), 0},
            {"zone", corners(zone), bands[0].angle_deg, true},
            {"lower", polygon_or_none(pack_rectangle(outline, frame, bands[0], zone, options, -1)), 0}};
  }
} // namespace diptych::coupling
