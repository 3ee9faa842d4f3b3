// diptych: the order in which contacts are swept
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contact_order.h"

#include <algorithm>
#include <limits>

namespace diptych::discrete
{
  std::vector<int> sweep_order(const std::vector<Contact> &contacts, const double length)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Contact &c : contacts)
      low = std::min(low, c.point.y()), high = std::max(high, c.point.y());
    // Far flung grains must not ask for more layers than there are contacts to sort.
    const double layer    = std::max(0.1 * length, (high - low) / (4. * contacts.size() + 1.));
    const auto   layer_of = [&](const Contact &c) { return std::size_t((c.point.y() - low) / layer); };

    std::vector<int> start(contacts.empty() ? 1 : layer_of({0, 0, 0, {}, {0, high}}) + 2, 0), order(contacts.size());
    for (const Contact &c : contacts)
      ++start[layer_of(c) + 1];
    for (std::size_t k = 1; k < start.size(); ++k)
      start[k] += start[k - 1];
    for (std::size_t k = 0; k < contacts.size(); ++k)
      order[start[layer_of(contacts[k])]++] = int(k);
    return order;
  }
} // namespace diptych::discrete
