// diptych: helpers for the HDF5 library: ids that close themselves, errors as exceptions
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include <hdf5.h>

namespace diptych::discrete
{
  namespace hdf5_library
  {
    [[noreturn]] inline void fail(const std::string &what, const std::string &path, const std::string &name)
    {
      throw std::runtime_error("HDF5: cannot " + what + " '" + name + "' in " + path);
    }

    [[noreturn]] inline void refuse(const std::string &path, const std::string &name, const std::string &what)
    {
      throw std::invalid_argument(path + ": '" + name + "' " + what);
    }

    // An id that is closed when it goes out of scope. A negative id means that opening failed.
    class Id
    {
    public:
      Id(const hid_t id, herr_t (*close)(hid_t))
          : id(id),
            close(close)
      {}
      ~Id()
      {
        if (id >= 0)
          close(id);
      }
      Id(const Id &)            = delete;
      Id &operator=(const Id &) = delete;
          operator hid_t() const { return id; }

    private:
      hid_t id;
      herr_t (*close)(hid_t);
    };

    // Errors become exceptions. The library must not print them a second time.
    inline void silence()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    inline std::size_t product(const std::vector<std::size_t> &extents)
    {
      return std::accumulate(extents.begin(), extents.end(), std::size_t(1), std::multiplies<>());
    }
  } // namespace hdf5_library
} // namespace diptych::discrete
