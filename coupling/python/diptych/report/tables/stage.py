# diptych: tables of one stage: probes, stress differences, dissipation and force chains
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A table is None if nothing of it is stored."""

from ..data.numbers import interval
from ..data.panels import PANEL_NAMES
from .wording import number, rounded, shown, typeset

PERCENTILES = ("5", "25", "50", "75", "95")
OF_BOTH = ("s1", "s2", "direction_deg", "t_over_s", "count")
# key -> key of its error
OF_GRAINS = {"fabric_direction_deg": "fabric_direction_error_deg", "fabric_to_stress_deg": None,
             "anisotropy": "anisotropy_error", "contacts": None}


def _table(head, rows):
    return {"head": head, "rows": rows} if rows else None


def _meanings(result, place, keys):
    return [result.numbers.meaning(f"{place}/{key}") for key in keys]


def probes(result, increment):
    rows = []
    for panel, words in PANEL_NAMES.items():
        place = increment.place(f"{panel}/probes")
        for probe in increment.panel(panel).get("probes") or []:
            row = [probe.get("name", ""), words] + [_cell(result, place, probe, key) for key in OF_BOTH]
            rows.append(row + ([_cell(result, place, probe, key, error) for key, error in OF_GRAINS.items()]
                               if panel == "discrete" else ["–"] * len(OF_GRAINS)))
    keys = _meanings(result, increment.place("discrete/probes"), (*OF_BOTH, *OF_GRAINS))
    return _table(["probe", "panel", *keys], rows)


def _cell(result, place, record, key, error=None):
    """A number, followed by its standard error if it has no interval."""
    text = shown(result.numbers, f"{place}/{key}", record.get(key))
    if error is None or record.get(error) is None or interval(record.get(key)):
        return text
    return f"{text} ± {shown(result.numbers, f'{place}/{error}', record[error])}"


def differences(result, increment):
    """Differences between the probes of the grains in the band and outside."""
    place = increment.place("discrete/probe_differences")
    keys = ("t_over_s", "anisotropy", "direction_deg")
    rows = [[f"{row.get('of', '')} − {row.get('and', '')}", *[_cell(result, place, row, key) for key in keys],
             typeset(row.get("verdict") or "")] for row in increment.panel("discrete").get("probe_differences") or []]
    return _table(["probes of the grains", *_meanings(result, place, (*keys, "verdict"))], rows)


def grain_pressures(result, increment):
    """Scatter of the pressure of single grains in each probe."""
    place, rows = increment.place("discrete/probes/grain_pressure"), []
    for probe in increment.panel("discrete").get("probes") or []:
        spread = probe.get("grain_pressure")
        if spread:
            percentiles = spread.get("percentiles") or {}
            rows.append([probe.get("name", "")] + [_cell(result, place, spread, key) for key in ("mean", "deviation")]
                        + [_cell(result, f"{place}/percentiles", percentiles, level) for level in PERCENTILES])
    return _table(["pressure of single grains", "mean", "standard deviation", *[f"{p} %" for p in PERCENTILES]], rows)


def stress_difference(result, increment):
    """Difference of the stress on cells, 3 d and 6 d, and the difference expected from sampling only. The verdict is a
    note."""
    place = increment.place("difference/stress")
    keys = ("resolution_d", "relative_l2", "sampling_alone", "direction_deg")
    rows = [[row.get("label", ""), *[_cell(result, place, row, key) for key in keys]]
            for row in increment.panel("difference").get("stress") or []]
    return _table(["averaged over", *_meanings(result, place, keys)], rows)


def mapping(result):
    """Errors of the mapping at each stage."""
    keys = ("total_relative_error", "nodal_residual", "couple_residual")
    rows = [[result.loading_variable.text(stage.end), str(kept.get("method", "")),
             *[number(kept.get(key), "", 2) for key in keys], rounded(kept.get("outside_share"), "%", 2)]
            for stage in result.stages for kept in [stage.panel("mapping")] if kept]
    words = _meanings(result, "stages/mapping", (*keys, "outside_share"))
    return _table([result.loading_variable.word, "method", *words], rows)


def dissipation(result, increment):
    rows, keys = [], ("share_inside", "area_share", "density_ratio")
    for panel, words in PANEL_NAMES.items():
        found = increment.panel(panel).get("dissipation")
        if found:
            place = increment.place(f"{panel}/dissipation")
            rows.append([words] + [shown(result.numbers, f"{place}/{key}", found.get(key), digits)
                                   for key, digits in zip(keys, (1, 1, 2))])
    return _table(["dissipation since the previous stage (grains: friction and impacts; continuum: plastic work)",
                   *_meanings(result, increment.place("discrete/dissipation"), keys)], rows)


def chains(result, increment):
    """Major principal stress of single grains inside and outside the band."""
    found = increment.panel("discrete").get("force_chains") or {}
    rows = [[f"{name} the band", number(part.get("grains")), rounded(part.get("mean"), ""),
             rounded(part.get("share_above_mean"), "%", 1)]
            for name in ("inside", "outside") for part in [found.get(name)] if part]
    if rows and found.get("largest_distance") is not None:
        words = result.numbers.meaning(increment.place("discrete/force_chains/largest_distance"))
        rows.append([words, "", rounded(found["largest_distance"], ""), ""])
    return _table(["major principal stress of a grain", "grains", "mean, relative", "share above the mean"], rows)
