// diptych: arrays and numbers in an HDF5 file, written whole or not at all, and not believed before they are checked
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  class Hdf5Reader;

  // An HDF5 file in memory; finish() writes it under `path`.part and renames, so that a kill never leaves half a file under the
  // final name, and a full disk is met by a plain write, not within the library, which it would bring down. Arrays carry
  // checksums. Missing groups of a name like "stage_0001/grains/radius" are made on the way. All functions throw
  // std::runtime_error naming file and path.
  class Hdf5Writer
  {
  public:
    explicit Hdf5Writer(const std::string &path);
    // For what is too large to be held in memory twice: the file grows on the disk, in room for `n_bytes` and a little more that
    // is taken beforehand.
    Hdf5Writer(const std::string &path, std::size_t n_bytes);
    ~Hdf5Writer(); // without finish() nothing is written
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
    void attribute(const std::string &object, const std::string &name, double value);
    void attribute(const std::string &object, const std::string &name, const std::vector<double> &values);
    void attribute(const std::string &object, const std::string &name, const std::string &text);
    void copy(const Hdf5Reader &from, const std::string &name); // of a file of ours: a group with all it holds, or one array
    // The same of a file of somebody else's, whose damage the library's own copying would carry into memory: what it holds is
    // read and written. Throws std::invalid_argument where it cannot be read.
    void copy_values(const Hdf5Reader &from, const std::string &name);
    void link(const std::string &name, const std::string &other_file, const std::string &object); // path relative to this file
    void finish();

  private:
    std::string  path_;
    std::int64_t file_    = -1;
    bool         on_disk_ = false;
  };

  // All functions throw std::invalid_argument naming file and object: missing, truncated, damaged (checksum), of another type or
  // shape than asked for, or in another file, where links and arrays may lead: to pipes, devices, what the reader alone may see.
  // Only the stages of a StagedFile are files of their own.
  class Hdf5Reader
  {
  public:
    enum class From
    {
      anybody,
      this_program // numbers of another type than it writes, or without the checksum that it gives them, are refused, too
    };

    explicit Hdf5Reader(const std::string &path, From from = From::anybody);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader &)            = delete;
    Hdf5Reader &operator=(const Hdf5Reader &) = delete;

    bool                         has(const std::string &name) const;          // and all groups on the way
    bool                         is_link(const std::string &name) const;      // into another file
    std::vector<double>          read(const std::string &name) const;         // C order
    std::vector<int>             read_int(const std::string &name) const;     // integers of any width that fit
    std::vector<Eigen::Vector2d> read_vectors(const std::string &name) const; // first two components of (n, 2 or 3)
    std::vector<Eigen::Matrix2d> read_tensors(const std::string &name) const; // in-plane part of (n, 2, 2) or (n, 3, 3)
    std::string                  read_string(const std::string &name) const;
    double                       attribute(const std::string &object, const std::string &name) const;
    std::vector<double>          attributes(const std::string &object, const std::string &name) const; // one or several numbers
    bool                         has_attribute(const std::string &object, const std::string &name) const;
    std::string                  text_attribute(const std::string &object, const std::string &name) const;
    std::vector<std::string>     members(const std::string &group) const; // names, sorted
    std::vector<std::size_t>     extents(const std::string &name) const;
    const std::string           &path() const { return path_; }

  private:
    friend class Hdf5Writer; // copies need the open file
    struct Links;

    std::int64_t link_access() const;                   // how names are followed
    std::int64_t opened(const std::string &name) const; // an array, to be closed
    void         check_numbers(const std::string &name, std::int64_t data, std::size_t n) const;
    void         check_storage_below(const std::string &name) const;
    void         refuse_links(const std::string &name) const;

    std::string            path_;
    std::int64_t           file_ = -1;
    From                   from_;
    bool                   has_checksums_ = false;
    std::unique_ptr<Links> links_; // how names are followed
  };
} // namespace diptych::discrete
