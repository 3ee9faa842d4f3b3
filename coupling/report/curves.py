# diptych: histories of both panels against axial strain
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sources: discrete.csv and continuum.csv; stage markers from comparison.json. Forces in P d (unit thickness)."""

import numpy as np
from matplotlib.figure import Figure

from load import percent
from maps import plain
from style import FAINT, INK, PANEL_COLOURS, PANEL_LINES, PANEL_NAMES, svg

POINTS = 1500   # of a raw curve on paper


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    last = f"{percent(result.averaging_strain)} % of strain"
    return [
        _both(result, "stress_ratio", 1.0, "stress ratio t/s", "Stress ratio of the whole sample. Thin: every step; "
              "thick: mean over the last " + last + "; open marks: the stages of the comparison table."),
        _both(result, "volumetric_strain", 100.0, "volumetric strain (%)", "Volumetric strain 1 − V/V₀, drawn "
              "likewise; dilation is negative."),
        _platens(result),
        _platen_difference(result),
        _kinetic_energy(result),
        _sweeps(result),
    ]


def trailing_mean(strain, values, window):
    """Mean over the window of strain before each point, nan where it is not yet full; steps may be uneven."""
    area = np.concatenate([[0.0], np.cumsum(np.diff(strain) * (values[1:] + values[:-1]) / 2)])
    start = np.maximum(strain - window, strain[0])
    full = strain >= window - 1e-9
    # The integral up to start: whole steps, then the trapezium of the step that start cuts.
    step = np.clip(np.searchsorted(strain, start, side="right") - 1, 0, len(strain) - 1)
    before = area[step] + (start - strain[step]) * (values[step] + np.interp(start, strain, values)) / 2
    return np.divide(area - before, strain - start, out=np.full(len(strain), np.nan), where=full & (strain > start))


def thin(x, y, points=POINTS):
    """Lowest and highest point of each of points/2 bins: a long history keeps its spikes."""
    if len(x) <= points:
        return x, y
    keep = set()
    for part in np.array_split(np.flatnonzero(np.isfinite(y)), points // 2):
        if len(part):
            keep.update((part[np.argmin(y[part])], part[np.argmax(y[part])]))
    keep = sorted(keep)
    return x[keep], y[keep]


def _decades(values):
    """Whole decades that hold the values, so that a logarithmic axis always has labels."""
    if not len(values):
        return 0.1, 1.0
    low, high = np.floor(np.log10(values.min()) + 1e-9), np.ceil(np.log10(values.max()) - 1e-9)
    return 10.0 ** low, 10.0 ** max(high, low + 1)


def _history(result, panel, name):
    """(strain, values) where both are finite and strain grows; None if the column is not there."""
    columns = result.histories[panel]
    if "axial_strain" not in columns or name not in columns:
        return None
    strain, values = columns["axial_strain"], columns[name]
    good = np.isfinite(strain) & np.isfinite(values)
    strain, values = strain[good], values[good]
    return (strain, values) if len(strain) > 1 else None


def _axes(label, height=3.3, log=False):
    figure = Figure(figsize=(5.0, height))
    axes = figure.add_axes([0.14, 0.5 / height, 0.835, 1 - 0.62 / height])
    axes.set(xlabel="axial strain (%)", ylabel=label)
    if log:
        axes.set_yscale("log")
    axes.grid(True, color="#e4e4e4", linewidth=0.6)
    axes.set_axisbelow(True)
    return figure, axes


def _both(result, name, scale, label, caption):
    figure, axes = _axes(label)
    drawn = []
    for panel, colour in PANEL_COLOURS.items():
        history = _history(result, panel, name)
        if history is None:
            continue
        strain, values = history
        width = 0.5 if panel == "discrete" else 0.9
        axes.plot(*thin(100 * strain, scale * values), color=colour, linewidth=width, alpha=0.5)
        values = trailing_mean(strain, values, result.averaging_strain)
        axes.plot(*thin(100 * strain, scale * values), color=colour, linewidth=1.8, linestyle=PANEL_LINES[panel],
                  label=PANEL_NAMES[panel])
        stages = [(100 * s.end, plain(s.panel(panel).get(name))) for s in result.stages]
        stages = [(strain, scale * value) for strain, value in stages if value is not None]
        if stages:
            axes.plot(*zip(*stages), "o" if panel == "discrete" else "s", markersize=4.5, markerfacecolor="white",
                      markeredgecolor=colour, markeredgewidth=1.2)
        drawn.append(PANEL_NAMES[panel])
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    if name == "stress_ratio":
        axes.set_ylim(bottom=0)
    axes.legend(loc="best")
    return svg(figure, f"{label} against axial strain: {', '.join(drawn)}."), caption


def _platens(result):
    caption = ("Vertical force of each platen on the sample. Thin: every step of the grains; thick: mean over the last "
               f"{percent(result.averaging_strain)} % of strain.")
    figure, axes = _axes("vertical platen force (P d)")
    unit = result.pressure * result.diameter
    drawn = 0
    for panel, colour in PANEL_COLOURS.items():
        for side, line in (("lower", "-"), ("upper", (0, (4, 2)))):
            history = _history(result, panel, side + "_fy")
            if history is None:
                continue
            strain, force = history[0], np.abs(history[1]) / unit
            if panel == "discrete":
                axes.plot(*thin(100 * strain, force), color=colour, linewidth=0.35, alpha=0.3)
            mean = trailing_mean(strain, force, result.averaging_strain)
            axes.plot(*thin(100 * strain, mean), color=colour, linestyle=line, label=f"{PANEL_NAMES[panel]}, {side}")
            drawn += 1
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    axes.legend(loc="best", ncol=2)
    return svg(figure, "Vertical platen forces against axial strain, both panels, lower and upper platen."), caption


def _platen_difference(result):
    caption = ("Relative difference of the two platens' vertical forces on the grains, |F_lower + F_upper| over their "
               "mean size. The paper reports less than 1 %.")
    lower, upper = _history(result, "discrete", "lower_fy"), _history(result, "discrete", "upper_fy")
    if lower is None or upper is None or len(lower[0]) != len(upper[0]):
        return None, caption
    size = (np.abs(lower[1]) + np.abs(upper[1])) / 2
    difference = 100 * np.divide(np.abs(lower[1] + upper[1]), size, out=np.full_like(size, np.nan), where=size > 0)
    good = difference > 0
    if not good.any():
        return None, caption
    figure, axes = _axes("difference of platen forces (%)", log=True)
    axes.plot(*thin(100 * lower[0][good], difference[good]), color=PANEL_COLOURS["discrete"], linewidth=0.6)
    axes.axhline(1, color=INK, linewidth=1, linestyle="--")
    axes.annotate("1 %", (0.99, 1), xycoords=("axes fraction", "data"), ha="right", va="bottom")
    axes.set_xlim(left=0)
    return svg(figure, "Relative difference of the platens' vertical forces against axial strain, log scale."), caption


def _kinetic_energy(result):
    caption = ("Kinetic energy of the grains over M|V|²/4 (half of the mass moving with the platen). A median above 2 "
               "warns of solver noise; single peaks are crises of the packing.")
    history = _history(result, "discrete", "kinetic_energy_ratio")
    if history is None or not (history[1] > 0).any():
        return None, caption
    good = history[1] > 0
    strain, ratio = history[0][good], history[1][good]
    figure, axes = _axes("kinetic energy / (M|V|²/4)", log=True)
    axes.set_ylim(_decades(ratio))
    axes.plot(*thin(100 * strain, ratio), color=PANEL_COLOURS["discrete"], linewidth=0.6)
    median = float(np.median(ratio))
    axes.axhline(median, color=INK, linewidth=1, label=f"median {median:.3g}")
    axes.axhline(2, color=FAINT, linewidth=1, linestyle="--", label="2: warning")
    axes.set_xlim(left=0)
    axes.legend(loc="upper right")
    return svg(figure, f"Kinetic energy ratio against axial strain, logarithmic; median {median:.3g}."), caption


def _sweeps(result):
    caption = ("Contact solver, every step: sweeps over the contacts, and the residual measured outside the solver "
               "(natural map, relative).")
    sweeps, residual = (_history(result, "discrete", name) for name in ("sweeps", "residual"))
    if sweeps is None or residual is None:
        return None, caption
    figure = Figure(figsize=(5.0, 3.3))
    for k, ((strain, values), label) in enumerate(((sweeps, "sweeps"), (residual, "residual"))):
        axes = figure.add_axes([0.135, 0.56 - 0.41 * k, 0.84, 0.37])
        good = values > 0
        axes.plot(*thin(100 * strain[good], values[good]), color=PANEL_COLOURS["discrete"], linewidth=0.6)
        axes.set(ylabel=label, yscale="log", ylim=_decades(values[good]))
        axes.set_xlim(left=0)
        axes.grid(True, color="#e4e4e4", linewidth=0.6)
        axes.tick_params(labelbottom=k == 1)
    axes.set_xlabel("axial strain (%)")
    return svg(figure, "Sweeps and residual of the contact solver against axial strain, logarithmic."), caption
