// diptych: CPU seconds of every averaging method
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cstdio>

#include "benchmarks/contact_solver/measuring.h"
#include "benchmarks/homogenisation/samples.h"
#include "benchmarks/homogenisation/sections.h"
#include "coupling/fields/fields.h"
#include "coupling/averaging/periodic.h"

namespace diptych::benchmarks
{
  using namespace diptych::coupling;

  namespace
  {
    struct Row
    {
      std::string         name;
      std::vector<double> seconds;
    };

    void print(const std::vector<Row> &rows)
    {
      const double reference = spread(rows.front().seconds).median;
      for (const Row &row : rows)
        {
          const Spread s = spread(row.seconds);
          std::printf("  %-32s %9.4f (%9.4f) s  %6.1f\n", row.name.c_str(), s.median, s.least, s.median / reference);
        }
    }

    // Stress only: contact forces of a snapshot onto cells, including the making of the search. Methods take turns.
    void stress_cost(const discrete::Snapshot &grains, const QuadMesh &mesh, const int repeats)
    {
      std::vector<Row> rows{{"segments, by triangles and checked", {}}};
      for (const NamedMethod &method : methods)
        rows.push_back({method.name, {}});
      double sum = 0; // Used, so that the compiler cannot remove the work.
      for (int repeat = 0; repeat < repeats; ++repeat)
        {
          double begin = cpu_seconds();
          sum += map_grains(mesh, grains).moment.total.trace();
          rows[0].seconds.push_back(cpu_seconds() - begin);
          for (std::size_t k = 0; k < methods.size(); ++k)
            {
              begin = cpu_seconds();
              const TargetCells target(mesh);
              sum += distribute(methods[k].options, target, moment_carriers(grains.position, grains.radius, grains.window_forces))
                       .uniform.sum();
              rows[k + 1].seconds.push_back(cpu_seconds() - begin);
            }
        }
      std::printf("%zu grains, %zu contacts, %zu cells: stress; median (least) of %d, ratio of medians to the first [%.0e]\n",
                  grains.position.size(), grains.window_forces.size(), mesh.cell.size(), repeats, sum);
      print(rows);
    }

    void fields_cost(const discrete::Snapshot &from, const discrete::Snapshot &to, const QuadMesh &mesh, const int repeats)
    {
      std::vector<Row> rows;
      for (const NamedMethod &method : methods)
        rows.push_back({method.name, {}});
      for (int repeat = 0; repeat < repeats; ++repeat)
        for (std::size_t k = 0; k < methods.size(); ++k)
          {
            const double begin = cpu_seconds();
            (void)grain_fields(mesh, from, to, methods[k].options);
            rows[k].seconds.push_back(cpu_seconds() - begin);
          }
      std::printf("%zu grains: all fields\n", to.position.size());
      print(rows);
    }
  } // namespace

  void cost(const std::string &samples)
  {
    const std::vector<discrete::Snapshot> snapshots = sheared_sample(samples);
    const discrete::Snapshot             &to        = snapshots.back();
    const double                          width     = to.outline.right.front().x() - to.outline.left.front().x();
    const double                          height    = to.upper_y - to.lower_y;
    const QuadMesh mesh = outline_mesh(to.outline, unsigned(width / 2 + 0.5), unsigned(height / 2 + 0.5)); // Cells of 2 d.
    stress_cost(to, mesh, 9);
    fields_cost(snapshots[snapshots.size() - 2], to, mesh, 5);

    const discrete::Snapshot sixteen = copies(to, 4);
    Eigen::Vector2d          lower = sixteen.position.front(), upper = lower;
    for (const Eigen::Vector2d &x : sixteen.position)
      lower = lower.cwiseMin(x), upper = upper.cwiseMax(x);
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(
      0.2); // Less than a radius: discs and contacts extend beyond the grid.
    stress_cost(sixteen, regular_grid(lower - margin, upper + margin, 2), 7);
  }
} // namespace diptych::benchmarks
