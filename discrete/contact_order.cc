// diptych: the order in which contacts are swept
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contact_order.h"

#include <algorithm>
#include <numeric>

namespace diptych::discrete
{
  namespace
  {
    constexpr std::size_t batch_size = 4, window_size = 64;

    bool share_a_grain(const Contact &a, const Contact &b, const int n_grains)
    {
      const auto same = [n_grains](const int p, const int q) { return p == q && p < n_grains; };
      return same(a.i, b.i) || same(a.i, b.j) || same(a.j, b.i) || same(a.j, b.j);
    }
  } // namespace

  std::vector<Contact> sweep_order(const std::vector<Contact> &contacts, const int n_grains)
  {
    std::vector<int> queue(contacts.size());
    std::iota(queue.begin(), queue.end(), 0);
    std::stable_sort(queue.begin(), queue.end(),
                     [&](const int a, const int b) { return contacts[a].point.y() < contacts[b].point.y(); });

    std::vector<Contact> ordered;
    ordered.reserve(contacts.size());
    std::vector<int> window; // contacts waiting, oldest first
    std::size_t      next = 0;
    while (ordered.size() < contacts.size())
      {
        while (window.size() < window_size && next < queue.size())
          window.push_back(queue[next++]);
        const std::size_t batch_begin = ordered.size();
        for (auto w = window.begin(); w != window.end() && ordered.size() < batch_begin + batch_size;)
          {
            const Contact &candidate = contacts[*w];
            const bool     free      = std::none_of(ordered.begin() + batch_begin, ordered.end(),
                                                    [&](const Contact &c) { return share_a_grain(c, candidate, n_grains); });
            if (free)
              {
                ordered.push_back(candidate);
                w = window.erase(w);
              }
            else
              ++w;
          }
      }
    return ordered;
  }
} // namespace diptych::discrete
