# diptych: tables of cost, provenance, and parameters of the continuum law
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..data.files import scene_section
from . import summary
from .wording import number


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
