// diptych: arrays and numbers in an HDF5 file, written whole or not at all, and not believed before they are checked
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

#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  namespace
  {
    [[noreturn]] void fail(const std::string &what, const std::string &path, const std::string &name)
    {
      throw std::runtime_error("HDF5: cannot " + what + " '" + name + "' in " + path);
    }

    [[noreturn]] void refuse(const std::string &path, const std::string &name, const std::string &what)
    {
      throw std::invalid_argument(path + ": '" + name + "' " + what);
    }

    // An id that is closed when it goes out of scope; opening reports failure by a negative one.
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

    // Errors are reported as exceptions; the library's own print-out would only double them.
    void silence()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    std::size_t product(const std::vector<std::size_t> &extents)
    {
      return std::accumulate(extents.begin(), extents.end(), std::size_t(1), std::multiplies<>());
    }

    // In pieces of up to 4096 rows with a checksum, so that a damaged file is refused rather than read. Scalars and empty arrays
    // have no pieces.
    bool set_checksum(const hid_t properties, std::vector<hsize_t> extents)
    {
      if (extents.empty() || std::count(extents.begin(), extents.end(), 0u) > 0)
        return true;
      extents[0] = std::min<hsize_t>(extents[0], 4096);
      return H5Pset_chunk(properties, int(extents.size()), extents.data()) >= 0 && H5Pset_fletcher32(properties) >= 0;
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
      const Id groups(H5Pcreate(H5P_LINK_CREATE), H5Pclose), properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
      H5Pset_create_intermediate_group(groups, 1);
      if (!set_checksum(properties, dimensions))
        fail("set a checksum for", path, name);
      const Id data(H5Dcreate2(file, name.c_str(), type, space, groups, properties, H5P_DEFAULT), H5Dclose);
      if (data < 0 || (n_values > 0 && H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
        fail("write", path, name);
    }

    // A string type of fixed length that holds `text` and its closing zero.
    hid_t string_type(const std::string &text)
    {
      const hid_t type = H5Tcopy(H5T_C_S1);
      H5Tset_size(type, text.size() + 1);
      return type;
    }

    void make_group(const hid_t file, const std::string &group)
    {
      if (group != "/" && H5Lexists(file, group.c_str(), H5P_DEFAULT) <= 0)
        H5Gclose(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
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

    // Up to the first closing zero, which null-padded strings lack.
    std::string text_of(const std::vector<char> &characters)
    {
      return {characters.begin(), std::find(characters.begin(), characters.end(), '\0')};
    }

    hid_t file_in_memory(const std::string &name)
    {
      constexpr std::size_t increment = 1 << 20;
      const Id              access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      if (H5Pset_fapl_core(access, increment, /* backing store */ 0) < 0)
        return -1;
      return H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
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
    const std::string part = path + ".part";
    {
      const Id file(H5Fcreate(part.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
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
      file_ = H5Fopen(part.c_str(), H5F_ACC_RDWR, H5P_DEFAULT); // closing cuts off what is left over
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
    write_text(path_, image);
  }

  Hdf5Reader::Hdf5Reader(const std::string &path)
      : path_(path)
  {
    silence();
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0)
      throw std::invalid_argument(path + ": cannot be opened: missing, truncated or no HDF5 file");
  }

  Hdf5Reader::~Hdf5Reader()
  {
    H5Fclose(file_);
  }

  bool Hdf5Reader::has(const std::string &name) const
  {
    for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
      if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0)
        return false;
    return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
  }

  bool Hdf5Reader::is_link(const std::string &name) const
  {
    H5L_info_t info;
    return H5Lget_info(file_, name.c_str(), &info, H5P_DEFAULT) >= 0 && info.type == H5L_TYPE_EXTERNAL;
  }

  namespace
  {
    hid_t opened(const hid_t file, const std::string &path, const std::string &name)
    {
      const hid_t data = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
      if (data < 0)
        refuse(path, name, "is missing or no array (a file of another version?)");
      return data;
    }

    bool is_number(const hid_t type)
    {
      const H5T_class_t kind = H5Tget_class(type);
      return kind == H5T_FLOAT || kind == H5T_INTEGER;
    }
  } // namespace

  std::vector<std::size_t> Hdf5Reader::extents(const std::string &name) const
  {
    const Id             data(opened(file_, path_, name), H5Dclose), space(H5Dget_space(data), H5Sclose);
    std::vector<hsize_t> dimensions(std::size_t(std::max(0, H5Sget_simple_extent_ndims(space))));
    if (H5Sget_simple_extent_dims(space, dimensions.data(), nullptr) < 0)
      refuse(path_, name, "has no extents");
    return {dimensions.begin(), dimensions.end()};
  }

  std::vector<double> Hdf5Reader::read(const std::string &name) const
  {
    const std::size_t n = product(extents(name));
    const Id          data(opened(file_, path_, name), H5Dclose), type(H5Dget_type(data), H5Tclose);
    if (!is_number(type))
      refuse(path_, name, "holds no numbers");
    if (n > 0 && H5Dget_storage_size(data) == 0)
      refuse(path_, name, "was never written");
    std::vector<double> values(n);
    if (n > 0 && H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      refuse(path_, name, "cannot be read: damaged");
    return values;
  }

  std::vector<int> Hdf5Reader::read_int(const std::string &name) const
  {
    const std::vector<double> values = read(name);
    for (const double value : values)
      if (!(std::abs(value) <= std::numeric_limits<int>::max() && value == std::floor(value)))
        refuse(path_, name, "holds " + std::to_string(value) + ", no whole number in range");
    return {values.begin(), values.end()};
  }

  std::vector<Eigen::Vector2d> Hdf5Reader::read_vectors(const std::string &name) const
  {
    const std::vector<std::size_t> shape = extents(name);
    if (shape.size() != 2 || shape[1] < 2)
      refuse(path_, name, "holds no vectors");
    const std::vector<double>    flat = read(name);
    std::vector<Eigen::Vector2d> vectors(shape[0]);
    for (std::size_t i = 0; i < shape[0]; ++i)
      vectors[i] = {flat[i * shape[1]], flat[i * shape[1] + 1]};
    return vectors;
  }

  std::vector<Eigen::Matrix2d> Hdf5Reader::read_tensors(const std::string &name) const
  {
    const std::vector<std::size_t> shape = extents(name);
    if (shape.size() != 3 || shape[1] < 2 || shape[1] != shape[2])
      refuse(path_, name, "holds no tensors");
    const std::vector<double>    flat = read(name);
    std::vector<Eigen::Matrix2d> tensors(shape[0]);
    for (std::size_t i = 0; i < shape[0]; ++i)
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b)
          tensors[i](a, b) = flat[(i * shape[1] + a) * shape[1] + b];
    return tensors;
  }

  std::string Hdf5Reader::read_string(const std::string &name) const
  {
    const Id          data(opened(file_, path_, name), H5Dclose), type(H5Dget_type(data), H5Tclose);
    const bool        fixed = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0 && product(extents(name)) == 1;
    std::vector<char> characters(fixed ? H5Tget_size(type) : 0);
    if (!fixed || H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()) < 0)
      refuse(path_, name, "is not one string of fixed length");
    return text_of(characters);
  }

  std::vector<std::string> Hdf5Reader::members(const std::string &group) const
  {
    const Id id(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    if (id < 0)
      refuse(path_, group, "is missing or no group");
    std::vector<std::string> names;
    const auto               collect = [](hid_t, const char *name, const H5L_info_t *, void *to) -> herr_t {
      static_cast<std::vector<std::string> *>(to)->push_back(name);
      return 0;
    };
    if (H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) < 0)
      refuse(path_, group, "cannot be listed: damaged");
    return names;
  }

  bool Hdf5Reader::has_attribute(const std::string &object, const std::string &name) const
  {
    return H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
  }

  std::vector<double> Hdf5Reader::attributes(const std::string &object, const std::string &name) const
  {
    const Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (attribute < 0)
      refuse(path_, object, "has no attribute " + name + " (a file of another version?)");
    const Id            space(H5Aget_space(attribute), H5Sclose), type(H5Aget_type(attribute), H5Tclose);
    std::vector<double> values(std::size_t(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
    if (!is_number(type) || H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0)
      refuse(path_, object, "has an attribute " + name + " that holds no numbers");
    return values;
  }

  double Hdf5Reader::attribute(const std::string &object, const std::string &name) const
  {
    const std::vector<double> values = attributes(object, name);
    if (values.size() != 1)
      refuse(path_, object, "has an attribute " + name + " of " + std::to_string(values.size()) + " numbers, not one");
    return values[0];
  }

  std::string Hdf5Reader::text_attribute(const std::string &object, const std::string &name) const
  {
    const Id          attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    const Id          type(attribute < 0 ? -1 : H5Aget_type(attribute), H5Tclose);
    const bool        fixed = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0;
    std::vector<char> characters(fixed ? H5Tget_size(type) : 0);
    if (!fixed || H5Aread(attribute, type, characters.data()) < 0)
      refuse(path_, object, "has no attribute " + name + " that is a text");
    return text_of(characters);
  }
} // namespace diptych::discrete
