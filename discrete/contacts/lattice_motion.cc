// diptych: motion of a lattice under its drive and the impulses of contacts
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/lattice_motion.h"

namespace diptych::discrete
{
  namespace
  {
    // Isotropic response of (sxx, syy, sxy) to (exx, eyy, 2 exy) with a Poisson's ratio of 0.2.
    const Eigen::Matrix3d isotropic = (Eigen::Matrix3d() << 8. / 3, 2. / 3, 0, 2. / 3, 8. / 3, 0, 0, 0, 1).finished();

    Eigen::Vector3d components(const Eigen::Matrix2d &m)
    {
      return {m(0, 0), m(1, 1), 0.5 * (m(0, 1) + m(1, 0))};
    }
  } // namespace

  Eigen::Matrix3d lattice_inertia(const Grains &grains)
  {
    double sum = 0; // of mass x diameter^2
    for (std::size_t i = 0; i < grains.size(); ++i)
      sum += 4 * grains.mass[i] * grains.radius[i] * grains.radius[i];
    return 0.6 * sum * isotropic;
  }

  LatticeMotion lattice_motion(const Lattice &lattice, const double time, const double step)
  {
    const LatticeDrive &drive = lattice.drive;
    Eigen::Matrix3d     rows = drive.form, of_moment = Eigen::Matrix3d::Zero();
    Eigen::Vector3d     right;
    for (int k = 0; k < 3; ++k)
      {
        const auto at = [&](const double share) { return drive.values.at(time + share * step)[k]; };
        if (drive.is_stress[k])
          {
            rows.row(k)      = drive.form.row(k) * drive.inertia;
            of_moment.row(k) = drive.form.row(k);
            right[k]         = step * lattice.area() * at(0.5) + rows.row(k).dot(lattice.rate);
          }
        else // removes at the next mid-step the deviation of this one
          right[k] = (at(1) - at(0) + at(0.5) - drive.form.row(k).dot(lattice.strain)) / step;
      }
    const Eigen::Matrix3d inverse = rows.inverse();
    return {inverse * right, inverse * of_moment};
  }

  Eigen::Vector3d start_rate(const LatticeDrive &drive)
  {
    Eigen::Matrix3d rows  = drive.form;
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k)
      if (drive.is_stress[k])
        rows.row(k) *= isotropic;
      else
        right[k] = (drive.values.value[1][k] - drive.values.value[0][k]) / drive.values.time[1];
    return rows.inverse() * right;
  }

  void add_gradient(const std::vector<Eigen::Vector2d> &place, const Eigen::Matrix2d &gradient, std::vector<BodyVelocity> &v)
  {
    for (std::size_t b = 0; b < place.size(); ++b)
      {
        v[b].x += gradient(0, 0) * place[b].x() + gradient(0, 1) * place[b].y();
        v[b].y += gradient(1, 0) * place[b].x() + gradient(1, 1) * place[b].y();
      }
  }

  void follow_impulses(const ContactProblem            &problem,
                       const std::vector<BodyVelocity> &free,
                       const std::vector<Impulse>      &impulses,
                       std::vector<BodyVelocity>       &v)
  {
    if (!problem.lattice)
      return;
    Eigen::Matrix2d crossing = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < impulses.size(); ++k)
      if (const ContactRow &c = problem.contacts[k]; c.image_body >= 0)
        crossing += crossing_of(c, impulses[k], *problem.lattice);
    follow_crossing(*problem.lattice, free, crossing, v);
  }

  void follow_crossing(const LatticeProblem            &lattice,
                       const std::vector<BodyVelocity> &free,
                       const Eigen::Matrix2d           &crossing,
                       std::vector<BodyVelocity>       &v)
  {
    const std::size_t     record = lattice.place.size(), n_grains = record - 2;
    const Eigen::Vector3d free_rate = rate_of(free[record]), rate = rate_of(v[record]);
    const Eigen::Matrix2d known  = velocity_gradient(rate - free_rate);
    Eigen::Matrix2d       moment = -crossing; // and the sum of (impulse on a grain) x (its place)^T
    for (std::size_t i = 0; i < n_grains; ++i)
      {
        const Eigen::Vector2d &x = lattice.place[i];
        const Eigen::Vector2d  change(v[i].x - free[i].x, v[i].y - free[i].y);
        moment += (change - known * x) / v[i].inverse_mass * x.transpose();
      }
    const Eigen::Vector3d next = free_rate - lattice.mobility * components(moment);
    add_gradient(lattice.place, velocity_gradient(next - rate), v);
    v[record] = record_of(next);
  }
} // namespace diptych::discrete
