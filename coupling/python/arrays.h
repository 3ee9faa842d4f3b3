// diptych: conversion between C++ arrays and NumPy arrays
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

#include <Eigen/Core>

namespace diptych::python
{
  namespace py = pybind11;

  // Memory layout of one value: NumPy's number type, extents and strides [bytes] of the axes beyond the first.
  template <class T> struct Layout
  {
    using Number                      = T;
    static constexpr bool    is_plain = std::is_arithmetic_v<T>;
    static std::vector<long> extents() { return {}; }
    static std::vector<long> strides() { return {}; }
  };
  template <class Number_, int rows, int columns> struct Layout<Eigen::Matrix<Number_, rows, columns>>
  {
    using Number = Number_;
    static std::vector<long> extents() { return columns == 1 ? std::vector<long>{rows} : std::vector<long>{rows, columns}; }
    static std::vector<long> strides() // Eigen stores by columns
    {
      return columns == 1 ? std::vector<long>{sizeof(Number)} : std::vector<long>{sizeof(Number), rows * sizeof(Number)};
    }
  };
  template <class Number_, std::size_t n> struct Layout<std::array<Number_, n>>
  {
    using Number = Number_;
    static std::vector<long> extents() { return {long(n)}; }
    static std::vector<long> strides() { return {sizeof(Number)}; }
  };

  // A read-only view of n values, `stride` bytes apart, without a copy. `base` keeps them alive.
  template <class T> py::array strided_view(const T *first, const std::size_t n, const std::size_t stride, const py::handle base)
  {
    using Number = typename Layout<T>::Number;
    std::vector<py::ssize_t> shape{py::ssize_t(n)}, strides{py::ssize_t(stride)};
    for (const long extent : Layout<T>::extents())
      shape.push_back(extent);
    for (const long one : Layout<T>::strides())
      strides.push_back(one);
    py::array array = n == 0 ? py::array(py::dtype::of<Number>(), shape)
                             : py::array(py::dtype::of<Number>(), shape, strides, first, base);
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
  }

  template <class T> py::array view(const std::vector<T> &values, const py::handle base)
  {
    if constexpr (std::is_enum_v<T>)
      return strided_view(reinterpret_cast<const std::underlying_type_t<T> *>(values.data()), values.size(), sizeof(T), base);
    else
      return strided_view(values.data(), values.size(), sizeof(T), base);
  }

  template <class Struct, class Member>
  py::array member_view(const std::vector<Struct> &values, Member Struct::*member, const py::handle base)
  {
    const Member *first = values.empty() ? nullptr : &(values.front().*member);
    return strided_view(first, values.size(), sizeof(Struct), base);
  }

  // An array that takes over the values without a copy.
  template <class T> py::array own(std::vector<T> values)
  {
    auto              kept = std::make_unique<std::vector<T>>(std::move(values));
    std::vector<T>   &list = *kept;
    const py::capsule keeper(kept.get(), [](void *all) { delete static_cast<std::vector<T> *>(all); });
    kept.release();
    py::array array = view(list, keeper);
    py::detail::array_proxy(array.ptr())->flags |= py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
  }

  template <class Number, int rows, int columns> py::array copy(const Eigen::Matrix<Number, rows, columns> &value)
  {
    return own(std::vector<Eigen::Matrix<Number, rows, columns>>{value})[py::int_(0)];
  }

  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  using Indices = py::array_t<int, py::array::c_style | py::array::forcecast>;

  // These throw std::invalid_argument with the argument, its shape and the required shape.
  [[noreturn]] void            refuse_shape(const py::array &array, const std::string &name, const std::string &needed);
  std::vector<Eigen::Vector2d> vectors_of(const Numbers &array, const std::string &name); // (n, 2)
  std::vector<Eigen::Matrix2d> tensors_of(const Numbers &array, const std::string &name); // (n, 2, 2)
  std::vector<double>          numbers_of(const Numbers &array, const std::string &name); // (n)
  std::vector<int>             indices_of(const Indices &array, const std::string &name); // (n)
  Eigen::Vector2d              vector_of(const Numbers &array, const std::string &name);  // (2)
} // namespace diptych::python
