// diptych: one homogeneous point along prescribed strains
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/strain_path.h"

#include <stdexcept>
#include <string>

#include "continuum/laws/any_law.h"
#include "continuum/laws/plastic_flow.h"

namespace diptych::continuum
{
  namespace
  {
    void demand_tensor(const Eigen::Matrix2d &tensor, const std::string &what)
    {
      if (!tensor.allFinite() || tensor(0, 1) != tensor(1, 0))
        throw std::invalid_argument(what + " must be finite and symmetric");
    }

    void validate(const StrainPath &path)
    {
      demand_tensor(path.stress, "the initial stress");
      if (path.strain.empty())
        throw std::invalid_argument("strain_path is empty: give at least one strain");
      for (std::size_t k = 0; k < path.strain.size(); ++k)
        demand_tensor(path.strain[k], "strain_path[" + std::to_string(k) + "]");
      if (!path.time.empty() && path.time.size() != path.strain.size())
        throw std::invalid_argument("time must have one entry per strain, " + std::to_string(path.strain.size()) + ", but has " +
                                    std::to_string(path.time.size()));
    }

    StrainPathRow row_of_path(const MaterialState &state, const Verdict verdict)
    {
      StrainPathRow row;
      row.stress << -state.stress[xx], -state.stress[xy], -state.stress[xy], -state.stress[yy];
      row.stress_zz                 = -state.stress_zz;
      row.equivalent_plastic_strain = state.equivalent_plastic_strain;
      row.dissipation               = state.dissipation;
      row.verdict                   = verdict;
      return row;
    }

    template <class AnyLaw> std::vector<StrainPathRow> drive_along(const AnyLaw &law, const StrainPath &path)
    {
      MaterialState state;
      state.stress[xx] = -path.stress(0, 0);
      state.stress[yy] = -path.stress(1, 1);
      state.stress[xy] = -path.stress(0, 1);
      state.stress_zz  = -path.stress_zz;
      std::vector<StrainPathRow> rows{row_of_path(state, Verdict::reliable)};
      for (std::size_t k = 1; k < path.strain.size(); ++k)
        {
          const Eigen::Matrix2d d = path.strain[k - 1] - path.strain[k];
          Strain                d_strain;
          d_strain[xx]                = d(0, 0);
          d_strain[yy]                = d(1, 1);
          d_strain[xy]                = 2 * d(0, 1);
          const double         d_time = path.time.empty() ? 0 : path.time[k] - path.time[k - 1];
          const MaterialUpdate update = law.update(state, d_strain, d_time);
          if (update.verdict == Verdict::failed)
            break;
          const MaterialState s0 = state;
          state                  = update.state;
          add_plastic_flow(law.moduli(), s0, d_strain, state);
          rows.push_back(row_of_path(state, update.verdict));
        }
      return rows;
    }
  } // namespace

  std::vector<StrainPathRow> drive_strain_path(const LawKind     law,
                                               const LawOptions &options,
                                               const Units      &units,
                                               const StrainPath &path)
  {
    validate(path);
    return std::visit([&](const auto &one) { return drive_along(one, path); }, make_law(uniform_law(law), options, units));
  }
} // namespace diptych::continuum
