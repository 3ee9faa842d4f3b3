// diptych: arrays and numbers in an HDF5 file: complete when written, checked when read
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

  // Builds an HDF5 file in memory; finish() writes it under `path`.part and renames it. So a killed program never leaves half a
  // file under the final name. A full disk also fails in our write and not within the library, which would crash. Arrays have
  // checksums. Missing groups of a name like "stage_0001/grains/radius" are made. All functions throw std::runtime_error with
  // file and name.
  class Hdf5Writer
  {
  public:
    explicit Hdf5Writer(const std::string &path);
    // For data too large to be in memory twice. The file grows on the disk; space for a little more than `n_bytes` is reserved
    // first.
    Hdf5Writer(const std::string &path, std::size_t n_bytes);
    ~Hdf5Writer(); // without finish() nothing is written
    Hdf5Writer(const Hdf5Writer &)            = delete;
    Hdf5Writer &operator=(const Hdf5Writer &) = delete;

    // Writes `values` in C order with the given extents.
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
    void copy(const Hdf5Reader  &from,
              const std::string &name); // a group with its contents, or one array, from a file of this program
    // As copy(), from a file of another program, which may be damaged. Reads and writes each array, because copying within the
    // library could corrupt memory. Throws std::invalid_argument if an array cannot be read.
    void copy_values(const Hdf5Reader &from, const std::string &name);
    void link(const std::string &name, const std::string &other_file, const std::string &object); // path relative to this file
    void finish();

  private:
    std::string  path_;
    std::int64_t file_    = -1;
    bool         on_disk_ = false;
  };

  // Functions throw std::invalid_argument with file and object if it is missing, truncated, damaged (checksum), or has a wrong
  // type or shape. They refuse objects in another file, because a link may lead to a pipe, a device or a private file. Only the
  // stages of a StagedFile may be in separate files.
  class Hdf5Reader
  {
  public:
    enum class From
    {
      anybody,
      this_program // also refuses numbers of a type that this program does not write, or without its checksum
    };

    explicit Hdf5Reader(const std::string &path, From from = From::anybody);
    ~Hdf5Reader();
    Hdf5Reader(const Hdf5Reader &)            = delete;
    Hdf5Reader &operator=(const Hdf5Reader &) = delete;

    bool                         has(const std::string &name) const;          // false also if a group of the name is missing
    bool                         is_link(const std::string &name) const;      // a link into another file
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

    std::int64_t link_access() const;                   // access list that restricts external links
    std::int64_t opened(const std::string &name) const; // opens an array, which the caller closes
    void         check_numbers(const std::string &name, std::int64_t data, std::size_t n) const;
    void         check_storage_below(const std::string &name) const;
    void         refuse_links(const std::string &name) const;

    std::string            path_;
    std::int64_t           file_ = -1;
    From                   from_;
    bool                   has_checksums_ = false;
    std::unique_ptr<Links> links_; // files to which links may lead
  };
} // namespace diptych::discrete
