// diptych: copies objects of foreign HDF5 files value by value
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "discrete/files/hdf5_file.h"
#include "discrete/files/hdf5_library.h"

namespace diptych::discrete
{
  using namespace hdf5_library;

  namespace
  {
    struct Copy
    {
      hid_t       from, to, links; // `links`: how names of `from` are followed
      std::string from_path, to_path;

      void attributes(const std::string &object) const
      {
        const Id source(H5Oopen(from, object.c_str(), links), H5Oclose),
          target(H5Oopen(to, object.c_str(), H5P_DEFAULT), H5Oclose);
        H5O_info_t info{};
        if (H5Oget_info2(source, &info, H5O_INFO_NUM_ATTRS) < 0)
          refuse(from_path, object, "cannot be read: damaged");
        for (hsize_t k = 0; k < info.num_attrs; ++k)
          {
            const Id attribute(H5Aopen_by_idx(source, ".", H5_INDEX_NAME, H5_ITER_INC, k, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
            char     name[256] = "";
            if (attribute < 0 || H5Aget_name(attribute, sizeof name, name) < 0)
              refuse(from_path, object, "has an attribute that cannot be read: damaged");
            const Id          type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
            std::vector<char> bytes(bytes_of(object, type, space, H5Aget_storage_size(attribute)));
            if (H5Aread(attribute, type, bytes.data()) < 0)
              refuse(from_path, object, "has an attribute " + std::string(name) + " that cannot be read: damaged");
            const Id copy(H5Acreate2(target, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
            if (copy < 0 || H5Awrite(copy, type, bytes.data()) < 0)
              fail("write attribute " + std::string(name) + " of", to_path, object);
            H5Dvlen_reclaim(type, space, H5P_DEFAULT, bytes.data());
          }
      }

      void array(const hid_t source, const std::string &name) const
      {
        const Id          type(H5Dget_type(source), H5Tclose), space(H5Dget_space(source), H5Sclose);
        std::vector<char> bytes(bytes_of(name, type, space, H5Dget_storage_size(source)));
        if (!bytes.empty() && H5Dread(source, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0)
          refuse(from_path, name, "cannot be read: damaged");
        const Id target(H5Dcreate2(to, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
        if (target < 0 || (!bytes.empty() && H5Dwrite(target, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0))
          fail("write", to_path, name);
        if (!bytes.empty())
          H5Dvlen_reclaim(type, space, H5P_DEFAULT, bytes.data());
      }

      std::size_t bytes_of(const std::string &name, const hid_t type, const hid_t space, const hsize_t stored) const
      {
        constexpr double largest_compression = 1100; // of deflate, and a little
        const double     n                   = double(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
        const double     size                = n * double(H5Tget_size(type));
        if (type < 0 || space < 0 || size > largest_compression * double(stored))
          refuse(from_path, name, "claims more than the file holds: damaged or never written");
        return std::size_t(size);
      }
    };
  } // namespace

  void Hdf5Writer::copy_values(const Hdf5Reader &from, const std::string &name)
  {
    const Copy copy{from.file_, file_, from.link_access(), from.path_, path_};
    H5O_info_t info;
    if (H5Oget_info_by_name2(from.file_, name.c_str(), &info, H5O_INFO_BASIC, from.link_access()) < 0)
      {
        from.refuse_links(name);
        refuse(from.path_, name, "cannot be read: damaged");
      }
    if (info.type == H5O_TYPE_GROUP)
      {
        const Id group(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
        if (group < 0)
          fail("make the group", path_, name);
        for (const std::string &member : from.members(name))
          copy_values(from, name + "/" + member);
      }
    else if (info.type == H5O_TYPE_DATASET)
      copy.array(Id(from.opened(name), H5Dclose), name);
    else
      return; // a type by itself holds no values
    copy.attributes(name);
  }
} // namespace diptych::discrete
