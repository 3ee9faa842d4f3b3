// diptych: scatter of every averaging method on a sheared sample, and stress against the averaging length
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cmath>
#include <cstdio>

#include "benchmarks/homogenisation/samples.h"
#include "benchmarks/homogenisation/sections.h"
#include "coupling/fields/resolution_study.h"

namespace diptych::benchmarks
{
  using namespace diptych::coupling;

  namespace
  {
    // The coarsest cells are about 6 d wide. The others divide them.
    struct Divisions
    {
      unsigned int columns, rows;
    };

    Divisions divisions(const discrete::Snapshot &s)
    {
      const double width = s.outline.right.front().x() - s.outline.left.front().x(), height = s.upper_y - s.lower_y;
      return {unsigned(std::lround(width / (6 * s.mean_diameter))), unsigned(std::lround(height / (6 * s.mean_diameter)))};
    }

    // Symmetric stress of the cells from the given forces.
    std::vector<Eigen::Matrix2d> stress_of(const QuadMesh                            &mesh,
                                           const discrete::Snapshot                  &s,
                                           const std::vector<discrete::ContactForce> &forces,
                                           const AveragingOptions                    &options)
    {
      const TargetCells            target(mesh);
      const Columns                sums = distribute(options, target, moment_carriers(s.position, s.radius, forces)).uniform;
      std::vector<Eigen::Matrix2d> stress;
      for (Eigen::Index k = 0; k < sums.rows(); ++k)
        {
          Eigen::Matrix2d m;
          m << sums(k, 0), 0.5 * (sums(k, 1) + sums(k, 2)), 0.5 * (sums(k, 1) + sums(k, 2)), sums(k, 3);
          stress.push_back(m / target.area[k]);
        }
      return stress;
    }

    struct Figures
    {
      double scatter;    // Deviation / mean of s = trace/2 over the cells.
      double difference; // Relative L2 difference from the time-averaged stress of the surrounding 6 d cell.
    };

    Figures figures(const std::vector<Eigen::Matrix2d> &stress,
                    const std::vector<Eigen::Matrix2d> &reference,
                    const Divisions                    &coarse,
                    const unsigned int                  parts)
    {
      double s = 0, squares = 0, difference = 0, norm = 0;
      for (unsigned int k = 0; k < stress.size(); ++k)
        {
          const unsigned int row = k / (coarse.columns * parts) / parts, column = k % (coarse.columns * parts) / parts;
          const double       trace = 0.5 * stress[k].trace();
          s += trace, squares += trace * trace;
          difference += (stress[k] - reference[row * coarse.columns + column]).squaredNorm();
          norm += reference[row * coarse.columns + column].squaredNorm();
        }
      const double n = double(stress.size()), mean = s / n;
      return {std::sqrt(squares / n - mean * mean) / mean, std::sqrt(difference / norm)};
    }
  } // namespace

  void sheared_grains(const std::string &samples)
  {
    const std::vector<discrete::Snapshot> snapshots = sheared_sample(samples);
    const discrete::Snapshot             &last      = snapshots.back();
    const Divisions                       coarse    = divisions(last);

    // The windows of 0.5 % strain before the last one, each on the shape of the sample at its end.
    std::vector<Eigen::Matrix2d> reference(coarse.columns * coarse.rows, Eigen::Matrix2d::Zero());
    const std::size_t            first = 2, n_windows = snapshots.size() - 1 - first; // 2.5, 3 and 3.5 % strain.
    for (std::size_t w = first; w + 1 < snapshots.size(); ++w)
      {
        const auto stress = stress_of(outline_mesh(snapshots[w].outline, coarse.columns, coarse.rows), snapshots[w],
                                      snapshots[w].window_forces, {});
        for (std::size_t k = 0; k < reference.size(); ++k)
          reference[k] += stress[k] / double(n_windows);
      }

    std::printf(
      "scatter of s over the cells / difference from the stress of 6 d cells averaged over 2 to 3.5 %% strain, in %%\n");
    for (const bool window : {true, false})
      {
        std::printf("%s\n  %-24s %15s %15s %15s\n", window ? "mean forces of 3.5 to 4 % strain" : "forces of the last step", "",
                    "cells of 2 d", "3 d", "6 d");
        for (const NamedMethod &method : methods)
          {
            std::printf("  %-24s", method.name);
            for (const unsigned int parts : {3, 2, 1})
              {
                const QuadMesh mesh = outline_mesh(last.outline, coarse.columns * parts, coarse.rows * parts);
                const Figures  f    = figures(stress_of(mesh, last, window ? last.window_forces : last.contacts, method.options),
                                              reference, coarse, parts);
                std::printf("  %5.1f / %5.1f", 100 * f.scatter, 100 * f.difference);
              }
            std::printf("\n");
          }
      }
  }

  void resolution(const std::string &samples)
  {
    const discrete::Snapshot last   = sheared_sample(samples).back();
    const Divisions          coarse = divisions(last);
    const QuadMesh           mesh   = outline_mesh(last.outline, 3 * coarse.columns, 3 * coarse.rows);
    const double             x      = 0.5 * (last.outline.left.front().x() + last.outline.right.front().x());
    const double             height = last.upper_y - last.lower_y;
    std::vector<StudyPoint>  points;
    for (const double share : {0.75, 0.5, 0.25})
      points.push_back({share == 0.5 ? "middle" : share > 0.5 ? "upper" : "lower", {x, last.lower_y + share * height}});
    for (const KernelShape kernel : {KernelShape::gauss, KernelShape::lucy})
      {
        const ResolutionStudy study = resolution_study(mesh, last, points, kernel);
        const auto            print = [&](const char *title, const std::vector<ResolutionRow> &rows) {
          std::printf("%s: s and t/s at upper, middle, lower; scatter of s and t over the sample in %%\n", title);
          for (const ResolutionRow &row : rows)
            {
              std::printf("  %5.2f d ", row.width);
              for (const PointStress &p : row.points)
                std::printf("  %6.3f %6.3f", p.s, p.t_over_s);
              std::printf("   %5.1f %5.1f\n", 100 * row.scatter_s, 100 * row.scatter_t);
            }
        };
        print(kernel == KernelShape::gauss ? "kernel gauss" : "kernel lucy", study.kernel);
        if (kernel == KernelShape::gauss)
          print("cells", study.cells);
        std::printf("%s\n", study.verdict.c_str());
      }
  }
} // namespace diptych::benchmarks
