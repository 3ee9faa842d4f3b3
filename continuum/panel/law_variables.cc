// diptych: state variables of a law from a library, for output
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/panel/law_variables.h"

namespace diptych::continuum
{
  std::vector<double> variables_of(const BoundaryValueProblem &problem, const std::size_t c)
  {
    const unsigned int  n = problem.discretisation().reference.n_points;
    std::vector<double> means(part_of<LibraryState>(problem.committed().points[c * n]).size(), 0.);
    double              area = 0;
    for (unsigned int q = 0; q < n; ++q)
      {
        const double w = problem.geometry().cells[c].points[q].area;
        area += w;
        for (std::size_t k = 0; k < means.size(); ++k)
          means[k] += w * part_of<LibraryState>(problem.committed().points[c * n + q])[k];
      }
    for (double &mean : means)
      mean /= area;
    return means;
  }

  std::vector<LawVariable> described_variables(const Law &law)
  {
    std::vector<LawVariable> variables;
    if (const auto *library = std::get_if<LibraryLaw>(&law))
      for (const std::string &name : variable_names(library->library()))
        {
          const diptych_variable &one = library->library().law->variables[variables.size()];
          variables.push_back({name, one.unit, one.meaning, {}});
        }
    return variables;
  }
} // namespace diptych::continuum
