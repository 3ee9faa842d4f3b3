// diptych: HDF5 ids that close themselves, typed arrays, files that are whole or absent
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include <hdf5.h>

namespace diptych::continuum::hdf5
{
  using Extents = std::vector<hsize_t>;

  // An HDF5 id that is closed when it goes out of scope. Opening reports failure by a negative id.
  class Id
  {
  public:
    Id(const hid_t id, herr_t (*close)(hid_t), const std::string &what)
        : id(id),
          close(close)
    {
      if (id < 0)
        throw std::runtime_error("HDF5 cannot open or create " + what);
    }
    ~Id() { close(id); }
    Id(const Id &)            = delete;
    Id &operator=(const Id &) = delete;
        operator hid_t() const { return id; }

  private:
    hid_t id;
    herr_t (*close)(hid_t);
  };

  // Errors are told by exceptions; the library's own print-out would only double them.
  class Silence
  {
  public:
    Silence()
    {
      H5Eget_auto2(H5E_DEFAULT, &print, &data);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Silence() { H5Eset_auto2(H5E_DEFAULT, print, data); }
    Silence(const Silence &)            = delete;
    Silence &operator=(const Silence &) = delete;

  private:
    H5E_auto2_t print = nullptr;
    void       *data  = nullptr;
  };

  inline void require(const bool done, const std::string &what)
  {
    if (!done)
      throw std::runtime_error("HDF5 cannot " + what);
  }

  // clang-format off
  inline hid_t type_of(const double *) { return H5T_NATIVE_DOUBLE; }
  inline hid_t type_of(const unsigned int *) { return H5T_NATIVE_UINT; }
  inline hid_t type_of(const long long *) { return H5T_NATIVE_LLONG; }
  inline hid_t type_of(const char *) { return H5T_NATIVE_CHAR; }
  // clang-format on

  // In pieces of up to 4096 rows with a checksum, so that a damaged file is refused rather than read.
  inline void set_checksum(const hid_t properties, Extents extents)
  {
    if (std::count(extents.begin(), extents.end(), 0u) > 0)
      return;
    extents[0] = std::min<hsize_t>(extents[0], 4096);
    require(H5Pset_chunk(properties, extents.size(), extents.data()) >= 0, "set a chunk size");
    require(H5Pset_fletcher32(properties) >= 0, "set a checksum");
  }

  // `values` in C order with the given extents; missing groups of a name like cells/stress are made on the way.
  template <class T> void write(const hid_t parent, const std::string &name, const Extents &extents, const std::vector<T> &values)
  {
    const Id space(H5Screate_simple(extents.size(), extents.data(), nullptr), H5Sclose, "space of " + name);
    const Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "property list");
    const Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "property list");
    require(H5Pset_create_intermediate_group(links, 1) >= 0, "make the groups of " + name);
    set_checksum(properties, extents);
    const hid_t type = type_of(values.data());
    const Id    set(H5Dcreate2(parent, name.c_str(), type, space, links, properties, H5P_DEFAULT), H5Dclose, name);
    require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, "write " + name);
  }

  // Whether a link stands at a name like cells/stress; every group on the way is asked for, as HDF5 wants it.
  inline bool exists(const hid_t parent, const std::string &name)
  {
    for (std::size_t end = name.find('/'); end != std::string::npos; end = name.find('/', end + 1))
      if (H5Lexists(parent, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
        return false;
    return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0;
  }

  inline hid_t open_dataset(const hid_t parent, const std::string &name)
  {
    if (!exists(parent, name))
      throw std::runtime_error(name + " is missing (a file of another version?)");
    return H5Dopen2(parent, name.c_str(), H5P_DEFAULT);
  }

  inline Extents extents_of(const hid_t parent, const std::string &name)
  {
    const Id set(open_dataset(parent, name), H5Dclose, name);
    const Id space(H5Dget_space(set), H5Sclose, "space of " + name);
    Extents  extents(std::max(0, H5Sget_simple_extent_ndims(space)));
    require(H5Sget_simple_extent_dims(space, extents.data(), nullptr) >= 0, "tell the extents of " + name);
    return extents;
  }

  template <class T> std::vector<T> read(const hid_t parent, const std::string &name)
  {
    const Id       set(open_dataset(parent, name), H5Dclose, name);
    const Id       space(H5Dget_space(set), H5Sclose, "space of " + name);
    std::vector<T> values(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
    require(H5Dread(set, type_of(values.data()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0, "read " + name);
    return values;
  }

  inline void write_attribute(const hid_t group, const std::string &name, const std::vector<double> &values)
  {
    const hsize_t extent = values.size();
    const Id      space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr), H5Sclose,
                   "space of " + name);
    const Id      attribute(H5Acreate2(group, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
    require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()) >= 0, "write " + name);
  }

  inline std::vector<double> read_attribute(const hid_t group, const std::string &name)
  {
    if (H5Aexists(group, name.c_str()) <= 0)
      throw std::runtime_error("attribute " + name + " is missing (a file of another version?)");
    const Id            attribute(H5Aopen(group, name.c_str(), H5P_DEFAULT), H5Aclose, name);
    const Id            space(H5Aget_space(attribute), H5Sclose, "space of " + name);
    std::vector<double> values(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
    require(H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) >= 0, "read " + name);
    return values;
  }

  // An HDF5 file without contents, made in memory.
  inline std::vector<char> empty_image()
  {
    const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "property list");
    require(H5Pset_fapl_core(access, 4096, false) >= 0, "make a file in memory");
    const Id file(H5Fcreate("empty", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "a file in memory");
    require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "make a file in memory");
    std::vector<char> image(std::max<ssize_t>(0, H5Fget_file_image(file, nullptr, 0)));
    require(H5Fget_file_image(file, image.data(), image.size()) > 0, "make a file in memory");
    return image;
  }

  // Enlarges the file by n_bytes that exist on the disk.
  inline void reserve(const std::string &name, const std::size_t n_bytes)
  {
    const int descriptor = ::open(name.c_str(), O_WRONLY);
    const int error      = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, std::filesystem::file_size(name) + n_bytes);
    if (descriptor >= 0)
      ::close(descriptor);
    if (error != 0)
      throw std::system_error(error, std::generic_category(), "no room for " + std::to_string(n_bytes) + " bytes");
  }

  // At least what arrays with n_bytes together take in a file: their last pieces are stored whole.
  inline std::size_t room_for(const std::size_t n_bytes)
  {
    return 2 * n_bytes + (1 << 20);
  }

  enum class Start
  {
    empty,
    with_old_contents
  };

  // Calls body(file) on an open temporary file and renames it. The room it may need is reserved before, because HDF5 1.10 ends
  // the program with a segmentation fault once a file could not be closed on a full disk; what is left over is cut off when the
  // file is closed. Throws std::runtime_error naming the file.
  template <class Body> void write_file(const std::string &name, const Start start, const std::size_t room, Body &&body)
  {
    const Silence     silence;
    const std::string temporary = name + ".part";
    try
      {
        if (start == Start::with_old_contents)
          std::filesystem::copy_file(name, temporary, std::filesystem::copy_options::overwrite_existing);
        else
          {
            const std::vector<char> image = empty_image();
            std::ofstream           stream(temporary, std::ios::binary);
            if (!stream.write(image.data(), image.size()).flush())
              throw std::runtime_error("cannot write " + temporary);
          }
        const std::size_t limit = std::filesystem::file_size(temporary) + room;
        reserve(temporary, room);
        {
          const Id file(H5Fopen(temporary.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, temporary);
          body(hid_t(file));
          require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0, "flush " + temporary);
        }
        assert(std::filesystem::file_size(temporary) <= limit);
        (void)limit;
        std::filesystem::rename(temporary, name);
      }
    catch (const std::exception &error)
      {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw std::runtime_error("cannot write " + name + ": " + error.what());
      }
  }

  // Returns body(file) of a file opened for reading. Throws std::runtime_error naming the file.
  template <class Body> auto read_file(const std::string &name, Body &&body)
  {
    const Silence silence;
    if (!std::filesystem::exists(name))
      throw std::runtime_error(name + " does not exist");
    try
      {
        const Id file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "it: cut short, damaged or no HDF5 file");
        return body(hid_t(file));
      }
    catch (const std::exception &error)
      {
        throw std::runtime_error(name + ": " + error.what());
      }
  }
} // namespace diptych::continuum::hdf5
