# diptych: histories of both panels against the loading
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sources: discrete.csv and continuum.csv; stage markers from comparison.json. Forces in P d (unit thickness)."""

import numpy as np

from increments import scaled
from style import INK, PANEL_COLOURS, PANEL_LINES, PANEL_NAMES, chart, svg, with_intervals

POINTS = 1500   # of a raw curve on paper


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    last = f"{result.progress.text(result.averaging_strain)} of {result.progress.word}"
    return [
        _both(result, "stress_ratio", 1.0, "stress ratio t/s", "Stress ratio of the whole sample. Thin: every step; "
              "thick: mean over the last " + last + "; open marks: the stages, with 95 % intervals of the mean in time."),
        _both(result, "volumetric_strain", 100.0, "volumetric strain (%)", "Volumetric strain 1 − V/V₀, every step; "
              "dilation is negative. Open marks: the stages."),
        _platens(result),
        _platen_difference(result),
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


def decades(values):
    """Whole decades that hold the values, so that a logarithmic axis always has labels."""
    if not len(values):
        return 0.1, 1.0
    low, high = np.floor(np.log10(values.min()) + 1e-9), np.ceil(np.log10(values.max()) - 1e-9)
    return 10.0 ** low, 10.0 ** max(high, low + 1)


def history(result, panel, name):
    """(strain, values) where both are finite and strain grows; None if the column is not there."""
    columns = result.histories[panel]
    if "axial_strain" not in columns or name not in columns:
        return None
    strain, values = columns["axial_strain"], columns[name]
    good = np.isfinite(strain) & np.isfinite(values)
    strain, values = strain[good], values[good]
    return (strain, values) if len(strain) > 1 else None


def _both(result, name, scale, label, caption):
    figure, axes = chart(result, label)
    drawn = []
    for panel, colour in PANEL_COLOURS.items():
        found = history(result, panel, name)
        if found is None:
            continue
        strain, values = found
        if name == "stress_ratio":
            axes.plot(*thin(result.across(strain), scale * values), color=colour, alpha=0.5,
                      linewidth=0.5 if panel == "discrete" else 0.9)
            values = trailing_mean(strain, values, result.averaging_strain)
        axes.plot(*thin(result.across(strain), scale * values), color=colour, linewidth=1.8, linestyle=PANEL_LINES[panel],
                  label=PANEL_NAMES[panel])
        with_intervals(axes, [result.across(s.end) for s in result.stages],
                       [scaled(s.panel(panel).get(name), scale) for s in result.stages],
                       fmt="o" if panel == "discrete" else "s", markersize=4.5, markerfacecolor="white", color=colour,
                       markeredgewidth=1.2)
        drawn.append(PANEL_NAMES[panel])
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    if name == "stress_ratio":
        axes.set_ylim(bottom=0)
    axes.legend(loc="best")
    return svg(figure, f"{label} against the loading: {', '.join(drawn)}."), caption


def _platens(result):
    caption = ("Vertical force of each platen on the sample. Thin: every step of the grains; thick: mean over the last "
               f"{result.progress.text(result.averaging_strain)} of {result.progress.word}.")
    figure, axes = chart(result, "vertical platen force (P d)")
    unit = result.pressure * result.diameter
    drawn = 0
    for panel, colour in PANEL_COLOURS.items():
        for side, line in (("lower", "-"), ("upper", (0, (4, 2)))):
            found = history(result, panel, side + "_fy")
            if found is None:
                continue
            strain, force = found[0], np.abs(found[1]) / unit
            if panel == "discrete":
                axes.plot(*thin(result.across(strain), force), color=colour, linewidth=0.35, alpha=0.3)
            mean = trailing_mean(strain, force, result.averaging_strain)
            axes.plot(*thin(result.across(strain), mean), color=colour, linestyle=line, label=f"{PANEL_NAMES[panel]}, {side}")
            drawn += 1
    if not drawn:
        return None, caption
    axes.set_xlim(left=0)
    axes.legend(loc="best", ncol=2)
    return svg(figure, "Vertical platen forces against the loading, both panels, lower and upper platen."), caption


def _platen_difference(result):
    caption = ("Relative difference of the two platens' vertical forces on the grains, |F_lower + F_upper| over their "
               "mean size. The paper reports less than 1 %.")
    lower, upper = history(result, "discrete", "lower_fy"), history(result, "discrete", "upper_fy")
    if lower is None or upper is None or len(lower[0]) != len(upper[0]):
        return None, caption
    size = (np.abs(lower[1]) + np.abs(upper[1])) / 2
    difference = 100 * np.divide(np.abs(lower[1] + upper[1]), size, out=np.full_like(size, np.nan), where=size > 0)
    good = difference > 0
    if not good.any():
        return None, caption
    figure, axes = chart(result, "difference of platen forces (%)", log=True)
    axes.plot(*thin(result.across(lower[0][good]), difference[good]), color=PANEL_COLOURS["discrete"], linewidth=0.6)
    axes.axhline(1, color=INK, linewidth=1, linestyle="--")
    axes.annotate("1 %", (0.99, 1), xycoords=("axes fraction", "data"), ha="right", va="bottom")
    axes.set_xlim(left=0)
    return svg(figure, "Relative difference of the platens' vertical forces against the loading, log scale."), caption
