// diptych: error of every averaging method against a known stress field
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>

#include "benchmarks/homogenisation/airy_network.h"
#include "benchmarks/homogenisation/sections.h"
#include "coupling/cells/mesh_cells.h"

namespace diptych::benchmarks
{
  using namespace diptych::coupling;

  namespace
  {
    const Eigen::Vector2d lower(0, 0), upper(60, 90);

    // Means of a stress over the cells from the middles of 10 x 10 parts of each: good to 0.1 % for waves of ten cell sides.
    std::vector<Eigen::Matrix2d> exact_means(const QuadMesh &grid, const AiryFunction &phi)
    {
      constexpr int                n = 10;
      std::vector<Eigen::Matrix2d> means;
      for (const auto &cell : grid.cell)
        {
          const Eigen::Vector2d &from = grid.node[cell[0]], size = grid.node[cell[2]] - from;
          Eigen::Matrix2d        sum = Eigen::Matrix2d::Zero();
          for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b)
              sum += phi(from + Eigen::Vector2d((a + 0.5) / n * size.x(), (b + 0.5) / n * size.y())).stress() / (n * n);
          means.push_back(sum);
        }
      return means;
    }

    // sqrt(sum |a - b|^2 / sum |b|^2) over the cells of equal size that are at least `margin` away from the edge.
    double relative_error(const QuadMesh                     &grid,
                          const CellSums                     &sums,
                          const std::vector<Eigen::Matrix2d> &exact,
                          const double                        margin)
    {
      const double area       = cell_areas(grid).front();
      double       difference = 0, norm = 0;
      for (unsigned int k = 0; k < grid.cell.size(); ++k)
        {
          const Eigen::Vector2d x = cell_centre(grid, k);
          if (((x - lower).array() < margin).any() || ((upper - x).array() < margin).any())
            continue;
          Eigen::Matrix2d stress;
          stress << sums.uniform(k, 0), sums.uniform(k, 1), sums.uniform(k, 2), sums.uniform(k, 3);
          difference += (0.5 * (stress + stress.transpose()) / area - exact[k]).squaredNorm();
          norm += exact[k].squaredNorm();
        }
      return std::sqrt(difference / norm);
    }

    // Root mean square distance between the cell's centre and the centre of mass of its grains, where an affine velocity is
    // reproduced.
    double centre_offset(const QuadMesh &grid, const AiryNetwork &network, const AveragingOptions &options)
    {
      Carriers c = moment_carriers(network.position, network.radius, {});
      c.of_grains.resize(Eigen::Index(network.position.size()), 3);
      for (Eigen::Index i = 0; i < c.of_grains.rows(); ++i)
        {
          const double mass = network.radius[i] * network.radius[i];
          c.of_grains.row(i) << mass, mass * network.position[i].x(), mass * network.position[i].y();
        }
      const Columns sums    = distribute(options, TargetCells(grid), c).of_grains;
      double        squares = 0, n = 0;
      for (unsigned int k = 0; k < grid.cell.size(); ++k)
        if (sums(k, 0) > 0)
          squares += (Eigen::Vector2d(sums(k, 1), sums(k, 2)) / sums(k, 0) - cell_centre(grid, k)).squaredNorm(), ++n;
      return std::sqrt(squares / n);
    }
  } // namespace

  namespace
  {
    constexpr double margin    = 6;               // Least distance of an inner cell from the edge.
    constexpr double lengths[] = {0, 40, 20, 10}; // Wave lengths; 0: no wave.

    void print_errors(const QuadMesh &grid, const AveragingOptions &options, const Faces faces)
    {
      for (const double length : lengths)
        {
          const AiryFunction phi     = pressure_wave(length > 0 ? 0.3 : 0, length > 0 ? length : 1);
          const AiryNetwork  network = airy_network(lower, upper, phi, 1, faces);
          const auto         exact   = exact_means(grid, phi);
          const CellSums     sums    = distribute(options, TargetCells(grid),
                                                  moment_carriers(network.position, network.radius, network.contacts));
          std::printf("  %5.2f (%5.2f)", 100 * relative_error(grid, sums, exact, 0),
                      100 * relative_error(grid, sums, exact, margin));
        }
    }

    void print_heading(const double size, const Faces faces, const char *last)
    {
      std::printf("cells of %g d, forces through %s: relative L2 error in %% (of cells %g d and more from the edge)\n", size,
                  faces == Faces::voronoi ? "Voronoi cells" : "power cells", margin);
      std::printf("  %-24s %14s %14s %14s %14s  %s\n", "", "uniform", "wave 40 d", "20 d", "10 d", last);
    }
  } // namespace

  void known_stress(const std::string &)
  {
    for (const double size : {2., 3., 6.})
      {
        const QuadMesh grid = regular_grid(lower, upper, size);
        print_heading(size, Faces::power_cells, "centre of mass off the cell's centre [d]");
        for (const NamedMethod &method : methods)
          {
            std::printf("  %-24s", method.name);
            print_errors(grid, method.options, Faces::power_cells);
            std::printf("  %6.2f\n", centre_offset(grid, airy_network(lower, upper, pressure_wave(0, 1), 1), method.options));
          }
      }
    const QuadMesh grid = regular_grid(lower, upper, 2);
    print_heading(2, Faces::voronoi, "");
    for (const NamedMethod &method : methods)
      {
        std::printf("  %-24s", method.name);
        print_errors(grid, method.options, Faces::voronoi);
        std::printf("\n");
      }
  }
} // namespace diptych::benchmarks
