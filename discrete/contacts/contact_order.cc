// diptych: order in which contacts are swept
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/contacts/contact_order.h"

#include <algorithm>
#include <limits>

namespace diptych::discrete
{
  namespace
  {
    std::vector<int> layers_of(const std::vector<Contact> &contacts, const double length)
    {
      std::vector<int> layers(contacts.size());
      double           low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Contact &c : contacts)
        {
          low  = std::min(low, c.point.y());
          high = std::max(high, c.point.y());
        }
      // Distant grains must not require more layers than there are contacts to sort.
      const double layer = std::max(0.1 * length, (high - low) / (4. * contacts.size() + 1.));
      for (std::size_t k = 0; k < contacts.size(); ++k)
        layers[k] = int((contacts[k].point.y() - low) / layer);
      return layers;
    }
  } // namespace

  std::vector<int> sweep_order(const std::vector<Contact> &contacts, const double length)
  {
    const std::vector<int> layers = layers_of(contacts, length);
    std::vector<int> start(layers.empty() ? 1 : 2 + *std::max_element(layers.begin(), layers.end()), 0), order(layers.size());
    for (const int layer : layers)
      ++start[layer + 1];
    for (std::size_t k = 1; k < start.size(); ++k)
      start[k] += start[k - 1];
    for (std::size_t k = 0; k < layers.size(); ++k)
      order[start[layers[k]]++] = int(k);
    return order;
  }
} // namespace diptych::discrete
