// diptych: resultant forces across the diameters of a circle, compared with those from the circle's mean stress (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/probes/circular_probe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "coupling/averaging/cell_cover.h"

namespace diptych::coupling
{
  namespace
  {
    struct Diameter
    {
      Eigen::Vector2d along, normal;
    };

    Diameter diameter(const double angle_deg)
    {
      const double angle = angle_deg * M_PI / 180;
      return {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
    }

    double relative_norm(const double q, const double p)
    {
      return p > 0 ? std::sqrt(q / p) : NAN;
    }

    // Part of a branch within the circle, with the parameters from < to; none if from >= to. Solves |a + t d|^2 = R^2 about the
    // centre.
    std::array<double, 2> within(const Circle &circle, const Branch &branch)
    {
      const Eigen::Vector2d a = branch.from - circle.centre, d = branch.to - branch.from;
      const double          square = d.squaredNorm(), half_linear = a.dot(d);
      const double          discriminant = half_linear * half_linear - square * (a.squaredNorm() - circle.radius * circle.radius);
      if (!(discriminant > 0))
        return {{1, 0}};
      const double root = std::sqrt(discriminant);
      return {{std::max(0., (-half_linear - root) / square), std::min(1., (-half_linear + root) / square)}};
    }

    Eigen::Matrix2d mean_stress(const Circle &circle, const std::vector<Branch> &all)
    {
      Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
      for (const Branch &branch : all)
        if (const auto [from, to] = within(circle, branch); from < to)
          sum -= (to - from) * branch.force * (branch.to - branch.from).transpose();
      return sum / (M_PI * circle.radius * circle.radius);
    }

    struct CellStress
    {
      const QuadMesh                     &mesh;
      const TriangleSearch               &search;
      const std::vector<Eigen::Matrix2d> &stress;

      const Eigen::Matrix2d &of(const unsigned int triangle) const { return stress[mesh.triangle[triangle].cell]; }
    };

    Eigen::Matrix2d mean_stress(const Circle &circle, const CellStress &cells)
    {
      const Eigen::Vector2d        reach = Eigen::Vector2d::Constant(circle.radius);
      std::vector<unsigned int>    triangles;
      std::vector<Eigen::Vector2d> corners(3);
      Eigen::Matrix2d              sum  = Eigen::Matrix2d::Zero();
      double                       area = 0;
      cells.search.triangles_in_box(circle.centre - reach, circle.centre + reach, triangles);
      for (const unsigned int t : triangles)
        if (cells.of(t).allFinite())
          {
            std::copy(cells.search.corners(t).begin(), cells.search.corners(t).end(), corners.begin());
            const double part = disc_polygon_area(circle.centre, circle.radius, corners);
            sum += part * cells.of(t);
            area += part;
          }
      return sum / area; // NaN if no cell has a value
    }

    Eigen::Matrix2d mean_stress_along(const Circle &circle, const Diameter &d, const CellStress &cells)
    {
      std::vector<TriangleSearch::Piece> pieces;
      Eigen::Matrix2d                    sum    = Eigen::Matrix2d::Zero();
      double                             length = 0;
      cells.search.cut(circle.centre - circle.radius * d.along, circle.centre + circle.radius * d.along, pieces);
      for (const auto &piece : pieces)
        if (piece.inside && cells.of(piece.triangle).allFinite())
          {
            sum += (piece.to - piece.from) * cells.of(piece.triangle);
            length += piece.to - piece.from;
          }
      return sum / length;
    }

    // Forces across equal blocks of a diameter, from -radius to radius along it. The side behind the normal exerts them.
    std::vector<Eigen::Vector2d> block_forces(const Circle              &circle,
                                              const Diameter            &d,
                                              const std::vector<Branch> &all,
                                              const int                  n)
    {
      std::vector<Eigen::Vector2d> force(n, Eigen::Vector2d::Zero());
      for (const Branch &branch : all)
        {
          const Eigen::Vector2d a = branch.from - circle.centre, b = branch.to - circle.centre;
          const double          above_a = a.dot(d.normal), above_b = b.dot(d.normal);
          if ((above_a >= 0) == (above_b >= 0))
            continue;
          const double place = (a + above_a / (above_a - above_b) * (b - a)).dot(d.along);
          if (std::abs(place) >= circle.radius)
            continue;
          const int block = std::clamp(static_cast<int>(0.5 * (place / circle.radius + 1) * n), 0, n - 1);
          force[block] += (above_a >= 0 ? 1. : -1.) * branch.force;
        }
      return force;
    }

    // Mean over the blocks and its standard error, components x and y; block length = diameter / n. There is no error for n < 3.
    struct Traction
    {
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      Eigen::Matrix2d covariance; // covariance of the mean
    };
    Traction traction_of(const std::vector<Eigen::Vector2d> &force, const double block_length)
    {
      const double n = double(force.size());
      Traction     result;
      for (const Eigen::Vector2d &f : force)
        result.mean += f / (n * block_length);
      result.covariance.setConstant(n < 3 ? NAN : 0);
      for (const Eigen::Vector2d &f : force)
        {
          const Eigen::Vector2d deviation = f / block_length - result.mean;
          result.covariance += deviation * deviation.transpose() / (n * (n - 1));
        }
      return result;
    }

    CircularProbe empty_probe(const Circle &circle, const int n_angles)
    {
      if (n_angles < 2)
        throw std::invalid_argument("a circular probe needs at least two diameters");
      CircularProbe probe;
      probe.circle = circle;
      if (circle.radius > 0)
        for (int k = 0; k < n_angles; ++k)
          probe.angles_deg.push_back(180. * k / n_angles);
      return probe;
    }

    void add_traction(const Diameter &d, const Eigen::Vector2d &traction, CircularProbe &probe)
    {
      const Eigen::Vector2d predicted = probe.stress * d.normal;
      probe.normal.push_back(traction.dot(d.normal));
      probe.tangential.push_back(traction.dot(d.along));
      probe.predicted_normal.push_back(predicted.dot(d.normal));
      probe.predicted_tangential.push_back(predicted.dot(d.along));
    }

    struct Squares
    {
      std::vector<double> difference, predicted;
    };
    Squares squares(const CircularProbe &probe)
    {
      Squares result;
      for (std::size_t k = 0; k < probe.normal.size(); ++k)
        {
          const double normal     = probe.normal[k] - probe.predicted_normal[k],
                       tangential = probe.tangential[k] - probe.predicted_tangential[k];
          const bool known        = std::isfinite(normal) && std::isfinite(tangential);
          result.difference.push_back(known ? normal * normal + tangential * tangential : 0);
          result.predicted.push_back(known ? probe.predicted_normal[k] * probe.predicted_normal[k] +
                                               probe.predicted_tangential[k] * probe.predicted_tangential[k]
                                           : 0);
        }
      return result;
    }

    // Diameters at an angle a to each other are R a apart at the rim. Neighbours closer there than a block belong to one block.
    Interval angle_block_interval(const Squares &all, const double radius, const BootstrapOptions &options)
    {
      const int           n_angles = static_cast<int>(all.difference.size());
      const int           n        = std::min(n_angles, static_cast<int>(M_PI * radius / options.block));
      std::vector<double> q(std::max(n, 1), 0.), p(q.size(), 0.);
      for (int k = 0; k < n_angles; ++k)
        {
          const std::size_t block = static_cast<std::size_t>(k) * q.size() / n_angles;
          q[block] += all.difference[k];
          p[block] += all.predicted[k];
        }
      const auto norm = [&](const std::vector<int> &times) {
        double sum_q = 0, sum_p = 0;
        for (std::size_t b = 0; b < q.size(); ++b)
          {
            sum_q += times[b] * q[b];
            sum_p += times[b] * p[b];
          }
        return relative_norm(sum_q, sum_p);
      };
      const double                 value = norm(std::vector<int>(q.size(), 1));
      std::vector<Eigen::Vector3d> influence; // influence of a block on sum q - value^2 sum p
      std::vector<Eigen::Vector2i> place;
      for (std::size_t b = 0; b < q.size(); ++b)
        {
          influence.emplace_back(q[b] - value * value * p[b], 0, 0);
          place.emplace_back(static_cast<int>(b), 0);
        }
      const double        stretch = small_sample_factor(n) * neighbour_factor(influence, place);
      std::vector<double> deviations;
      for (const std::vector<int> &times : resampled_blocks(n, options))
        deviations.push_back(stretch * (norm(times) - value));
      Interval result = interval_from(value, deviations);
      if (result.low < 0)
        result.low = 0;
      return result;
    }
  } // namespace

  Circle place_circle(const std::vector<Eigen::Vector2d> &outline,
                      const SampleFrame                  &frame,
                      const std::vector<Band>            &bands,
                      const ProbeOptions                 &options)
  {
    check_probe_options(options);
    const double d = frame.mean_diameter;
    Circle       circle{frame.centre, INFINITY};
    double       gap = options.platen_gap * d;
    if (!options.probe_circle.empty())
      {
        circle.centre += d * Eigen::Vector2d(options.probe_circle[0], options.probe_circle[1]);
        circle.radius = d * options.probe_circle[2];
        gap           = 0;
      }
    else if (!bands.empty())
      circle.centre = band_middle(outline, frame, bands[0]).value_or(frame.centre);
    circle.radius = std::min(circle.radius, distance_to_edges(circle.centre, outline) - gap);
    if (!inside_polygon(circle.centre, outline) || circle.radius < 0.5 * options.minimum_side * d)
      circle.radius = 0;
    return circle;
  }

  CircularProbe grain_circular_probe(const Circle           &circle,
                                     const GrainNetwork     &network,
                                     const BootstrapOptions &options,
                                     const int               n_angles)
  {
    if (!(options.block > 0))
      throw std::invalid_argument("the side of a block must be above 0");
    CircularProbe probe = empty_probe(circle, n_angles);
    if (!(circle.radius > 0))
      return probe;
    const std::vector<Branch> all = branches(network.position, network.forces, network.period);
    probe.stress                  = mean_stress(circle, all);

    const int n_blocks     = std::max(1, static_cast<int>(2 * circle.radius / options.block));
    double    error_square = 0;
    for (const double angle : probe.angles_deg)
      {
        const Diameter d        = diameter(angle);
        const Traction traction = traction_of(block_forces(circle, d, all, n_blocks), 2 * circle.radius / n_blocks);
        add_traction(d, traction.mean, probe);
        probe.normal_error.push_back(std::sqrt(d.normal.dot(traction.covariance * d.normal)));
        probe.tangential_error.push_back(std::sqrt(d.along.dot(traction.covariance * d.along)));
        error_square += traction.covariance.trace();
      }
    const Squares of_angles = squares(probe);
    double        predicted = 0;
    for (const double p : of_angles.predicted)
      predicted += p;
    probe.relative_l2        = angle_block_interval(of_angles, circle.radius, options);
    probe.independent_blocks = relative_norm(error_square, predicted);
    return probe;
  }

  CircularProbe cell_circular_probe(const Circle                       &circle,
                                    const QuadMesh                     &mesh,
                                    const TriangleSearch               &search,
                                    const std::vector<Eigen::Matrix2d> &stress,
                                    const int                           n_angles)
  {
    if (stress.size() != mesh.cell.size())
      throw std::invalid_argument("a circular probe needs one stress per cell");
    CircularProbe probe = empty_probe(circle, n_angles);
    if (!(circle.radius > 0))
      return probe;
    const CellStress cells{mesh, search, stress};
    probe.stress = mean_stress(circle, cells);
    for (const double angle : probe.angles_deg)
      {
        const Diameter d = diameter(angle);
        add_traction(d, mean_stress_along(circle, d, cells) * d.normal, probe);
      }
    const Squares of_angles  = squares(probe);
    double        difference = 0, predicted = 0;
    for (std::size_t k = 0; k < of_angles.predicted.size(); ++k)
      {
        difference += of_angles.difference[k];
        predicted += of_angles.predicted[k];
      }
    probe.relative_l2.value = relative_norm(difference, predicted);
    return probe;
  }
} // namespace diptych::coupling
