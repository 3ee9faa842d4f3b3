// diptych: checks of the continuum options of a scene
// SPDX-License-Identifier: LGPL-2.1-or-later
#include "continuum/options.h"

#include "continuum/laws/law_library.h"
#include "continuum/require.h"

namespace diptych::continuum
{
  MeshOption::MeshOption(const std::string &text)
      : kind(text == "outline"     ? Kind::outline
             : text == "rectangle" ? Kind::rectangle
                                   : Kind::file),
        file(kind == Kind::file ? text : "")
  {}

  std::string text_of(const MeshOption &option)
  {
    return option.kind == MeshOption::Kind::outline     ? "outline"
           : option.kind == MeshOption::Kind::rectangle ? "rectangle"
                                                        : option.file;
  }

  void complete(Options &options)
  {
    if (options.law == LawKind::library)
      complete(options.material.library);
  }

  void validate(const Options &options)
  {
    require_keys(options.min_step > 0 && options.min_step <= options.initial_step && options.initial_step <= options.max_step,
                 {"min_step", "initial_step", "max_step"}, "steps: 0 < min_step = ", options.min_step,
                 " <= initial_step = ", options.initial_step, " <= max_step = ", options.max_step, " is needed");
    require_keys((!is_cosserat(options) && !traits(options.law).is_gradient) || options.element != Displacement::q1_bbar,
                 {"element", "law"}, "element = ", name_of(options.element), " with law = ", name_of(options.law),
                 ": laws with an internal length need q2 (equal orders of displacement and rotation lock)");
    require_keys(options.mesh.kind != MeshOption::Kind::rectangle ||
                   (options.rectangle_width > 0 && options.rectangle_height > 0),
                 {"rectangle_width", "rectangle_height", "mesh"}, "rectangle_width = ", options.rectangle_width,
                 ", rectangle_height = ", options.rectangle_height, ": mesh = rectangle needs both");
    check_ranges(options, unused_keys(options));
    validate(options.law, options.material);
  }

  std::vector<UnusedKey> unused_keys(const Options &o)
  {
    std::vector<UnusedKey> unused = unused_keys(o.law, o.material);
    const auto             unless = [&](const bool used, const std::string &because, const std::vector<const char *> &keys) {
      for (const char *key : keys)
        if (!used)
          unused.push_back({key, because});
    };
    const bool plastic = traits(o.law).is_plastic || o.law == LawKind::library, weak = plastic && o.weak_spot_strain > 0;
    unless(o.platens == Platens::frictional, "platens = " + name_of(o.platens), {"platen_friction", "platen_slip_length"});
    unless(is_cosserat(o), "law = " + name_of(o.law), {"platen_rotation"});
    unless(o.mesh.kind == MeshOption::Kind::rectangle, "mesh = " + text_of(o.mesh),
           {"rectangle_width", "rectangle_height", "platen_width"});
    unless(o.mesh.kind != MeshOption::Kind::file, "mesh = " + text_of(o.mesh), {"element_size"});
    unless(o.refinement == Refinement::adaptive, "refinement = " + name_of(o.refinement),
           {"refinement_levels", "refinement_threshold"});
    unless(plastic, "law = " + name_of(o.law), {"weak_spot_strain"});
    unless(weak, plastic ? "weak_spot_strain = 0" : "law = " + name_of(o.law),
           {"weak_spot_radius", "weak_spot_x", "weak_spot_y"});
    return unused;
  }

  std::vector<DoubtfulValue> doubtful_values(const Options &o)
  {
    constexpr double           softest = 50, stiffest = 1e6, most_cohesive = 1;
    std::vector<DoubtfulValue> found;
    each_used_number(o.material, unused_keys(o), [&](const std::string &key, const double value, const char *, const auto &) {
      const char *why = nullptr;
      if (key == "youngs_modulus" && value < softest)
        why = "is below 50: elastic strain reaches several percent before the sample yields";
      if (key == "youngs_modulus" && value > stiffest)
        why = "is above 1e6: was it given as an absolute modulus?";
      if ((key == "cohesion" || key == "table_cohesion") && value > most_cohesive)
        why = "is above 1: cohesion then exceeds the pressure; was it given as an absolute stress?";
      if (why != nullptr)
        found.push_back({key, concatenated(" = ", value, " (in units of loading/pressure) ", why)});
    });
    return found;
  }
} // namespace diptych::continuum
