# diptych: how accurate the numbers of a result are: solver, ledgers, mapping, mesh and step
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from increments import plain
from wording import ABSENT, number, rounded


def table(result):
    """Rows: what, value, what to hold it against."""
    return {"head": ["", "value", "hold against"], "rows": _grains(result) + _mapping(result) + _continuum(result)}


def _grains(result):
    summary = result.comparison.get("discrete_summary") or {}
    rows = [["grains: largest contact residual (natural map, relative)", number(summary.get("residual")), ""],
            ["grains: residual × step / inertial number", number(_noise(result, summary), "", 2),
             "safe up to 0.7; strength doubtful from 5"],
            ["grains: error of single grains' stress", *_grain_stress_error(summary)]]
    if summary.get("snapshots_sampled") is not None:
        rows.append(["grains: snapshots that reached the demanded accuracy of grain stress",
                     f"{number(summary.get('snapshots_accurate'))} of {number(summary['snapshots_sampled'])}",
                     "means over a stage bear less accuracy than single snapshots do"])
    return rows + [["grains: energy residual, relative", number(summary.get("energy_residual")), "closed balance: 0"],
                   ["grains: momentum residual", number(summary.get("momentum_residual")), "closed balance: 0"],
                   ["grains: dynamic terms over the mean stress, largest of the stages: spin; acceleration in one step",
                    f"{number(_largest(result, 'dynamic_share'), '', 2)}; {number(_largest(result, 'acceleration_share'), '', 2)}",
                    "paper: below 10⁻³; prototype: 5·10⁻⁵; 0.3–0.5 %"],
                   ["grains: largest penetration", number(summary.get("max_penetration_d"), " d"), "rigid: 0"],
                   ["grains: step length; mean inertial number",
                    f"{number(summary.get('step_length'))}; {number(summary.get('mean_inertial_number'))}",
                    "quasi-static: inertial number well below 10⁻³"]]


def _largest(result, key):
    """Largest size of a number of the grains' stages; None where no stage has it."""
    return max((abs(plain(s.panel("discrete").get(key))) for s in result.stages
                if plain(s.panel("discrete").get(key)) is not None), default=None)


def _noise(result, summary):
    """Solver noise over the motion: residual times the step in d sqrt(rho/P), over the inertial number; None if not known."""
    step, inertial = plain(summary.get("step_length")), plain(summary.get("mean_inertial_number"))
    residual = plain(summary.get("residual"))
    try:
        density = float(result.scene["sample"].get("density", "nan"))
    except ValueError:
        density = float("nan")
    if None in (step, inertial, residual) or not inertial or not density > 0:
        return None
    return residual * step * np.sqrt(result.pressure / density) / result.diameter / inertial


def _grain_stress_error(summary):
    factor, residual = plain(summary.get("residual_factor")), plain(summary.get("residual"))
    if factor is not None and residual is not None:
        return number(factor * residual, "%", 2), f"error = {number(factor, '', 2)} × residual, measured on the first snapshot"
    change, reached = plain(summary.get("residual_factor_error")), plain(summary.get("residual_factor_reference_residual"))
    if change is None:
        return ABSENT, ""
    return "not known", (f"the first snapshot, solved on to a residual of {number(reached)}, changed by "
                         f"{number(change, '%', 2)}: too much to tell an error from")


def _mapping(result):
    kept = [stage.record.get("mapping") or {} for stage in result.stages]
    rows = []
    for key, words, unit, expected in (
            ("total_relative_error", "mapping: largest relative error of the total moment", "", "conservative: round-off"),
            ("nodal_residual", "mapping: largest nodal residual of equilibrium", "", "identity of virtual power: round-off"),
            ("outside_share", "mapping: largest share from outside the mesh", "%", "warned above 5 %")):
        values = [plain(m.get(key)) for m in kept if plain(m.get(key)) is not None]
        rows.append([words, number(max(values), unit, 2) if values else ABSENT, expected])
    return rows


def _continuum(result):
    summary, coarse = (result.comparison.get(key) or {} for key in ("continuum_summary", "continuum_coarse"))
    scene = result.scene["continuum"]
    rows = [["continuum: element size; tolerance of the equilibrium",
             f"{number(summary.get('element_size_d'), ' d')}; {_text_number(scene.get('tolerance'))}", ""],
            ["continuum: platen forces out of balance, at the end", number(_unbalance(result), "", 2), "equilibrium: 0"]]
    if coarse:
        size = number(coarse.get("element_size_d"), " d")
        rows.append(["continuum: peak stress ratio; on the coarse mesh",
                     f"{rounded(summary.get('peak_stress_ratio'), '')}; {rounded(coarse.get('peak_stress_ratio'), '')}",
                     f"coarse mesh: elements of {size}"])
        rows.append(["continuum: band width, last window; on the coarse mesh", "; ".join(_widths(result, coarse)),
                     "a thickness counts only where both agree"])
    return rows + [["continuum: points where σ_zz is not intermediate", number(summary.get("share_zz_not_intermediate"), "%"),
                    "below 5 %: the in-plane yield surface is exact only where it is"]]


def _text_number(text):
    try:
        return number(float(text))
    except (TypeError, ValueError):
        return text or ABSENT


def _widths(result, coarse):
    fine = result.windows[-1].bands("continuum") if result.windows else []
    rough = (coarse.get("windows") or [{}])[-1].get("bands") or []
    return [rounded(bands[0].get("width_10_90_d"), " d") if bands else "no band" for bands in (fine, rough)]


def _unbalance(result):
    history = result.histories["continuum"]
    if not all(len(history.get(name, ())) for name in ("lower_fy", "upper_fy")):
        return None
    lower, upper = history["lower_fy"][-1], history["upper_fy"][-1]
    size = (abs(lower) + abs(upper)) / 2
    return abs(lower + upper) / size if size > 0 else None
