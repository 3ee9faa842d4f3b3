// diptych: the one list of fields that continuum.h5, continuum.xdmf and the .vtu files carry
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "continuum/snapshot.h"

namespace diptych::continuum
{
  // One value a node or a cell. In a file a vector has 3 components (z = 0), a tensor 9, row by row.
  struct Field
  {
    using Member = std::variant<std::vector<double>          Snapshot::*,
                                std::vector<Eigen::Vector2d> Snapshot::*,
                                double                       CellState::*,
                                Eigen::Vector2d              CellState::*,
                                Eigen::Matrix3d              CellState::*>;

    const char *name; // of the member, and in all files
    Member      member;
    bool        cosserat_only = false; // left out where the snapshot has no rotation
  };

  // Position stands apart: it is the grid's geometry.
  inline constexpr Field position_field{"position", &Snapshot::position};

  inline constexpr Field fields[] = {
    {"displacement", &Snapshot::displacement},
    {"rotation", &Snapshot::rotation, true},
    {"weight", &Snapshot::weight},
    {"stress", &CellState::stress},
    {"strain", &CellState::strain},
    {"plastic_strain", &CellState::plastic_strain},
    {"couple_stress", &CellState::couple_stress},
    {"area", &CellState::area},
    {"equivalent_plastic_strain", &CellState::equivalent_plastic_strain},
    {"dissipation", &CellState::dissipation},
    {"overstress", &CellState::overstress},
    {"share_zz_not_intermediate", &CellState::share_zz_not_intermediate},
    {"acoustic_determinant", &CellState::acoustic_determinant},
    {"localisation_angle", &CellState::localisation_angle},
  };

  inline bool of_nodes(const Field &field)
  {
    return field.member.index() < 2;
  }

  inline unsigned int n_components(const Field &field)
  {
    constexpr unsigned int components[] = {1, 3, 1, 3, 9};
    return components[field.member.index()];
  }

  // Of an array with n values of the field: (n), (n, 3) or (n, 3, 3).
  inline std::vector<std::size_t> extents(const Field &field, const std::size_t n)
  {
    std::vector<std::size_t> result{n};
    for (unsigned int components = n_components(field); components > 1; components /= 3)
      result.push_back(3);
    return result;
  }

  // Whether a stage carries the field.
  inline bool is_carried(const Field &field, const bool has_rotation)
  {
    return has_rotation || !field.cosserat_only;
  }

  // Of the stage's group in the .h5 file and of its .vtu file.
  inline std::string stage_name(const std::size_t stage)
  {
    char name[32];
    std::snprintf(name, sizeof name, "stage_%04zu", stage);
    return name;
  }

  // Place in a stage of the .h5 file, such as cells/stress.
  inline std::string path_of(const Field &field)
  {
    return (of_nodes(field) ? "nodes/" : "cells/") + std::string(field.name);
  }

  // clang-format off
  inline void append(std::vector<double> &values, const double item) { values.push_back(item); }
  inline void append(std::vector<double> &values, const Eigen::Vector2d &item)
  {
    values.insert(values.end(), {item.x(), item.y(), 0.});
  }
  inline void append(std::vector<double> &values, const Eigen::Matrix3d &item)
  {
    for (int k = 0; k < 9; ++k)
      values.push_back(item(k / 3, k % 3));
  }

  // The inverse: sets the item from what append wrote and returns where the next item begins.
  inline const double *take(const double *values, double &item) { item = *values; return values + 1; }
  inline const double *take(const double *values, Eigen::Vector2d &item) { item = {values[0], values[1]}; return values + 3; }
  inline const double *take(const double *values, Eigen::Matrix3d &item)
  {
    item = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values);
    return values + 9;
  }
  // clang-format on

  // Calls action(item) with the field's value at every node or cell. `snapshot` may be const.
  template <class AnySnapshot, class Action> void for_each_item(AnySnapshot &snapshot, const Field &field, Action &&action)
  {
    std::visit(
      [&](const auto member) {
        if constexpr (std::is_invocable_v<decltype(member), AnySnapshot &>)
          for (auto &item : snapshot.*member)
            action(item);
        else
          for (auto &cell : snapshot.cell_state)
            action(cell.*member);
      },
      field.member);
  }

  // Row by row, ready for a file.
  inline std::vector<double> values_of(const Snapshot &snapshot, const Field &field)
  {
    std::vector<double> values;
    values.reserve(n_components(field) * (of_nodes(field) ? snapshot.position.size() : snapshot.cells.size()));
    for_each_item(snapshot, field, [&](const auto &item) { append(values, item); });
    return values;
  }

  // Throws std::invalid_argument when a list of the snapshot is not as long as its nodes or cells are many.
  inline void require_equal_lengths(const Snapshot &snapshot)
  {
    if (snapshot.cell_state.size() != snapshot.cells.size())
      throw std::invalid_argument("snapshot: " + std::to_string(snapshot.cell_state.size()) + " cell states for " +
                                  std::to_string(snapshot.cells.size()) + " cells");
    for (const Field &field : fields)
      if (of_nodes(field) && is_carried(field, !snapshot.rotation.empty()))
        {
          std::size_t n = 0;
          for_each_item(snapshot, field, [&](const auto &) { ++n; });
          if (n != snapshot.position.size())
            throw std::invalid_argument("snapshot: " + path_of(field) + " holds " + std::to_string(n) + " values for " +
                                        std::to_string(snapshot.position.size()) + " nodes");
        }
  }
} // namespace diptych::continuum
