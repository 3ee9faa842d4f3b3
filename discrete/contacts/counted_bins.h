// diptych: items sorted into numbered bins
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace diptych::discrete
{
  // A counting sort. Bins follow one another and items ascend in each bin, so the order depends only on the items.
  class CountedBins
  {
  public:
    // Sorts items 0 .. n_items - 1. Each time, bins_of(item, action) calls action(bin) for the same bins of an item.
    template <class BinsOf> void sort(const std::size_t n_bins, const std::size_t n_items, BinsOf &&bins_of)
    {
      begin.assign(n_bins + 1, 0);
      for (unsigned int i = 0; i < n_items; ++i)
        bins_of(i, [this](const std::size_t bin) { ++begin[bin + 1]; });
      for (std::size_t b = 1; b < begin.size(); ++b)
        begin[b] += begin[b - 1];
      items.resize(begin.back());
      std::vector<unsigned int> next(begin.begin(), begin.end() - 1);
      for (unsigned int i = 0; i < n_items; ++i)
        bins_of(i, [&](const std::size_t bin) { items[next[bin]++] = i; });
    }

    // Items of a bin: sorted()[begins(bin)] .. sorted()[begins(bin + 1) - 1].
    unsigned int                     begins(const std::size_t bin) const { return begin[bin]; }
    const std::vector<unsigned int> &sorted() const { return items; }

    template <class Action> void for_each_in(const std::size_t bin, Action &&action) const
    {
      for (unsigned int k = begin[bin]; k < begin[bin + 1]; ++k)
        action(items[k]);
    }

  private:
    std::vector<unsigned int> begin = {0}, items;
  };
} // namespace diptych::discrete
