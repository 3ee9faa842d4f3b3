// diptych: state of the sample per cell, for refinement and checkpoints
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/cell_records.h"

#include <algorithm>

#include <deal.II/base/geometry_info.h>

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    // Values of the state of a point; those of a law from a library follow.
    constexpr unsigned int n_built_in = 2 * n_components + 11, n_fields = 3; // fields: displacement and LastMotion
    unsigned int           n_state(const BoundaryValueProblem &problem)
    {
      const auto *library = std::get_if<LibraryLaw>(&problem.law());
      return n_built_in + (library != nullptr ? unsigned(library->library().law->n_variables) : 0);
    }

    // The numbers that follow the stress.
    std::array<double *, n_built_in - 2 * n_components> numbers(MaterialState &s, HardeningState &hardening)
    {
      PlasticStrain &plastic = s.plastic_strain;
      return {&s.stress_zz,
              &hardening.nonlocal_plastic_strain,
              &s.equivalent_plastic_strain,
              &s.overstress,
              &plastic.xx,
              &plastic.yy,
              &plastic.zz,
              &plastic.xy,
              &s.dissipation,
              &hardening.stress_ratio_gain,
              &hardening.densification};
    }

    std::vector<double> packed(MaterialState s)
    {
      HardeningState      hardening = hardening_state(s);
      const Stress       &back      = part_of<KinematicState>(s).back_stress_ratio;
      const LibraryState &variables = part_of<LibraryState>(s);
      std::vector<double> values(&s.stress[0], &s.stress[0] + n_components);
      for (const double *number : numbers(s, hardening))
        values.push_back(*number);
      values.insert(values.end(), &back[0], &back[0] + n_components);
      values.insert(values.end(), variables.begin(), variables.end());
      return values;
    }

    MaterialState unpacked(const Law &law, const double *values, const unsigned int n)
    {
      MaterialState  s;
      HardeningState state;
      std::copy_n(values, n_components, &s.stress[0]);
      const double *next = values + n_components;
      for (double *number : numbers(s, state))
        *number = *next++;
      state.equivalent_plastic_strain = s.equivalent_plastic_strain;
      if (const Hardening *hardening = std::visit([](const auto &one) { return one.hardening(); }, law))
        hardening->write(state, s);
      if (auto *moving = std::get_if<KinematicState>(&s.own))
        std::copy_n(next, n_components, &moving->back_stress_ratio[0]);
      if (std::holds_alternative<GradientLaw>(law))
        s.own = NonlocalState{state.nonlocal_plastic_strain};
      if (std::holds_alternative<LibraryLaw>(law))
        s.own = LibraryState(values + n_built_in, values + n);
      return s;
    }

    double interpolated(const std::vector<double> &weights, const double *values, const std::size_t stride)
    {
      double sum = 0;
      for (std::size_t k = 0; k < weights.size(); ++k)
        sum += weights[k] * values[k * stride];
      return sum;
    }

    // Weights of the parent's values for each child's nodes and points: [child x node or point][parent's node or point].
    struct ChildWeights
    {
      std::vector<std::vector<double>> nodes, corners, points;

      explicit ChildWeights(const ReferenceElement &reference)
      {
        const unsigned int degree = reference.n_nodes == 9 ? 2 : 1;
        for (unsigned int child = 0; child < 4; ++child)
          {
            const auto in_parent = [&](const Point<2> &p) { return GeometryInfo<2>::child_to_cell_coordinates(p, child); };
            for (const auto &node : reference.nodes)
              {
                nodes.push_back(nodal_interpolation(degree, in_parent(node)));
                corners.push_back(nodal_interpolation(1, in_parent(node)));
              }
            for (const auto &point : reference.points)
              points.push_back(gauss_interpolation(degree, in_parent(point)));
          }
      }
    };

    // The polynomial through the parent's points is drawn towards its mean until no point of a child leaves the range of the
    // parent's points. This keeps the integral over the parent. Returns the share of the deviation that remains.
    double kept_deviation(const ChildWeights &children, const double mean, const double *values, const std::size_t stride)
    {
      double low = values[0], high = values[0], kept = 1;
      for (std::size_t k = 1; k < children.points[0].size(); ++k)
        {
          low  = std::min(low, values[k * stride]);
          high = std::max(high, values[k * stride]);
        }
      for (const auto &weights : children.points)
        {
          const double v = interpolated(weights, values, stride);
          if (v > high)
            kept = std::min(kept, (high - mean) / (v - mean));
          else if (v < low)
            kept = std::min(kept, (low - mean) / (v - mean));
        }
      return kept;
    }

    CellRecord child_record(const ReferenceElement &reference,
                            const ChildWeights     &children,
                            const CellRecord       &parent,
                            const unsigned int      child,
                            const unsigned int      n)
    {
      CellRecord record = parent;
      record[0] += 1;
      for (unsigned int field = 0; field < n_fields; ++field)
        {
          const std::size_t start = 1 + field * reference.n_dofs, rotations = start + 2 * reference.n_nodes;
          for (unsigned int node = 0; node < reference.n_nodes; ++node)
            for (unsigned int c = 0; c < 2; ++c)
              record[start + 2 * node + c] = interpolated(children.nodes[child * reference.n_nodes + node], &parent[start + c],
                                                          2);
          for (unsigned int corner = 0; corner < reference.n_rotations; ++corner)
            record[rotations + corner] = interpolated(children.corners[child * reference.n_nodes + corner], &parent[rotations],
                                                      1);
        }
      // Stress and the nonlocal hardening variable follow the polynomial; the hardening variable and the record of the past stay
      // within their range.
      const std::size_t states = 1 + n_fields * reference.n_dofs;
      for (unsigned int k = 0; k < n; ++k)
        {
          const double *values = &parent[states + k];
          const double  mean   = interpolated(reference.weights, values, n);
          const double  kept   = k <= n_components + 1 ? 1. : kept_deviation(children, mean, values, n);
          for (unsigned int q = 0; q < reference.n_points; ++q)
            record[states + q * n + k] = mean +
                                         kept * (interpolated(children.points[child * reference.n_points + q], values, n) - mean);
        }
      return record;
    }
  } // namespace

  std::size_t record_length(const BoundaryValueProblem &problem)
  {
    const ReferenceElement &reference = problem.discretisation().reference;
    return 1 + n_fields * reference.n_dofs + reference.n_points * n_state(problem);
  }

  std::vector<CellRecord> make_records(const BoundaryValueProblem &problem, const LastMotion &last)
  {
    const auto             &mesh = problem.discretisation();
    std::vector<CellRecord> records;
    for (const auto &active : mesh.dof_handler.active_cell_iterators())
      if (active->is_locally_owned())
        {
          const std::size_t c    = records.size();
          const auto       &cell = mesh.cells[c];
          CellRecord        record{double(active->level())};
          for (const auto *values : {&problem.committed().displacement, &last.increment, &last.curvature})
            for (unsigned int i = 0; i < mesh.reference.n_dofs; ++i)
              record.push_back((*values)[cell.local[i]]);
          for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
            {
              const auto values = packed(problem.committed().points[c * mesh.reference.n_points + q]);
              record.insert(record.end(), values.begin(), values.end());
            }
          records.push_back(std::move(record));
        }
    return records;
  }

  RestoredState read_records(const BoundaryValueProblem &problem, const std::vector<CellRecord> &records, const double progress)
  {
    const auto   &mesh = problem.discretisation();
    RestoredState restored;
    restored.state.progress = progress;
    restored.state.displacement.assign(mesh.relevant.n_elements(), 0.);
    restored.last.increment = restored.last.curvature = restored.state.displacement;
    const ChildWeights children(mesh.reference);
    const unsigned int n = n_state(problem);
    std::size_t        c = 0;
    for (const auto &active : mesh.dof_handler.active_cell_iterators())
      if (active->is_locally_owned())
        {
          CellRecord record = records[c];
          if (active->level() > int(record[0]))
            for (unsigned int child = 0; child < 4; ++child)
              if (active->parent()->child(child) == active)
                {
                  record = child_record(mesh.reference, children, records[c], child, n);
                  break;
                }
          for (unsigned int i = 0; i < mesh.reference.n_dofs; ++i)
            {
              restored.state.displacement[mesh.cells[c].local[i]] = record[1 + i];
              restored.last.increment[mesh.cells[c].local[i]]     = record[1 + mesh.reference.n_dofs + i];
              restored.last.curvature[mesh.cells[c].local[i]]     = record[1 + 2 * mesh.reference.n_dofs + i];
            }
          for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
            restored.state.points.push_back(unpacked(problem.law(), &record[1 + n_fields * mesh.reference.n_dofs + q * n], n));
          ++c;
        }
    restored.state.localisation.assign(restored.state.points.size(), {});
    restored.state.platen_force  = problem.committed().platen_force;
    restored.state.friction_work = problem.committed().friction_work;
    return restored;
  }
} // namespace diptych::continuum
