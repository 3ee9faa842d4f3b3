// diptych: a loading path of one homogeneous point, with strains and stresses prescribed
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/point_path.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace diptych::continuum
{
  namespace
  {
    std::string column(const Control control, const double value)
    {
      std::ostringstream text;
      text.precision(10);
      text << "column '" << name_of(control) << "' = " << value;
      return text.str();
    }

    // One control of the shear and two of the normal components. Volume and mean stress follow from each other in an isotropic
    // law.
    void check_independence(const Controls &controls)
    {
      const std::set<Control> given(controls.begin(), controls.end());
      const auto              both = [&](const Control a, const Control b) { return given.count(a) + given.count(b); };
      if (given.size() < 3 || both(Control::exy, Control::sxy) != 1 || both(Control::volume, Control::mean_stress) == 2)
        throw WrongPath(WrongPath::header, "columns " + name_of(controls[0]) + ", " + name_of(controls[1]) + ", " +
                                             name_of(controls[2]) +
                                             " do not determine the state: one follows from the others; give three independent "
                                             "ones, for example eyy, sxx, exy");
    }

    void check_start(const PointPath &path)
    {
      const Eigen::Vector3d stress(path.stress(0, 0), path.stress(1, 1), path.stress(0, 1));
      for (int k = 0; k < 3; ++k)
        {
          const double of_start = form_of(path.controls[k]) * stress, given = path.values[0][k];
          if (is_stress(path.controls[k]) && !(std::abs(given - of_start) <= 1e-9 * path.pressure))
            {
              std::ostringstream text;
              text << column(path.controls[k], given) << " is not the stress of the start; the first row must have " << of_start;
              throw WrongPath(0, text.str());
            }
        }
    }

    double steps_between(const PointPath &path, const std::size_t row, const double strain_step)
    {
      double most = 1;
      for (int k = 0; k < 3; ++k)
        most = std::max(most, std::abs(path.values[row][k] - path.values[row - 1][k]) /
                                (is_stress(path.controls[k]) ? 0.01 * path.pressure : strain_step));
      return std::ceil(most - 1e-9);
    }
  } // namespace

  Eigen::RowVector3d form_of(const Control control)
  {
    switch (control)
      {
      case Control::exx:
      case Control::sxx:
        return {1, 0, 0};
      case Control::eyy:
      case Control::syy:
        return {0, 1, 0};
      case Control::exy:
        return {0, 0, 0.5};
      case Control::sxy:
        return {0, 0, 1};
      case Control::volume:
        return {1, 1, 0};
      case Control::mean_stress:
        return {0.5, 0.5, 0};
      }
    throw std::logic_error("form_of: a control without a form");
  }

  PointPath PointPath::from(const double pressure_, const double k0)
  {
    PointPath path;
    path.pressure = path.stress_zz = pressure_;
    path.stress                    = Eigen::Vector2d(pressure_, pressure_ / k0).asDiagonal();
    return path;
  }

  void validate(const NamedPath name, const PathSize &size)
  {
    std::ostringstream wrong;
    if (!(size.pressure > 0 && std::isfinite(size.pressure)))
      wrong << "pressure = " << size.pressure << " must be positive";
    else if (const double most = name == NamedPath::simple_shear ? 1e4 : 1; !(size.strain > 0 && size.strain < most))
      wrong << "axial_strain = " << size.strain << " must lie in (0, " << most << "); path " << name_of(name)
            << (name == NamedPath::simple_shear ? " shears" : " shortens the height") << " by it";
    else if (!(size.step >= 1e-7 && size.step < 1))
      wrong << "step = " << size.step << " must lie in [1e-7, 1)";
    if (!wrong.str().empty())
      throw std::invalid_argument(wrong.str());
  }

  PointPath named_path(const NamedPath name, const PathSize &size)
  {
    validate(name, size);
    PointPath path = PointPath::from(size.pressure, size.k0);
    if (name == NamedPath::constant_volume)
      path.controls[1] = Control::volume;
    else if (name == NamedPath::constant_mean_stress)
      path.controls[1] = Control::mean_stress;
    else if (name == NamedPath::simple_shear)
      path.controls = {Control::exy, Control::syy, Control::exx};
    const Eigen::Vector3d stress(path.stress(0, 0), path.stress(1, 1), 0);
    const double          second = is_stress(path.controls[1]) ? form_of(path.controls[1]).dot(stress) : 0.;

    const unsigned int n_steps = std::max(1., std::ceil(size.strain / size.step - 1e-9));
    for (unsigned int k = 0; k <= n_steps; ++k)
      {
        const double end = k < n_steps ? k * size.step : size.strain;
        path.progress.push_back(end);
        path.values.emplace_back(name == NamedPath::simple_shear ? end / 2 : 0 - std::log1p(-end), second, 0);
      }
    return path;
  }

  PointPath refined(const PointPath &path, const double strain_step)
  {
    PointPath fine = path;
    fine.values.resize(1);
    fine.progress.assign(1, path.progress_at(0));
    for (std::size_t row = 1; row < path.values.size(); ++row)
      {
        const double n = steps_between(path, row, strain_step);
        if (!(double(fine.values.size()) + n < 1e6))
          throw WrongPath(row,
                          "the path needs more than a million steps; are its stresses in the unit of the pressure, and is the "
                          "step long enough?");
        for (int k = 1; k <= n; ++k)
          {
            const double share = k / n;
            fine.values.push_back((1 - share) * path.values[row - 1] + share * path.values[row]);
            fine.progress.push_back((1 - share) * path.progress_at(row - 1) + share * path.progress_at(row));
          }
      }
    return fine;
  }

  void validate(const PointPath &path)
  {
    check_independence(path.controls);
    if (!path.stress.allFinite() || path.stress(0, 1) != path.stress(1, 0) || !std::isfinite(path.stress_zz))
      throw std::invalid_argument("the initial stress must be finite and symmetric");
    if (path.values.empty())
      throw WrongPath(WrongPath::header, "the path is empty: give at least one row, the start");
    if (!path.progress.empty() && path.progress.size() != path.values.size())
      throw WrongPath(WrongPath::header, "progress must have one entry per row, " + std::to_string(path.values.size()) +
                                           ", but has " + std::to_string(path.progress.size()));
    for (std::size_t row = 0; row < path.values.size(); ++row)
      {
        for (int k = 0; k < 3; ++k)
          if (!std::isfinite(path.values[row][k]))
            throw WrongPath(row, column(path.controls[k], path.values[row][k]) + " must be finite");
        if (row > 0 && !(path.progress_at(row) > path.progress_at(row - 1) && std::isfinite(path.progress_at(row))))
          throw WrongPath(row, "column 'progress' must be above that of the row before");
      }
    check_start(path);
  }
} // namespace diptych::continuum
