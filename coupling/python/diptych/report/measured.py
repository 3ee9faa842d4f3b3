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

WIDTH, TALLEST = 3.6, 5.3  # of a map, inches
CURVES = {"stress_ratio": (1.0, "stress ratio t/s"), "volumetric_strain": (100.0, "volumetric strain (%)")}


@by_matplotlib.styled()
def draw(folder):
    record, across = read_json(os.path.join(folder, LEVELLED), 1), loading_variable_of("axial_strain")
    increments = []
    with open_arrays(os.path.join(folder, "levelled.h5")) as file:
        for window in record["windows"]:
            title = f"{across.number(window['from'])}–{across.text(window['to'])}"
            figures, words = _maps(file[window["key"]], window, title), f"Displacement across the band, {title}."
            if profile := measured.profile(window["levelled"], words):
                figures.append((profile, words))
            increments.append({"title": title, "notes": tables.notes(record, window), "figures": figures,
                               "tables": [tables.bands(window), tables.thickness(window)]})
    facts = os.path.join(record["folder"], "measured.json")
    write(folder, "measured.html", name=os.path.basename(os.path.abspath(folder)), increments=increments,
          curves=_curves(record["history"]),
          command=read_provenance(os.path.join(folder, "provenance.json"))["command"],
          beside=tables.summary(record) if record["summary"] else None,
          remarks=read_json(facts).get("notes", []) if os.path.exists(facts) else [])


def _maps(fields, window, title):
    """(Picture, caption) of the shear strain of every pane, on one scale."""
    strains = {pane: 100 * fields[f"{pane}_shear_strain_increment"][()] for pane in PANE_NAMES
               if pane in window["levelled"]}
    high = np.nanpercentile(strains["measured"], 98)
    d = window["mean_diameter"]
    return [_map(fields["position"][()] / d, values, high, [
        {**band, "middle": np.array(band["middle"]) / d} for band in window["levelled"][pane]["bands"]],
                 caption=f"Shear strain. {PANE_NAMES[pane]}, {title}.") for pane, values in strains.items()]


def _map(points, values, high, bands, *, caption):
    narrow = [band for band in bands if not band["diffuse"]]
    caption += " Line: middle of the band." if narrow else ""
    low, size = points.min(0), np.ptp(points, axis=0)
    figure = Figure(figsize=(WIDTH, min(TALLEST, WIDTH * size[1] / size[0] + 0.7)), layout="constrained")
    axes = figure.add_subplot(xlim=(low[0], low[0] + size[0]), ylim=(low[1], low[1] + size[1]), aspect="equal",
                              xlabel="x / d", ylabel="y / d")
    side = 1.5 * np.sqrt(np.prod(size) / len(points))  # discs that leave no gap
    discs = EllipseCollection(*np.full((2, len(points)), side), np.zeros(len(points)), units="xy", offsets=points,
                              transOffset=axes.transData, array=np.ma.masked_invalid(values))
    discs.set_clim(0, high)
    axes.add_collection(discs)
    for band in narrow:
        axes.axline(band["middle"], slope=np.tan(np.radians(band["angle_deg"]["value"])), color=INK)
    figure.colorbar(discs, ax=axes, orientation="horizontal", extend="max", label="shear strain ε₁ − ε₂ (%)")
    return by_matplotlib.svg(figure, caption), caption


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
