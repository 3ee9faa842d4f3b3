# diptych: report.html of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later

from types import SimpleNamespace

from ..charts import chains, circular, histories, measured, platens, probes, profiles, resolution, strips, trends
from ..charts.style import Pair
from ..data.result import load
from . import viewer
from .writing import write
from ..tables import accuracy, bands, stage, summary, wording
from ..tables import measured as measured_tables


def end_of(increments):
    """Progress at which the page opens: the end of the last window, or of the last stage if there is no window."""
    windows = [i for i in increments if i.kind == "window"]
    return (windows or increments)[-1].end


def opens_at(increments, end):
    """The first increment that reaches `end`, or the last one; windows come before stages."""
    return next((i for i in increments if i.end >= end - 1e-9), increments[-1])


def _part(name, title, increments, end, content, *, maps=""):
    """A part of the page with one pane per increment.

    maps: name of a pair of maps that draw.js draws, or "". content(increment): charts, tables and notes below the maps,
    by name; the template shows them. end: all parts open at the increment that ends there.
    """
    first = opens_at(increments, end)
    items = [{"key": i.key, "label": i.label, "kind": i.kind, "title": i.title, "end": f"{i.end:.9g}",
              "open": i is first, **content(i)} for i in increments]
    return SimpleNamespace(name=name, title=title, maps=maps, items=items)


def parts(result):
    """The parts in the order of the page. A new part is an entry here and its explanation in templates/result.html."""
    every, stages, end = result.increments, result.stages, end_of(result.increments)
    measured_windows = [i for i in every if i.levelled]
    return [
        _part("maps", "Grains and continuum at the same instant", every, end, lambda i: {
            "tables": [bands.bands(result, i)], "notes": bands.notes(result, i)}, maps="quantity"),
        *([_part("measured", "Beside the measurement", measured_windows, end, lambda i: {
            "pair": Pair(*(measured.profile(i.levelled[of], f"Displacement across the band, {of}.")
                           for of in ("levelled", "unblurred")), "Displacement across the band: levelled, unblurred."),
            "tables": [measured_tables.bands(i.levelled), measured_tables.thickness(i.levelled)],
            "notes": measured_tables.notes(result.levelled, i.levelled)})] if measured_windows else []),
        _part("difference", "Difference on the same cells", every, end, lambda i: {
            "tables": [stage.stress_difference(result, i), stage.dissipation(result, i)],
            "notes": paragraph(i.panel("difference").get("stress_verdict"))}, maps="difference"),
        _part("arrows", "Displacements and velocities", every, end, lambda i: {}, maps="arrows"),
        _part("strips", "Sixteen strips parallel to the band", every, end, lambda i: {"pair": strips.pair(i)}),
        _part("profiles", "Profiles across the band", [i for i in every if i.kind == "window"] or stages, end,
             lambda i: {"pair": profiles.pair(i)}),
        _part("probes", "Probes: mean stress and contact normals", stages, end, lambda i: {
            "roses": probes.roses(i), "notes": [], "tables": [
                stage.probes(result, i), stage.differences(result, i), stage.grain_pressures(result, i)]},
             maps="probes"),
        _part("crosses", "Internal moments of single grains", stages, end, lambda i: {
            "pair": Pair(chains.distribution(i), chains.traction(i)),
            "tables": [stage.chains(result, i)],
            "notes": paragraph((i.panel("discrete").get("force_chains") or {}).get("verdict"))}, maps="crosses"),
        _part("forces", "Contact forces", stages, end, lambda i: {}, maps="forces"),
        _part("circle", "Circular probe", stages, end, lambda i: {"pair": circular.pair(i)}),
    ]


def paragraph(sentence):
    """[A verdict with capital letter and full stop], or [] for an empty one."""
    return [wording.typeset(sentence[0].upper() + sentence[1:].rstrip(".") + ".")] if sentence else []


def draw(folder, next_folder=None):
    """Writes the page to next_folder, whose files take the place of older ones in folder; default: folder."""
    result = load(folder, next_folder or folder)
    study = result.part("resolution_study")
    write(next_folder or folder, "result.html",
          comparison=result.comparison, imported=result.imported, parts=parts(result), maps=viewer.data(result),
          curves=histories.figures(result) + platens.figures(result), solver=histories.solver(result),
          trends=trends.figures(result), resolution=resolution.figures(study),
          resolution_verdict=paragraph(study.get("verdict")), stages=bands.stages(result),
          mapping=stage.mapping(result), accuracy=accuracy.table(result), checks=accuracy.checks(result),
          first=summary.first(result.comparison), levelled=result.levelled,
          beside=measured_tables.summary(result.levelled) if result.levelled else None,
          discrete_summary=summary.table(result, "discrete_summary"),
          continuum_summary=summary.table(result, "continuum_summary"),
          coarse=result.part("continuum_coarse"), cost=accuracy.cost(result), provenance=accuracy.provenance(result),
          law=accuracy.law_parameters(result), law_name=result.part("continuum_summary").get("law") or "",
          scene_text=result.scene_text, number=wording.number, absent=wording.ABSENT,
          fitted=result.part("continuum_summary").get("parameters_from"), thickness_note=bands.thickness_note(result),
          thickness_reason=wording.MESH_SET_REASON if bands.internal_length(result) is None
          else wording.LENGTH_SET_REASON, loading_variable=result.loading_variable, averaging=result.averaging)
