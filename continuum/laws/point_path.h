// diptych: a loading path of one homogeneous point, with strains and stresses prescribed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "continuum/choices.h"

namespace diptych::continuum
{
  // A quantity that a path prescribes, positive in compression. Strains count from the start. A law receives their increments
  // unchanged: logarithmic strains describe a finite deformation, and the axes do not turn with the shear.
  enum class Control
  {
    exx,
    eyy,
    exy,    // component of the tensor, half the engineering shear
    volume, // exx + eyy
    sxx,
    syy,
    sxy,
    mean_stress // (sxx + syy)/2
  };
  constexpr auto choices(Control)
  {
    return std::array{std::pair{Control::exx, "exx"}, std::pair{Control::eyy, "eyy"},
                      std::pair{Control::exy, "exy"}, std::pair{Control::volume, "volume"},
                      std::pair{Control::sxx, "sxx"}, std::pair{Control::syy, "syy"},
                      std::pair{Control::sxy, "sxy"}, std::pair{Control::mean_stress, "mean_stress"}};
  }
  constexpr bool is_stress(const Control control)
  {
    return control >= Control::sxx;
  }

  // The quantity as a linear form of (e_xx, e_yy, gamma_xy) or (s_xx, s_yy, s_xy).
  Eigen::RowVector3d form_of(Control control);

  using Controls = std::array<Control, 3>;

  struct PointPath
  {
    double                       pressure  = 1;                           // scale of the stresses [pressure], positive
    Eigen::Matrix2d              stress    = Eigen::Matrix2d::Identity(); // at the start, symmetric [pressure]
    double                       stress_zz = 1;                           // at the start [pressure]
    Controls                     controls  = {Control::eyy, Control::sxx, Control::exy};
    std::vector<Eigen::Vector3d> values;   // of the controls, row by row; the first row is the start
    std::vector<double>          progress; // one per row, ascending, for viscosity; empty: rate independent, 0, 1, 2, ...

    double progress_at(std::size_t row) const { return progress.empty() ? double(row) : progress[row]; }

    // Starts with sxx = szz = `pressure_` and syy = `pressure_` / k0.
    static PointPath from(double pressure_, double k0);
  };

  // Paths from a stress without shear, without shear strain unless stated.
  enum class NamedPath
  {
    drained,              // eyy grows, sxx is constant: the biaxial test
    constant_volume,      // eyy grows, exx + eyy = 0: the undrained test
    constant_mean_stress, // eyy grows, (sxx + syy)/2 is constant
    simple_shear          // exy grows, syy is constant, exx = 0
  };
  constexpr auto choices(NamedPath)
  {
    return std::array{std::pair{NamedPath::drained, "drained"}, std::pair{NamedPath::constant_volume, "constant_volume"},
                      std::pair{NamedPath::constant_mean_stress, "constant_mean_stress"},
                      std::pair{NamedPath::simple_shear, "simple_shear"}};
  }

  struct PathSize
  {
    double pressure = 1;    // lateral stress of the start, also out of the plane [pressure], positive
    double strain   = 0.1;  // final 1 - h/h0, in (0, 1); simple_shear: final 2 exy, up to 1e4
    double step     = 1e-3; // increment of this strain; the last step may be shorter
    double k0       = 1;    // lateral over axial stress of the start, positive
  };

  // Throws std::invalid_argument with the member of `size` that is out of range.
  void      validate(NamedPath name, const PathSize &size);
  PointPath named_path(NamedPath name, const PathSize &size);

  // Divides the way between two rows into equal steps: at most `strain_step` in a strain and 1 % of the pressure in a stress. The
  // progress of a path without one is the number of the row. Throws WrongPath at the row that reaches a million steps.
  PointPath refined(const PointPath &path, double strain_step);

  // A wrong row of a path; the message has the column and its value.
  struct WrongPath : std::invalid_argument
  {
    static constexpr std::size_t header = std::size_t(-1); // the columns are wrong, not a row
    WrongPath(const std::size_t row, const std::string &problem)
        : std::invalid_argument(problem),
          row(row)
    {}

    std::size_t row;
  };

  // Throws WrongPath if the controls depend on each other, if a value is not finite, if the progress does not ascend or if the
  // first row has another stress than the start.
  void validate(const PointPath &path);
} // namespace diptych::continuum
