// diptych: tractions on planes parallel to a band, one value per strip
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/band_traction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/cells/polygon.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double clear_of_outline = 2; // in mean diameters; outermost grains have contacts on one side only
    constexpr double shortest_strip   = 8; // in mean diameters

    Eigen::Vector2d along_of(const TractionStrips &strips)
    {
      return {std::cos(strips.angle_deg * M_PI / 180), std::sin(strips.angle_deg * M_PI / 180)};
    }

    // Coordinates along and across the band.
    Eigen::Vector2d local(const TractionStrips &strips, const Eigen::Vector2d &x)
    {
      const Eigen::Vector2d along = along_of(strips), relative = x - strips.origin;
      return {relative.dot(along), along.x() * relative.y() - along.y() * relative.x()};
    }

    struct Box
    {
      Eigen::Vector2d low, high;
    };

    // Share of the segment a-b within a box (Liang and Barsky 1984).
    double share_within(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Box &box)
    {
      double from = 0, to = 1;
      for (int k = 0; k < 2; ++k)
        {
          const double step = b[k] - a[k];
          if (step == 0)
            {
              if (a[k] < box.low[k] || a[k] >= box.high[k])
                return 0;
              continue;
            }
          const double at_low = (box.low[k] - a[k]) / step, at_high = (box.high[k] - a[k]) / step;
          from = std::max(from, std::min(at_low, at_high));
          to   = std::min(to, std::max(at_low, at_high));
        }
      return std::max(0., to - from);
    }

    double deviation(const std::vector<double> &values)
    {
      double sum = 0, squares = 0;
      int    n = 0;
      for (const double v : values)
        if (std::isfinite(v))
          {
            sum += v;
            ++n;
          }
      for (const double v : values)
        if (std::isfinite(v))
          squares += (v - sum / n) * (v - sum / n);
      return n > 1 ? std::sqrt(squares / (n - 1)) : NAN;
    }

    double mean_of_known(const std::vector<double> &values)
    {
      double sum = 0;
      int    n   = 0;
      for (const double v : values)
        if (std::isfinite(v))
          {
            sum += v;
            ++n;
          }
      return n > 0 ? sum / n : NAN;
    }

    double root_mean_square(std::vector<double> values)
    {
      for (double &v : values)
        v *= v;
      return std::sqrt(mean_of_known(values));
    }

    void add_variation(BandTraction &traction)
    {
      const double size         = std::hypot(mean_of_known(traction.normal), mean_of_known(traction.shear));
      traction.variation_normal = deviation(traction.normal) / size;
      traction.variation_shear  = deviation(traction.shear) / size;
      if (traction.normal_error.empty())
        return;
      traction.independent_normal = root_mean_square(traction.normal_error) / size;
      traction.independent_shear  = root_mean_square(traction.shear_error) / size;
    }

    struct StripBlocks
    {
      Box                          box;
      double                       length;   // of a block
      std::vector<Eigen::Vector2d> traction; // components along and across the band, for each block
    };

    StripBlocks empty_blocks(const TractionStrips &strips, const std::size_t k, const double block)
    {
      const double length = strips.to[k] - strips.from[k];
      const int    n      = std::max(1, static_cast<int>(length / block));
      return {{{strips.from[k], strips.edges[k]}, {strips.to[k], strips.edges[k + 1]}},
              length / n,
              std::vector<Eigen::Vector2d>(n, Eigen::Vector2d::Zero())};
    }

    // Adds the second column of -f (x) (b - a) / area, in the band's axes. a, b: ends of a branch; force: on the body at a.
    void add_branch(const Eigen::Vector2d &a, const Eigen::Vector2d &b, const Eigen::Vector2d &force, StripBlocks &strip)
    {
      const double low = std::min(a.x(), b.x()) - strip.box.low.x(), high = std::max(a.x(), b.x()) - strip.box.low.x();
      const int    n = static_cast<int>(strip.traction.size());
      if (high < 0 || low >= n * strip.length || std::max(a.y(), b.y()) < strip.box.low.y() ||
          std::min(a.y(), b.y()) >= strip.box.high.y())
        return;
      const double area  = strip.length * (strip.box.high.y() - strip.box.low.y());
      const int    first = std::max(0, static_cast<int>(low / strip.length));
      const int    last  = std::min(n - 1, static_cast<int>(high / strip.length));
      for (int k = first; k <= last; ++k)
        {
          Box block     = strip.box;
          block.low[0]  = strip.box.low.x() + k * strip.length;
          block.high[0] = block.low.x() + strip.length;
          strip.traction[k] -= share_within(a, b, block) * (b.y() - a.y()) / area * force;
        }
    }

    struct MeanAndError
    {
      Eigen::Vector2d mean, error;
    };
    MeanAndError mean_and_error(const std::vector<Eigen::Vector2d> &values)
    {
      const double n = double(values.size());
      MeanAndError result{Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(n < 3 ? NAN : 0)};
      for (const Eigen::Vector2d &v : values)
        result.mean += v / n;
      for (const Eigen::Vector2d &v : values)
        result.error += (v - result.mean).cwiseAbs2() / (n * (n - 1));
      result.error = result.error.cwiseSqrt();
      return result;
    }

    std::vector<Eigen::Vector2d> rectangle(const TractionStrips &strips, const std::size_t k)
    {
      const Eigen::Vector2d along = along_of(strips), normal(-along.y(), along.x());
      return rectangle_corners(strips.origin + 0.5 * (strips.from[k] + strips.to[k]) * along +
                                 0.5 * (strips.edges[k] + strips.edges[k + 1]) * normal,
                               along, strips.to[k] - strips.from[k], strips.edges[k + 1] - strips.edges[k]);
    }

    // NaN if no cell has a value.
    Eigen::Matrix2d mean_over_rectangle(const std::vector<Eigen::Vector2d> &box,
                                        const QuadMesh                     &mesh,
                                        const TriangleSearch               &search,
                                        const std::vector<Eigen::Matrix2d> &stress)
    {
      std::vector<unsigned int>    triangles;
      std::vector<Eigen::Vector2d> corners(3);
      Eigen::Matrix2d              sum  = Eigen::Matrix2d::Zero();
      double                       area = 0;
      search.triangles_in_box(box[0].cwiseMin(box[1]).cwiseMin(box[2]).cwiseMin(box[3]),
                              box[0].cwiseMax(box[1]).cwiseMax(box[2]).cwiseMax(box[3]), triangles);
      for (const unsigned int t : triangles)
        if (const Eigen::Matrix2d &its = stress[mesh.triangle[t].cell]; its.allFinite())
          {
            std::copy(search.corners(t).begin(), search.corners(t).end(), corners.begin());
            const double part = polygon_area(clipped(corners, box));
            sum += part * its;
            area += part;
          }
      return sum / area;
    }
  } // namespace

  TractionStrips traction_strips(const std::vector<Eigen::Vector2d> &outline,
                                 const SampleFrame                  &frame,
                                 const double                        angle_deg,
                                 const std::vector<double>          &edges,
                                 const double                        share)
  {
    if (edges.size() < 2 || !std::is_sorted(edges.begin(), edges.end()))
      throw std::invalid_argument("the edges of the strips must be in ascending order");
    TractionStrips        strips{frame.centre, angle_deg, edges, {}, {}};
    const Eigen::Vector2d along = along_of(strips), normal(-along.y(), along.x());
    const double          gap   = clear_of_outline * frame.mean_diameter;
    for (std::size_t k = 0; k + 1 < edges.size(); ++k)
      {
        double from = -INFINITY, to = INFINITY;
        for (const double across : {edges[k], 0.5 * (edges[k] + edges[k + 1]), edges[k + 1]})
          {
            const auto span = line_span(outline, frame.centre + across * normal, along);
            from            = std::max(from, span ? (*span)[0] + gap : INFINITY);
            to              = std::min(to, span ? (*span)[1] - gap : -INFINITY);
          }
        const double middle = 0.5 * (from + to), half = 0.5 * share * (to - from);
        const bool   carries = edges[k + 1] > edges[k] && to > from && 2 * half >= shortest_strip * frame.mean_diameter;
        strips.from.push_back(carries ? middle - half : NAN);
        strips.to.push_back(carries ? middle + half : NAN);
      }
    return strips;
  }

  BandTraction grain_band_traction(const TractionStrips &strips, const GrainNetwork &network, const double block)
  {
    if (!(block > 0))
      throw std::invalid_argument("the side of a block must be above 0");
    const std::size_t        n = strips.from.size();
    std::vector<StripBlocks> of_strip(n);
    for (std::size_t k = 0; k < n; ++k)
      if (std::isfinite(strips.from[k]))
        of_strip[k] = empty_blocks(strips, k, block);
    const Eigen::Vector2d along = along_of(strips), normal(-along.y(), along.x());
    for (const Branch &branch : branches(network.position, network.forces, network.period))
      {
        const Eigen::Vector2d a = local(strips, branch.from), b = local(strips, branch.to);
        const Eigen::Vector2d force(branch.force.dot(along), branch.force.dot(normal));
        for (StripBlocks &strip : of_strip)
          if (!strip.traction.empty())
            add_branch(a, b, force, strip);
      }

    BandTraction result;
    result.edges = strips.edges;
    for (const StripBlocks &strip : of_strip)
      {
        const bool         carries = !strip.traction.empty();
        const MeanAndError value   = carries ? mean_and_error(strip.traction)
                                             : MeanAndError{Eigen::Vector2d::Constant(NAN), Eigen::Vector2d::Constant(NAN)};
        result.shear.push_back(value.mean.x());
        result.normal.push_back(value.mean.y());
        result.shear_error.push_back(value.error.x());
        result.normal_error.push_back(value.error.y());
      }
    add_variation(result);
    return result;
  }

  BandTraction cell_band_traction(const TractionStrips               &strips,
                                  const QuadMesh                     &mesh,
                                  const TriangleSearch               &search,
                                  const std::vector<Eigen::Matrix2d> &stress)
  {
    if (stress.size() != mesh.cell.size())
      throw std::invalid_argument("the traction along a band needs one stress per cell");
    const Eigen::Vector2d along = along_of(strips), normal(-along.y(), along.x());
    BandTraction          result;
    result.edges = strips.edges;
    for (std::size_t k = 0; k < strips.from.size(); ++k)
      {
        Eigen::Vector2d traction = Eigen::Vector2d::Constant(NAN);
        if (std::isfinite(strips.from[k]))
          traction = mean_over_rectangle(rectangle(strips, k), mesh, search, stress) * normal;
        result.normal.push_back(traction.dot(normal));
        result.shear.push_back(traction.dot(along));
      }
    add_variation(result);
    return result;
  }
} // namespace diptych::coupling
