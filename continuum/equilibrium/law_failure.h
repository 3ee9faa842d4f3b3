// diptych: where a law from a library failed
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "continuum/elements/discretisation.h"
#include "continuum/laws/any_law.h"

namespace diptych::continuum
{
  // Until it goes out of scope, failures of a law from a library name the point with `where`. Forgets earlier failures.
  template <class L> class WatchedLaw
  {
  public:
    template <class Where>
    WatchedLaw(const L &law, const Where &where)
        : law(law)
    {
      if constexpr (std::is_same_v<L, LibraryLaw>)
        {
          law.forget_failure();
          law.where = where;
        }
    }
    WatchedLaw(const WatchedLaw &)            = delete;
    WatchedLaw &operator=(const WatchedLaw &) = delete;
    ~WatchedLaw()
    {
      if constexpr (std::is_same_v<L, LibraryLaw>)
        law.where = {};
    }

  private:
    const L &law;
  };

  // "element 3, point 1 (x = 0.5, y = 2)", an element of this process. Displacement: relevant dofs.
  std::string name_of_point(const Discretisation      &mesh,
                            const std::vector<double> &displacement,
                            std::size_t                cell,
                            unsigned int               point);

  // A failure of a law from a library since it was watched, on any process; empty for other laws. Collective.
  LibraryLaw::Failure law_failure(const Law &law, MPI_Comm communicator);
} // namespace diptych::continuum
