# diptych: cost, provenance, and what of the continuum is fitted
# SPDX-License-Identifier: LGPL-2.1-or-later

from load import scene_section
from tables import LAW_KEYS, summary
from wording import number


def cost(result):
    """Totals of comparison.json, then every phase of provenance.json."""
    totals = [row[:2] for row in summary(result.comparison.get("cost"))["rows"]]
    phases = [[str(phase.get("name", "")), number(phase.get("cpu_s"), " s", 3), number(phase.get("wall_s"), " s", 3),
               number(phase.get("peak_memory_mb"), " MB", 3)] for phase in result.provenance.get("phases") or []]
    return {"totals": {"head": ["CPU time and memory", ""], "rows": totals},
            "phases": {"head": ["phase", "CPU time", "wall time", "peak memory"], "rows": phases}}


def provenance(result):
    source, rows = result.provenance, []
    for key, words in (("program", "program"), ("version", "version"), ("git_revision", "revision"),
                       ("command", "command"), ("scene", "scene"), ("seed", "seed"), ("date", "run on")):
        rows.append([words, number(source.get(key)) if not isinstance(source.get(key), int) else str(source[key])])
    rows += [[name, str(version)] for name, version in sorted((source.get("libraries") or {}).items())]
    rows += [["host: " + name, str(value)] for name, value in sorted((source.get("host") or {}).items())]
    return {"head": ["", ""], "rows": rows}


def law_parameters(result):
    """Name and value of every parameter of the law: from the summary, otherwise the scene's section continuum."""
    values = result.comparison.get("continuum_summary") or {}
    rows = []
    for key in LAW_KEYS:
        if isinstance(values.get(key), dict):
            rows += [[name.replace("_", " "), number(value), ""] for name, value in values[key].items()]
        elif values.get(key) is not None:
            rows.append([key.replace("_", " "), number(values[key]), ""])
    if len(rows) < 2:
        rows = [[name.replace("_", " "), value, meaning] for name, value, meaning in
                scene_section(result.scene_text, "continuum")] or rows
    return {"head": ["parameter", "value", "meaning [unit]; range"], "rows": rows}

