// diptych: the grains' fields on cells between two stages, all by the same averaging
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "coupling/fields/grain_kinematics.h"
#include "coupling/averaging/periodic.h"

namespace diptych::coupling
{
  namespace
  {
    // Columns of Carriers::of_grains. The components of a vector or symmetric tensor follow in the next columns.
    namespace grain
    {
      enum : Eigen::Index
      {
        count,
        mass,
        momentum, // x, y
        fluctuating_mass = momentum + 2,
        fluctuation,
        disc_area,
        weight,       // disc area of grains that are not rattlers; weight of the two following fields
        displacement, // x, y
        rotation = displacement + 2,
        contacts,
        moment, // xx, xy, yy
        moment_square = moment + 3,
        pressure_square,
        spin_term,
        n_columns
      };
    }
    namespace half
    {
      enum : Eigen::Index
      {
        moments, // of moment_carriers()
        dissipation = moments + n_moment_columns,
        bearing,
        fabric, // xx, xy, yy of n (x) n
        n_columns = fabric + 3
      };
    }

    bool bears(const discrete::ContactForce &contact)
    {
      return !contact.force.isZero(0);
    }

    Columns grain_columns(const TargetCells               &target,
                          const discrete::Snapshot        &from,
                          const discrete::Snapshot        &to,
                          const std::vector<unsigned int> &n_contacts)
    {
      const std::vector<double> energy = fluctuation_energy(target, to);
      const DisplacementField   field  = displacement_field(from, to);
      Columns                   q      = Columns::Zero(Eigen::Index(to.position.size()), grain::n_columns);
      for (Eigen::Index i = 0; i < q.rows(); ++i)
        {
          auto                   row      = q.row(i);
          const Eigen::Matrix2d &m        = to.mean_internal_moment[i];
          row[grain::count]               = 1;
          row[grain::mass]                = to.mass[i];
          row.segment<2>(grain::momentum) = to.mass[i] * to.velocity[i].transpose();
          if (!std::isnan(energy[i]))
            {
              row[grain::fluctuating_mass] = to.mass[i];
              row[grain::fluctuation]      = to.mass[i] * energy[i];
            }
          row[grain::disc_area]               = M_PI * to.radius[i] * to.radius[i];
          row[grain::weight]                  = field.weight[i];
          row.segment<2>(grain::displacement) = field.weight[i] * field.increment[i].transpose();
          row[grain::rotation]                = field.weight[i] * (to.rotation[i] - from.rotation[i]);
          row[grain::contacts]                = n_contacts[i];
          row.segment<3>(grain::moment)       = Eigen::RowVector3d(m(0, 0), m(0, 1), m(1, 1));
          row[grain::moment_square]           = m.squaredNorm();
          row[grain::pressure_square]         = 0.25 * m.trace() * m.trace();
          row[grain::spin_term]               = to.mean_spin_term[i];
        }
      return q;
    }

    // Adds half branches of the window's forces with moment and dissipation. Then adds those of the contacts that carry force in
    // the last step, with their fabric.
    void add_halves(const discrete::Snapshot &s, std::vector<unsigned int> &n_contacts, Carriers &c)
    {
      const int  n_grains        = int(s.position.size());
      const bool has_dissipation = s.window_dissipation.size() == s.window_forces.size();
      using UniformRow           = Eigen::Matrix<double, 1, half::n_columns>;
      std::vector<UniformRow, Eigen::aligned_allocator<UniformRow>> uniform;
      std::vector<Eigen::RowVector2d>                               tapered;
      for (std::size_t k = 0; k < s.window_forces.size(); ++k)
        {
          const discrete::ContactForce &contact = s.window_forces[k];
          const double                  share   = contact.j < n_grains ? 0.5 : 1;
          for_each_half(contact, s.position,
                        [&](const unsigned int i, const Eigen::Vector2d &l, const Eigen::Vector2d &f, const double m) {
                          UniformRow row                               = UniformRow::Zero();
                          row.segment<n_moment_columns>(half::moments) = uniform_moments(l, f, m);
                          row[half::dissipation]                       = has_dissipation ? share * s.window_dissipation[k] : 0;
                          uniform.push_back(row);
                          tapered.push_back(tapered_couple(l, f));
                          c.half.push_back({i, l});
                          c.half_size.push_back(f.norm() * l.norm());
                        });
        }
      for (const discrete::ContactForce &contact : s.contacts)
        if (bears(contact))
          for_each_half(contact, s.position,
                        [&](const unsigned int i, const Eigen::Vector2d &l, const Eigen::Vector2d &, double) {
                          const Eigen::Vector2d &n     = contact.normal;
                          UniformRow             row   = UniformRow::Zero();
                          row[half::bearing]           = 1;
                          row.segment<3>(half::fabric) = Eigen::RowVector3d(n.x() * n.x(), n.x() * n.y(), n.y() * n.y());
                          uniform.push_back(row);
                          tapered.push_back(Eigen::RowVector2d::Zero());
                          c.half.push_back({i, l});
                          c.half_size.push_back(0);
                          ++n_contacts[i];
                        });
      c.uniform.resize(Eigen::Index(uniform.size()), half::n_columns);
      c.tapered.resize(Eigen::Index(tapered.size()), 2);
      for (std::size_t h = 0; h < uniform.size(); ++h)
        {
          c.uniform.row(Eigen::Index(h)) = uniform[h];
          c.tapered.row(Eigen::Index(h)) = tapered[h];
        }
    }

    Carriers carriers_of(const TargetCells &target, const discrete::Snapshot &from, const discrete::Snapshot &to)
    {
      Carriers                  c;
      std::vector<unsigned int> n_contacts(to.position.size(), 0);
      c.position      = to.position;
      c.radius        = to.radius;
      c.mean_diameter = to.mean_diameter;
      add_halves(to, n_contacts, c);
      c.count_joined = true;
      c.of_grains    = grain_columns(target, from, to, n_contacts);
      return c;
    }

    Eigen::Matrix2d symmetric(const double xx, const double xy, const double yy)
    {
      Eigen::Matrix2d m;
      m << xx, xy, xy, yy;
      return m;
    }

    void take_stress(const CellSums &sums, const std::vector<double> &area, GrainFields &fields)
    {
      for (std::size_t k = 0; k < area.size(); ++k)
        {
          const auto      h = sums.uniform.row(Eigen::Index(k)), g = sums.of_grains.row(Eigen::Index(k));
          Eigen::Matrix2d contact_stress;
          contact_stress << h[half::moments], h[half::moments + 1], h[half::moments + 2], h[half::moments + 3];
          contact_stress /= area[k];
          fields.contact_stress.push_back(contact_stress);
          fields.stress.push_back(contact_stress - g[grain::spin_term] / area[k] * Eigen::Matrix2d::Identity());
          fields.couple_stress.push_back(
            (sums.tapered.row(Eigen::Index(k)) + h.segment<2>(half::moments + couple_moment)).transpose() / area[k]);
          fields.dissipation.push_back(h[half::dissipation] / area[k]);

          const double          n = g[grain::count], density = n / area[k];
          const Eigen::Matrix2d mean     = symmetric(g[grain::moment], g[grain::moment + 1], g[grain::moment + 2]) / n;
          const double          pressure = 0.5 * mean.trace(), joined = sums.joined[k];
          const auto            error = [&](const double variance) {
            return joined > 1 ? density * std::sqrt(std::max(0., variance) / (joined - 1)) : NAN;
          };
          fields.standard_error.push_back(error(g[grain::pressure_square] / n - pressure * pressure));
          fields.stress_standard_error.push_back(error(g[grain::moment_square] / n - mean.squaredNorm()));
        }
    }

    void take_means(const CellSums &sums, const std::vector<double> &area, GrainFields &fields)
    {
      const auto over = [](const double sum, const double weight) { return weight > 0 ? sum / weight : NAN; };
      for (std::size_t k = 0; k < area.size(); ++k)
        {
          const auto            h = sums.uniform.row(Eigen::Index(k)), g = sums.of_grains.row(Eigen::Index(k));
          const Eigen::Vector2d momentum = g.segment<2>(grain::momentum), displacement = g.segment<2>(grain::displacement);
          fields.velocity.push_back(momentum * over(1, g[grain::mass]));
          fields.granular_temperature.push_back(over(g[grain::fluctuation], g[grain::fluctuating_mass]));
          fields.displacement_increment.push_back(displacement * over(1, g[grain::weight]));
          fields.rotation_increment.push_back(over(g[grain::rotation], g[grain::weight]));
          fields.coordination_number.push_back(over(g[grain::contacts], g[grain::count]));
          fields.fabric.push_back(symmetric(h[half::fabric], h[half::fabric + 1], h[half::fabric + 2]) *
                                  over(1, h[half::bearing]));
          fields.solid_fraction.push_back(g[grain::disc_area] / area[k]);
          fields.grain_count.push_back(g[grain::count]);
        }
    }

    void take_gradients(const TargetCells        &target,
                        const discrete::Snapshot &from,
                        const discrete::Snapshot &to,
                        GrainFields              &fields)
    {
      const double radius = strain_radius(to.mean_diameter);
      LocalMotion  moved = local_motion(periodic_displacement_field(target, from, to, radius), cell_centres(target.mesh), radius);
      fields.displacement_gradient  = std::move(moved.gradient);
      fields.shear_strain_increment = std::move(moved.shear);
      fields.spin_increment         = std::move(moved.spin);
      fields.relative_rotation      = std::move(moved.relative_rotation);
    }

    double relative_error(const discrete::Snapshot &s, const std::vector<double> &area, const GrainFields &fields)
    {
      Eigen::Matrix2d expected = Eigen::Matrix2d::Zero(), sum = expected;
      for (const Eigen::Matrix2d &moment : s.mean_internal_moment)
        expected += moment;
      for (std::size_t k = 0; k < area.size(); ++k)
        sum += 0.5 * area[k] * (fields.stress[k] + fields.stress[k].transpose());
      return (sum - expected).norm() / std::max(expected.norm(), std::numeric_limits<double>::min());
    }

    void set_nan(double &value)
    {
      value = NAN;
    }

    template <class Tensor> void set_nan(Tensor &value)
    {
      value.setConstant(NAN);
    }

    template <class... Field> void hide(const std::vector<std::uint8_t> &covered, Field &...field)
    {
      for (std::size_t k = 0; k < covered.size(); ++k)
        if (!covered[k])
          (set_nan(field[k]), ...);
    }
  } // namespace

  GrainFields grain_fields(const QuadMesh           &mesh,
                           const discrete::Snapshot &from,
                           const discrete::Snapshot &to,
                           const AveragingOptions   &options,
                           const bool                judge_nodes)
  {
    if (from.rotation.size() != to.rotation.size() || to.mean_internal_moment.size() != to.position.size() ||
        to.mean_spin_term.size() != to.position.size())
      throw std::invalid_argument("fields between two stages need snapshots of the same grains, with their moments");
    const TargetCells target(mesh, period_of(to));
    Carriers          carriers = carriers_of(target, from, to);
    carriers.judge_nodes       = judge_nodes;
    const CellSums sums        = distribute(options, target, carriers);

    GrainFields f;
    take_stress(sums, target.area, f);
    take_means(sums, target.area, f);
    take_gradients(target, from, to, f);
    f.outside_share        = sums.outside_share;
    f.nodal_residual       = sums.nodal_residual;
    f.couple_residual      = sums.couple_residual;
    f.total_relative_error = relative_error(to, target.area, f);
    if (to.window_dissipation.size() != to.window_forces.size())
      f.dissipation.assign(f.dissipation.size(), NAN);
    f.covered = grain_cover(mesh, to).covered;
    hide(f.covered, f.stress, f.contact_stress, f.couple_stress, f.dissipation, f.velocity, f.granular_temperature,
         f.displacement_increment, f.displacement_gradient, f.shear_strain_increment, f.rotation_increment, f.spin_increment,
         f.relative_rotation, f.coordination_number, f.fabric, f.standard_error, f.stress_standard_error);
    return f;
  }
} // namespace diptych::coupling
