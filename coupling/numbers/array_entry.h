// diptych: description of each array of a result, and a writer of arrays to HDF5
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "coupling/numbers/number_entry.h"
#include "discrete/files/hdf5_file.h"

namespace diptych::coupling
{
  // Each type with public arrays has a function beside it, template <class Visit> void list_...(what, Visit &&visit). It calls
  // visit(ArrayEntry{...}, values) for each array. values are numbers, vectors or tensors, rows of integers (std::array) or rows
  // of numbers (std::vector).
  struct ArrayEntry
  {
    const char *key;   // name of the dataset, and of the array in a .vtu file
    const char *title; // short text for a figure
    const char *unit, *meaning;
  };

  // Writes listed arrays below a group, and listed numbers (NumberEntry) as attributes of the group.
  struct IntoGroup
  {
    discrete::Hdf5Writer &file;
    std::string           group;

    template <class T> void operator()(const ArrayEntry &entry, const std::vector<T> &values) const
    {
      write(path(entry), values);
      file.attribute(path(entry), "title", entry.title);
      file.attribute(path(entry), "unit", entry.unit);
      file.attribute(path(entry), "meaning", entry.meaning);
    }
    void operator()(const NumberEntry &entry, const double value) const { file.attribute(group, entry.key, value); }
    void operator()(const NumberEntry &entry, const std::string &text) const { file.attribute(group, entry.key, text); }
    void operator()(const NumberEntry &entry, const Eigen::Vector2d &value) const
    {
      file.attribute(group, entry.key, std::vector<double>{value.x(), value.y()});
    }

  private:
    std::string path(const ArrayEntry &entry) const { return (group == "/" ? "" : group + "/") + entry.key; }

    template <class T> void write(const std::string &name, const std::vector<T> &values) const
    {
      file.write(name, values); // plane vectors and tensors
    }
    template <class Whole, std::size_t n> void write(const std::string &name, const std::vector<std::array<Whole, n>> &rows) const
    {
      std::vector<int> all;
      for (const auto &row : rows)
        all.insert(all.end(), row.begin(), row.end());
      file.write(name, all, {rows.size(), n});
    }
    void write(const std::string &name, const std::vector<std::vector<double>> &rows) const
    {
      std::vector<double> all;
      for (const std::vector<double> &row : rows)
        all.insert(all.end(), row.begin(), row.end());
      file.write(name, all, {rows.size(), rows.empty() ? 0 : rows.front().size()});
    }
  };
} // namespace diptych::coupling
