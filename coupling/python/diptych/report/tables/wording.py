# diptych: numbers as text
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A number may carry an interval: {"value", "low", "high"}. Unit "%" multiplies by 100, others are appended.

Meanings and units come from the list of numbers of the comparison. This file adds the form of numbers.
"""

import math
import re

from ...arrays import ends_text

ABSENT = "not computed"
MESH_SET = "set by the mesh (local law)"
MESH_SET_REASON = "It is not a material property, unless it is the same on two meshes."
LENGTH_SET_REASON = "It depends on this length, the size of the sample and the softening; all are chosen or fitted."

# Keys of pure numbers that are shown in per cent.
PER_CENT = {"volumetric_strain", "final_volumetric_strain", "reached_axial_strain", "reached_shear_strain",
            "share_inside", "area_share", "share_above_mean", "lost_share", "relative_l2", "stress_l2_relative",
            "sampling_alone", "lowest_scatter", "outside_share", "viscous_share", "unstable_share",
            "share_zz_not_intermediate", "solver_share_of_cpu", "platen_difference_share_below_1_percent",
            "platen_difference_mean", "platen_difference_largest", "expected_strength_error", "impact_share",
            "grain_stress_error", "residual_factor_error", "residual_factor_estimate"}

# Order of a summary; other keys follow in alphabetical order.
ORDER = ("grains", "cells", "unknowns", "element_size_d", "preparation_solid_fraction", "preparation_friction",
         "preparation_steps", "preparation_residual", "preparation_unbalanced_force", "initial_height", "platen_speed",
         "mean_inertial_number", "finished", "reached_progress", "reached_axial_strain", "reached_shear_strain",
         "peak_stress_ratio", "peak_friction_angle_deg", "peak_outline_stress_ratio", "peak_core_stress_ratio",
         "peak_nominal_stress_ratio",
         "friction_angle_deg", "strain_at_peak", "early_strength", "strength", "platen_force_pd", "mean_sxx",
         "sides_sxx", "platens_sxx", "final_volumetric_strain", "max_equivalent_plastic_strain", "internal_length_d",
         "localisation_strain", "localisation_angle_deg", "unstable_share", "viscous_share", "platen_unbalance",
         "share_zz_not_intermediate", "processes", "steps", "step_length", "step", "step_bound", "halved_steps",
         "cut_backs", "newton_iterations", "sweeps", "residual", "solver_noise", "grain_stress_error",
         "max_penetration_d", "impact_share", "energy_residual", "momentum_residual", "spin_term_share",
         "kinetic_energy_ratio_median", "kinetic_energy_ratio_largest", "kinetic_energy_bursts",
         "platen_difference_share_below_1_percent", "platen_difference_mean", "platen_difference_largest", "contacts",
         "coordination_number", "rattlers", "preparation_cpu_s", "discrete_cpu_s", "continuum_cpu_s",
         "comparison_cpu_s", "peak_memory_mb")

# key -> meaning of null
NULLS = {"internal_length_d": "none", "localisation_strain": "never", "localisation_angle_deg": "–"}

UNBROKEN = "\u00a0"  # between a number and its unit: no line break
SUFFIXES = {"": "", "-": "", "time": "", "strain or time": "", "degrees": "°", "rad": " rad", "mean diameters": " d"}
DECIMALS = {"°": 1, " d": 1, " P": 2, "%": 2, "": 3}


def suffix(unit):
    """Suffix of a number for a unit of the files, lengths in d and stresses in P: " P d²" for "pressure length^2"."""
    if unit in SUFFIXES:
        return SUFFIXES[unit]
    return " " + unit.replace("pressure", "P").replace("length", "d").replace("^2", "²")


def shown_unit(numbers, place):
    """Unit for number() and rounded() of a place in the list of numbers."""
    return "%" if place.rsplit("/", 1)[-1] in PER_CENT else suffix(numbers.unit(place))


def shown(numbers, place, value, decimals=None):
    """Text of the value of a place, with the usual decimals of its unit."""
    return rounded(value, shown_unit(numbers, place), decimals)


LETTERS = (("eps_1", "ε₁"), ("eps_2", "ε₂"), ("s_1", "σ₁"), ("s_2", "σ₂"), (" - ", " − "), (" (x) ", " ⊗ "))


def typeset(text):
    """A sentence of the program with Greek letters and minus signs: "eps_1 - eps_2" becomes "ε₁ − ε₂"."""
    for plain, letter in LETTERS:
        text = text.replace(plain, letter)
    return re.sub(r"(?<![\w.])-(?=\d)", "−", text)


def ending(unit):
    """The unit as it follows a number, without a line break between them."""
    return (" %" if unit == "%" else unit).replace(" ", UNBROKEN, 1)


def fixed(value, unit, decimals=None):
    """A number without its unit, with the usual decimals of the unit."""
    decimals = DECIMALS.get(unit, 3) if decimals is None else decimals
    value = round(100 * value if unit == "%" else value, decimals) + 0.0  # no minus sign before zero
    return f"{value:.{decimals}f}".replace("-", "−")


def _with_ends(number, unit, form):
    """form(number, unit), followed by its interval without the unit and without line breaks."""
    factor = 100 if unit == "%" else 1
    return form(number["value"], unit) + ends_text(number.get("low"), number.get("high"),
                                                   lambda end: form(factor * end, ""), "," + UNBROKEN)


def number(value, unit="", digits=4):
    """A number as text, with minus signs and powers of ten; its interval follows in brackets."""
    if isinstance(value, dict) and "value" in value:
        return _with_ends(value, unit, lambda one, unit: number(one, unit, digits))
    if value is None or isinstance(value, (dict, list)):
        return ABSENT
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return ABSENT
    value, unit = 100 * value if unit == "%" else value, ending(unit)
    size = abs(value)
    if isinstance(value, int) or 1e3 <= size < 1e12:
        return f"{value:,.0f}".replace(",", "\u202f").replace("-", "−") + unit
    if size and (size < 1e-3 or size >= 1e12):
        mantissa, exponent = f"{value:.1e}".split("e")
        raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        return f"{mantissa}{UNBROKEN}×{UNBROKEN}10{raised}".replace("-", "−") + unit
    return f"{value:.{digits}g}".replace("-", "−") + unit


def rounded(value, unit, decimals=None):
    """As number(), but with a fixed number of decimals, so that columns align."""
    decimals = DECIMALS.get(unit, 3) if decimals is None else decimals
    if isinstance(value, dict) and "value" in value:
        return _with_ends(value, unit, lambda one, unit: rounded(one, unit, decimals))
    if not isinstance(value, float) or not math.isfinite(value):
        return number(value, unit)
    return fixed(value, unit, decimals) + ending(unit)
