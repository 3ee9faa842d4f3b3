// diptych: conversion of listed numbers to JSON and back
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include <nlohmann/json.hpp>

#include "coupling/numbers/number_entry.h"
#include "coupling/statistics/interval.h"

namespace diptych::coupling
{
  // NaN becomes null, an interval {"value", "low", "high"}, a vector [x, y], a tensor [[xx, xy], [yx, yy]].
  inline nlohmann::json json_of(const Interval &i, const double unit)
  {
    return {{"value", i.value / unit}, {"low", i.low / unit}, {"high", i.high / unit}};
  }
  inline nlohmann::json json_of(const Eigen::Vector2d &v, const double unit)
  {
    return {v.x() / unit, v.y() / unit};
  }
  inline nlohmann::json json_of(const Eigen::Matrix2d &m, const double unit)
  {
    return {{m(0, 0) / unit, m(0, 1) / unit}, {m(1, 0) / unit, m(1, 1) / unit}};
  }
  inline nlohmann::json json_of(const std::string &text, double)
  {
    return text;
  }
  template <class T> nlohmann::json json_of(const T &value, const double unit)
  {
    if constexpr (std::is_same_v<T, double>)
      return std::isfinite(value) ? nlohmann::json(value / unit) : nlohmann::json(nullptr);
    else if constexpr (std::is_arithmetic_v<T>)
      return value;
    else if constexpr (std::is_same_v<T, std::optional<double>> || std::is_same_v<T, std::optional<std::array<double, 2>>>)
      return value ? json_of(*value, unit) : nlohmann::json(nullptr);
    else
      {
        nlohmann::json list = nlohmann::json::array();
        for (const auto &entry : value)
          list.push_back(json_of(entry, unit));
        return list;
      }
  }

  struct NumbersToJson
  {
    nlohmann::json &out;
    double          mean_diameter;

    template <class T> void operator()(const NumberEntry &entry, const T &value) const
    {
      out[entry.key] = json_of(value, entry.in_diameters ? mean_diameter : 1.);
    }
    template <class Record> void group(const char *key, const char *, const Record &record) const
    {
      NumbersToJson inner{out[key] = nlohmann::json::object(), mean_diameter};
      list_numbers(record, inner);
    }
    template <class Record> void group(const char *key, const char *meaning, const std::optional<Record> &record) const
    {
      if (record)
        group(key, meaning, *record);
      else
        out[key] = nullptr;
    }
    template <class Record> void list(const char *key, const char *, const std::vector<Record> &records) const
    {
      nlohmann::json &array = out[key] = nlohmann::json::array();
      for (const Record &record : records)
        {
          array.push_back(nlohmann::json::object());
          NumbersToJson inner{array.back(), mean_diameter};
          list_numbers(record, inner);
        }
    }
  };

  // Reads plain members from an object. Members that are missing or null in it keep their values. Throws
  // nlohmann::json::exception if it is not an object, or if a member has another type.
  struct NumbersFromJson
  {
    const nlohmann::json &in;

    template <class T> void operator()(const NumberEntry &entry, T &value) const
    {
      const auto found = in.is_object() ? in.find(entry.key) : in.at(entry.key).end(); // throws if `in` is not an object
      if (found == in.end() || found->is_null())
        return;
      if constexpr (std::is_same_v<T, std::optional<double>>)
        value = found->template get<double>();
      else
        value = found->template get<T>();
    }
  };
} // namespace diptych::coupling
