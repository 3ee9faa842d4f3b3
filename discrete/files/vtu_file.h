// diptych: grids with fields as VTK files, which ParaView and meshio open
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace diptych::discrete
{
  enum class VtkCell : std::uint8_t
  {
    vertex                    = 1, // one node
    line                      = 3, // two nodes
    quadrilateral             = 9, // four nodes, anticlockwise
    biquadratic_quadrilateral = 28 // the four nodes, then the middles of the edges and the centre
  };

  // One array: (n), (n, 3) or (n, 9), row by row.
  struct VtuField
  {
    std::string         name;
    unsigned int        n_components = 1;
    std::vector<double> values;
    bool                of_nodes = false;
  };

  struct VtuGrid
  {
    std::vector<Eigen::Vector2d> points;
    std::vector<unsigned int>    cells; // nodes of all cells, one after the other
    VtkCell                      type = VtkCell::quadrilateral;
    std::vector<VtuField>        fields;
  };

  // Writes points and fields in single precision, as uncompressed binary arrays; missing values are NaN. Throws
  // std::runtime_error with the file's name, and std::invalid_argument if the length of a field is not the number of nodes or
  // cells.
  void write_vtu(const std::string &path, const VtuGrid &grid);

  // PATH/stage_NNNN.vtu of every stage, and their list PATH.pvd, which is complete after every add(). ParaView shows the progress
  // of the loading as time.
  class VtuSeries
  {
  public:
    // Keeps the files of the first stages, which have these times, and removes later ones. Stages count from `first`.
    explicit VtuSeries(std::string path_without_ending, std::vector<double> kept = {}, std::size_t first = 0);

    void add(double time, const VtuGrid &grid);

  private:
    std::string file(std::size_t k) const; // of the k-th time, below the folder of PATH

    std::string         path;
    std::vector<double> times;
    std::size_t         first;
  };
} // namespace diptych::discrete
