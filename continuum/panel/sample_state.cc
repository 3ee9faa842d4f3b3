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
#include "continuum/snapshot_fields.h"

namespace diptych::continuum
{
  using dealii::Utilities::MPI::sum;

  namespace
  {
    // Row: component of the force; column: normal of the face. A Cosserat stress has a skew part.
    Eigen::Matrix3d compression_positive(const MaterialState &point, const bool is_cosserat)
    {
      const auto     &s    = point.stress;
      const double    skew = is_cosserat ? s[relative_rotation] : 0;
      Eigen::Matrix3d m;
      m << s[xx], s[xy] - skew, 0, s[xy] + skew, s[yy], 0, 0, 0, point.stress_zz;
      return -m;
    }

    Eigen::Matrix3d compression_positive(const PlasticStrain &e)
    {
      Eigen::Matrix3d m;
      m << e.xx, e.xy / 2, 0, e.xy / 2, e.yy, 0, 0, 0, e.zz;
      return -m;
    }

    double shear_radius(const Stress &s)
    {
      return std::hypot((s[xx] - s[yy]) / 2, s[xy]);
    }

    constexpr double one_radian = 180 / dealii::numbers::PI; // [degrees]

    bool zz_is_not_intermediate(const MaterialState &point)
    {
      const double mean = (point.stress[xx] + point.stress[yy]) / 2;
      return std::abs(point.stress_zz - mean) >
             shear_radius(point.stress) * (1 + 1e-9) + 1e-6 * std::abs(mean); // equal stresses differ by round-off
    }

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
              state.friction_angle += w * hardening->at(now).friction * one_radian;
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

    double stress_ratio(const Eigen::Matrix3d &stress)
    {
      const double s = (stress(0, 0) + stress(1, 1)) / 2;
      return std::hypot((stress(0, 0) - stress(1, 1)) / 2, (stress(0, 1) + stress(1, 0)) / 2) / s;
    }

    void sum_up(Eigen::Matrix3d &matrix, const MPI_Comm communicator)
    {
      for (int k = 0; k < 9; ++k)
        matrix.data()[k] = sum(matrix.data()[k], communicator);
    }

    // On the shape that is in equilibrium.
    double platen_sxx(const BoundaryValueProblem &problem)
    {
      const auto &mesh     = problem.discretisation();
      const Shape shape    = shape_of(problem);
      const auto &position = &problem.geometry() == &problem.moved_geometry() ? shape.now : shape.before;
      const auto  forces   = problem.platen_node_forces();
      double      moment   = 0;
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        if (const auto dof = mesh.nodes[i].dofs[0]; mesh.owned.is_element(dof))
          moment -= position[i].x() * forces[mesh.relevant.index_within_set(dof)];
      return sum(moment, mesh.communicator()) / sum(problem.geometry().area, mesh.communicator());
    }

    template <class Target> void set_progress(const BoundaryValueProblem &problem, const Loading &loading, Target &target)
    {
      const Progress now      = progress_of(problem, loading);
      target.progress         = now.progress;
      target.axial_strain     = now.axial_strain;
      target.shear_strain     = now.shear_strain;
      target.time             = now.time;
      target.loading_variable = loading.loading_variable;
    }

    void add_point_sums(const BoundaryValueProblem &problem, HistoryRow &row)
    {
      const auto  &mesh     = problem.discretisation();
      const auto  &state    = problem.committed();
      const auto  &geometry = problem.geometry();
      const auto   position = positions(mesh, state.displacement);
      const double bottom   = mesh.origin.y() + problem.platen_travel(false).y(),
                   height   = mesh.origin.y() + mesh.extent.y() + problem.platen_travel(true).y() - bottom;
      double area = 0, core_area = 0, yielding = 0, unreliable = 0, not_intermediate = 0, viscous = 0, dissipation = 0,
             largest = 0, unstable = 0;
      for (std::size_t i = 0; i < state.points.size(); ++i)
        {
          const auto  &point = state.points[i];
          const auto   cell = i / mesh.reference.n_points, q = i % mesh.reference.n_points;
          const double w      = geometry.cells[cell].points[q].area;
          const auto   stress = compression_positive(point, mesh.kind == ElementKind::q2_cosserat);
          double       y      = -bottom;
          for (unsigned int node = 0; node < mesh.reference.n_nodes; ++node)
            y += mesh.reference.shape[q][node] * position[mesh.cells[cell].nodes[node]].y();
          area += w;
          row.mean_stress += w * stress;
          if (std::abs(y - 0.5 * height) < 0.25 * height)
            {
              core_area += w;
              row.core_stress += w * stress;
            }
          not_intermediate += w * zz_is_not_intermediate(point);
          dissipation += w * point.dissipation;
          largest = std::max(largest, point.equivalent_plastic_strain);
          unreliable += w * (problem.last_update()[i].verdict == Verdict::unreliable);
          if (problem.last_update()[i].regime == Regime::elastic)
            continue;
          yielding += w;
          unstable += w * problem.last_instability()[i];
          const double strength = std::visit([&](const auto &law) { return law.shear_strength(point); }, problem.law());
          viscous += strength > 0 ? w * point.overstress / strength : 0;
        }
      area = sum(area, mesh.communicator());
      sum_up(row.mean_stress, mesh.communicator());
      sum_up(row.core_stress, mesh.communicator());
      row.core_stress = (row.core_stress + row.core_stress.transpose()).eval() / 2 /
                        std::max(sum(core_area, mesh.communicator()), 1e-300);
      row.mean_stress /= area;
      yielding                          = sum(yielding, mesh.communicator());
      row.plastic_share                 = yielding / area;
      row.viscous_share                 = sum(viscous, mesh.communicator()) / std::max(yielding, 1e-300);
      row.unstable_share                = sum(unstable, mesh.communicator()) / area;
      row.unreliable_share              = sum(unreliable, mesh.communicator()) / area;
      row.share_zz_not_intermediate     = sum(not_intermediate, mesh.communicator()) / area;
      row.dissipation                   = sum(dissipation, mesh.communicator());
      row.max_equivalent_plastic_strain = dealii::Utilities::MPI::max(largest, mesh.communicator());
      const double moved_area           = sum(problem.moved_geometry().area, mesh.communicator());
      row.volumetric_strain             = 1 - moved_area / problem.initial_area();
      row.width                         = moved_area / height;
    }

    void add_localisation(const BoundaryValueProblem &problem, HistoryRow &row)
    {
      Localisation least;
      for (const auto &place : problem.committed().localisation)
        if (place.determinant < least.determinant)
          least = place;
      for (const auto &other : dealii::Utilities::MPI::all_gather(problem.discretisation().communicator(),
                                                                  std::vector<double>{least.determinant, least.angle_deg}))
        if (other[0] < row.least_acoustic_determinant)
          {
            row.least_acoustic_determinant = other[0];
            row.localisation_angle         = other[1];
          }
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

  HistoryRow make_history_row(const BoundaryValueProblem &problem, const LoadDriver &driver, const Loading &loading)
  {
    const auto &mesh  = problem.discretisation();
    const auto &count = driver.state().count;
    HistoryRow  row;
    row.step = count.steps;
    set_progress(problem, loading, row);
    add_point_sums(problem, row);
    add_localisation(problem, row);
    row.stress_ratio       = stress_ratio(row.mean_stress);
    row.lower_platen_force = problem.platen_force(false);
    row.upper_platen_force = problem.platen_force(true);
    row.platen_sxx         = platen_sxx(problem);
    row.friction_work      = problem.committed().friction_work;
    row.n_cells            = int(mesh.triangulation.n_global_active_cells());
    row.n_unknowns         = int(mesh.dof_handler.n_dofs());
    row.newton_iterations  = count.newton_iterations;
    row.linear_iterations  = driver.linear_solver().linear_iterations();
    row.factorisations     = driver.linear_solver().factorisations();
    row.cut_backs          = count.cut_backs;
    row.point_cpu_s        = problem.seconds().points;
    row.assembly_cpu_s     = problem.seconds().assembly;
    row.geometry_cpu_s     = problem.seconds().geometry;
    row.solve_cpu_s        = driver.linear_solver().cpu_s();
    return row;
  }
} // namespace diptych::continuum
