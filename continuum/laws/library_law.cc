// diptych: a law of the user from a shared library
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/library_law.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "continuum/laws/rotation.h"
#include "continuum/require.h"

namespace diptych::continuum
{
  namespace
  {
    constexpr unsigned int most = n_components; // the class has a function of this name

    bool is_finite(const MaterialUpdate &answer)
    {
      double sum = answer.state.stress_zz + answer.state.equivalent_plastic_strain + answer.state.dissipation;
      for (unsigned int i = 0; i < n_components; ++i)
        {
          sum += answer.state.stress[i];
          for (unsigned int k = 0; k < n_components; ++k)
            sum += answer.tangent[i][k];
        }
      for (const double value : part_of<LibraryState>(answer.state))
        sum += value;
      const PlasticStrain &p = answer.state.plastic_strain;
      return std::isfinite(sum + p.xx + p.yy + p.zz + p.xy);
    }

    std::vector<double> converted(const LawParameters &parameters, const Units &units)
    {
      std::vector<double> values;
      for (const LawParameter &one : parameters.list)
        values.push_back(one.value * (one.unit == DIPTYCH_STRESS ? units.stress : one.unit == DIPTYCH_LENGTH ? units.length : 1));
      return values;
    }
  } // namespace

  LibraryLaw::LibraryLaw(LibraryOptions options, const Units &units)
      : path(options.file.path)
  {
    complete(options);
    opened     = &law_library(path);
    parameters = converted(options.parameters, units);
    MaterialState rest;
    rest.stress[xx] = rest.stress[yy] = rest.stress_zz = -units.stress;
    start(rest);
    const MaterialUpdate answer = update(rest, {}, 0);
    require_keys(answer.verdict != Verdict::failed, {"law_library"}, "law_library fails at rest: ", failure(rest, {}, 0).text);
    const char *signs = "; tension is positive, in stress and in strain";
    for (const auto &[name, stress] : {std::pair("s_xx", answer.state.stress[xx]), std::pair("s_yy", answer.state.stress[yy]),
                                       std::pair("s_zz", answer.state.stress_zz)})
      require_keys(!(std::abs(stress - units.stress) < 1e-6 * units.stress), {"law_library"}, "law_library = ", path,
                   ": a step without strain turns the sign of ", name, ", from ", -units.stress, " to ", stress, signs);
    elastic = answer.tangent;
    require_keys(elastic[xx][xx] > 0 && elastic[xy][xy] > 0, {"law_library"}, "law_library = ", path,
                 ": the tangent at rest has no positive stiffness: d s_xx / d e_xx = ", elastic[xx][xx],
                 ", d s_xy / d gamma_xy = ", elastic[xy][xy], signs);
    moduli_.shear = elastic[xy][xy];
  }

  void LibraryLaw::start(MaterialState &state) const
  {
    LibraryState &own = own_part<LibraryState>(state);
    own.clear();
    for (int k = 0; k < opened->law->n_variables; ++k)
      own.push_back(opened->law->variables[k].start);
    if (opened->start == nullptr)
      return;
    double variables[DIPTYCH_MOST_VARIABLES] = {};
    std::copy(own.begin(), own.end(), variables);
    opened->start(parameters.data(), &state.stress[0], state.stress_zz, variables);
    std::copy_n(variables, own.size(), own.begin());
  }

  // The buffers have the full size: a library that fills six components of a law with three damages nothing.
  diptych_verdict LibraryLaw::call(const MaterialState &s0,
                                   const Strain        &d_strain,
                                   const double         d_time,
                                   MaterialUpdate      &answer) const noexcept
  {
    const unsigned int n            = n_components();
    double             stress[most] = {}, variables[DIPTYCH_MOST_VARIABLES] = {}, tangent[most * most] = {};
    std::copy_n(&s0.stress[0], n, stress);
    const LibraryState &before = part_of<LibraryState>(s0);
    std::copy(before.begin(), before.end(), variables);
    const diptych_step    step{parameters.data(), &s0.stress[0], s0.stress_zz, s0.equivalent_plastic_strain,
                            before.data(),     &d_strain[0],  d_time};
    diptych_answer        end{stress, s0.stress_zz, s0.equivalent_plastic_strain, variables, tangent, {}, 0, DIPTYCH_ELASTIC};
    const diptych_verdict verdict = opened->update(&step, &end);

    MaterialState &state = answer.state;
    for (unsigned int i = 0; i < n; ++i)
      {
        state.stress[i] = stress[i];
        std::copy_n(tangent + i * n, n, &answer.tangent[i][0]);
      }
    state.stress_zz                 = end.stress_zz;
    state.equivalent_plastic_strain = end.hardening;
    std::copy_n(variables, before.size(), own_part<LibraryState>(state).begin());
    state.plastic_strain.xx += end.plastic_strain[0];
    state.plastic_strain.yy += end.plastic_strain[1];
    state.plastic_strain.zz += end.plastic_strain[2];
    state.plastic_strain.xy += end.plastic_strain[3];
    state.dissipation += end.dissipation;
    answer.regime = end.branch == DIPTYCH_ELASTIC ? Regime::elastic : end.branch == DIPTYCH_TIP ? Regime::apex : Regime::plastic;
    return verdict;
  }

  MaterialUpdate LibraryLaw::update(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    MaterialUpdate        answer{s0, {}};
    const diptych_verdict verdict = call(s0, d_strain, d_time, answer);
    answer.verdict                = verdict == DIPTYCH_FAILED || !is_finite(answer) ? Verdict::failed
                                    : verdict == DIPTYCH_UNRELIABLE                 ? Verdict::unreliable
                                                                                    : Verdict::reliable;
    return answer;
  }

  void LibraryLaw::turn_variables(MaterialState &state, const double angle) const
  {
    LibraryState &own = own_part<LibraryState>(state);
    for (const unsigned int k : opened->tensors)
      turn_tensor(own[k], own[k + 1], own[k + 2], std::cos(angle), std::sin(angle));
  }

  LibraryLaw::Failure LibraryLaw::failure(const MaterialState &s0,
                                          const Strain        &d_strain,
                                          const double         d_time,
                                          const std::string   &where) const
  {
    MaterialUpdate     answer{s0, {}};
    const bool         is_not_finite = call(s0, d_strain, d_time, answer) != DIPTYCH_FAILED;
    std::ostringstream text;
    text.precision(6);
    text << "the law library " << path
         << (is_not_finite ? " returned a number that is not finite" : " gave no answer (DIPTYCH_FAILED)");
    if (!where.empty())
      text << " in " << where;
    text << ". Strain increment (tension positive):";
    for (unsigned int i = 0; i < n_components(); ++i)
      text << ' ' << d_strain[i];
    text << "; stress before:";
    for (unsigned int i = 0; i < n_components(); ++i)
      text << ' ' << s0.stress[i];
    text << ", zz " << s0.stress_zz << "; hardening " << s0.equivalent_plastic_strain;
    const LibraryState &own = part_of<LibraryState>(s0);
    for (std::size_t k = 0; k < own.size(); ++k)
      text << ", " << opened->law->variables[k].name << ' ' << own[k];
    return {text.str(), is_not_finite};
  }
} // namespace diptych::continuum
