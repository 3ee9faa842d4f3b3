// diptych: arrays and numbers of an HDF5 file, checked before use
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/hdf5_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "discrete/files/hdf5_library.h"
#include "discrete/files/text_file.h"

namespace diptych::discrete
{
  using namespace hdf5_library;

  // The library asks here whether it may follow a name out of the file.
  struct Hdf5Reader::Links
  {
    explicit Links(const std::string &path)
        : path(path),
          access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose)
    {
      const auto follow = [](const char *parent, const char *, const char *child, const char *, unsigned *, hid_t, void *links) {
        return static_cast<Links *>(links)->is_own(parent, child) ? herr_t(0) : herr_t(-1);
      };
      if (H5Pset_elink_cb(access, follow, this) < 0)
        throw std::runtime_error("HDF5: links cannot be watched");
    }

    // A stage of this file, as StagedFile links it. Links inside a stage are not followed.
    bool is_own(const std::string &parent, const std::string &child)
    {
      namespace fs           = std::filesystem;
      const fs::path stage   = child;
      const bool     is_near = stage.parent_path() == fs::path(path).stem() && stage.filename().string().rfind("stage_", 0) == 0;
      refused                = child;
      if (parent != path || !is_near)
        return false;
      try
        {
          require_regular_file((fs::path(path).parent_path() / stage).string());
        }
      catch (const std::exception &) // an exception must not cross the C library
        {
          return false;
        }
      refused.clear();
      return true;
    }

    std::string path, refused;
    Id          access;
  };

  namespace
  {
    // True if the file has the format whose arrays carry checksums; earlier versions wrote another one.
    bool is_of_format_110(const hid_t file)
    {
      constexpr unsigned super_block_of_110 = 3;
      H5F_info2_t        info{};
      return H5Fget_info2(file, &info) >= 0 && info.super.version >= super_block_of_110;
    }

    bool is_in_its_file(const hid_t data)
    {
      const Id properties(H5Dget_create_plist(data), H5Pclose);
      return properties >= 0 && H5Pget_layout(properties) != H5D_VIRTUAL && H5Pget_external_count(properties) == 0;
    }

    bool is_scalar(const hid_t data)
    {
      const Id space(H5Dget_space(data), H5Sclose);
      return H5Sget_simple_extent_ndims(space) == 0;
    }

    bool has_checksum(const hid_t data)
    {
      const Id     properties(H5Dget_create_plist(data), H5Pclose);
      unsigned     flags = 0;
      std::size_t  n     = 0;
      unsigned int config;
      return H5Pget_filter_by_id2(properties, H5Z_FILTER_FLETCHER32, &flags, &n, nullptr, 0, nullptr, &config) >= 0;
    }

    // Up to the first closing zero, which null-padded strings lack.
    std::string text_of(const std::vector<char> &characters)
    {
      return {characters.begin(), std::find(characters.begin(), characters.end(), '\0')};
    }

    // Whole bytes in a usual order. The library converts other numbers bit by bit at offsets from the file, perhaps beyond its
    // own memory.
    bool is_number(const hid_t type)
    {
      const hid_t usual[] = {H5T_IEEE_F64LE, H5T_IEEE_F64BE, H5T_IEEE_F32LE, H5T_IEEE_F32BE, H5T_STD_I64LE,
                             H5T_STD_I64BE,  H5T_STD_U64LE,  H5T_STD_U64BE,  H5T_STD_I32LE,  H5T_STD_I32BE,
                             H5T_STD_U32LE,  H5T_STD_U32BE,  H5T_STD_I16LE,  H5T_STD_I16BE,  H5T_STD_U16LE,
                             H5T_STD_U16BE,  H5T_STD_I8LE,   H5T_STD_I8BE,   H5T_STD_U8LE,   H5T_STD_U8BE};
      return std::any_of(std::begin(usual), std::end(usual), [&](const hid_t one) { return H5Tequal(type, one) > 0; });
    }
  } // namespace

  Hdf5Reader::Hdf5Reader(const std::string &path, const From from)
      : path_(path),
        from_(from)
  {
    require_regular_file(path);
    silence();
    links_ = std::make_unique<Links>(path);
    file_  = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0)
      throw std::invalid_argument(path + ": is missing, truncated or not an HDF5 file");
    has_checksums_ = is_of_format_110(file_);
  }

  Hdf5Reader::~Hdf5Reader()
  {
    H5Fclose(file_);
  }

  std::int64_t Hdf5Reader::link_access() const
  {
    return links_->access;
  }

  void Hdf5Reader::refuse_links(const std::string &name) const
  {
    if (!links_->refused.empty())
      refuse(path_, name, "is in another file, '" + links_->refused + "'; links into other files are not followed");
  }

  bool Hdf5Reader::has(const std::string &name) const
  {
    const auto is_there = [&](const std::string &object) {
      const bool found = H5Lexists(file_, object.c_str(), links_->access) > 0;
      refuse_links(object);
      return found;
    };
    for (std::size_t end = name.find('/', 1); end != std::string::npos; end = name.find('/', end + 1))
      if (!is_there(name.substr(0, end)))
        return false;
    return is_there(name);
  }

  bool Hdf5Reader::is_link(const std::string &name) const
  {
    H5L_info_t info;
    return H5Lget_info(file_, name.c_str(), &info, links_->access) >= 0 && info.type == H5L_TYPE_EXTERNAL;
  }

  std::int64_t Hdf5Reader::opened(const std::string &name) const
  {
    const hid_t data = H5Dopen2(file_, name.c_str(), links_->access);
    if (data < 0)
      {
        refuse_links(name);
        refuse(path_, name, "is missing or no array (a file of another version?)");
      }
    if (!is_in_its_file(data))
      {
        H5Dclose(data);
        refuse(path_, name, "has its numbers in other files, which are not read");
      }
    return data;
  }

  // Checks one array, or every array of a group.
  void Hdf5Reader::check_storage_below(const std::string &name) const
  {
    const auto look = [](hid_t object, const char *below, const H5O_info_t *info, void *) -> herr_t {
      if (info->type != H5O_TYPE_DATASET)
        return 0;
      const Id data(H5Oopen(object, below, H5P_DEFAULT), H5Oclose);
      return data >= 0 && is_in_its_file(data) ? 0 : -1;
    };
    const herr_t looked = H5Ovisit_by_name2(file_, name.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, look, nullptr, H5O_INFO_BASIC,
                                            links_->access);
    refuse_links(name);
    if (looked < 0)
      refuse(path_, name, "cannot be read: damaged, or its numbers are in other files");
  }

  std::vector<std::size_t> Hdf5Reader::extents(const std::string &name) const
  {
    const Id             data(opened(name), H5Dclose), space(H5Dget_space(data), H5Sclose);
    std::vector<hsize_t> dimensions(std::size_t(std::max(0, H5Sget_simple_extent_ndims(space))));
    if (H5Sget_simple_extent_dims(space, dimensions.data(), nullptr) < 0)
      refuse(path_, name, "has no extents");
    return {dimensions.begin(), dimensions.end()};
  }

  // Throws unless the data are numbers, and no more than the file can hold.
  void Hdf5Reader::check_numbers(const std::string &name, const std::int64_t data, const std::size_t n) const
  {
    constexpr double largest_compression = 1100; // of deflate, and a little
    const Id         type(H5Dget_type(data), H5Tclose);
    if (!is_number(type))
      refuse(path_, name, "holds no numbers, or none of a usual type (integers of 8 to 64 bits, floats of 32 or 64)");
    if (from_ == From::this_program && H5Tequal(type, H5T_IEEE_F64LE) <= 0 && H5Tequal(type, H5T_STD_I32LE) <= 0)
      refuse(path_, name, "holds numbers of another type than this program writes");
    if (from_ == From::this_program && has_checksums_ && n > 0 && !is_scalar(data) && !has_checksum(data))
      refuse(path_, name, "has no checksum: this program has not written it");
    if (n > 0 && H5Dget_storage_size(data) == 0)
      refuse(path_, name, "was never written");
    if (double(n) * double(H5Tget_size(type)) > largest_compression * double(H5Dget_storage_size(data)))
      refuse(path_, name, "claims " + std::to_string(n) + " numbers, more than the file holds");
  }

  std::vector<double> Hdf5Reader::read(const std::string &name) const
  {
    const std::size_t n = product(extents(name));
    const Id          data(opened(name), H5Dclose);
    check_numbers(name, data, n);
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
    const Id          data(opened(name), H5Dclose), type(H5Dget_type(data), H5Tclose);
    const bool        fixed = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0 && product(extents(name)) == 1;
    std::vector<char> characters(fixed ? H5Tget_size(type) : 0);
    if (!fixed || H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()) < 0)
      refuse(path_, name, "is not one string of fixed length");
    return text_of(characters);
  }

  std::vector<std::string> Hdf5Reader::members(const std::string &group) const
  {
    const Id id(H5Oopen(file_, group.c_str(), links_->access), H5Oclose);
    refuse_links(group);
    if (id < 0 || H5Iget_type(id) != H5I_GROUP)
      refuse(path_, group, "is missing or no group");
    std::vector<std::string> names;
    const auto               collect = [](hid_t, const char *name, const H5L_info_t *, void *to) -> herr_t {
      static_cast<std::vector<std::string> *>(to)->push_back(name);
      return 0;
    };
    // Native order, because for the order of names the library makes a table, and in a damaged group it frees entries that it
    // never filled.
    if (H5Literate(id, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &names) < 0)
      refuse(path_, group, "cannot be listed: damaged");
    std::sort(names.begin(), names.end());
    return names;
  }

  bool Hdf5Reader::has_attribute(const std::string &object, const std::string &name) const
  {
    const bool found = H5Aexists_by_name(file_, object.c_str(), name.c_str(), links_->access) > 0;
    refuse_links(object);
    return found;
  }

  std::vector<double> Hdf5Reader::attributes(const std::string &object, const std::string &name) const
  {
    const Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, links_->access), H5Aclose);
    refuse_links(object);
    if (attribute < 0)
      refuse(path_, object, "has no attribute " + name + " (a file of another version?)");
    const Id            space(H5Aget_space(attribute), H5Sclose), type(H5Aget_type(attribute), H5Tclose);
    std::vector<double> values(std::size_t(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space))));
    if (!is_number(type) || H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0)
      refuse(path_, object, "has an attribute " + name + " that holds no numbers, or none of a usual type");
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
    const Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, links_->access), H5Aclose);
    refuse_links(object);
    const Id          type(attribute < 0 ? -1 : H5Aget_type(attribute), H5Tclose);
    const Id          space(attribute < 0 ? -1 : H5Aget_space(attribute), H5Sclose);
    const bool        is_one = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
    const bool        fixed  = type >= 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0;
    std::vector<char> characters(fixed && is_one ? H5Tget_size(type) : 0);
    if (characters.empty() || H5Aread(attribute, type, characters.data()) < 0)
      refuse(path_, object, "has no attribute " + name + " that is a text");
    return text_of(characters);
  }
} // namespace diptych::discrete
