// diptych: a law of the user from a shared library
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/laws/library_law.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <sstream>

#include <unistd.h>

#include "continuum/laws/crash_guard.h"
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
      for (const double value : answer.state.variables)
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

    // After abort() the heap may be damaged: the run cannot go on to write files.
    [[noreturn]] void end_after_abort(const std::string &text)
    {
      (void)!write(STDERR_FILENO, text.c_str(), text.size());
      _exit(3);
    }
  } // namespace

  LibraryLaw::LibraryLaw(const LawOptions &options, const Units &units)
      : path(options.library.file.path)
  {
    LibraryOptions whole = options.library;
    complete(whole);
    opened     = &law_library(path);
    parameters = converted(whole.parameters, units);
    MaterialState rest;
    rest.stress[xx] = rest.stress[yy] = rest.stress_zz = -units.stress;
    start(rest);
    const MaterialUpdate answer = update(rest, {}, 0);
    require_keys(answer.verdict != Verdict::failed, {"law_library"}, "law_library fails at rest: ", last_failure.text);
    elastic = answer.tangent;
    require_keys(elastic[xx][xx] > 0 && elastic[xy][xy] > 0, {"law_library"}, "law_library = ", path,
                 ": the tangent at rest has no positive stiffness: d s_xx / d e_xx = ", elastic[xx][xx],
                 ", d s_xy / d gamma_xy = ", elastic[xy][xy]);
    moduli_.shear = elastic[xy][xy];
  }

  void LibraryLaw::start(MaterialState &state) const
  {
    state.variables.clear();
    for (int k = 0; k < opened->law->n_variables; ++k)
      state.variables.push_back(opened->law->variables[k].start);
    if (opened->start == nullptr)
      return;
    double variables[DIPTYCH_MOST_VARIABLES] = {};
    std::copy(state.variables.begin(), state.variables.end(), variables);
    const int signal = guarded([&] { opened->start(parameters.data(), &state.stress[0], state.stress_zz, variables); });
    require_keys(signal == 0, {"law_library"}, "law_library = ", path, " crashed in diptych_law_start: ", name_of_crash(signal));
    std::copy_n(variables, state.variables.size(), state.variables.begin());
  }

  struct LibraryLaw::Reply
  {
    // Of the full size: a library that fills six components of a law with three damages nothing.
    struct
    {
      double stress[most] = {}, variables[DIPTYCH_MOST_VARIABLES] = {}, tangent[most * most] = {};
    } buffers;
    diptych_answer  end     = {};
    diptych_verdict verdict = DIPTYCH_FAILED;
    int             signal  = 0; // of a crash
    std::string     thrown;      // by an exception
  };

  LibraryLaw::Reply LibraryLaw::call(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    Reply reply;
    auto &buffers = reply.buffers;
    for (unsigned int i = 0; i < n_components(); ++i)
      buffers.stress[i] = s0.stress[i];
    std::copy(s0.variables.begin(), s0.variables.end(), buffers.variables);
    const diptych_step step{parameters.data(),   &s0.stress[0], s0.stress_zz, s0.equivalent_plastic_strain,
                            s0.variables.data(), &d_strain[0],  d_time};
    reply.end    = {buffers.stress, s0.stress_zz, s0.equivalent_plastic_strain, buffers.variables, buffers.tangent, {}, 0,
                    DIPTYCH_ELASTIC};
    reply.signal = guarded([&] {
      try
        {
          reply.verdict = opened->update(&step, &reply.end);
        }
      catch (const std::exception &error)
        {
          reply.thrown = std::string("threw an exception: ") + error.what();
        }
      catch (...)
        {
          reply.thrown = "threw an exception";
        }
    });
    return reply;
  }

  void LibraryLaw::take(const Reply &reply, MaterialUpdate &answer) const
  {
    const auto           &buffers = reply.buffers;
    const diptych_answer &end     = reply.end;
    MaterialState        &state   = answer.state;
    for (unsigned int i = 0; i < n_components(); ++i)
      {
        state.stress[i] = buffers.stress[i];
        for (unsigned int k = 0; k < n_components(); ++k)
          answer.tangent[i][k] = buffers.tangent[i * n_components() + k];
      }
    state.stress_zz                 = end.stress_zz;
    state.equivalent_plastic_strain = end.hardening;
    std::copy_n(buffers.variables, state.variables.size(), state.variables.begin());
    state.plastic_strain.xx += end.plastic_strain[0];
    state.plastic_strain.yy += end.plastic_strain[1];
    state.plastic_strain.zz += end.plastic_strain[2];
    state.plastic_strain.xy += end.plastic_strain[3];
    state.dissipation += end.dissipation;
    answer.regime = end.branch == DIPTYCH_ELASTIC ? Regime::elastic : end.branch == DIPTYCH_TIP ? Regime::apex : Regime::plastic;
  }

  MaterialUpdate LibraryLaw::update(const MaterialState &s0, const Strain &d_strain, const double d_time) const
  {
    MaterialUpdate answer{s0, {}};
    answer.verdict    = Verdict::failed;
    const Reply reply = call(s0, d_strain, d_time);
    if (reply.signal != 0 || !reply.thrown.empty())
      {
        note(reply.signal != 0 ? std::string("crashed with ") + name_of_crash(reply.signal) : reply.thrown, true, s0, d_strain);
        if (reply.signal == SIGABRT)
          end_after_abort("diptych: " + last_failure.text + "\nThe stages written so far and the last checkpoint are kept.\n");
        return answer;
      }
    take(reply, answer);
    if (reply.verdict == DIPTYCH_FAILED)
      note("gave no answer (DIPTYCH_FAILED)", false, s0, d_strain);
    else if (!is_finite(answer))
      {
        note("returned a number that is not finite", false, s0, d_strain);
        if (not_finite.empty())
          not_finite = last_failure.text;
      }
    else
      answer.verdict = reply.verdict == DIPTYCH_UNRELIABLE ? Verdict::unreliable : Verdict::reliable;
    return answer;
  }

  void LibraryLaw::turn_variables(MaterialState &state, const double angle) const
  {
    for (const unsigned int k : opened->tensors)
      turn_tensor(state.variables[k], state.variables[k + 1], state.variables[k + 2], std::cos(angle), std::sin(angle));
  }

  void LibraryLaw::note(const std::string &what, const bool is_broken, const MaterialState &s0, const Strain &d_strain) const
  {
    if (last_failure.is_broken)
      return;
    std::ostringstream text;
    text.precision(6);
    text << "the law library " << path << ' ' << what;
    if (where)
      text << " in " << where();
    text << ". Strain increment (tension positive):";
    for (unsigned int i = 0; i < n_components(); ++i)
      text << ' ' << d_strain[i];
    text << "; stress before:";
    for (unsigned int i = 0; i < n_components(); ++i)
      text << ' ' << s0.stress[i];
    text << ", zz " << s0.stress_zz << "; hardening " << s0.equivalent_plastic_strain;
    for (std::size_t k = 0; k < s0.variables.size(); ++k)
      text << ", " << opened->law->variables[k].name << ' ' << s0.variables[k];
    last_failure = {text.str(), is_broken};
  }
} // namespace diptych::continuum
