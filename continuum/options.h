// diptych: options of the continuum panel in a scene
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
    updated, // nodes move and stress rotates with the material after every step
    small_strain
  };
  constexpr auto choices(Kinematics)
  {
    return std::array{std::pair{Kinematics::updated, "updated"}, std::pair{Kinematics::small_strain, "small_strain"}};
  }

  enum class Platens
  {
    rough,     // both components of the displacement follow the platen
    smooth,    // only the vertical component follows the platen
    frictional // as smooth, but friction resists the slip along platens and rigid side walls
  };
  constexpr auto choices(Platens)
  {
    return std::array{std::pair{Platens::rough, "rough"}, std::pair{Platens::smooth, "smooth"},
                      std::pair{Platens::frictional, "frictional"}};
  }

  enum class PlatenRotation
  {
    free, // no couple
    held  // rotation is zero
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
    automatic, // depends on the number of unknowns
    direct,    // LU in single precision on one process, MUMPS on several
    amg        // ML with GMRES
  };
  constexpr auto choices(LinearChoice)
  {
    return std::array{std::pair{LinearChoice::automatic, "auto"}, std::pair{LinearChoice::direct, "direct"},
                      std::pair{LinearChoice::amg, "amg"}};
  }

  // Source of the mesh: "outline", "rectangle", or else the path of a file.
  struct MeshOption
  {
    enum class Kind
    {
      outline,   // outline of the prepared grain sample
      rectangle, // rectangle_width x rectangle_height
      file       // file .msh or .geo
    };
    Kind        kind = Kind::outline;
    std::string file;

    MeshOption() = default;
    MeshOption(const std::string &text);
    MeshOption(const char *text)
        : MeshOption(std::string(text))
    {}
    bool names_a_file() const { return kind == Kind::file; }
  };
  std::string text_of(const MeshOption &option);

  // Stresses and lengths of the law count in Units (laws/options.h). All other lengths have the unit stated below.
  struct Options
  {
    LawKind        law                   = LawKind::cosserat_mohr_coulomb;
    Displacement   element               = Displacement::automatic;
    Kinematics     geometry              = Kinematics::updated;
    Platens        platens               = Platens::rough;
    double         platen_friction       = 0; // coupling derives both from the friction between the grains
    double         platen_slip_length    = 0;
    PlatenRotation platen_rotation       = PlatenRotation::free;
    InitialStress  initial_stress        = InitialStress::isotropic;
    double         k0                    = 1;
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

  // Lists the panel's own keys first, then those of the law. All names are distinct.
  template <class Visitor> void visit_parameters(Options &o, Visitor &&visitor)
  {
    visitor(
      "law", o.law, "-",
      "constitutive law; Cosserat and gradient laws have an internal length, with any other softening law the mesh sets the "
      "band's thickness; library: your own law, in law_library");
    visitor("element", o.element, "-",
            "q2: biquadratic displacement with 3x3 points; q1_bbar: bilinear with mean dilation; auto: q2. Cosserat and gradient "
            "laws need q2 and use a bilinear field beside it");
    visitor("geometry", o.geometry, "-",
            "updated: nodes move and stress rotates with the material after every step; small_strain: neither");
    visitor("platens", o.platens, "-",
            "rough: both displacement components follow the platen; smooth: only the vertical one; frictional: as smooth, but "
            "friction resists the slip along platens and rigid side walls");
    visitor("platen_friction", o.platen_friction, "-", {0., 1e6},
            "platens = frictional: largest ratio of shear to normal stress on platens and rigid side walls");
    visitor("platen_slip_length", o.platen_slip_length, "mean diameters", {0., 1e12},
            "platens = frictional: the ratio is platen_friction tanh(v / (platen_friction platen_slip_length)) for a slip v per "
            "unit strain; 0: Coulomb");
    visitor("platen_rotation", o.platen_rotation, "-",
            "Cosserat laws: free: no couple acts on the rotations at the platens; held: these rotations are zero");
    visitor("initial_stress", o.initial_stress, "-",
            "isotropic: the pressure everywhere; mapped: the stress of the prepared grain sample, cell by cell, then brought to "
            "equilibrium");
    visitor("k0", o.k0, "-", {0.01, 100.},
            "`material-point` and targets of `calibrate` alone: lateral over axial stress at the start of the path; the lateral "
            "stress is the pressure");
    visitor("mesh", o.mesh, "-",
            "outline: outline of the prepared grain sample; rectangle: rectangle_width x rectangle_height; otherwise the path of "
            "a .msh file with the physical lines lower_platen, upper_platen, left_side, right_side (and free)");
    visitor("rectangle_width", o.rectangle_width, "length", {0., 1e12}, "mesh = rectangle: width of the sample");
    visitor("rectangle_height", o.rectangle_height, "length", {0., 1e12}, "mesh = rectangle: height of the sample");
    visitor("platen_width", o.platen_width, "length", {0., 1e12},
            "mesh = rectangle: width of the upper platen in the middle of the upper edge; 0: the whole edge");
    visitor("element_size", o.element_size, "mean diameters", {0.01, 1e3},
            "edge length of an element; at most 2 internal lengths give peak and strength within 2 %, at most 1 the band width "
            "within 4 %");
    visitor("refinement", o.refinement, "-",
            "adaptive: elements start 2^refinement_levels times larger and are divided where plastic strain concentrates");
    visitor("refinement_levels", o.refinement_levels, "-", {1, 6}, "adaptive: number of divisions down to element_size");
    visitor("refinement_threshold", o.refinement_threshold, "-", {1e-6, 1.},
            "adaptive: an element is divided if its plastic strain in a step exceeds this share of the largest one");
    visitor(
      "linear_solver", o.linear_solver, "-",
      "direct: LU factors in single precision on one process, MUMPS on several; amg: ML; all precondition GMRES; auto: by size");
    visitor("initial_step", o.initial_step, "strain (mode time: time)", {1e-9, 1e6}, "first load step");
    visitor("max_step", o.max_step, "strain (mode time: time)", {1e-9, 1e6}, "largest load step");
    visitor("min_step", o.min_step, "strain (mode time: time)", {1e-12, 1e6},
            "smallest load step; if a smaller one would be needed, the run stops and reports the progress reached");
    visitor("tolerance", o.tolerance, "-", {1e-12, 1e-1}, "largest unbalanced nodal force, relative to the reaction forces");
    visitor("max_newton_iterations", o.max_newton_iterations, "-", {1, 1000}, "Newton iterations before a step is halved");
    visitor("weak_spot_strain", o.weak_spot_strain, "-", {0., 10.},
            "initial hardening variable in the middle of a weak spot, for samples that would otherwise stay homogeneous; 0: no "
            "weak spot");
    visitor("weak_spot_radius", o.weak_spot_radius, "mean diameters", {1e-6, 1e6},
            "radius of the weak spot (standard deviation of a Gaussian)");
    visitor("weak_spot_x", o.weak_spot_x, "widths", {0., 1.}, "horizontal position of the weak spot");
    visitor("weak_spot_y", o.weak_spot_y, "heights", {0., 1.}, "vertical position of the weak spot");
    visitor("checkpoint_minutes", o.checkpoint_minutes, "min", {0., 1e6},
            "wall-clock time between checkpoints; 0: after every step");
    visit_parameters(o.material, visitor);
  }

  // Whether the law has rotations and couple stresses. For law = library only after complete().
  inline bool is_cosserat(const Options &options)
  {
    return options.law == LawKind::library ? options.material.library.is_cosserat : traits(options.law).is_cosserat;
  }

  // Reads the description of a library: all its parameters get a value. Throws WrongKeys. Other laws need nothing.
  void complete(Options &options);

  // law = library must be complete.
  void validate(const Options &options);

  std::vector<UnusedKey> unused_keys(const Options &options);

  // A value that is allowed but implausible for a granular sample, such as a very high modulus. The panel warns of it. `words`
  // is the text after the key.
  struct DoubtfulValue
  {
    std::string key, words; // "youngs_modulus", " = 49 (in units of ...) is below 50: ..."
  };
  std::vector<DoubtfulValue> doubtful_values(const Options &options);
} // namespace diptych::continuum
