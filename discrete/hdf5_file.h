// diptych: arrays and numbers in an HDF5 file, written whole or not at all
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  // Writes under `path`.part and renames in finish(), so that a kill never leaves half a file under the final name.
  // Missing groups of a path like "stage_0001/grains/radius" are made on the way. All functions throw
  // std::runtime_error naming file and path.
  class Hdf5Reader;

  class Hdf5Writer
  {
  public:
    explicit Hdf5Writer(const std::string &path);
    ~Hdf5Writer(); // an unfinished file is removed
    Hdf5Writer(const Hdf5Writer &)            = delete;
    Hdf5Writer &operator=(const Hdf5Writer &) = delete;

    // `values` in C order with the given extents.
    void write(const std::string &name, const std::vector<double> &values, const std::vector<std::size_t> &extents);
    void write(const std::string &name, const std::vector<int> &values, const std::vector<std::size_t> &extents);
    void write(const std::string &name, const std::vector<double> &values); // (n)
    void write(const std::string &name, const std::vector<int> &values);
    void write(const std::string &name, const std::vector<Eigen::Vector2d> &values, std::size_t components = 2); // (n, 2 or 3)
    void write(const std::string                  &name,
               const std::vector<Eigen::Matrix2d> &values,
               std::size_t                         components = 2);                              // (n, 2, 2 or 3, 3)
    void write_string(const std::string &name, const std::string &text); // scalar, fixed length
    void attribute(const std::string &group, const std::string &name, double value);
    void attribute(const std::string &group, const std::string &name, const std::string &text);
    void copy(const Hdf5Reader &from, const std::string &name); // a group with all it holds, or one array
    void finish();

  private:
    std::string  path_;
    std::int64_t file_ = -1;
  };

  class Hdf5Reader
  {
  public:
    explicit Hdf5Reader(const std::string &path);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader &)            = delete;
    Hdf5Reader &operator=(const Hdf5Reader &) = delete;

    bool                         has(const std::string &name) const;
    std::vector<double>          read(const std::string &name) const; // C order
    std::vector<int>             read_int(const std::string &name) const;
    std::vector<Eigen::Vector2d> read_vectors(const std::string &name) const; // first two components of (n, 2 or 3)
    std::vector<Eigen::Matrix2d> read_tensors(const std::string &name) const; // in-plane part of (n, 2, 2) or (n, 3, 3)
    std::string                  read_string(const std::string &name) const;
    double                       attribute(const std::string &group, const std::string &name) const;
    std::vector<std::string>     members(const std::string &group) const; // names, sorted

  private:
    friend class Hdf5Writer; // copy() needs the open file

    std::vector<std::size_t> extents(const std::string &name) const;

    std::string  path_;
    std::int64_t file_ = -1;
  };
} // namespace diptych::discrete
