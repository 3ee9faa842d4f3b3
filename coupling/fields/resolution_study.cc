// diptych: dependence of the grains' stress on the averaging length
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/resolution_study.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupling/averaging/averaging.h"
#include "coupling/averaging/periodic.h"
#include "coupling/averaging/point_stress.h"
#include "coupling/averaging/power_cells.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr double scatter_grid   = 2;    // mean diameters
    constexpr double tolerance      = 0.05; // largest deviation in a plateau, relative to the mean
    constexpr double least_ratio    = 2;
    constexpr double least_t_over_s = 0.1; // a smaller mean of t/s counts as this, so that an isotropic state can be steady, too

    double mean_of(const Eigen::Matrix2d &stress)
    {
      return 0.5 * stress.trace();
    }

    double deviator_of(const Eigen::Matrix2d &stress)
    {
      return std::hypot(0.5 * (stress(0, 0) - stress(1, 1)), 0.5 * (stress(0, 1) + stress(1, 0)));
    }

    PointStress point_stress(const std::string &name, const Eigen::Matrix2d &stress)
    {
      const double s = mean_of(stress);
      return {name, s, s > 0 ? deviator_of(stress) / s : NAN};
    }

    double relative_scatter(const std::vector<double> &value, const std::vector<double> &area)
    {
      double sum = 0, sum_value = 0, squares = 0;
      for (std::size_t k = 0; k < value.size(); ++k)
        {
          sum += area[k];
          sum_value += area[k] * value[k];
        }
      const double mean = sum_value / sum;
      for (std::size_t k = 0; k < value.size(); ++k)
        squares += area[k] * (value[k] - mean) * (value[k] - mean);
      return std::sqrt(squares / sum) / mean;
    }

    void take_scatter(const std::vector<Eigen::Matrix2d> &stress, const std::vector<double> &area, ResolutionRow &row)
    {
      std::vector<double> s, t;
      for (const Eigen::Matrix2d &tensor : stress)
        {
          s.push_back(mean_of(tensor));
          t.push_back(deviator_of(tensor));
        }
      row.scatter_s = relative_scatter(s, area);
      row.scatter_t = relative_scatter(t, area);
    }

    // Squares over the bounding box of a region, each with the area that it shares with the region. `covered`: grains cover the
    // square and at least half of it lies in the region.
    struct Grid
    {
      QuadMesh                  mesh;
      std::vector<double>       area; // shared with the region [length^2]
      std::vector<unsigned int> covered;
    };

    Grid grid_over(const TargetCells &region, const discrete::Snapshot &grains, const double size)
    {
      Grid                         grid;
      std::vector<unsigned int>    triangles;
      std::vector<Eigen::Vector2d> polygon(4), scratch;
      grid.mesh = regular_grid(region.lower, region.upper, size);
      grid.area.assign(grid.mesh.cell.size(), 0.);
      const std::vector<std::uint8_t> covered = grain_cover(grid.mesh, grains).covered;
      for (unsigned int k = 0; k < grid.mesh.cell.size(); ++k)
        {
          for (unsigned int c = 0; c < 4; ++c)
            polygon[c] = grid.mesh.node[grid.mesh.cell[k][c]];
          region.search.triangles_in_box(polygon[0], polygon[2], triangles);
          for (const unsigned int t : triangles)
            if (t < region.mesh.triangle.size()) // the mesh itself, not its images
              grid.area[k] += std::max(0., shared_area(polygon, region.search.corners(t), scratch));
          if (covered[k] && grid.area[k] >= 0.5 * polygon_area(polygon))
            grid.covered.push_back(k);
        }
      return grid;
    }

    // The same for all rows.
    struct Sample
    {
      const discrete::Snapshot &grains;
      const TargetCells        &region;
      Carriers                  moments;
      Grid                      grid; // of the scatter after smoothing
    };

    ResolutionRow kernel_row(const Sample                  &sample,
                             const std::vector<StudyPoint> &points,
                             const KernelShape              kernel,
                             const double                   width)
    {
      const Grid                  &grid = sample.grid;
      std::vector<Eigen::Vector2d> places;
      std::vector<double>          area;
      for (const StudyPoint &point : points)
        places.push_back(point.position);
      for (const unsigned int k : grid.covered)
        {
          places.push_back(cell_centre(grid.mesh, k));
          area.push_back(grid.area[k]);
        }
      const std::vector<Eigen::Matrix2d> stress = stress_at_points(sample.region, sample.moments, places, kernel,
                                                                   width * sample.grains.mean_diameter);

      ResolutionRow row;
      row.width = width;
      for (std::size_t p = 0; p < points.size(); ++p)
        row.points.push_back(point_stress(points[p].name, stress[p]));
      take_scatter({stress.begin() + std::ptrdiff_t(points.size()), stress.end()}, area, row);
      return row;
    }

    ResolutionRow cells_row(const Sample &sample, const std::vector<StudyPoint> &points, const double size)
    {
      const Grid        grid = grid_over(sample.region, sample.grains, size * sample.grains.mean_diameter);
      const TargetCells target(grid.mesh, sample.region.period);
      const CellSums    sums   = distribute({}, target, sample.moments);
      const auto        stress = [&](const unsigned int k) {
        Eigen::Matrix2d m = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(sums.uniform.row(k).data());
        return Eigen::Matrix2d(m / grid.area[k]);
      };

      ResolutionRow row;
      row.width = size;
      for (const StudyPoint &point : points)
        {
          const unsigned int k         = target.cell_of(target.search.locate(target.wrapped(point.position)).triangle);
          const bool         has_value = std::binary_search(grid.covered.begin(), grid.covered.end(), k);
          row.points.push_back(has_value ? point_stress(point.name, stress(k)) : PointStress{point.name, NAN, NAN});
        }
      std::vector<Eigen::Matrix2d> covered;
      std::vector<double>          area;
      for (const unsigned int k : grid.covered)
        {
          covered.push_back(stress(k));
          area.push_back(grid.area[k]);
        }
      take_scatter(covered, area, row);
      return row;
    }

    // Largest relative deviation of s or t/s from their mean over the rows first .. last, over all points. Infinity if a value is
    // missing.
    double largest_deviation(const std::vector<ResolutionRow> &rows, const std::size_t first, const std::size_t last)
    {
      double largest = 0;
      for (std::size_t p = 0; p < rows[first].points.size(); ++p)
        for (const bool ratio : {false, true})
          {
            const double least = ratio ? least_t_over_s : 0;
            const auto   value = [&](const std::size_t k) { return ratio ? rows[k].points[p].t_over_s : rows[k].points[p].s; };
            double       mean  = 0;
            for (std::size_t k = first; k <= last; ++k)
              mean += value(k) / double(last - first + 1);
            for (std::size_t k = first; k <= last; ++k)
              {
                const double deviation = std::abs(value(k) - mean) / std::max(std::abs(mean), least);
                largest                = std::isnan(deviation) ? INFINITY : std::max(largest, deviation);
              }
          }
      return largest;
    }

    std::string verdict_of(const ResolutionStudy &study)
    {
      std::ostringstream text;
      text.precision(3);
      if (study.plateau)
        text << "plateau from w = " << (*study.plateau)[0] << " to " << (*study.plateau)[1]
             << " mean diameters: s and t/s at every "
             << "point stay within " << 100 * tolerance << " % of their mean";
      else
        text << "no plateau: there is no range of w of a factor of " << least_ratio
             << " in which s and t/s at every point stay within " << 100 * tolerance << " % of their mean";
      return text.str();
    }
  } // namespace

  std::optional<std::array<double, 2>> find_plateau(const std::vector<ResolutionRow> &rows)
  {
    std::optional<std::array<double, 2>> widest;
    if (rows.empty() || rows.front().points.empty())
      return widest;
    double widest_ratio = 0;
    for (std::size_t first = 0; first < rows.size(); ++first)
      for (std::size_t last = first; last < rows.size(); ++last)
        {
          const double ratio = rows[last].width / rows[first].width;
          if (ratio >= least_ratio && ratio > widest_ratio && largest_deviation(rows, first, last) <= tolerance)
            {
              widest       = {{rows[first].width, rows[last].width}};
              widest_ratio = ratio;
            }
        }
    return widest;
  }

  ResolutionStudy resolution_study(const QuadMesh                &mesh,
                                   const discrete::Snapshot      &grains,
                                   const std::vector<StudyPoint> &points,
                                   const KernelShape              kernel)
  {
    const TargetCells region(mesh, period_of(grains));
    const Sample      sample{grains, region, moment_carriers(grains.position, grains.radius, grains.window_forces),
                        grid_over(region, grains, scatter_grid * grains.mean_diameter)};
    ResolutionStudy   study;
    for (const double width : kernel_widths)
      study.kernel.push_back(kernel_row(sample, points, kernel, width));
    for (const double size : cell_sizes)
      study.cells.push_back(cells_row(sample, points, size));
    study.plateau = find_plateau(study.kernel);
    study.verdict = verdict_of(study);
    return study;
  }
} // namespace diptych::coupling
