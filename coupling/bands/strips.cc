// diptych: strips parallel to a band and the mean longitudinal displacement in each (Moreau 1997)
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/bands/strips.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace diptych::coupling
{
  std::vector<double> strip_edges(const SampleFrame &frame, const double angle_deg, const double offset, const int n_strips)
  {
    if (n_strips < 1)
      throw std::invalid_argument("the number of strips must be at least 1");
    const double angle = angle_deg * M_PI / 180;
    const double reach = 0.5 * (frame.width * std::abs(std::sin(angle)) + frame.height * std::abs(std::cos(angle)));
    const double half  = 30 * frame.mean_diameter;
    double       from = std::max(-reach, offset - half), to = std::min(reach, offset + half);
    if (!(from < to)) // the band lies outside the sample
      {
        from = -reach;
        to   = reach;
      }

    std::vector<double> edges(n_strips + 1);
    for (int k = 0; k <= n_strips; ++k)
      edges[k] = from + (to - from) * k / n_strips;
    return edges;
  }

  std::array<double, 2> background(const Strips &strips, const Band &band)
  {
    double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
    for (std::size_t k = 0; k < strips.mean.size(); ++k)
      if (strips.count[k] > 0)
        {
          const double n = strips.count[k], x = 0.5 * (strips.edges[k] + strips.edges[k + 1]),
                       y = strips.mean[k] - 0.5 * band.jump * std::tanh((x - band.offset) / band.half_width);
          w += n;
          wx += n * x;
          wy += n * y;
          wxx += n * x * x;
          wxy += n * x * y;
        }
    const double determinant = w * wxx - wx * wx;
    if (!(determinant > 0))
      return {NAN, NAN};
    return {(wxx * wy - wx * wxy) / determinant, (w * wxy - wx * wy) / determinant};
  }

  Strips strip_means(const DisplacementField   &field,
                     const SampleFrame         &frame,
                     const double               angle_deg,
                     const std::vector<double> &edges)
  {
    const double platen = frame.platen_increment.norm();
    if (!(platen > 0))
      throw std::invalid_argument("strips need a platen increment above zero");
    if (edges.size() < 2 || !std::is_sorted(edges.begin(), edges.end()))
      throw std::invalid_argument("the edges of the strips must be in ascending order");

    const std::size_t   n = edges.size() - 1;
    Strips              strips{angle_deg, edges, std::vector<double>(n, 0.), std::vector<double>(n, 0.), std::vector<int>(n, 0)};
    std::vector<double> weight(n, 0.);

    Band axes;
    axes.angle_deg           = angle_deg;
    const auto for_each_kept = [&](const auto &action) {
      for (std::size_t i = 0; i < field.position.size(); ++i)
        {
          const double across = (field.position[i] - frame.centre).dot(axes.normal());
          const auto   above  = std::upper_bound(edges.begin(), edges.end(), across) - edges.begin();
          if (field.weight[i] > 0 && above > 0 && above <= static_cast<std::ptrdiff_t>(n))
            action(above - 1, field.weight[i], field.increment[i].dot(axes.direction()) / platen);
        }
    };
    for_each_kept([&](const std::size_t k, const double w, const double u) {
      ++strips.count[k];
      weight[k] += w;
      strips.mean[k] += w * u;
    });
    for (std::size_t k = 0; k < n; ++k)
      strips.mean[k] = strips.count[k] > 0 ? strips.mean[k] / weight[k] : NAN;
    for_each_kept([&](const std::size_t k, const double w, const double u) {
      strips.deviation[k] += w * (u - strips.mean[k]) * (u - strips.mean[k]);
    });
    for (std::size_t k = 0; k < n; ++k)
      strips.deviation[k] = strips.count[k] > 0 ? std::sqrt(strips.deviation[k] / weight[k]) : NAN;
    return strips;
  }
} // namespace diptych::coupling
