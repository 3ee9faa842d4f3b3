# diptych: report.html of a measurement alone or beside one panel
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure

from ..files import LEVELLED, read_json, read_provenance
from .charts import by_matplotlib, measured
from .charts.style import INK, framed, svg, THIRD
from .data.files import open_arrays
from .data.numbers import loading_variable_of
from .data.panels import PANE_NAMES
from .page.writing import write
from .tables import measured as tables

WIDTH, TALLEST = 3.6, 4.6  # of a map, inches
CURVES = {"stress_ratio": (1.0, "stress ratio t/s"), "volumetric_strain": (100.0, "volumetric strain (%)")}


@by_matplotlib.styled()
def draw(folder):
    record, across = read_json(os.path.join(folder, LEVELLED), 1), loading_variable_of("axial_strain")
    provenance = read_provenance(os.path.join(folder, "provenance.json"))
    increments = []
    with open_arrays(os.path.join(folder, "levelled.h5")) as file:
        for window in record["windows"]:
            fields, title = file[window["key"]], f"{across.number(window['from'])}–{across.text(window['to'])}"
            charts = [(chart, f"{words}, {title}.") for chart, words in (
                (measured.profile(window), "Displacement across the band"),
                (measured.thickness(window), "Thickness by several conventions")) if chart]
            increments.append({"title": title, "figures": _maps(fields, window, title) + charts,
                               "notes": tables.notes(record, window),
                               "tables": [tables.bands(window), tables.thickness(window)]})
    facts = os.path.join(record["folder"], "measured.json")
    write(folder, "measured.html", record=record, name=os.path.basename(os.path.abspath(folder)),
          increments=increments, curves=_curves(record["history"]), command=provenance["command"],
          beside=tables.summary(record) if record["summary"] else None,
          remarks=read_json(facts).get("notes", []) if os.path.exists(facts) else [])


def _maps(fields, window, title):
    """(Picture, caption) of the shear strain of every pane, on one scale."""
    strains = {pane: 100 * fields[f"{pane}_shear_strain_increment"][()] for pane in PANE_NAMES
               if pane in window["levelled"]}
    points = fields["position"][()]
    high = np.nanpercentile(strains["measured"], 98)
    return [_map(points, values, high, (window["levelled"][pane]["bands"], f"{PANE_NAMES[pane]}, {title}"))
            for pane, values in strains.items()]


def _map(points, values, high, words):
    bands, caption = words
    low, size = points.min(0), np.ptp(points, axis=0)
    side = np.sqrt(np.prod(size) / len(points))
    scale = min((WIDTH - 0.2) / size[0], TALLEST / size[1])
    height = scale * size[1] + 0.75
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.add_axes([0.5 - scale * size[0] / WIDTH / 2, 0.7 / height, scale * size[0] / WIDTH,
                            scale * size[1] / height])
    axes.set(xlim=(low[0], low[0] + size[0]), ylim=(low[1], low[1] + size[1]), aspect="equal")
    axes.axis("off")
    discs = EllipseCollection(*np.full((2, len(points)), 1.4 * side), np.zeros(len(points)), units="xy",
                              offsets=points, transOffset=axes.transData, array=np.ma.masked_invalid(values))
    discs.set_clim(0, high)
    axes.add_collection(discs)
    for band in [band for band in bands if not band["diffuse"]]:
        angle = np.radians(band["angle_deg"]["value"])
        axes.axline(band["middle"], (band["middle"][0] + np.cos(angle), band["middle"][1] + np.sin(angle)), color=INK)
    bar = figure.colorbar(discs, cax=figure.add_axes([0.2, 0.46 / height, 0.6, 0.1 / height]),
                          orientation="horizontal", extend="max")
    bar.set_label("shear strain ε₁ − ε₂ (%)")
    return by_matplotlib.svg(figure, f"Shear strain: {caption}"), f"Shear strain. {caption}; line: middle of the band."


def _curves(history):
    """(Picture, caption) of the measured curves."""
    found = []
    for key in [key for key in CURVES if key in history]:
        factor, label = CURVES[key]
        figure, axes = framed("axial strain (%)", label)
        axes.plot(100 * np.array(history["axial_strain"]), factor * np.array(history[key], dtype=float), "D-",
                  color=THIRD, markersize=4)
        found.append((svg(figure, f"{label} over axial strain."), f"{label[0].upper() + label[1:]}, measured."))
    return found
