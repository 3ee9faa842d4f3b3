// diptych: conversion between C++ arrays and NumPy arrays
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/python/arrays.h"

#include <cmath>

namespace diptych::python
{
  namespace
  {
    void demand_finite(const Numbers &array, const std::string &name)
    {
      for (py::ssize_t k = 0; k < array.size(); ++k)
        if (!std::isfinite(array.data()[k]))
          throw std::invalid_argument(name + ": entry " + std::to_string(k) + " (counted row by row) is not finite");
    }

    bool has_shape(const py::array &array, const std::vector<py::ssize_t> &beyond_the_first)
    {
      if (array.ndim() != py::ssize_t(1 + beyond_the_first.size()))
        return false;
      for (std::size_t k = 0; k < beyond_the_first.size(); ++k)
        if (array.shape(py::ssize_t(k + 1)) != beyond_the_first[k])
          return false;
      return true;
    }
  } // namespace

  void refuse_shape(const py::array &array, const std::string &name, const std::string &needed)
  {
    std::string shape;
    for (py::ssize_t k = 0; k < array.ndim(); ++k)
      shape += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
    throw std::invalid_argument(name + ": an array of shape " + needed + " is needed, this one has (" + shape + ")");
  }

  std::vector<Eigen::Vector2d> vectors_of(const Numbers &array, const std::string &name)
  {
    if (!has_shape(array, {2}))
      refuse_shape(array, name, "(n, 2)");
    demand_finite(array, name);
    std::vector<Eigen::Vector2d> values(std::size_t(array.shape(0)));
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = {array.data()[2 * k], array.data()[2 * k + 1]};
    return values;
  }

  std::vector<Eigen::Matrix2d> tensors_of(const Numbers &array, const std::string &name)
  {
    if (!has_shape(array, {2, 2}))
      refuse_shape(array, name, "(n, 2, 2)");
    demand_finite(array, name);
    std::vector<Eigen::Matrix2d> values(std::size_t(array.shape(0)));
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] << array.data()[4 * k], array.data()[4 * k + 1], array.data()[4 * k + 2], array.data()[4 * k + 3];
    return values;
  }

  std::vector<double> numbers_of(const Numbers &array, const std::string &name)
  {
    if (!has_shape(array, {}))
      refuse_shape(array, name, "(n)");
    demand_finite(array, name);
    return {array.data(), array.data() + array.size()};
  }

  std::vector<int> indices_of(const Indices &array, const std::string &name)
  {
    if (!has_shape(array, {}))
      refuse_shape(array, name, "(n)");
    return {array.data(), array.data() + array.size()};
  }

  Eigen::Vector2d vector_of(const Numbers &array, const std::string &name)
  {
    if (array.ndim() != 1 || array.size() != 2)
      refuse_shape(array, name, "(2)");
    demand_finite(array, name);
    return {array.data()[0], array.data()[1]};
  }
} // namespace diptych::python
