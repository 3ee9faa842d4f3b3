# diptych: numbers as text, and the words for the keys of the summaries
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A number may carry an interval: {"value", "low", "high"}. Unit "%" multiplies by 100, others are appended."""

import math

ABSENT = "not computed"
MESH_SET = "set by the mesh (local law)"
MESH_SET_REASON = "It is no property of the material unless it stays the same on two meshes."
LENGTH_SET_REASON = "It depends on that length, the size of the sample and the softening, all of them chosen or fitted."

# key of a summary -> (words, unit, what to hold it against), in the order of the page
WORDS = {
    "grains": ("grains", "", ""),
    "cells": ("cells", "", ""),
    "unknowns": ("unknowns", "", ""),
    "element_size_d": ("element size", " d", ""),
    "preparation_solid_fraction": ("solid fraction as prepared", "", ""),
    "preparation_residual": ("residual at the end of the preparation", "", ""),
    "preparation_unbalanced_force": ("unbalanced force after the preparation", "", ""),
    "preparation_steps": ("steps of the preparation", "", ""),
    "initial_height": ("initial height", "", ""),
    "platen_speed": ("platen speed", "", ""),
    "mean_inertial_number": ("mean inertial number", "", "quasi-static: well below 10⁻³"),
    "reached_axial_strain": ("axial strain reached", "%", ""),
    "peak_stress_ratio": ("peak stress ratio t/s, of the running mean", "", ""),
    "strain_at_peak": ("axial strain at the peak", "%", ""),
    "final_volumetric_strain": ("volumetric strain at the end", "%", ""),
    "max_equivalent_plastic_strain": ("largest equivalent plastic strain", "", ""),
    "internal_length_d": ("internal length of the law", " d", "a local law has none: its band is set by the mesh"),
    "localisation_strain": ("axial strain at the first loss of ellipticity", "%", ""),
    "localisation_angle_deg": ("angle of the line that could form there", "°", ""),
    "viscous_share": ("largest share of the strength that viscosity carries", "%", "rate independent: 0"),
    "processes": ("processes", "", ""),
    "share_zz_not_intermediate": ("points where σ_zz is not intermediate", "%", "below 5 %: the in-plane yield surface is exact only where it is"),
    "steps": ("steps", "", ""),
    "step_length": ("step length", "", ""),
    "cut_backs": ("load steps cut back", "", ""),
    "newton_iterations": ("Newton iterations", "", ""),
    "sweeps": ("solver sweeps in all", "", ""),
    "ns_per_update": ("time of one contact update", " ns", ""),
    "solver_share_of_cpu": ("contact solver's share of the CPU time", "%", ""),
    "residual": ("largest residual (natural map, relative)", "", ""),
    "residual_factor": ("grain-stress error over residual", "", ""),
    "max_penetration_d": ("largest penetration", " d", "rigid grains: 0"),
    "energy_residual": ("energy residual, relative", "", "closed balance: 0"),
    "momentum_residual": ("momentum residual", "", "closed balance: 0"),
    "spin_term_share": ("largest spin term over mean stress", "", "paper: dynamic terms below 10⁻³"),
    "kinetic_energy_ratio_median": ("kinetic energy over M|V|²/4, median", "", "slow: below 2"),
    "kinetic_energy_ratio_largest": ("kinetic energy over M|V|²/4, largest", "", ""),
    "platen_difference_share_below_1_percent": ("share of steps with platen forces equal within 1 %", "%",
                                                "expected: 98 % or more"),
    "platen_difference_mean": ("mean difference of the platen forces", "%", "paper: below 1 %"),
    "contacts": ("contacts at the end", "", ""),
    "coordination_number": ("coordination number", "", ""),
    "rattlers": ("grains without contact force", "", ""),
    "message": ("message", "", ""),
    "preparation_cpu_s": ("preparation of the grains", " s", ""),
    "discrete_cpu_s": ("grains, loading", " s", ""),
    "continuum_cpu_s": ("continuum", " s", ""),
    "comparison_cpu_s": ("homogenisation and comparison", " s", ""),
    "peak_memory_mb": ("peak memory", " MB", ""),
}


# key -> what null says, where it does say something
NULLS = {"internal_length_d": "none", "localisation_strain": "never", "localisation_angle_deg": "–"}


def origin(text):
    """Where the continuum's parameters come from, in the scene's own words (key comparison/parameters_from)."""
    return text or "the scene does not say whether its parameters are fitted or predicted"


def number(value, unit="", digits=4):
    """Text of a number with true minus sign and powers of ten; an interval follows in brackets."""
    if isinstance(value, dict) and "value" in value:
        text = number(value["value"], unit, digits)
        if value.get("low") is None or value.get("high") is None:
            return text
        return f"{text} {_brackets([number(value[end], unit, digits) for end in ('low', 'high')], unit)}"
    if value is None or isinstance(value, (dict, list)):
        return ABSENT
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if not math.isfinite(value):
        return ABSENT
    if unit == "%":
        value, unit = 100 * value, " %"
    size = abs(value)
    if isinstance(value, int) or 1e3 <= size < 1e12:
        return f"{value:,.0f}".replace(",", "\u202f").replace("-", "−") + unit
    if size and (size < 1e-3 or size >= 1e12):
        mantissa, exponent = f"{value:.1e}".split("e")
        raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
        return f"{mantissa} × 10{raised}".replace("-", "−") + unit
    return f"{value:.{digits}g}".replace("-", "−") + unit


def _brackets(ends, unit):
    """Interval without its unit, in one piece when a line is broken."""
    suffix = " %" if unit == "%" else unit
    return "[" + ",\u00a0".join(end.removesuffix(suffix) if suffix else end for end in ends) + "]"


DECIMALS = {"°": 1, " d": 1, " P": 2, "%": 2, "": 3}


def rounded(value, unit, decimals=None):
    """As number(), but with a fixed count of decimals, so that a column reads evenly."""
    if isinstance(value, dict) and "value" in value:
        text = rounded(value["value"], unit, decimals)
        if value.get("low") is None or value.get("high") is None:
            return text
        return f"{text} {_brackets([rounded(value[end], unit, decimals) for end in ('low', 'high')], unit)}"
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        return number(value)
    decimals = DECIMALS[unit] if decimals is None else decimals
    scale, unit = (100, " %") if unit == "%" else (1, unit)
    return f"{scale * value:.{decimals}f}".replace("-", "−") + unit
