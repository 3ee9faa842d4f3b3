// diptych: equilibrium of the sample: residual and consistent tangent on trial states
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/equilibrium/boundary_value_problem.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <type_traits>

#include "continuum/elements/element_kernels.h"
#include "continuum/equilibrium/initial_points.h"
#include "continuum/equilibrium/point_operations.h"
#include "continuum/laws/plastic_flow.h"
#include "continuum/equilibrium/loads.h"

namespace diptych::continuum
{
  using namespace dealii;

  namespace
  {
    struct Stopwatch
    {
      double      &seconds;
      std::clock_t start = std::clock();
      ~Stopwatch() { seconds += double(std::clock() - start) / CLOCKS_PER_SEC; }
    };

    ElementKind element_kind(const Options &options)
    {
      if (is_cosserat(options))
        return ElementKind::q2_cosserat;
      if (traits(options.law).is_gradient)
        return ElementKind::q2_gradient;
      return options.element == Displacement::q1_bbar ? ElementKind::q1_mean_dilation : ElementKind::q2;
    }

    // Elastic slip of one step under friction, in units of length.
    constexpr double stick_slip = 1e-6;

    bool same_nodes(const SideContact &a, const SideContact &b)
    {
      const auto same = [](const Node &m, const Node &n) { return m.dofs == n.dofs; };
      return std::equal(a[0].begin(), a[0].end(), b[0].begin(), b[0].end(), same) &&
             std::equal(a[1].begin(), a[1].end(), b[1].begin(), b[1].end(), same);
    }
  } // namespace

  BoundaryValueProblem::BoundaryValueProblem(const QuadMesh  &quads,
                                             const Units     &units,
                                             const Loading   &loading,
                                             const Options   &options,
                                             const MPI_Comm   communicator,
                                             const CheckStop &check_stop)
      : options(options),
        loading(loading),
        units(units),
        material(make_law(options.law, options.material, units)),
        mesh(quads, element_kind(options), communicator, check_stop)
  {
    call(check_stop);
    rebuild(check_stop);
    call(check_stop);
    area_at_start = Utilities::MPI::sum(current.area, mesh.communicator());
    set_at_rest(mesh, options, units, loading.pressure, state.points);
    start_variables(material, state.points);
    begin_step(0);
    (void)evaluate(zero_vector());
    reset_balance();
  }

  void BoundaryValueProblem::rebuild(const CheckStop &check_stop)
  {
    set_conditions({}, check_stop);
    call(check_stop);
    const std::size_t n_points = mesh.cells.size() * mesh.reference.n_points;
    trial.assign(n_points, {});
    increments.assign(n_points, Increment(Motion(), moves()));
    trial_increment.assign(mesh.relevant.n_elements(), 0.);
    internal = external = balanced_force = weight = state.displacement = trial_increment;
    state.points.assign(n_points, {});
    state.localisation.assign(n_points, {});
    flow.assign(n_points, 0.);
    unstable.assign(n_points, 0);
    current = geometry_at(mesh, positions(mesh, state.displacement));
    if (!moves())
      moved = current;
    if (loading.body_force.norm() > 0)
      add_body_force(mesh, current, loading.body_force, weight);
  }

  void BoundaryValueProblem::set_conditions(const SideContact &contact, const CheckStop &check_stop)
  {
    in_side_contact = contact;
    conditions      = std::make_unique<BoundaryConditions>(
      mesh, loading,
      PlatenGrip{options.platens == Platens::rough, options.platens == Platens::frictional && options.platen_friction > 0,
                 options.platen_rotation == PlatenRotation::held},
      contact);
    call(check_stop);
    tangent.reinit(mesh, conditions->correction(), check_stop);
    ++structure_version;
  }

  // Moves the shape to the committed displacement. Nodes of free sides that have reached the plane of a platen join it.
  void BoundaryValueProblem::move_nodes()
  {
    (moves() ? current : moved) = geometry_at(mesh, positions(mesh, state.displacement));
    if (!moves() ||
        !(std::holds_alternative<SidePressure>(loading.lateral) || std::holds_alternative<FreeSides>(loading.lateral)))
      return;
    const auto contact = side_contact(mesh, state.displacement, platen_planes());
    if (!same_nodes(contact, in_side_contact))
      set_conditions(contact);
  }

  void BoundaryValueProblem::adopt(CommittedState new_state)
  {
    state = std::move(new_state);
    move_nodes();
    begin_step(state.progress);
    (void)evaluate(zero_vector());
    reset_balance();
  }

  void BoundaryValueProblem::set_initial_solid_fraction(const std::vector<double> &solid_fraction)
  {
    set_solid_fraction(solid_fraction, mesh.reference.n_points, options.material, state.points);
  }

  void BoundaryValueProblem::set_initial_stress(const std::vector<Eigen::Matrix2d> &stress)
  {
    set_stress(stress, mesh.reference.n_points, state.points);
    start_variables(material, state.points);
    (void)evaluate(zero_vector());
    reset_balance();
  }

  std::array<PlatenPlane, 2> BoundaryValueProblem::platen_planes() const
  {
    std::array<PlatenPlane, 2> planes;
    for (const unsigned int platen : {0u, 1u})
      {
        const double initial = conditions->platens()[platen].front().initial.y();
        planes[platen]       = {initial, initial + platen_travel(platen).y()};
      }
    return planes;
  }

  Eigen::Vector2d BoundaryValueProblem::platen_travel(const bool upper) const
  {
    const Node     &node = conditions->platens()[upper].front();
    Eigen::Vector2d travel;
    for (unsigned int c = 0; c < 2; ++c)
      {
        const bool mine = mesh.owned.is_element(node.dofs[c]);
        travel[c]       = Utilities::MPI::sum(mine ? state.displacement[mesh.relevant.index_within_set(node.dofs[c])] : 0.,
                                        mesh.communicator());
      }
    return travel;
  }

  // On rigid walls and with a free period the pressure acts through the ties of the nodes, so nodes on a platen get none.
  double BoundaryValueProblem::side_pressure() const
  {
    if (!sides_carry_pressure(loading.lateral))
      return 0;
    return loading.side_pressure ? loading.side_pressure(step_end) : loading.pressure;
  }

  std::vector<double> BoundaryValueProblem::trial_displacement() const
  {
    std::vector<double> sum = state.displacement;
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += trial_increment[i];
    return sum;
  }

  // Side pressure acts along the sides of the shape for equilibrium.
  void BoundaryValueProblem::find_loads()
  {
    external = weight;
    add_side_pressure(mesh, positions(mesh, moves() ? trial_displacement() : std::vector<double>(weight.size(), 0.)),
                      side_pressure(), external);
    for (std::size_t i = 0; i < external.size(); ++i)
      external[i] = step_share * external[i] + (1 - step_share) * balanced_force[i];
  }

  void BoundaryValueProblem::begin_step(const double to, const double share)
  {
    step_end   = to;
    step_share = share;
    if (!moves())
      find_loads(); // they stay those of the initial shape
    step_constraints.clear();
    step_constraints.copy_from(conditions->increment(state.progress, to));
    friction.begin_step({options.platen_friction, options.platen_slip_length * units.length, stick_slip * units.length},
                        conditions->sliding_nodes(), state.progress, to);
    applied = zero_vector();
    for (const auto &[dof, force] : conditions->applied_forces(to))
      if (mesh.owned.is_element(dof))
        applied[dof] += share * force;
    applied.compress(VectorOperation::add);
  }

  void BoundaryValueProblem::impose(DistributedVector &increment) const
  {
    step_constraints.distribute(increment);
  }

  template <class L, class Element> void BoundaryValueProblem::update_points(const L &law, Element, std::vector<double> &force)
  {
    const double d_time = step_end - state.progress;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        const auto             u = gather<Element>(mesh.cells[c], trial_increment);
        ElementVector<Element> f{};
        for (unsigned int q = 0; q < Element::n_points; ++q)
          {
            const std::size_t point = c * Element::n_points + q;
            const Increment  &step = increments[point] = Increment(motion_at<Element>(mesh.reference, current.cells[c], q, u),
                                                                   moves(), Element::is_gradient);
            trial[point]                               = law.update(state.points[point], step.strain(), d_time);
            add_force<Element>(mesh.reference, current.cells[c], q, step.force(trial[point].state.stress), f);
          }
        scatter<Element>(mesh.cells[c], f, force);
      }
  }

  void BoundaryValueProblem::reset_balance()
  {
    balanced_force = internal;
  }

  Imbalance BoundaryValueProblem::evaluate(const DistributedVector &increment)
  {
    const Stopwatch watch{phase.points};
    trial_increment = relevant_values(increment);
    internal.assign(trial_increment.size(), 0.);
    std::visit(
      [&](const auto &law) { with_element(mesh.kind, [&](const auto chosen) { update_points(law, chosen, internal); }); },
      material);
    if (moves())
      find_loads();

    auto force = internal;
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] -= external[i];
    nodal_force = assembled(mesh, force);
    if (!conditions->sliding_nodes().empty())
      friction.add_force(mesh, trial_increment, relevant_values(nodal_force), force);
    condense(mesh, conditions->correction(), force);
    rhs = assembled(mesh, force);
    rhs -= applied;
    rhs *= -1;

    Imbalance imbalance;
    imbalance.residual = rhs.l2_norm();
    imbalance.scale    = platen_scale();
    for (const auto &point : trial)
      imbalance.n_failed += point.verdict == Verdict::failed;
    for (const auto &increment : increments)
      imbalance.n_inverted += increment.is_inverted();
    imbalance.n_failed   = Utilities::MPI::sum(imbalance.n_failed, mesh.communicator());
    imbalance.n_inverted = Utilities::MPI::sum(imbalance.n_inverted, mesh.communicator());
    return imbalance;
  }

  // A point at the apex has hardly any stiffness, and a patch of such points would make the matrix singular. Adding a
  // thousandth of the elastic tangent changes the iterations, but not their limit.
  PiolaTangent BoundaryValueProblem::point_tangent(const std::size_t point) const
  {
    const MaterialUpdate &update = trial[point];
    if (update.regime != Regime::apex)
      return increments[point].tangent(update.state.stress, update.tangent);
    const Tangent elastic = std::visit([](const auto &law) { return law.elastic_tangent(); }, material);
    return increments[point].tangent(update.state.stress, update.tangent + 1e-3 * elastic);
  }

  DistributedVector BoundaryValueProblem::linearised_residual(const DistributedVector &increment)
  {
    (void)evaluate(zero_vector());
    const auto          values = relevant_values(increment);
    std::vector<double> force(external.size(), 0.);
    with_element(mesh.kind, [&](const auto chosen) {
      using Element = std::decay_t<decltype(chosen)>;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          const auto             u = gather<Element>(mesh.cells[c], values);
          ElementVector<Element> f{};
          for (unsigned int q = 0; q < Element::n_points; ++q)
            {
              const auto motion = motion_at<Element>(mesh.reference, current.cells[c], q, u);
              add_force<Element>(mesh.reference, current.cells[c], q,
                                 PiolaStress(point_tangent(c * Element::n_points + q) * motion), f);
            }
          scatter<Element>(mesh.cells[c], f, force);
        }
    });
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] += internal[i] - external[i];
    if (!conditions->sliding_nodes().empty())
      friction.stick(mesh, relevant_values(nodal_force));
    friction.add_resistance(values, force);
    condense(mesh, conditions->correction(), force);
    auto result = assembled(mesh, force);
    result -= applied;
    result *= -1;
    return result;
  }

  const TrilinosWrappers::SparseMatrix &BoundaryValueProblem::assemble_tangent(const double caution)
  {
    const Stopwatch watch{phase.assembly};
    const double    pressure = moves() ? step_share * side_pressure() : 0;
    tangent.clear();
    with_element(mesh.kind, [&](const auto chosen) {
      using Element = std::decay_t<decltype(chosen)>;
      auto edge     = mesh.edges.begin();
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          ElementMatrix<Element> K{};
          for (unsigned int q = 0; q < Element::n_points; ++q)
            add_stiffness<Element>(mesh.reference, current.cells[c], q, point_tangent(c * Element::n_points + q), K);
          for (; edge != mesh.edges.end() && edge->cell == c; ++edge)
            add_side_stiffness(*edge, Element::n_nodes > 4, -pressure, row_length<Element>, K.data());
          friction.add_to<Element>(K, mesh.cells[c]);
          tangent.add<Element>(c, K);
        }
    });
    for (const auto &one : friction.stiffness())
      tangent.add(one.dof, one.tangent + caution * (one.secant - one.tangent));
    tangent.finish();
    return tangent.matrix();
  }

  bool BoundaryValueProblem::is_folded() const
  {
    return Utilities::MPI::max(int(!geometry_at(mesh, positions(mesh, trial_displacement())).is_regular), mesh.communicator()) ==
           1;
  }

  void BoundaryValueProblem::commit()
  {
    const Stopwatch watch{phase.geometry};
    const Tangent   elastic     = std::visit([](const auto &law) { return law.elastic_tangent(); }, material);
    const auto      moduli      = std::visit([](const auto &law) { return law.moduli(); }, material);
    const bool      is_gradient = mesh.kind == ElementKind::q2_gradient;
    unstable.assign(trial.size(), 0);
    for (std::size_t point = 0; point < trial.size(); ++point)
      {
        MaterialState next       = trial[point].state;
        const bool    is_elastic = trial[point].regime == Regime::elastic;
        if (!is_elastic)
          {
            const Strain &d_strain = increments[point].strain();
            add_plastic_flow(moduli, state.points[point], d_strain, next);
            unstable[point] = weakens_contracting(moduli, state.points[point], d_strain, next);
          }
        const Tangent &D          = trial[point].tangent;
        state.localisation[point] = is_elastic ? Localisation() : localisation(is_gradient ? uniform_tangent(D) : D, elastic);
        flow[point]               = next.equivalent_plastic_strain - state.points[point].equivalent_plastic_strain;
        if (moves())
          turn(next, increments[point].angle(), material, is_gradient);
        state.points[point] = next;
      }
    state.displacement = trial_displacement();
    state.progress     = step_end;
    state.platen_force = {trial_platen_force(false), trial_platen_force(true)};
    state.friction_work += Utilities::MPI::sum(friction.work(), mesh.communicator());
    move_nodes();
  }

  Eigen::Vector2d BoundaryValueProblem::trial_platen_force(const bool upper) const
  {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    for (const auto &node : conditions->platens()[upper])
      for (unsigned int c = 0; c < 2; ++c)
        if (mesh.owned.is_element(node.dofs[c]))
          force[c] += nodal_force[node.dofs[c]];
    for (unsigned int c = 0; c < 2; ++c)
      force[c] = Utilities::MPI::sum(force[c], mesh.communicator());
    return force;
  }

  // If nothing is loaded yet, the scale is a billionth of the elastic modulus times the width of the sample.
  double BoundaryValueProblem::platen_scale() const
  {
    double sum = 0;
    for (const auto &platen : conditions->platens())
      for (const auto &node : platen)
        for (unsigned int c = 0; c < 2; ++c)
          if (mesh.owned.is_element(node.dofs[c]))
            sum += nodal_force[node.dofs[c]] * nodal_force[node.dofs[c]];
    const double floor = 1e-9 * options.material.elastic.youngs_modulus * units.stress * mesh.extent.x();
    return std::max(floor, std::sqrt(Utilities::MPI::sum(sum, mesh.communicator())));
  }
} // namespace diptych::continuum
