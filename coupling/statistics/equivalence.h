// diptych: statistics over realisations, and the equivalence of two panels within a margin
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // Statistics of independent realisations. NaN if n is too small: the mean needs n >= 1, the others n >= 2.
  struct SampleStatistics
  {
    int    n    = 0;
    double mean = std::numeric_limits<double>::quiet_NaN();
    double deviation =
      std::numeric_limits<double>::quiet_NaN(); // standard deviation of one realisation, with n - 1 in the denominator
    double low  = std::numeric_limits<double>::quiet_NaN(); // ends of the 95 % Student interval of the mean
    double high = std::numeric_limits<double>::quiet_NaN();
  };

  [[nodiscard]] SampleStatistics statistics(const std::vector<double> &values);

  // The same for angles of lines [degrees], which repeat after 180. The mean is half the direction of the sum of the unit vectors
  // of the doubled angles, in (-90, 90]. The deviation is the standard deviation of the rotations from this mean. low and high
  // may lie outside (-90, 90]. NaN if the lines have no mean direction. Source: Mardia and Jupp, Directional Statistics (2000),
  // section 2.2.
  [[nodiscard]] SampleStatistics line_statistics(const std::vector<double> &degrees);

  enum class Verdict
  {
    equivalent, // two one-sided tests at 5 %: the 90 % interval of the difference lies within (-margin, margin)
    different,  // the 95 % interval lies beyond the margin
    cannot_tell // neither of these, or fewer than two pairs
  };

  std::string text_of(Verdict verdict); // "equivalent", "different", "cannot tell"

  // Source of the test: Schuirmann, J. Pharmacokinet. Biopharm. 15 (1987) 657.
  struct Equivalence
  {
    int      n = 0;         // number of pairs
    Interval difference;    // 95 %
    Interval difference_90; // decides on the verdict `equivalent`
    Verdict  verdict = Verdict::cannot_tell;
  };

  // differences: second panel minus first, one per realisation, in the unit of the margin.
  [[nodiscard]] Equivalence compare_differences(const std::vector<double> &differences, double margin);

  // The same for rotations between lines [degrees].
  [[nodiscard]] Equivalence compare_turns(const std::vector<double> &turns, double margin);

  // The same difference if the second panel has an additional, independent uncertainty: its standard deviation in the unit of the
  // margin, and the 97.5 % quantile for it. The squares of the half widths are added.
  [[nodiscard]] Equivalence widened(Equivalence result, double deviation, double quantile, double margin);

  // The difference is (mean of second) / (mean of first) - 1, with Fieller's interval, so that the scatter of the first panel
  // also counts. Entry k of both lists belongs to one realisation. If the mean of `first` does not differ significantly from 0,
  // the ends are NaN and the verdict is cannot_tell. Sources: Fieller, J. R. Stat. Soc. B 16 (1954) 175; for the test Hauschke et
  // al., J. Biopharm. Stat. 9 (1999) 89. Throws std::invalid_argument for lists of different lengths.
  [[nodiscard]] Equivalence compare_relative(const std::vector<double> &first, const std::vector<double> &second, double margin);
} // namespace diptych::coupling
