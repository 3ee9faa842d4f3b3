// diptych: arrays and numbers in an HDF5 file, written whole or not at all
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/hdf5_file.h"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include <hdf5.h>

namespace diptych::discrete
{
  namespace
  {
    [[noreturn]] void fail(const std::string &what, const std::string &path, const std::string &name)
    {
      throw std::runtime_error("HDF5: cannot " + what + " '" + name + "' in " + path);
    }

    // Errors are reported as exceptions; the library's own print-out would only double them.
    void silence()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    std::size_t product(const std::vector<std::size_t> &extents)
    {
      return std::accumulate(extents.begin(), extents.end(), std::size_t(1), std::multiplies<>());
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
      const hid_t                space  = H5Screate_simple(int(dimensions.size()), dimensions.data(), nullptr);
      const hid_t                groups = H5Pcreate(H5P_LINK_CREATE);
      H5Pset_create_intermediate_group(groups, 1);
      const hid_t data = H5Dcreate2(file, name.c_str(), type, space, groups, H5P_DEFAULT, H5P_DEFAULT);
      const bool  good = data >= 0 && (n_values == 0 || H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
      if (data >= 0)
        H5Dclose(data);
      H5Pclose(groups);
      H5Sclose(space);
      if (!good)
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

    bool write_attribute(const hid_t file, const std::string &group, const std::string &name, const hid_t type, const void *value)
    {
      make_group(file, group);
      const hid_t space     = H5Screate(H5S_SCALAR);
      const hid_t attribute = H5Acreate_by_name(file, group.c_str(), name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT,
                                                H5P_DEFAULT);
      const bool  good      = attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
      if (attribute >= 0)
        H5Aclose(attribute);
      H5Sclose(space);
      return good;
    }

    // Up to the first closing zero, which null-padded strings lack.
    std::string text_of(const std::vector<char> &characters)
    {
      return {characters.begin(), std::find(characters.begin(), characters.end(), '\0')};
    }
  } // namespace

  Hdf5Writer::Hdf5Writer(const std::string &path)
      : path_(path)
  {
    silence();
    file_ = H5Fcreate((path_ + ".part").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    if (file_ < 0)
      fail("create the file", path_, "/");
  }

  Hdf5Writer::~Hdf5Writer()
  {
    if (file_ < 0)
      return;
    H5Fclose(file_);
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
    const hid_t type = string_type(text);
    write_array(file_, path_, name, type, text.c_str(), 1, {});
    H5Tclose(type);
  }

  void Hdf5Writer::attribute(const std::string &group, const std::string &name, const double value)
  {
    if (!write_attribute(file_, group, name, H5T_NATIVE_DOUBLE, &value))
      fail("write attribute " + name + " of", path_, group);
  }

  void Hdf5Writer::attribute(const std::string &group, const std::string &name, const std::string &text)
  {
    const hid_t type = string_type(text);
    const bool  good = write_attribute(file_, group, name, type, text.c_str());
    H5Tclose(type);
    if (!good)
      fail("write attribute " + name + " of", path_, group);
  }

  void Hdf5Writer::copy(const Hdf5Reader &from, const std::string &name)
  {
    if (H5Ocopy(from.file_, name.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
      fail("copy from " + from.path_ + " the object", path_, name);
  }

  void Hdf5Writer::finish()
  {
    const bool closed = H5Fclose(file_) >= 0;
    file_             = -1;
    if (!closed || std::rename((path_ + ".part").c_str(), path_.c_str()) != 0)
      fail("finish the file", path_, "/");
  }

  Hdf5Reader::Hdf5Reader(const std::string &path)
      : path_(path)
  {
    silence();
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0)
      fail("open the file (missing, truncated or no HDF5 file?)", path_, "/");
  }

  Hdf5Reader::~Hdf5Reader()
  {
    H5Fclose(file_);
  }

  bool Hdf5Reader::has(const std::string &name) const
  {
    return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
  }

  std::vector<std::size_t> Hdf5Reader::extents(const std::string &name) const
  {
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (data < 0)
      fail("find", path_, name);
    const hid_t          space = H5Dget_space(data);
    std::vector<hsize_t> dimensions(H5Sget_simple_extent_ndims(space));
    H5Sget_simple_extent_dims(space, dimensions.data(), nullptr);
    H5Sclose(space);
    H5Dclose(data);
    return {dimensions.begin(), dimensions.end()};
  }

  std::vector<double> Hdf5Reader::read(const std::string &name) const
  {
    std::vector<double> values(product(extents(name)));
    const hid_t         data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    const bool good = values.empty() || H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
    H5Dclose(data);
    if (!good)
      fail("read", path_, name);
    return values;
  }

  std::vector<int> Hdf5Reader::read_int(const std::string &name) const
  {
    const std::vector<double> values = read(name);
    return {values.begin(), values.end()};
  }

  std::vector<Eigen::Vector2d> Hdf5Reader::read_vectors(const std::string &name) const
  {
    const std::vector<std::size_t> shape = extents(name);
    if (shape.size() != 2 || shape[1] < 2)
      fail("read vectors from", path_, name);
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
      fail("read tensors from", path_, name);
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
    const hid_t data = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (data < 0)
      fail("find", path_, name);
    const hid_t       type  = H5Dget_type(data);
    const bool        fixed = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0 && product(extents(name)) == 1;
    std::vector<char> characters(H5Tget_size(type));
    const bool        good = fixed && H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()) >= 0;
    H5Tclose(type);
    H5Dclose(data);
    if (!good)
      fail("read one string of fixed length from", path_, name);
    return text_of(characters);
  }

  std::vector<std::string> Hdf5Reader::members(const std::string &group) const
  {
    const hid_t id = H5Gopen2(file_, group.c_str(), H5P_DEFAULT);
    if (id < 0)
      fail("find the group", path_, group);
    std::vector<std::string> names;
    const auto               collect = [](hid_t, const char *name, const H5L_info_t *, void *to) -> herr_t {
      static_cast<std::vector<std::string> *>(to)->push_back(name);
      return 0;
    };
    const bool good = H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names) >= 0;
    H5Gclose(id);
    if (!good)
      fail("list the group", path_, group);
    return names;
  }

  double Hdf5Reader::attribute(const std::string &group, const std::string &name) const
  {
    const hid_t attribute = H5Aopen_by_name(file_, group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
    double      value     = 0;
    const bool  good      = attribute >= 0 && H5Aread(attribute, H5T_NATIVE_DOUBLE, &value) >= 0;
    if (attribute >= 0)
      H5Aclose(attribute);
    if (!good)
      fail("read attribute " + name + " of", path_, group);
    return value;
  }
} // namespace diptych::discrete
