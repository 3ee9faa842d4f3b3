// diptych: difference between the stresses of the two panels, beside the scatter that sampling would give
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/fields/stress_difference.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <Eigen/QR>

#include "coupling/cells/principal_axes.h"

namespace diptych::coupling
{
  namespace
  {
    constexpr int n_polynomial = 6; // 1, x, y, x^2, xy, y^2

    Eigen::Matrix2d symmetric(const Eigen::Matrix2d &m)
    {
      return 0.5 * (m + m.transpose());
    }

    // Sum over cells of A |residual|^2 of the quadratic fit to the components xx, yy and sqrt(2) xy, times n / (n - 6).
    double scatter(const QuadMesh                     &mesh,
                   const std::vector<double>          &area,
                   const std::vector<unsigned int>    &kept,
                   const std::vector<Eigen::Matrix2d> &stress)
    {
      const Eigen::Index n = kept.size();
      if (n <= n_polynomial)
        return NAN;
      Eigen::Vector2d centre = Eigen::Vector2d::Zero();
      double          extent = 0;
      for (const unsigned int k : kept)
        centre += cell_centre(mesh, k) / double(n);
      for (const unsigned int k : kept)
        extent = std::max(extent, (cell_centre(mesh, k) - centre).norm());

      Eigen::MatrixXd basis(n, n_polynomial), values(n, 3);
      for (Eigen::Index row = 0; row < n; ++row)
        {
          const unsigned int    k = kept[row];
          const Eigen::Vector2d x = (cell_centre(mesh, k) - centre) / extent;
          const Eigen::Matrix2d s = symmetric(stress[k]);
          const double          w = std::sqrt(area[k]);
          basis.row(row) << w, w * x.x(), w * x.y(), w * x.x() * x.x(), w * x.x() * x.y(), w * x.y() * x.y();
          values.row(row) << w * s(0, 0), w * s(1, 1), w * M_SQRT2 * s(0, 1);
        }
      const Eigen::MatrixXd fitted = basis * basis.colPivHouseholderQr().solve(values);
      return (values - fitted).squaredNorm() * double(n) / double(n - n_polynomial);
    }
  } // namespace

  StressDifference stress_difference(const QuadMesh &mesh, const StressPair &stress)
  {
    const std::vector<double> area = cell_areas(mesh);
    std::vector<unsigned int> kept;
    for (unsigned int k = 0; k < mesh.cell.size(); ++k)
      if (stress.grains[k].allFinite() && stress.continuum[k].allFinite())
        kept.push_back(k);

    StressDifference result;
    result.cells      = int(kept.size());
    double difference = 0, norm = 0, turn = 0, total = 0, error = 0;
    for (const unsigned int k : kept)
      {
        const Eigen::Matrix2d a = symmetric(stress.grains[k]), b = symmetric(stress.continuum[k]);
        difference += area[k] * (a - b).squaredNorm();
        norm += area[k] * b.squaredNorm();
        turn += area[k] * std::pow(line_turn(major_direction(a), major_direction(b)), 2);
        error += area[k] * std::pow(stress.standard_error[k], 2);
        total += area[k];
      }
    if (!(norm > 0))
      return result;
    result.size           = std::sqrt(total / double(kept.size()));
    result.relative_l2    = std::sqrt(difference / norm);
    result.direction_deg  = std::sqrt(turn / total);
    result.sampling_alone = std::sqrt(scatter(mesh, area, kept, stress.grains) / norm);
    result.lowest_scatter = std::sqrt(error / norm);
    return result;
  }

  std::string stress_verdict(const StressDifference &widest)
  {
    std::ostringstream out;
    out.precision(2);
    if (!std::isfinite(widest.relative_l2) || !std::isfinite(widest.sampling_alone))
      return "too few cells of " + widest.label + " to distinguish a difference of the panels' stresses from sampling scatter";
    out << "at " << widest.label << " the stresses differ by " << 100 * widest.relative_l2
        << " %, and the grains' own scatter is " << 100 * widest.sampling_alone << " %: ";
    if (widest.relative_l2 <= widest.sampling_alone)
      out << "no difference beyond sampling";
    else
      out << "beyond sampling by " << 100 * std::sqrt(std::pow(widest.relative_l2, 2) - std::pow(widest.sampling_alone, 2))
          << " %";
    return out.str();
  }
} // namespace diptych::coupling
