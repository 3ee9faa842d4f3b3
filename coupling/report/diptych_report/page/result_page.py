# diptych: report.html of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later

from diptych_report.charts import chains, circular, histories, ledgers, probes, resolution, strips, style, trends
from diptych_report.charts.style import Pair
from diptych_report.data.result import load
from diptych_report.page import opening, viewer
from diptych_report.page.writing import template, write
from diptych_report.tables import accounts, accuracy, bands, stage, summary, wording


class Part:
    """A part of the page stepped through by increments.

    maps: name of a pair of maps that draw.js draws, or "". content(increment): what stands under it, by name; the page says
    how each is shown. Each part opens at the end of its first window, or at 1 % of strain: all open at one instant.
    """

    def __init__(self, name, title, increments, content, maps=""):
        self.name, self.title, self.maps = name, title, maps
        first = opening.opens_at(increments)
        self.items = [{"key": i.key, "label": i.label, "kind": i.kind, "title": i.title, "end": f"{i.end:.9g}",
                       "open": i is first, **content(i)} for i in increments]


def parts(result):
    """The steppable parts in the order of the page; a new one is one entry here, its words one in the page."""
    mapped = [i for i in result.increments if i.arrays]
    stages = [i for i in mapped if i.kind == "stage"]
    return [
        Part("maps", "Grains and continuum at the same instant", mapped, lambda i: {
            "tables": [bands.bands(result, i)], "notes": bands.notes(result, i)}, "quantity"),
        Part("difference", "Difference on the same cells", mapped, lambda i: {
            "tables": [stage.stress_difference(result, i), stage.dissipation(result, i)],
            "notes": said((i.record.get("difference") or {}).get("stress_verdict"))}, "difference"),
        Part("arrows", "Field of motion", mapped, lambda i: {}, "arrows"),
        Part("strips", "Sixteen strips parallel to the band", result.increments, lambda i: {"pair": strips.pair(i)}),
        Part("probes", "Probes: mean stress and contact normals", stages, lambda i: {
            "roses": probes.roses(i), "notes": [], "tables": [
                stage.probes(result, i), stage.differences(result, i), stage.grain_pressures(result, i)]}, "probes"),
        Part("crosses", "Internal moments of single grains", stages, lambda i: {
            "pair": Pair(chains.distribution(i), chains.traction(i)),
            "tables": [stage.chains(result, i)], "notes": said(stage.chains_verdict(i))}, "crosses"),
        Part("forces", "Contact forces", stages, lambda i: {}, "forces"),
        Part("circle", "Circular probe", stages, lambda i: {"pair": circular.pair(i)}),
    ]


def said(sentence):
    """A verdict as a paragraph of its own: capital letter, full stop."""
    return [wording.typeset(sentence[0].upper() + sentence[1:].rstrip(".") + ".")] if sentence else []


def draw(folder):
    """Raises InputError where a file of the folder is missing, broken or of another format."""
    result = load(folder)
    style.set_up()
    write(folder, page(result))


def page(result):
    maps = viewer.data(result)
    return template("result.html").render(
        comparison=result.comparison, imported=result.imported, parts=parts(result), maps=maps, map_json=viewer.as_json(maps) if maps else "",
        still=opening.still_pair(result), curves=histories.figures(result) + ledgers.figures(result),
        solver=ledgers.solver(result), trends=trends.figures(result),
        resolution=resolution.figures(result), resolution_verdict=said(resolution.verdict(result)),
        stages=bands.stages(result), mapping=stage.mapping(result), accuracy=accuracy.table(result),
        discrete_summary=summary.table(result, "discrete_summary"),
        continuum_summary=summary.table(result, "continuum_summary"),
        coarse=result.part("continuum_coarse"), cost=accounts.cost(result), provenance=accounts.provenance(result),
        law=accounts.law_parameters(result), law_name=result.part("continuum_summary").get("law") or "",
        scene_text=result.scene_text, number=wording.number,
        fitted=wording.origin(result.part("continuum_summary").get("parameters_from")), absent=wording.ABSENT,
        thickness_note=bands.thickness_note(result),
        thickness_reason=wording.MESH_SET_REASON if bands.internal_length(result) is None else wording.LENGTH_SET_REASON,
        walk=result.walk, averaging=result.averaging)
