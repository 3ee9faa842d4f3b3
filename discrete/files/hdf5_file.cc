// diptych: arrays and numbers in an HDF5 file: complete when written, checked when read
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/hdf5_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

#include <hdf5.h>

#include "discrete/files/hdf5_library.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  using namespace hdf5_library;

  namespace
  {
    // The file format of HDF5 1.10, whose headers, attributes and indices of pieces carry checksums.
    hid_t checked_access()
    {
      const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
      if (access < 0 || H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) < 0)
        throw std::runtime_error("HDF5: the file format of 1.10 is not known");
      return access;
    }

    // Stores an array in pieces of up to 4096 rows, each with a checksum, so that a damaged file is refused. A scalar has no
    // pieces: its header, which has a checksum, holds it unless it is too long.
    bool set_checksum(const hid_t properties, std::vector<hsize_t> extents, const std::size_t n_bytes)
    {
      constexpr std::size_t most_bytes_of_a_header = 60000;
      if (extents.empty())
        return n_bytes > most_bytes_of_a_header || H5Pset_layout(properties, H5D_COMPACT) >= 0;
      if (std::count(extents.begin(), extents.end(), 0u) > 0)
        return true;
      extents[0] = std::min<hsize_t>(extents[0], 4096);
      return H5Pset_chunk(properties, int(extents.size()), extents.data()) >= 0 && H5Pset_fletcher32(properties) >= 0;
    }

    // Objects without times: the same results give the same bytes.
    hid_t without_times(const hid_t object_class)
    {
      const hid_t properties = H5Pcreate(object_class);
      H5Pset_obj_track_times(properties, false);
      return properties;
    }

    // With all groups that contain it.
    void make_group(const hid_t file, const std::string &group)
    {
      const Id properties(without_times(H5P_GROUP_CREATE), H5Pclose);
      for (std::size_t end = group.find('/', 1); !group.empty() && group != "/"; end = group.find('/', end + 1))
        {
          const std::string part = group.substr(0, end);
          if (H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0)
            H5Gclose(H5Gcreate2(file, part.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT));
          if (end == std::string::npos)
            break;
        }
    }

    void write_array(const hid_t                     file,
                     const std::string              &path,
                     const std::string              &name,
                     const hid_t                     type,
                     const void                     *values,
                     const std::size_t               n_values,
                     const std::vector<std::size_t> &extents)
    {
      if (product(extents) != n_values)
        fail("write an array of another size as", path, name);
      const std::vector<hsize_t> dimensions(extents.begin(), extents.end());
      const Id                   space(H5Screate_simple(int(dimensions.size()), dimensions.data(), nullptr), H5Sclose);
      const Id                   properties(without_times(H5P_DATASET_CREATE), H5Pclose);
      make_group(file, name.substr(0, std::max(name.rfind('/') + 1, std::size_t(1)) - 1)); // without '/': none
      if (!set_checksum(properties, dimensions, H5Tget_size(type)))
        fail("set a checksum for", path, name);
      const Id data(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
      if (data < 0 || (n_values > 0 && H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
        fail("write", path, name);
    }

    hid_t string_type(const std::string &text)
    {
      const hid_t type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, text.size() + 1);
      return type;
    }

    void write_attribute(const hid_t        file,
                         const std::string &path,
                         const std::string &object,
                         const std::string &name,
                         const hid_t        type,
                         const hid_t        space,
                         const void        *value)
    {
      make_group(file, object);
      const Id attribute(
        H5Acreate_by_name(file, object.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
      if (attribute < 0 || H5Awrite(attribute, type, value) < 0)
        fail("write attribute " + name + " of", path, object);
    }

    // The checksum of headers: lookup3 of Bob Jenkins (2006, public domain), for a length that is no multiple of 12.
    std::uint32_t lookup3(const unsigned char *bytes, std::size_t length)
    {
      const auto turned = [](const std::uint32_t x, const int k) { return (x << k) | (x >> (32 - k)); };
      const auto word   = [&](const std::size_t k) {
        std::uint32_t value = 0;
        for (std::size_t b = 0; b < 4 && k + b < length; ++b)
          value |= std::uint32_t(bytes[k + b]) << (8 * b);
        return value;
      };
      const auto mix = [&](std::uint32_t &x, std::uint32_t &y, const std::uint32_t z, const int k) {
        x -= y;
        x ^= turned(y, k);
        y += z;
      };
      const auto close = [&](std::uint32_t &x, const std::uint32_t y, const int k) {
        x ^= y;
        x -= turned(y, k);
      };
      std::uint32_t a = 0xdeadbeef + std::uint32_t(length), b = a, c = a;
      const auto    add = [&] {
        a += word(0);
        b += word(4);
        c += word(8);
      };
      for (; length > 12; bytes += 12, length -= 12)
        {
          add();
          mix(a, c, b, 4);
          mix(b, a, c, 6);
          mix(c, b, a, 8);
          mix(a, c, b, 16);
          mix(b, a, c, 19);
          mix(c, b, a, 4);
        }
      add();
      close(c, b, 14);
      close(a, c, 11);
      close(b, a, 25);
      close(c, b, 16);
      close(a, c, 4);
      close(b, a, 14);
      close(c, b, 24);
      return c;
    }

    // Removes the mark of an open file from the first block of an image and renews its checksum.
    void set_first_block(std::string &image)
    {
      constexpr std::size_t n_checked = 44, version_at = 8, mark_at = 11;
      if (image.size() < n_checked + 4 || image[version_at] != 3)
        throw std::logic_error("HDF5 wrote another file format than it was asked for");
      image[mark_at]          = 0;
      const std::uint32_t sum = lookup3(reinterpret_cast<const unsigned char *>(image.data()), n_checked);
      for (std::size_t b = 0; b < 4; ++b)
        image[n_checked + b] = char(sum >> (8 * b));
    }

    hid_t file_in_memory(const std::string &name)
    {
      constexpr std::size_t increment = 1 << 20;
      const Id              access(checked_access(), H5Pclose);
      if (H5Pset_fapl_core(access, increment, /* backing store */ 0) < 0)
        return -1;
      return H5Fcreate(name.c_str(), H5F_ACC_TRUNC, Id(without_times(H5P_FILE_CREATE), H5Pclose), access);
    }
  } // namespace

  Hdf5Writer::Hdf5Writer(const std::string &path)
      : path_(path)
  {
    silence();
    file_ = file_in_memory(path_);
    if (file_ < 0)
      fail("create the file", path_, "/");
  }

  Hdf5Writer::Hdf5Writer(const std::string &path, const std::size_t n_bytes)
      : path_(path),
        on_disk_(true)
  {
    silence();
    const std::string part = temporary_for(path);
    const Id          access(checked_access(), H5Pclose);
    {
      const Id properties(without_times(H5P_FILE_CREATE), H5Pclose);
      const Id file(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, properties, access), H5Fclose);
      if (file < 0)
        fail("create the file", path_, "/");
    }
    // HDF5 1.10 ends the program with a segmentation fault once a file could not be closed on a full disk.
    constexpr std::size_t more       = 1 << 20;
    const int             descriptor = ::open(part.c_str(), O_WRONLY | O_CLOEXEC);
    const int             error      = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, off_t(n_bytes + more));
    if (descriptor >= 0)
      ::close(descriptor);
    if (error == 0)
      file_ = H5Fopen(part.c_str(), H5F_ACC_RDWR, access); // closing cuts off the unused space
    if (file_ < 0)
      {
        std::remove(part.c_str());
        throw std::runtime_error("cannot write " + path_ + ": " + std::strerror(error));
      }
  }

  Hdf5Writer::~Hdf5Writer()
  {
    if (file_ < 0)
      return;
    H5Fclose(file_);
    if (on_disk_)
      std::remove((path_ + ".part").c_str());
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<double> &values, const std::vector<std::size_t> &extents)
  {
    write_array(file_, path_, name, H5T_NATIVE_DOUBLE, values.data(), values.size(), extents);
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<int> &values, const std::vector<std::size_t> &extents)
  {
    write_array(file_, path_, name, H5T_NATIVE_INT, values.data(), values.size(), extents);
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<double> &values)
  {
    write(name, values, {values.size()});
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<int> &values)
  {
    write(name, values, {values.size()});
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<Eigen::Vector2d> &values, const std::size_t components)
  {
    std::vector<double> flat(values.size() * components, 0.);
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a)
        flat[i * components + a] = values[i][a];
    write(name, flat, {values.size(), components});
  }

  void Hdf5Writer::write(const std::string &name, const std::vector<Eigen::Matrix2d> &values, const std::size_t components)
  {
    std::vector<double> flat(values.size() * components * components, 0.);
    for (std::size_t i = 0; i < values.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b)
          flat[(i * components + a) * components + b] = values[i](a, b);
    write(name, flat, {values.size(), components, components});
  }

  void Hdf5Writer::write_string(const std::string &name, const std::string &text)
  {
    const Id type(string_type(text), H5Tclose);
    write_array(file_, path_, name, type, text.c_str(), 1, {});
  }

  void Hdf5Writer::attribute(const std::string &object, const std::string &name, const double value)
  {
    const Id space(H5Screate(H5S_SCALAR), H5Sclose);
    write_attribute(file_, path_, object, name, H5T_NATIVE_DOUBLE, space, &value);
  }

  void Hdf5Writer::attribute(const std::string &object, const std::string &name, const std::vector<double> &values)
  {
    const hsize_t extent = values.size();
    const Id      space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
    write_attribute(file_, path_, object, name, H5T_NATIVE_DOUBLE, space, values.data());
  }

  void Hdf5Writer::attribute(const std::string &object, const std::string &name, const std::string &text)
  {
    const Id type(string_type(text), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    write_attribute(file_, path_, object, name, type, space, text.c_str());
  }

  void Hdf5Writer::copy(const Hdf5Reader &from, const std::string &name)
  {
    from.check_storage_below(name);
    if (H5Ocopy(from.file_, name.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
      fail("copy from " + from.path_ + " the object", path_, name);
  }

  void Hdf5Writer::link(const std::string &name, const std::string &other_file, const std::string &object)
  {
    if (H5Lcreate_external(other_file.c_str(), object.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
      fail("link " + other_file + " as", path_, name);
  }

  void Hdf5Writer::finish()
  {
    if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0)
      fail("finish the file", path_, "/");
    if (on_disk_)
      {
        const bool closed = H5Fclose(file_) >= 0;
        file_             = -1;
        if (!closed || std::rename((path_ + ".part").c_str(), path_.c_str()) != 0)
          fail("finish the file", path_, "/");
        return;
      }
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    std::string   image(std::size_t(std::max<ssize_t>(size, 0)), '\0');
    if (size <= 0 || H5Fget_file_image(file_, image.data(), image.size()) != size)
      fail("finish the file", path_, "/");
    H5Fclose(file_);
    file_ = -1;
    set_first_block(image);
    write_text(path_, image);
  }

} // namespace diptych::discrete
