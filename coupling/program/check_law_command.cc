// diptych: checks of a constitutive law, of the user too
// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "continuum/laws/law_checks.h"
#include "coupling/comparison/checks.h"
#include "coupling/program/commands.h"
#include "coupling/scene/scene_file.h"

namespace diptych::coupling
{
  namespace
  {
    // The law of a scene, or of a library with its usual parameters.
    Scene scene_of_target(const CommandLine &line)
    {
      if (std::filesystem::path(line.target).extension() != ".so")
        return scene_of(line);
      const Place        place(line.target);
      std::vector<Entry> entries = {{"continuum", "law", "library", place, ""},
                                    {"continuum", "law_library", line.target, place, ""}};
      for (const std::string &text : line.overrides)
        entries.push_back(entry_of_override(text));
      return scene_of_entries(line.target, entries, false);
    }

    std::string described(const Scene &scene, const continuum::Law &law)
    {
      const auto *library = std::get_if<continuum::LibraryLaw>(&law);
      if (library == nullptr)
        return "law " + text_of(scene.continuum.law);
      const diptych_law &one = *library->library().law;
      std::string text = "law library " + scene.continuum.material.library.file.path + ": " + std::to_string(one.n_components) +
                         " components, " + std::to_string(one.n_variables) + " state variables, " +
                         std::to_string(one.n_parameters) + " parameters";
      for (const continuum::LawParameter &p : scene.continuum.material.library.parameters.list)
        text += "\n  " + (continuum::LawParameters::prefix + p.name) + " = " + text_of(p.value) + " [" + p.unit + "]  " +
                allowed_number(p.range) + ": " + p.meaning;
      return text;
    }

    std::string line_of(const continuum::LawCheck &check)
    {
      if (check.holds() && check.trouble.empty() && check.n_not_judged == 0)
        return check.name + ": holds";
      std::ostringstream text;
      text.precision(3);
      text << check.name << (check.holds() ? ": holds" : ": FAILS") << ", largest deviation " << check.deviation << ' '
           << check.unit << " (allowed " << check.allowed << ") in " << check.n_judged << " steps";
      if (check.n_not_judged > 0)
        text << ", " << check.n_not_judged << " not judged";
      if (!check.trouble.empty())
        text << "; " << check.trouble;
      else if (!check.holds())
        text << "; " << check.where;
      return text.str();
    }
  } // namespace

  int check_law_of(const CommandLine &line)
  {
    const Scene          scene = scene_of_target(line);
    const continuum::Law law   = continuum::make_law(scene.continuum.law, scene.continuum.material, continuum_units(scene));
    if (!line.quiet)
      std::cout << described(scene, law) << '\n';
    const std::vector<continuum::LawCheck> checks = continuum::check_law(law, continuum_units(scene));
    for (const continuum::LawCheck &check : checks)
      std::cout << line_of(check) << '\n';
    std::cout.flush();
    const auto failed = std::count_if(checks.begin(), checks.end(), [](const auto &check) { return !check.holds(); });
    if (failed > 0)
      std::cerr << "check-law: " << count_of_checks(std::size_t(failed), checks.size()) << std::endl;
    return failed > 0 ? wrong_input : done;
  }
} // namespace diptych::coupling
