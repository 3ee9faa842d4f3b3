# diptych: tables of accuracy (solver, balances, mapping, mesh, step), cost, provenance and parameters of the law
# SPDX-License-Identifier: LGPL-2.1-or-later

from . import summary
from ..data.files import number as parsed, scene_section, scene_value
from ..data.numbers import known, plain
from .wording import ABSENT, number, rounded, shown_unit


def table(result):
    """Numbers without a check: name, value, note."""
    rows = [_row(result, "discrete_summary", "residual"), _grain_stress_error(result)]
    summary = result.part("discrete_summary")
    if summary.get("snapshots_sampled"):
        rows.append(["grains: snapshots with the required accuracy of grain stress",
                     f"{number(summary.get('snapshots_accurate'))} of {number(summary['snapshots_sampled'])}",
                     "means over a stage need less accuracy than single snapshots"])
    acceleration = max(map(abs, known(s.panel("discrete").get("acceleration_share") for s in result.stages)),
                       default=None)
    rows.append(["grains: acceleration term over the mean stress in one step, largest of the stages",
                 number(acceleration, "", 2), "a step holds impacts, whose mean over a stage is small"])
    return {"head": ["", "value", ""], "rows": [*rows, _row(result, "discrete_summary", "step_length"),
                                                *_continuum(result)]}


def checks(result):
    """Rows: name, value, limit, "kept" or "broken", reason; the broken ones first."""
    rows = sorted(result.comparison.get("checks", []), key=lambda one: one["kept"])
    return {"head": ["", "value", "limit", "", "beyond the limit"],
            "rows": [[one["name"], number(one["value"], "", 2), number(one["limit"], "", 2),
                      "kept" if one["kept"] else "broken", one["reason"]] for one in rows]}


def _row(result, part, key, digits=4):
    """A number of a summary, with its meaning from the program."""
    place = f"{part}/{key}"
    panel = "grains" if part == "discrete_summary" else "continuum"
    text = number(result.part(part).get(key), shown_unit(result.numbers, place), digits)
    return [f"{panel}: {result.numbers.meaning(place)}", text, ""]


def _grain_stress_error(result):
    summary = result.part("discrete_summary")
    label = "grains: " + result.numbers.meaning("discrete_summary/grain_stress_error")
    if plain(summary.get("grain_stress_error")) is not None:
        factor = number(summary.get("residual_factor"), "", 2)
        return [label, number(summary["grain_stress_error"], "%", 2),
                f"{factor} × residual, measured on the first snapshot"]
    change, reached = (plain(summary.get("residual_factor_" + key)) for key in ("error", "reference_residual"))
    if change is None:
        return [label, ABSENT, ""]
    return [label, "unknown", f"the first snapshot, solved further to a residual of {number(reached)}, changed by "
            f"{number(change, '%', 2)}, too much for an estimate"]


def _continuum(result):
    summary, coarse = result.part("continuum_summary"), result.part("continuum_coarse")
    tolerance = parsed(scene_value(result.scene_text, "continuum", "tolerance"))
    rows = [["continuum: element size; tolerance of the equilibrium",
             f"{number(summary.get('element_size_d'), ' d')}; {number(tolerance)}", ""],
            _row(result, "continuum_summary", "platen_unbalance", 2)]
    if coarse:
        rows.append(["continuum: band width, last window; on the coarse mesh", "; ".join(_widths(result, coarse)),
                     f"coarse mesh: elements of {number(coarse.get('element_size_d'), ' d')}"])
    return rows + [[*_row(result, "continuum_summary", "share_zz_not_intermediate")[:2],
                    "discs have no stress out of their plane; it matters for soils"]]


def _widths(result, coarse):
    fine = result.windows[-1].bands("continuum") if result.windows else []
    rough = (coarse.get("windows") or [{}])[-1].get("bands") or []
    return [rounded(bands[0].get("width_10_90_d"), " d") if bands else "no band" for bands in (fine, rough)]


def cost(result):
    """Totals from comparison.json, and every phase from provenance.json."""
    totals = [row[:2] for row in summary.table(result, "cost")["rows"]]
    phases = [[str(phase.get("name", "")), number(phase.get("cpu_s"), " s", 3), number(phase.get("wall_s"), " s", 3),
               number(phase.get("peak_memory_mb"), " MB", 3)] for phase in result.provenance.get("phases") or []]
    return {"totals": {"head": ["CPU time and memory", ""], "rows": totals},
            "phases": {"head": ["phase", "CPU time", "wall time", "peak memory"], "rows": phases}}


def provenance(result):
    source, rows = result.provenance, []
    for key, label in (("program", "program"), ("version", "version"), ("git_revision", "revision"),
                       ("command", "command"), ("scene", "scene"), ("seeds", "seed"), ("date", "run on")):
        value = source.get(key)
        rows.append([label, ", ".join(str(entry) for entry in value) if isinstance(value, list) else number(value)])
    rows += [[name, str(version)] for name, version in sorted((source.get("libraries") or {}).items())]
    rows += [["host: " + name, str(value)] for name, value in sorted((source.get("host") or {}).items())]
    return {"head": ["", ""], "rows": rows}


def law_parameters(result):
    """Name, value and meaning of every key in the section continuum of the scene."""
    rows = [[name.replace("_", " "), value, meaning]
            for name, value, meaning in scene_section(result.scene_text, "continuum")]
    return {"head": ["parameter", "value", "meaning [unit]; range"], "rows": rows}
