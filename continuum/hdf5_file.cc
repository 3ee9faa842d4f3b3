// diptych: the stages of the continuum panel in HDF5
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include <hdf5.h>

#include "continuum/output.h"

namespace diptych::continuum
{
  namespace
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
          throw std::runtime_error("HDF5: cannot open or create " + what);
      }
      ~Id() { close(id); }
      Id(const Id &)            = delete;
      Id &operator=(const Id &) = delete;
          operator hid_t() const { return id; }

    private:
      hid_t id;
      herr_t (*close)(hid_t);
    };

    void require(const herr_t status, const std::string &what)
    {
      if (status < 0)
        throw std::runtime_error("HDF5: cannot read or write " + what);
    }

    hid_t type_of(const double *)
    {
      return H5T_NATIVE_DOUBLE;
    }
    hid_t type_of(const unsigned int *)
    {
      return H5T_NATIVE_UINT;
    }

    template <class T>
    void write(const hid_t parent, const std::string &name, const Extents &extents, const std::vector<T> &values)
    {
      const Id space(H5Screate_simple(extents.size(), extents.data(), nullptr), H5Sclose, "space of " + name);
      const Id links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "property list");
      require(H5Pset_create_intermediate_group(links, 1), name);
      const hid_t type = type_of(values.data());
      const Id    set(H5Dcreate2(parent, name.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT), H5Dclose, name);
      require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
    }

    template <class T> std::vector<T> read(const hid_t parent, const std::string &name)
    {
      const Id       set(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, name);
      const Id       space(H5Dget_space(set), H5Sclose, "space of " + name);
      std::vector<T> values(H5Sget_simple_extent_npoints(space));
      require(H5Dread(set, type_of(values.data()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
      return values;
    }

    void write_attribute(const hid_t group, const std::string &name, const std::vector<double> &values)
    {
      const hsize_t extent = values.size();
      const Id      space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr), H5Sclose,
                     "space of " + name);
      const Id attribute(H5Acreate2(group, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
      require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data()), name);
    }

    std::vector<double> read_attribute(const hid_t group, const std::string &name)
    {
      const Id            attribute(H5Aopen(group, name.c_str(), H5P_DEFAULT), H5Aclose, name);
      const Id            space(H5Aget_space(attribute), H5Sclose, "space of " + name);
      std::vector<double> values(H5Sget_simple_extent_npoints(space));
      require(H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()), name);
      return values;
    }

    std::string stage_name(const unsigned int stage)
    {
      char name[32];
      std::snprintf(name, sizeof name, "stage_%04u", stage);
      return name;
    }

    // Two components per node, padded by z = 0 as ParaView wants them.
    std::vector<double> padded(const std::vector<Eigen::Vector2d> &vectors)
    {
      std::vector<double> values;
      for (const auto &v : vectors)
        values.insert(values.end(), {v.x(), v.y(), 0.});
      return values;
    }

    std::vector<Eigen::Vector2d> unpadded(const std::vector<double> &values)
    {
      std::vector<Eigen::Vector2d> vectors;
      for (std::size_t i = 0; i + 2 < values.size(); i += 3)
        vectors.emplace_back(values[i], values[i + 1]);
      return vectors;
    }

    std::vector<double> row_major(const Eigen::Matrix3d &m)
    {
      return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
    }

    Eigen::Matrix3d from_row_major(const double *values)
    {
      return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values);
    }

    void write_attributes(const hid_t group, const Snapshot &s)
    {
      write_attribute(group, "axial_strain", {s.axial_strain});
      write_attribute(group, "time", {s.time});
      write_attribute(group, "area", {s.area});
      write_attribute(group, "lower_platen_force", {s.lower_platen_force.x(), s.lower_platen_force.y()});
      write_attribute(group, "upper_platen_force", {s.upper_platen_force.x(), s.upper_platen_force.y()});
      write_attribute(group, "mean_stress", row_major(s.mean_stress));
    }

    void write_cells(const hid_t group, const Snapshot &s)
    {
      const hsize_t             n = s.cells.size();
      std::vector<unsigned int> nodes;
      for (const auto &cell : s.cells)
        nodes.insert(nodes.end(), cell.begin(), cell.end());
      write(group, "cells/nodes", {n, 9}, nodes);

      std::vector<double> stress, strain, area, plastic, zz;
      for (const auto &state : s.cell_state)
        {
          const auto a = row_major(state.stress), b = row_major(state.strain);
          stress.insert(stress.end(), a.begin(), a.end());
          strain.insert(strain.end(), b.begin(), b.end());
          area.push_back(state.area);
          plastic.push_back(state.equivalent_plastic_strain);
          zz.push_back(state.share_zz_not_intermediate);
        }
      write(group, "cells/stress", {n, 3, 3}, stress);
      write(group, "cells/strain", {n, 3, 3}, strain);
      write(group, "cells/area", {n}, area);
      write(group, "cells/equivalent_plastic_strain", {n}, plastic);
      write(group, "cells/share_zz_not_intermediate", {n}, zz);
    }

    void read_cells(const hid_t group, Snapshot &s)
    {
      const auto nodes  = read<unsigned int>(group, "cells/nodes");
      const auto stress = read<double>(group, "cells/stress"), strain = read<double>(group, "cells/strain");
      const auto area = read<double>(group, "cells/area"), plastic = read<double>(group, "cells/equivalent_plastic_strain");
      const auto zz = read<double>(group, "cells/share_zz_not_intermediate");
      const auto n  = area.size();
      if (nodes.size() != 9 * n || stress.size() != 9 * n || strain.size() != 9 * n || plastic.size() != n || zz.size() != n)
        throw std::runtime_error("HDF5: the lists under cells/ differ in length");
      s.cells.resize(n);
      for (std::size_t c = 0; c < n; ++c)
        {
          std::copy_n(nodes.begin() + 9 * c, 9, s.cells[c].begin());
          s.cell_state.push_back({from_row_major(&stress[9 * c]), from_row_major(&strain[9 * c]), area[c], plastic[c], zz[c]});
        }
    }

    Snapshot read_stage(const hid_t group)
    {
      Snapshot s;
      s.axial_strain       = read_attribute(group, "axial_strain").at(0);
      s.time               = read_attribute(group, "time").at(0);
      s.area               = read_attribute(group, "area").at(0);
      const auto lower     = read_attribute(group, "lower_platen_force");
      const auto upper     = read_attribute(group, "upper_platen_force");
      s.lower_platen_force = {lower.at(0), lower.at(1)};
      s.upper_platen_force = {upper.at(0), upper.at(1)};
      const auto stress    = read_attribute(group, "mean_stress");
      s.mean_stress        = from_row_major(&stress.at(8) - 8);
      s.position           = unpadded(read<double>(group, "nodes/position"));
      s.displacement       = unpadded(read<double>(group, "nodes/displacement"));
      s.weight             = read<double>(group, "nodes/weight");
      read_cells(group, s);
      return s;
    }
  } // namespace

  void append_to_hdf5(const std::string &h5_file, const Snapshot &snapshot, const unsigned int stage)
  {
    const std::string temporary = h5_file + ".part";
    if (stage > 0)
      std::filesystem::copy_file(h5_file, temporary, std::filesystem::copy_options::overwrite_existing);
    {
      const Id file(stage > 0 ? H5Fopen(temporary.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                              : H5Fcreate(temporary.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                    H5Fclose, temporary);
      const auto    name = stage_name(stage);
      const Id      group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name);
      const hsize_t n = snapshot.position.size();
      write_attributes(group, snapshot);
      write(group, "nodes/position", {n, 3}, padded(snapshot.position));
      write(group, "nodes/displacement", {n, 3}, padded(snapshot.displacement));
      write(group, "nodes/weight", {n}, snapshot.weight);
      write_cells(group, snapshot);
    }
    std::filesystem::rename(temporary, h5_file);
  }

  std::vector<Snapshot> read_snapshots(const std::string &h5_file)
  {
    if (!std::filesystem::exists(h5_file))
      throw std::runtime_error(h5_file + " does not exist");
    const Id              file(H5Fopen(h5_file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, h5_file);
    std::vector<Snapshot> snapshots;
    for (unsigned int stage = 0; H5Lexists(file, stage_name(stage).c_str(), H5P_DEFAULT) > 0; ++stage)
      try
        {
          const Id group(H5Gopen2(file, stage_name(stage).c_str(), H5P_DEFAULT), H5Gclose, stage_name(stage));
          snapshots.push_back(read_stage(group));
        }
      catch (const std::exception &error)
        {
          throw std::runtime_error(h5_file + ", " + stage_name(stage) + ": " + error.what());
        }
    return snapshots;
  }
} // namespace diptych::continuum
