// diptych: state of the continuum panel for output, positive in compression
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/panel/sample_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/LU>

#include <deal.II/base/mpi.h>

#include "continuum/panel/law_variables.h"
#include "continuum/panel/point_values.h"
#include "continuum/snapshot_fields.h"

namespace diptych::continuum
{
  using dealii::Utilities::MPI::sum;

  namespace
  {
    Eigen::Matrix3d compression_positive(const PlasticStrain &e)
    {
      Eigen::Matrix3d m;
      m << e.xx, e.xy / 2, 0, e.xy / 2, e.yy, 0, 0, 0, e.zz;
      return -m;
    }

    constexpr double one_radian = 180 / dealii::numbers::PI; // [degrees]

    Eigen::Matrix2d jacobian(const Discretisation               &mesh,
                             const Cell                         &cell,
                             const unsigned int                  q,
                             const std::vector<Eigen::Vector2d> &x)
    {
      Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
      for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
        {
          const auto &g = mesh.reference.gradient[q][node];
          J += x[cell.nodes[node]] * Eigen::RowVector2d(g[0], g[1]);
        }
      return J;
    }

    struct Shape
    {
      std::vector<Eigen::Vector2d> before, now;
    };

    Shape shape_of(const BoundaryValueProblem &problem)
    {
      const auto &mesh = problem.discretisation();
      Shape       shape;
      shape.before = positions(mesh, std::vector<double>(problem.committed().displacement.size(), 0.));
      shape.now    = positions(mesh, problem.committed().displacement);
      return shape;
    }

    CellState cell_state(const BoundaryValueProblem &problem, const Shape &shape, const std::size_t c)
    {
      const auto      &mesh        = problem.discretisation();
      const Hardening *hardening   = std::visit([](const auto &law) { return law.hardening(); }, problem.law());
      const bool       is_cosserat = mesh.kind == ElementKind::q2_cosserat;
      CellState        state;
      for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
        {
          const std::size_t     i     = c * mesh.reference.n_points + q;
          const auto           &point = problem.committed().points[i];
          const auto           &place = problem.committed().localisation[i];
          const double          w     = problem.geometry().cells[c].points[q].area;
          const Eigen::Matrix2d F     = jacobian(mesh, mesh.cells[c], q, shape.now) *
                                    jacobian(mesh, mesh.cells[c], q, shape.before).inverse();
          state.strain.topLeftCorner<2, 2>() -= w * ((F + F.transpose()) / 2 - Eigen::Matrix2d::Identity());
          state.stress += w * compression_positive(point, is_cosserat);
          state.plastic_strain += w * compression_positive(point.plastic_strain);
          if (is_cosserat)
            state.couple_stress += w * Eigen::Vector2d(point.stress[curvature_x], point.stress[curvature_y]);
          state.equivalent_plastic_strain += w * point.equivalent_plastic_strain;
          state.nonlocal_plastic_strain += w * part_of<NonlocalState>(point).plastic_strain;
          state.dissipation += w * point.dissipation;
          state.overstress += w * point.overstress;
          state.share_zz_not_intermediate += w * zz_is_not_intermediate(point);
          if (hardening)
            {
              const HardeningState now = hardening_state(point);
              state.friction_angle += w * hardening->at(now).friction.value * one_radian;
              state.solid_fraction += w * hardening->solid_fraction(now);
            }
          state.area += w;
          if (place.determinant < state.acoustic_determinant)
            {
              state.acoustic_determinant = place.determinant;
              state.localisation_angle   = place.angle_deg;
            }
        }
      for (auto *tensor : {&state.stress, &state.strain, &state.plastic_strain})
        *tensor /= state.area;
      state.couple_stress /= state.area;
      for (auto *value :
           {&state.equivalent_plastic_strain, &state.dissipation, &state.overstress, &state.share_zz_not_intermediate,
            &state.friction_angle, &state.solid_fraction, &state.nonlocal_plastic_strain})
        *value /= state.area;
      return state;
    }

    // A node of a snapshot. The key identifies it on all processes by the ids of the two mesh nodes between which it lies. A
    // mesh node has its own id twice. A third number marks the centre of a four-node element.
    struct NodeEntry
    {
      std::array<double, 3> key;
      Eigen::Vector2d       position, displacement;
      double                rotation = 0, weight = 0;
      Eigen::Vector2d       platen_force = Eigen::Vector2d::Zero();
    };
    constexpr unsigned int entry_length = 11;

    void append(std::vector<double> &message, const NodeEntry &n)
    {
      message.insert(message.end(), {n.key[0], n.key[1], n.key[2], n.position.x(), n.position.y(), n.displacement.x(),
                                     n.displacement.y(), n.rotation, n.weight, n.platen_force.x(), n.platen_force.y()});
    }

    // Calls visit(number) for every number of a state, in the order of its fields.
    template <class AnyCell, class Visit> void each_number(AnyCell &state, const Visit &visit)
    {
      visit_cell_fields(state, [&](const char *, auto &field, const char *, const char *) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(field)>>)
          visit(field);
        else
          std::for_each(field.data(), field.data() + field.size(), visit);
      });
    }

    // Maps deal.II's order of FE_Q(2) to corners counter-clockwise, midpoints of the edges, centre.
    constexpr unsigned int vtk_order[9] = {0, 1, 3, 2, 6, 5, 7, 4, 8};
    // The corners between which each node of FE_Q(2) lies.
    constexpr unsigned int between[9][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {0, 2}, {1, 3}, {0, 1}, {2, 3}, {0, 3}};

    // The nine nodes of a cell in deal.II's order. Nodes that a four-node element lacks are interpolated.
    std::array<NodeEntry, 9> cell_nodes(const BoundaryValueProblem &problem,
                                        const Shape                &shape,
                                        const std::vector<double>  &platen_forces,
                                        const std::size_t           c)
    {
      const auto              &mesh  = problem.discretisation();
      const auto              &cell  = mesh.cells[c];
      const auto              &u     = problem.committed().displacement;
      const bool               is_q2 = mesh.reference.n_nodes == 9;
      std::array<NodeEntry, 9> result;
      const auto               corner_rotation = [&](const unsigned int k) {
        return mesh.reference.n_rotations > 0 ? u[cell.local[2 * mesh.reference.n_nodes + k]] : 0.;
      };
      for (unsigned int k = 0; k < 9; ++k)
        {
          const auto a = is_q2 ? cell.nodes[k] : cell.nodes[between[k][0]], b = is_q2 ? cell.nodes[k] : cell.nodes[between[k][1]];
          auto      &entry  = result[k];
          const double id_a = double(mesh.nodes[a].dofs[0]), id_b = double(mesh.nodes[b].dofs[0]);
          entry.key          = {std::min(id_a, id_b), std::max(id_a, id_b), !is_q2 && k == 8 ? 1. : 0.};
          entry.position     = (shape.now[a] + shape.now[b]) / 2;
          entry.displacement = entry.position - (shape.before[a] + shape.before[b]) / 2;
          entry.rotation     = (corner_rotation(between[k][0]) + corner_rotation(between[k][1])) / 2;
        }
      // The centre lies between all four.
      const auto mean = [&](const auto member) {
        return ((result[0].*member + result[1].*member + result[2].*member + result[3].*member) / 4.).eval();
      };
      result[8].rotation = (result[0].rotation + result[1].rotation + result[2].rotation + result[3].rotation) / 4;
      if (!is_q2)
        {
          result[8].position     = mean(&NodeEntry::position);
          result[8].displacement = mean(&NodeEntry::displacement);
        }
      for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
        result[node].platen_force = {platen_forces[cell.local[2 * node]], platen_forces[cell.local[2 * node + 1]]};
      for (unsigned int q = 0; q < mesh.reference.n_points; ++q)
        for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
          result[node].weight += problem.moved_geometry().cells[c].points[q].area * mesh.reference.shape[q][node];
      return result;
    }

    // Returns the end of the message.
    const double *add_cell(Snapshot                                      &snapshot,
                           std::map<std::array<double, 3>, unsigned int> &node_of_key,
                           const double                                  *message,
                           const bool                                     rotates)
    {
      std::array<unsigned int, 9> nodes;
      for (unsigned int k = 0; k < 9; ++k, message += entry_length)
        {
          const auto [entry, is_new] = node_of_key.try_emplace({message[0], message[1], message[2]}, snapshot.position.size());
          nodes[k]                   = entry->second;
          if (is_new)
            {
              snapshot.position.emplace_back(message[3], message[4]);
              snapshot.displacement.emplace_back(message[5], message[6]);
              snapshot.weight.push_back(0);
              snapshot.platen_force.emplace_back(message[9], message[10]);
              if (rotates)
                snapshot.rotation.push_back(message[7]);
            }
          snapshot.weight[nodes[k]] += message[8];
        }
      std::array<unsigned int, 9> ordered;
      for (unsigned int k = 0; k < 9; ++k)
        ordered[k] = nodes[vtk_order[k]];
      snapshot.cells.push_back(ordered);
      CellState &state = snapshot.cell_state.emplace_back();
      each_number(state, [&](double &number) { number = *message++; });
      for (LawVariable &variable : snapshot.variables)
        variable.of_cells.push_back(*message++);
      snapshot.mean_stress += state.area * state.stress;
      snapshot.area += state.area;
      return message;
    }

  } // namespace

  Progress progress_of(const BoundaryValueProblem &problem, const Loading &loading)
  {
    const Eigen::Vector2d travel = problem.platen_travel(true) / problem.discretisation().extent.y();
    Progress              now;
    now.progress     = problem.progress();
    now.axial_strain = -travel.y();
    now.shear_strain = travel.x();
    now.time         = problem.progress() * loading.time_per_progress;
    if (loading.loading_variable == LoadingVariable::axial_strain)
      now.axial_strain = now.progress; // the prescribed value has no round-off
    if (loading.loading_variable == LoadingVariable::shear_strain)
      now.shear_strain = now.progress;
    if (loading.loading_variable == LoadingVariable::time)
      now.time = now.progress;
    return now;
  }

  Snapshot make_snapshot(const BoundaryValueProblem &problem, const Loading &loading)
  {
    const auto         &mesh          = problem.discretisation();
    const Shape         shape         = shape_of(problem);
    const auto          platen_forces = problem.platen_node_forces();
    std::vector<double> mine;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        for (const auto &node : cell_nodes(problem, shape, platen_forces, c))
          append(mine, node);
        const CellState state = cell_state(problem, shape, c);
        each_number(state, [&](const double number) { mine.push_back(number); });
        const std::vector<double> variables = variables_of(problem, c);
        mine.insert(mine.end(), variables.begin(), variables.end());
      }
    Snapshot snapshot;
    snapshot.variables = described_variables(problem.law());
    set_progress(problem, loading, snapshot);
    std::map<std::array<double, 3>, unsigned int> node_of_key;
    for (const auto &part : gathered(mine, mesh.communicator()))
      for (const double *at = part.data(); at != part.data() + part.size();)
        at = add_cell(snapshot, node_of_key, at, mesh.kind == ElementKind::q2_cosserat);
    snapshot.mean_stress /= std::max(snapshot.area, 1e-300);
    snapshot.lower_platen_force = problem.platen_force(false);
    snapshot.upper_platen_force = problem.platen_force(true);
    return snapshot;
  }

} // namespace diptych::continuum
