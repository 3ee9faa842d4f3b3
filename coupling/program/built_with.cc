// diptych: what the program was built with, in words
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/program/built_with.h"

#include <CLI/Version.hpp>

#include "coupling/version.h"

namespace diptych::coupling
{
  std::string built_with()
  {
    const std::string with = "\nwith Eigen " + std::string(eigen_version) + ", HDF5 " + hdf5_version + ", CLI11 " + CLI11_VERSION;
    const std::string continuum = ", deal.II " + std::string(deal_ii_version) + ", Trilinos " + trilinos_version + ", p4est " +
                                  p4est_version + ", gmsh API " + gmsh_version;
    const bool has_continuum = std::string(deal_ii_version) != "none";
    return std::string("diptych ") + version + " (" + git_revision + ")\nbuilt by " + compiler_version + ", " + build_type +
           with + (has_continuum ? continuum : ", without the continuum");
  }
} // namespace diptych::coupling
