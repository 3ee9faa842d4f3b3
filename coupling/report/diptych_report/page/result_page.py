#!/usr/bin/env python3
# diptych: report.html of a result folder; usage: report.py RESULT_DIR
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exit codes: 0 done, 2 wrong input (usage, missing or broken file). An old page stays until the new one is whole."""

import os
import sys

sys.dont_write_bytecode = True  # the source tree may be read-only, and stays clean

import jinja2  # noqa: E402

import accounts  # noqa: E402
import accuracy  # noqa: E402
import chains  # noqa: E402
import circular  # noqa: E402
import curves  # noqa: E402
import ledgers  # noqa: E402
import probes  # noqa: E402
import resolution  # noqa: E402
import stage_tables  # noqa: E402
import still  # noqa: E402
import strips  # noqa: E402
import style  # noqa: E402
import tables  # noqa: E402
import trends  # noqa: E402
import viewer  # noqa: E402
import wording  # noqa: E402
from load import InputError, load  # noqa: E402
from pair import Pair  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))


class Part:
    """A part of the page stepped through by increments.

    maps: name of a pair of maps that draw.js draws, or "". content(increment): what stands under it, by name; the page says
    how each is shown. Each part opens at the end of its first window, or at 1 % of strain: all open at one instant.
    """

    def __init__(self, name, title, increments, content, maps=""):
        self.name, self.title, self.maps = name, title, maps
        opening = opens_at(increments)
        self.items = [{"key": i.key, "label": i.label, "kind": i.kind, "title": i.title, "end": f"{i.end:.9g}",
                       "open": i is opening, **content(i)} for i in increments]


def opens_at(increments):
    """The increment that is shown first; None without any."""
    start = next((i.end for i in increments if i.kind == "window"), 0.01)
    return next((i for i in increments if i.end >= start - 1e-9), increments[-1] if increments else None)


def parts(result):
    """The steppable parts in the order of the page; a new one is one entry here, its words one in the page."""
    mapped = [i for i in result.increments if i.arrays]
    stages = [i for i in mapped if i.kind == "stage"]
    return [
        Part("maps", "Grains and continuum at the same instant", mapped, lambda i: {
            "tables": [tables.bands(result, i)], "notes": tables.band_notes(result, i)}, "quantity"),
        Part("difference", "Difference on the same cells", mapped, lambda i: {
            "tables": [stage_tables.stress_difference(i), stage_tables.dissipation(i)],
            "notes": said((i.record.get("difference") or {}).get("stress_verdict"))}, "difference"),
        Part("arrows", "Field of motion", mapped, lambda i: {}, "arrows"),
        Part("strips", "Sixteen strips parallel to the band", result.increments, lambda i: {"pair": strips.pair(i)}),
        Part("probes", "Probes: mean stress and contact normals", stages, lambda i: {
            "roses": probes.roses(i), "notes": [], "tables": [
                stage_tables.probes(i), stage_tables.differences(i), stage_tables.grain_pressures(i)]}, "probes"),
        Part("crosses", "Internal moments of single grains", stages, lambda i: {
            "pair": Pair(chains.distribution(i), chains.traction(i)),
            "tables": [stage_tables.chains(i)], "notes": said(stage_tables.chains_verdict(i))}, "crosses"),
        Part("forces", "Contact forces", stages, lambda i: {}, "forces"),
        Part("circle", "Circular probe", stages, lambda i: {"pair": circular.pair(i)}),
    ]


def said(sentence):
    """A verdict as a paragraph of its own: capital letter, full stop."""
    return [sentence[0].upper() + sentence[1:].rstrip(".") + "."] if sentence else []


def page(result):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    comparison = result.comparison
    maps = viewer.data(result)
    return environment.get_template("template.html").render(
        comparison=comparison, parts=parts(result), maps=maps, map_json=viewer.as_json(maps) if maps else "",
        still=still.pair(result, opens_at([i for i in result.increments if i.arrays])),
        curves=curves.figures(result) + ledgers.figures(result), solver=ledgers.solver(result),
        trends=trends.figures(result),
        resolution=resolution.figures(result), resolution_verdict=said(resolution.verdict(result)),
        stages=tables.stages(result), mapping=stage_tables.mapping(result), accuracy=accuracy.table(result),
        discrete_summary=tables.summary(comparison.get("discrete_summary")),
        continuum_summary=tables.summary(comparison.get("continuum_summary")),
        coarse=comparison.get("continuum_coarse") or {}, cost=accounts.cost(result),
        provenance=accounts.provenance(result),
        law=accounts.law_parameters(result), scene_text=result.scene_text, number=wording.number,
        fitted=wording.origin((comparison.get("continuum_summary") or {}).get("parameters_from")), absent=wording.ABSENT, thickness_note=tables.thickness_note(result),
        thickness_reason=wording.MESH_SET_REASON if tables.internal_length(result) is None else wording.LENGTH_SET_REASON,
        progress=result.progress,
        averaging=result.progress.text(result.averaging_strain))


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
