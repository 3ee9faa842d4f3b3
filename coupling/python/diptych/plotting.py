# diptych: pictures of maps, curves and bands
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawing behind the methods plot(), in the colours of the report. matplotlib loads with the first picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .arrays import Array, Band, History, Mesh

# Okabe and Ito's palette suits colour-blind readers. Line styles differ as well, for prints in grey.
GRAINS, CONTINUUM, DASHES = "#0072B2", "#D55E00", (0, (5, 1.5))
INK, NO_VALUE = "#222222", "#c4c4c4"
PANELS = {"grains": {"color": GRAINS}, "continuum": {"color": CONTINUUM, "linestyle": DASHES}}
_PER_CENT = ("axial_strain", "shear_strain", "volumetric_strain")
_EDGE = 1.0986  # half widths from the middle of a band to the edge of its 10-90 % width: artanh(0.8)


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot

    return matplotlib.pyplot.subplots(layout="constrained")[1]


def _plane(ax: Axes) -> Axes:
    ax.set(aspect="equal", xlabel="x [length]", ylabel="y [length]")
    return ax


def draw_cells(mesh: Mesh, values: Array, label: str, ax: Axes | None, look: dict[str, Any]) -> Axes:
    """Cells coloured by values (k) with a colour bar; NaN is grey. look: options of matplotlib's PolyCollection."""
    ax = _axes(ax)
    from matplotlib import colormaps
    from matplotlib.collections import PolyCollection

    cells = PolyCollection(mesh.polygons, array=np.ma.masked_invalid(values), edgecolor="face",
                           **{"cmap": colormaps["viridis"].with_extremes(bad=NO_VALUE), "linewidth": 0.3, **look})
    ax.add_collection(cells)
    ax.autoscale_view()
    ax.figure.colorbar(cells, ax=ax, label=label)
    return _plane(ax)


def draw_history(history: History, column: str, ax: Axes | None, look: dict[str, Any]) -> Axes:
    """A column over the loading variable: axial strain, shear strain or time. Strains in per cent."""
    ax = _axes(ax)
    loading = str(history["walk"][-1]) if "walk" in history else "axial_strain"
    (x, xlabel), (y, ylabel) = (_scaled(history, name) for name in (loading, column))
    ax.plot(x, y, **look)
    ax.set(xlabel=xlabel, ylabel=ylabel)
    return ax


def _scaled(history: History, column: str) -> tuple[Array, str]:
    words = "stress ratio t/s" if column == "stress_ratio" else column.replace("_", " ")
    if column in _PER_CENT:
        return 100 * history[column], words + " [%]"
    unit = history.unit.get(column, "-")
    return history[column], words + ("" if unit == "-" else f" [{unit}]")


def draw_bands(bands: list[Band], ax: Axes | None, size: tuple[float, float]) -> Axes:
    """Middle (solid) and edges of the 10-90 % width (dashed) of bands. size: of the picture without `ax` [length]."""
    from matplotlib.patheffects import withStroke

    alone, ax = ax is None, _axes(ax)
    for band in bands:
        for at, dashes in ((0.0, "-"), (-_EDGE, "--"), (_EDGE, "--")):
            ax.axline(*band.line(1.0, at), color=INK, linestyle=dashes, linewidth=1.2,
                      path_effects=[withStroke(linewidth=2.8, foreground="white")])
    if alone and bands:
        (x, y), (width, height) = bands[0].centre, size
        ax.set(xlim=(x - width / 2, x + width / 2), ylim=(y - height / 2, y + height / 2))
    return _plane(ax) if alone else ax
