#!/usr/bin/env python3
# diptych: report.html of a result folder; usage: report.py RESULT_DIR
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exit codes: 0 done, 2 wrong input (usage, missing or broken file). An old page stays until the new one is whole."""

import os
import sys

sys.dont_write_bytecode = True  # the source tree may be read-only, and stays clean

import jinja2  # noqa: E402

import accounts  # noqa: E402
import curves  # noqa: E402
import fields  # noqa: E402
import maps  # noqa: E402
import probes  # noqa: E402
import strips  # noqa: E402
import style  # noqa: E402
import tables  # noqa: E402
import vectors  # noqa: E402
import wording  # noqa: E402
from load import InputError, load, percent  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))


def section(name, title, increments, content):
    """A part of the page stepped through by increments. content(increment): its pane's "pairs", and perhaps tables.

    Each part opens at the end of its first window, or at 1 % of strain: all open at one instant.
    """
    start = next((i.end for i in increments if i.kind == "window"), 0.01)
    first = next((i.key for i in increments if i.end >= start - 1e-9), increments[-1].key if increments else "")
    items = [{"key": i.key, "label": i.label, "kind": i.kind, "title": i.title, "end": f"{i.end:.9g}",
              "open": i.key == first, **content(i)} for i in increments]
    return {"name": name, "title": title, "items": items}


def sections(result):
    """The steppable parts in the order of the page; a new one is one entry here, its introduction one in the page."""
    box = maps.extent(result.increments)
    strain, cells = (fields.limits(q, result.increments) for q in (fields.STRAIN, fields.STRAIN_ON_CELLS))
    stress = [(quantity, fields.limits(quantity, result.stages)) for quantity in fields.STRESS]
    probed = [i for i in result.stages if i.panel("discrete").get("probes") or i.panel("continuum").get("probes")]
    return [
        section("strain", "Shear strain increment", result.increments, lambda i: {
            "pairs": [fields.pair(fields.STRAIN, i, box, strain)], "band_table": tables.bands(result, i),
            "verdicts": tables.verdicts(i)}),
        section("stress", "Stress on the same mesh cells", result.stages, lambda i: {
            "pairs": [fields.pair(quantity, i, box, rule) for quantity, rule in stress],
            "mapping": i.record.get("mapping"),
            "stress_difference": (i.record.get("difference") or {}).get("stress_l2_relative")}),
        section("cells", "Shear strain increment on the same mesh cells", result.windows, lambda i: {
            "pairs": [fields.pair(fields.STRAIN_ON_CELLS, i, box, cells)]}),
        section("vectors", "Displacement increments", result.windows or result.stages, lambda i: {
            "pairs": [vectors.pair(i, box)]}),
        section("strips", "Sixteen strips parallel to the band", result.windows, lambda i: {"pairs": [strips.pair(i)]}),
        section("probes", "Three probes", probed, lambda i: {
            "pairs": [probes.pair(i, box)], "probe_table": tables.probes(i)}),
    ]


def page(result):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    comparison = result.comparison
    return environment.get_template("template.html").render(
        comparison=comparison, sections=sections(result), curves=curves.figures(result), stages=tables.stages(result),
        discrete_summary=tables.summary(comparison.get("discrete_summary")),
        continuum_summary=tables.summary(comparison.get("continuum_summary")),
        coarse=comparison.get("continuum_coarse") or {}, cost=accounts.cost(result),
        provenance=accounts.provenance(result),
        law=accounts.law_parameters(result), scene_text=result.scene_text, number=wording.number,
        fitted=wording.FITTED, absent=wording.ABSENT, thickness_note=tables.thickness_note(result),
        thickness_reason=wording.MESH_SET_REASON if tables.internal_length(result) is None else wording.LENGTH_SET_REASON,
        averaging=percent(result.averaging_strain))


def main(arguments):
    if len(arguments) != 1:
        print("usage: report.py RESULT_DIR", file=sys.stderr)
        return 2
    try:
        result = load(arguments[0])
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    style.set_up()
    text = page(result)
    path = os.path.join(arguments[0], "report.html")
    with open(path + ".part", "w", encoding="utf-8") as stream:
        stream.write(text)
    os.replace(path + ".part", path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
