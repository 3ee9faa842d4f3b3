// diptych: everything that a scene says of the continuum panel
// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "continuum/choices.h"
#include "continuum/laws/options.h"
#include "continuum/loading.h"

namespace diptych::continuum
{
  enum class Displacement
  {
    automatic, // biquadratic
    q2,        // biquadratic with 3x3 points
    q1_bbar    // bilinear with mean dilation
  };
  constexpr auto choices(Displacement)
  {
    return std::array{std::pair{Displacement::automatic, "auto"}, std::pair{Displacement::q2, "q2"},
                      std::pair{Displacement::q1_bbar, "q1_bbar"}};
  }

  enum class Kinematics
  {
    updated, // nodes move and stress turns with the material after every step
    small_strain
  };
  constexpr auto choices(Kinematics)
  {
    return std::array{std::pair{Kinematics::updated, "updated"}, std::pair{Kinematics::small_strain, "small_strain"}};
  }

  enum class Platens
  {
    rough, // both components of the displacement follow the platen
    smooth // the vertical one alone
  };
  constexpr auto choices(Platens)
  {
    return std::array{std::pair{Platens::rough, "rough"}, std::pair{Platens::smooth, "smooth"}};
  }

  enum class PlatenRotation
  {
    free, // no couple
    held  // at zero
  };
  constexpr auto choices(PlatenRotation)
  {
    return std::array{std::pair{PlatenRotation::free, "free"}, std::pair{PlatenRotation::held, "held"}};
  }

  enum class InitialStress
  {
    isotropic,
    mapped
  };
  constexpr auto choices(InitialStress)
  {
    return std::array{std::pair{InitialStress::isotropic, "isotropic"}, std::pair{InitialStress::mapped, "mapped"}};
  }

  enum class Refinement
  {
    uniform,
    adaptive
  };
  constexpr auto choices(Refinement)
  {
    return std::array{std::pair{Refinement::uniform, "uniform"}, std::pair{Refinement::adaptive, "adaptive"}};
  }

  enum class LinearChoice
  {
    automatic, // by size
    direct,    // UMFPACK on one process, MUMPS on several
    amg        // ML with GMRES
  };
  constexpr auto choices(LinearChoice)
  {
    return std::array{std::pair{LinearChoice::automatic, "auto"}, std::pair{LinearChoice::direct, "direct"},
                      std::pair{LinearChoice::amg, "amg"}};
  }

  // Where a mesh comes from: "outline", "rectangle", else the path of a file.
  struct MeshOption
  {
    enum class Kind
    {
      outline,   // of the prepared grain sample
      rectangle, // of rectangle_width and rectangle_height
      file       // .msh or .geo
    };
    Kind        kind = Kind::outline;
    std::string file;

    MeshOption() = default;
    MeshOption(const std::string &text);
    MeshOption(const char *text)
        : MeshOption(std::string(text))
    {}
  };
  std::string text_of(const MeshOption &option);

  // Stresses and lengths of the law count in Units, other lengths as their units say.
  struct Options
  {
    LawKind        law                   = LawKind::cosserat_mohr_coulomb;
    Displacement   element               = Displacement::automatic;
    Kinematics     geometry              = Kinematics::updated;
    Platens        platens               = Platens::rough;
    PlatenRotation platen_rotation       = PlatenRotation::free;
    InitialStress  initial_stress        = InitialStress::isotropic;
    MeshOption     mesh                  = {};
    double         rectangle_width       = 0;
    double         rectangle_height      = 0;
    double         platen_width          = 0;
    double         element_size          = 2;
    Refinement     refinement            = Refinement::uniform;
    int            refinement_levels     = 1;
    double         refinement_threshold  = 0.2;
    LinearChoice   linear_solver         = LinearChoice::automatic;
    double         initial_step          = 1e-3;
    double         max_step              = 5e-3;
    double         min_step              = 1e-5;
    double         tolerance             = 1e-5;
    int            max_newton_iterations = 20;
    double         weak_spot_strain      = 0;
    double         weak_spot_radius      = 2;
    double         weak_spot_x           = 0.5;
    double         weak_spot_y           = 0.5;
    double         checkpoint_minutes    = 10;
    LawOptions     material;
  };

  // Lists the panel's own keys first, then those of the law; all names are distinct.
  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visitor("law", o.law, "-",
            "constitutive law; the two with Cosserat rotations have an internal length, the band of a local law that softens is "
            "set by the mesh");
    visitor("element", o.element, "-",
            "displacement: biquadratic with 3x3 points, or bilinear with mean dilation; auto: q2. Cosserat laws need q2 and take "
            "bilinear rotations");
    visitor("geometry", o.geometry, "-", "nodes move and stress turns with the material after every step, or small strain");
    visitor("platens", o.platens, "-", "rough: both components follow the platen; smooth: only the vertical");
    visitor("platen_rotation", o.platen_rotation, "-",
            "Cosserat laws: rotations at the platens are free (no couple) or held at zero");
    visitor("initial_stress", o.initial_stress, "-",
            "the pressure everywhere, or the prepared grain sample's stress cell by cell, then brought to equilibrium");
    visitor(
      "mesh", o.mesh, "-",
      "outline: of the prepared grain sample; rectangle: of rectangle_width and rectangle_height; else a .msh file with the "
      "physical lines lower_platen, upper_platen, left_side, right_side (and free)");
    visitor("rectangle_width", o.rectangle_width, "length", {0., 1e12}, "mesh = rectangle: its width");
    visitor("rectangle_height", o.rectangle_height, "length", {0., 1e12}, "mesh = rectangle: its height");
    visitor("platen_width", o.platen_width, "length", {0., 1e12},
            "mesh = rectangle: of the upper platen, a strip in the middle of the upper edge; 0: the whole edge");
    visitor("element_size", o.element_size, "mean diameters", {0.01, 1e3},
            "edge length of an element; 1.5 to 2 internal lengths resolve a band");
    visitor("refinement", o.refinement, "-",
            "adaptive: elements are larger by 2^refinement_levels at first and divided where plastic strain gathers");
    visitor("refinement_levels", o.refinement_levels, "-", {1, 6}, "adaptive: divisions down to element_size");
    visitor("refinement_threshold", o.refinement_threshold, "-", {1e-6, 1.},
            "adaptive: an element is divided whose plastic strain in a step exceeds this share of the largest");
    visitor("linear_solver", o.linear_solver, "-",
            "direct: UMFPACK on one process, MUMPS on several; amg: ML with GMRES; auto: by size");
    visitor("initial_step", o.initial_step, "strain (mode time: time)", {1e-9, 1e6}, "first load step");
    visitor("max_step", o.max_step, "strain (mode time: time)", {1e-9, 1e6}, "largest load step");
    visitor("min_step", o.min_step, "strain (mode time: time)", {1e-12, 1e6},
            "smallest load step; below it the run stops and says how far it got");
    visitor("tolerance", o.tolerance, "-", {1e-12, 1e-1}, "unbalanced nodal force relative to the reaction forces");
    visitor("max_newton_iterations", o.max_newton_iterations, "-", {1, 1000}, "Newton iterations before a step is halved");
    visitor(
      "weak_spot_strain", o.weak_spot_strain, "-", {0., 10.},
      "hardening variable at the start in the middle of a weak spot, for samples that would else stay homogeneous; 0: none");
    visitor("weak_spot_radius", o.weak_spot_radius, "mean diameters", {1e-6, 1e6}, "of the weak spot, a Gaussian's deviation");
    visitor("weak_spot_x", o.weak_spot_x, "widths", {0., 1.}, "place of the weak spot");
    visitor("weak_spot_y", o.weak_spot_y, "heights", {0., 1.}, "place of the weak spot");
    visitor("checkpoint_minutes", o.checkpoint_minutes, "min", {0., 1e6},
            "wall-clock time between checkpoints; 0: after every step");
    visit_parameters(o.material, visitor);
  }

  // Throws std::invalid_argument naming key, value and what is allowed.
  void validate(const Options &options);

  // Keys that nothing reads as the options stand.
  std::vector<UnusedKey> unused_keys(const Options &options);

  // Pointed out, not refused: moduli and cohesions that no granular sample has. `words` go on behind the key.
  struct DoubtfulValue
  {
    std::string key, words; // "youngs_modulus", " = 49 (in units of ...) is below 50: ..."
  };
  std::vector<DoubtfulValue> doubtful_values(const Options &options);
} // namespace diptych::continuum
