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
    const auto   layer_of = [&](const double y) { return int((y - low) / layer); };

    std::vector<int> start(contacts.empty() ? 1 : layer_of(high) + 2, 0), layers(contacts.size()), order(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k)
      {
        layers[k] = layer_of(contacts[k].point.y());
        ++start[layers[k] + 1];
      }
    for (std::size_t k = 1; k < start.size(); ++k)
      start[k] += start[k - 1];
    for (std::size_t k = 0; k < contacts.size(); ++k)
      order[start[layers[k]]++] = int(k);
    return order;
  }
} // namespace diptych::discrete
