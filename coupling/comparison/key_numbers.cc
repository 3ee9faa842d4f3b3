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
    constexpr char no_interval[] = "no interval (one sample)";

    std::string verdict_of(const Interval &difference)
    {
      if (std::isnan(difference.value))
        return "not in both panels";
      if (std::isnan(difference.low) || std::isnan(difference.high))
        return no_interval;
      return difference.low > 0 || difference.high < 0 ? "different" : "cannot tell";
    }

    KeyNumber key_number(const KeyQuantity &q, const Interval &grains, const Interval &continuum, const Interval &difference)
    {
      KeyNumber number;
      number.key        = q.key;
      number.quantity   = q.name;
      number.unit       = q.unit;
      number.grains     = grains;
      number.continuum  = continuum;
      number.difference = difference;
      number.verdict    = verdict_of(difference);
      return number;
    }

    KeyNumber of_band(const KeyQuantity &q, const Increment &window)
    {
      const auto          take   = [&](const BandValues &band) { return q.of_band(band, window.frame.mean_diameter); };
      const ComparedBands bands  = compared_bands(window);
      KeyNumber           number = key_number(q, take(bands.grains), take(bands.continuum), take(band_difference(window)));
      char                where[64];
      std::snprintf(where, sizeof where, " (%.4g to %.4g)", window.from, window.to);
      if (std::isnan(number.difference.value) && !std::isnan(bands.grains.jump.value + bands.continuum.jump.value))
        number.verdict = "diffuse";
      number.quantity += where;
      return number;
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
    std::vector<KeyNumber> numbers;
    for (const KeyQuantity &q : key_quantities)
      if (q.of_panel)
        {
          const double grains = value_of(c.discrete.numbers.compared, q), nodes = value_of(c.continuum.numbers.compared, q);
          numbers.push_back(key_number(q, Interval{grains}, Interval{nodes}, Interval{nodes - grains}));
        }
      else if (!c.windows.empty())
        numbers.push_back(of_band(q, c.windows.back()));
    return numbers;
  }

  std::string csv_of(const std::vector<KeyNumber> &numbers, const std::vector<Check> &checks)
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
    out << "checks,-" << std::string(9, ',') << ',' << count_of(checks) << '\n';
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
    const auto of_one = [](const KeyNumber &k) { return k.verdict == no_interval; };
    if (std::any_of(numbers.begin(), numbers.end(), of_one))
      text += "\nno interval: run the scene with --seeds 1-8 for intervals and verdicts";
    return text;
  }

  std::string sxx_text_of(const Comparison &c, const double pressure)
  {
    if (std::isnan(c.discrete.numbers.mean_sxx))
      return "";
    std::string text = "mean sxx / P from 0.3 % strain:";
    for (const auto &[name, n] : {std::pair{" grains ", &c.discrete.numbers}, {", continuum ", &c.continuum.numbers}})
      text += name + number(n->mean_sxx / pressure) +
              (std::isnan(n->sides_sxx)
                 ? "" // imported grains
                 : " (sides " + number(n->sides_sxx / pressure) + ", platens " + number(n->platens_sxx / pressure) + ")");
    return "\n" + text;
  }

  std::string platens_text_of(const PlatenFriction &grains, const continuum::Options &o)
  {
    if (o.platens != continuum::Platens::frictional)
      return "";
    return "\nplatens: friction " + number(o.platen_friction) + ", slip length " + number(o.platen_slip_length) +
           " d; fitted to these grains: " +
           (std::isnan(grains.friction.value) ? "not determined"
                                              : with_ends(grains.friction) + ", " + with_ends(grains.slip_length) + " d");
  }

  std::string origin_of_law(const std::string &parameters_from)
  {
    return "parameters of the continuum: " + (parameters_from.empty()
                                                ? "set by the scene, which does not say to which grains they were fitted "
                                                  "(comparison/parameters_from; diptych calibrate fits them)"
                                                : parameters_from);
  }
} // namespace diptych::coupling
