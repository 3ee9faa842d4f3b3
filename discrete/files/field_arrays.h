// diptych: lists of numbers, vectors, tensors and choices as the arrays of a file
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "discrete/files/hdf5_file.h"

namespace diptych::discrete
{
  // Stored form of one value. Vectors have three components (z = 0), tensors nine, row by row. Counts and choices are whole
  // numbers.
  template <class T> inline constexpr bool is_whole = std::is_integral_v<T> || std::is_enum_v<T>;

  template <class T> constexpr int count_components()
  {
    if constexpr (is_whole<T> || std::is_same_v<T, double>)
      return 1;
    else
      return T::ColsAtCompileTime == 1 ? 3 : 9;
  }
  template <class T> inline constexpr int n_components = count_components<T>();

  inline void append(std::vector<double> &numbers, const double value)
  {
    numbers.push_back(value);
  }
  template <class Derived> void append(std::vector<double> &numbers, const Eigen::MatrixBase<Derived> &value)
  {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < (Derived::ColsAtCompileTime == 1 ? 1 : 3); ++b)
        numbers.push_back(a < Derived::RowsAtCompileTime && b < Derived::ColsAtCompileTime ? value(a, b) : 0.);
  }

  inline void take(const double *&numbers, double &value)
  {
    value = *numbers++;
  }
  template <class Derived> void take(const double *&numbers, Eigen::MatrixBase<Derived> &value)
  {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < (Derived::ColsAtCompileTime == 1 ? 1 : 3); ++b, ++numbers)
        if (a < Derived::RowsAtCompileTime && b < Derived::ColsAtCompileTime)
          value(a, b) = *numbers;
  }

  template <class T> std::vector<std::size_t> extents_of(const std::size_t n)
  {
    std::vector<std::size_t> extents{n};
    extents.insert(extents.end(), n_components<T> == 1 ? 0 : n_components<T> == 3 ? 1 : 2, 3);
    return extents;
  }

  template <class T> std::vector<double> flat(const std::vector<T> &values)
  {
    std::vector<double> numbers;
    numbers.reserve(values.size() * n_components<T>);
    for (const T &value : values)
      if constexpr (is_whole<T>)
        numbers.push_back(double(value));
      else
        append(numbers, value);
    return numbers;
  }

  template <class T>
  void write_field(Hdf5Writer           &file,
                   const std::string    &name,
                   const std::vector<T> &values,
                   const std::string    &unit,
                   const std::string    &meaning)
  {
    if constexpr (is_whole<T>)
      {
        std::vector<int> whole;
        for (const T value : values)
          whole.push_back(int(value));
        file.write(name, whole);
      }
    else
      file.write(name, flat(values), extents_of<T>(values.size()));
    file.attribute(name, "unit", unit);
    file.attribute(name, "meaning", meaning);
  }

  // Throws std::invalid_argument with file and array if the array has a wrong shape. Two-dimensional vectors and tensors are
  // accepted as three-dimensional ones.
  template <class T> std::vector<T> read_field(const Hdf5Reader &file, const std::string &name)
  {
    if constexpr (std::is_same_v<T, double>)
      return file.read(name);
    else if constexpr (std::is_same_v<T, Eigen::Vector2d>)
      return file.read_vectors(name);
    else if constexpr (std::is_same_v<T, Eigen::Matrix2d>)
      return file.read_tensors(name);
    else if constexpr (is_whole<T>)
      {
        std::vector<T> values;
        for (const int value : file.read_int(name))
          values.push_back(T(value));
        return values;
      }
    else
      {
        const std::vector<std::size_t> extents = file.extents(name);
        if (extents.empty() || extents != extents_of<T>(extents[0]))
          throw std::invalid_argument(file.path() + ": '" + name + "' holds no tensors of nine components");
        const std::vector<double> numbers = file.read(name);
        const double             *next    = numbers.data();
        std::vector<T>            values(extents[0]);
        for (T &value : values)
          take(next, value);
        return values;
      }
  }

  // Splits a list of structs into columns: action(name, values, unit, meaning) for each member that fields(entry, visit)
  // visits.
  template <class Entry, class Fields, class Action>
  void for_each_column(const std::vector<Entry> &entries, Fields &&fields, Action &&action)
  {
    Entry prototype{};
    fields(prototype, [&](const std::string &wanted, auto &member, const char *unit, const char *meaning) {
      using Value = std::decay_t<decltype(member)>;
      std::vector<Value> values;
      values.reserve(entries.size());
      for (const Entry &entry : entries)
        fields(entry, [&](const std::string &name, const auto &value, const char *, const char *) {
          if constexpr (std::is_same_v<Value, std::decay_t<decltype(value)>>)
            if (name == wanted)
              values.push_back(value);
        });
      action(wanted, values, unit, meaning);
    });
  }

  // The inverse: `column(name, values)` fills one column with one value per entry.
  template <class Entry, class Fields, class Column>
  void set_columns(std::vector<Entry> &entries, Fields &&fields, Column &&column)
  {
    Entry prototype{};
    fields(prototype, [&](const std::string &wanted, auto &member, const char *, const char *) {
      using Value = std::decay_t<decltype(member)>;
      std::vector<Value> values;
      column(wanted, values);
      for (std::size_t k = 0; k < entries.size(); ++k)
        fields(entries[k], [&](const std::string &name, auto &value, const char *, const char *) {
          if constexpr (std::is_same_v<Value, std::decay_t<decltype(value)>>)
            if (name == wanted)
              value = values[k];
        });
    });
  }

  struct ArrayCheck
  {
    std::string place; // file and group

    [[noreturn]] void refuse(const std::string &name, const std::string &what) const;
    void              size(const std::string &name, std::size_t found, std::size_t wanted) const;
    void              finite(const std::string &name, const std::vector<double> &numbers, std::size_t per_entry) const;

    template <class T> void finite(const std::string &name, const std::vector<T> &values) const
    {
      if constexpr (!is_whole<T>)
        finite(name, flat(values), n_components<T>);
    }
  };
} // namespace diptych::discrete
