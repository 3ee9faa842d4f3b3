// diptych: the numbers of a comparison that a user asks for first
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/comparison/key_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "coupling/comparison/band_difference.h"

namespace diptych::coupling
{
  namespace
  {
    std::string verdict_of(const Interval &difference)
    {
      if (std::isnan(difference.value))
        return "not in both panels";
      if (std::isnan(difference.low) || std::isnan(difference.high))
        return "one sample";
      return difference.low > 0 || difference.high < 0 ? "different" : "cannot tell";
    }

    KeyNumber key_number(const std::string &quantity,
                         const std::string &unit,
                         const Interval    &grains,
                         const Interval    &continuum,
                         const Interval    &difference)
    {
      return {quantity, unit, grains, continuum, difference, verdict_of(difference)};
    }

    KeyNumber of_values(const std::string &quantity, const double grains, const double continuum, const char *unit = "-")
    {
      return key_number(quantity, unit, Interval{grains}, Interval{continuum}, Interval{continuum - grains});
    }

    void add_band(const Increment &window, std::vector<KeyNumber> &numbers)
    {
      const double unit               = 1 / window.frame.mean_diameter;
      const auto [grains, continuum]  = compared_bands(window);
      const BandDifference difference = band_difference(window);
      char                 where[64];
      std::snprintf(where, sizeof where, " of the band (%.4g to %.4g)", window.from, window.to);
      numbers.push_back(
        key_number(std::string("inclination") + where, "degrees", grains.angle_deg, continuum.angle_deg, difference.angle_deg));
      numbers.push_back(key_number(std::string("10-90 % width") + where, "mean diameters", times(unit, grains.width_10_90),
                                   times(unit, continuum.width_10_90), times(unit, difference.width_10_90)));
    }

    std::string number(const double value, const char *absent = "")
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.4g", value);
      return std::isnan(value) ? absent : text;
    }

    std::string with_ends(const Interval &i)
    {
      return number(i.value, "none") + (std::isnan(i.low) || std::isnan(i.high) || i.low == i.high
                                          ? ""
                                          : " [" + number(i.low) + ", " + number(i.high) + "]");
    }
  } // namespace

  std::vector<KeyNumber> key_numbers(const Comparison &c)
  {
    std::vector<KeyNumber> numbers = {
      of_values("peak t/s", c.discrete.peak.value, c.continuum.peak.value),
      of_values("strength T/S from 0.3 % strain", c.discrete.strength.later, c.continuum.strength.later),
      of_values("platen force from 0.3 % strain", c.discrete.platen_force, c.continuum.platen_force, "P d"),
      of_values("volumetric strain at the end", c.discrete.final_volumetric_strain, c.continuum.final_volumetric_strain)};
    if (!c.windows.empty())
      add_band(c.windows.back(), numbers);
    return numbers;
  }

  std::string csv_of(const std::vector<KeyNumber> &numbers)
  {
    std::ostringstream out;
    out << header_of(summary_columns()) << '\n';
    for (const KeyNumber &k : numbers)
      {
        out << k.quantity << ',' << k.unit;
        for (const Interval &i : {k.grains, k.continuum, k.difference})
          for (const double value : {i.value, i.low, i.high})
            {
              char text[32];
              std::snprintf(text, sizeof text, "%.9g", value);
              out << ',' << (std::isnan(value) ? "" : text);
            }
        out << ',' << k.verdict << '\n';
      }
    return out.str();
  }

  std::string text_of(const std::vector<KeyNumber> &numbers)
  {
    std::vector<std::array<std::string, 5>> rows = {{"", "grains", "continuum", "difference [95 %]", "verdict"}};
    for (const KeyNumber &k : numbers)
      rows.push_back({k.quantity + (k.unit == "-" ? "" : " [" + k.unit + "]"), with_ends(k.grains), with_ends(k.continuum),
                      with_ends(k.difference), k.verdict});
    std::array<std::size_t, 5> width{};
    for (const auto &row : rows)
      for (std::size_t k = 0; k < row.size(); ++k)
        width[k] = std::max(width[k], row[k].size());
    std::string text;
    for (const auto &row : rows)
      {
        for (std::size_t k = 0; k + 1 < row.size(); ++k)
          text += row[k] + std::string(width[k] - row[k].size() + 2, ' ');
        text += row.back() + (&row == &rows.back() ? "" : "\n");
      }
    const auto of_one = [](const KeyNumber &k) { return k.verdict == "one sample"; };
    if (std::any_of(numbers.begin(), numbers.end(), of_one))
      text += "\none sample: run the scene with --seeds 1-8 for intervals and verdicts";
    return text;
  }
} // namespace diptych::coupling
