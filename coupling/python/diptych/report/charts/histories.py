# diptych: charts of histories over the loading, both panels: stress, volume, platens, energies, contact solver
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every step from discrete.csv and continuum.csv, running means from comparison.h5, stages from comparison.json. Forces
in P d (unit thickness)."""

import numpy as np

from .drawing import Figure
from .style import (CONTINUUM, FAINT, GRAINS, INK, PANEL_COLOURS, PANEL_LINES, PANEL_MARKS, ROUND_OFF, THIRD, chart,
                    decades, svg, thin, with_intervals)
from ..data.numbers import plain, scaled
from ..data.panels import PANEL_NAMES

RAW_WIDTH = {"discrete": 0.5, "continuum": 0.9}
ENERGIES = {"discrete": (("external_work", "work of platens and pressure, grains", GRAINS, "-"),
                         ("friction_dissipation", "dissipated by friction, grains", THIRD, (0, (6, 1.5))),
                         ("rolling_dissipation", "dissipated by rolling resistance, grains", THIRD, (0, (1, 1))),
                         ("impact_dissipation", "dissipated by impacts, grains", INK, (0, (2, 1.2)))),
            "continuum": (("dissipation", "plastic work, continuum", CONTINUUM, (0, (5, 1.5))),)}


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    return [
        _both(result, ("stress_ratio", "stress_ratio_mean"), 1.0, "stress ratio t/s",
              f"Stress ratio of the whole sample. Thin: every step; thick: mean over {result.averaging}. Open marks: "
              "stages, with 95 % intervals of the mean in time."),
        _both(result, ("volumetric_strain", "volumetric_strain"), 100.0, "volumetric strain (%)",
              "Volumetric strain 1 − V/V₀, every step; dilation is negative. Open marks: stages."),
        _platens(result),
        _platen_difference(result),
        _energies(result),
        _kinetic_energy(result),
    ]


def _both(result, columns, scale, label, caption):
    """columns: (name for every step, name for the thick line)."""
    figure, axes = chart(result, label)
    drawn, (every, thick) = [], columns
    for panel, colour in PANEL_COLOURS.items():
        raw, mean = result.history(panel, every), result.history(panel, thick)
        if raw is not None and thick != every:
            axes.plot(*thin(raw[0], scale * raw[1]), color=colour, alpha=0.5, linewidth=RAW_WIDTH[panel])
        if mean is not None:
            axes.plot(*thin(mean[0], scale * mean[1]), color=colour, linewidth=1.8, linestyle=PANEL_LINES[panel],
                      label=PANEL_NAMES[panel])
        if raw is None and mean is None:
            continue
        with_intervals(axes, [s.shown_end for s in result.stages],
                       [scaled(s.panel(panel).get(every), scale) for s in result.stages], fmt=PANEL_MARKS[panel],
                       markersize=4.5, markerfacecolor="white", color=colour, markeredgewidth=1.2)
        drawn.append(PANEL_NAMES[panel])
    if not drawn:
        return None, caption
    measured = result.levelled.get("history", {})
    if every in measured:
        axes.plot(result.loading_variable.factor * np.array(measured["axial_strain"]),
                  scale * np.array(measured[every], dtype=float), "D", color=THIRD, markersize=4, label="Measurement")
    axes.set(xlim=(0, None))
    if every == "stress_ratio":
        axes.set(ylim=(0, None))
    elif np.ptp(axes.y.limits()) < ROUND_OFF:
        axes.set(ylim=(-ROUND_OFF, ROUND_OFF))
    axes.legend()
    return svg(figure, f"{label} against the loading: {', '.join(drawn)}."), caption


def _platens(result):
    caption = ("Vertical force of each platen on the sample. Thin: every step of the grains; thick: mean over "
               f"{result.averaging}.")
    figure, axes = chart(result, "vertical platen force (P d)")
    unit, drawn = result.units.size("pressure length"), 0
    for panel, colour in PANEL_COLOURS.items():
        for side, line in (("lower", "-"), ("upper", (0, (4, 2)))):
            raw, mean = result.history(panel, side + "_fy"), result.history(panel, side + "_fy_mean")
            if raw is not None and panel == "discrete":
                axes.plot(*thin(raw[0], np.abs(raw[1]) / unit), color=colour, linewidth=0.35, alpha=0.3)
            if mean is not None:
                axes.plot(*thin(mean[0], np.abs(mean[1])), color=colour, linestyle=line,
                          label=f"{PANEL_NAMES[panel]}, {side}")
                drawn += 1
    if not drawn:
        return None, caption
    axes.set(xlim=(0, None))
    axes.legend()
    return svg(figure, "Vertical platen forces against the loading, both panels, lower and upper platen."), caption


def _positive(result, name):
    """(progress, values) of the grains where the values are positive; without any, both are empty."""
    progress, values = result.history("discrete", name) or (np.empty(0), np.empty(0))
    return progress[values > 0], values[values > 0]


def _over_decades(result, label, progress, values, shown):
    """(figure, axes) with a thin line of the grains over a logarithmic axis; shown: values within the limits."""
    figure, axes = chart(result, label)
    axes.y.is_log = True
    axes.plot(*thin(progress, values), color=PANEL_COLOURS["discrete"], linewidth=0.6)
    axes.set(xlim=(0, None), ylim=decades(shown))
    return figure, axes


def _platen_difference(result):
    caption = ("Relative difference of the vertical forces of both platens on the grains, |F_lower + F_upper| "
               "over their mean magnitude. Moreau (1997) reports less than 1 % in each step; the check is that of the "
               "mean.")
    progress, difference = _positive(result, "platen_difference")
    if not len(progress):
        return None, caption
    figure, axes = _over_decades(result, "difference of platen forces (%)", progress, 100 * difference,
                                 np.append(100 * difference, 1.0))
    axes.axhline(1, linestyle="--", label="1 %")
    axes.legend()
    return svg(figure, "Relative difference of the vertical platen forces against the loading, log scale."), caption


def _energies(result):
    caption = ("Energies since the start. Grains: work = friction + rolling resistance + impacts + change of kinetic "
               "energy; the accuracy table gives the residual. Continuum: plastic work.")
    figure, axes = chart(result, "energy (P d²)")
    unit = result.units.size("pressure length^2")
    for panel, lines in ENERGIES.items():
        for name, label, colour, dashes in lines:
            found = result.history(panel, name)
            if found is not None and (found[1] != 0).any():
                axes.plot(*thin(found[0], found[1] / unit), color=colour, linestyle=dashes, label=label)
    if axes.is_empty:
        return None, caption
    axes.set(xlim=(0, None), ylim=(0, None))
    axes.legend()
    return svg(figure, "Work and dissipation of grains and continuum against the loading."), caption


def _kinetic_energy(result):
    caption = ("Kinetic energy of the grains over M|V|²/4 (half of the mass moving with the platen). Single peaks are "
               "rearrangements of the packing. The continuum is quasi-static and has no kinetic energy.")
    progress, ratio = _positive(result, "kinetic_energy_ratio")
    if not len(progress):
        return None, caption
    figure, axes = _over_decades(result, "kinetic energy / (M|V|²/4)", progress, ratio, ratio)
    check = result.check("discrete_summary/kinetic_energy_ratio_median")
    if median := plain(check.get("value")):
        axes.axhline(median, label=f"median {median:.3g}")
        axes.axhline(check["limit"], color=FAINT, linestyle="--", label=f"its limit {check['limit']:g}")
    axes.legend()
    words = f"; median {median:.3g}" if median else ""
    return svg(figure, f"Kinetic energy ratio against the loading, logarithmic{words}."), caption


def solver(result):
    """(Picture or None, caption): sweeps and residual of every step."""
    caption = ("Contact solver, every step: number of sweeps over the contacts, and the residual (natural map, "
               "relative), computed outside the solver.")
    if any(result.history("discrete", name) is None for name in ("sweeps", "residual")):
        return None, caption
    figure = Figure((4.5, 3.1), [[0.15, 0.6 - 0.43 * k, 0.825, 0.36] for k in range(2)])
    for name, axes in zip(("sweeps", "residual"), figure.axes):
        progress, values = _positive(result, name)
        axes.y.is_log = True
        axes.plot(*thin(progress, values), color=PANEL_COLOURS["discrete"], linewidth=0.6)
        axes.set(ylabel=name, xlim=(0, None), ylim=decades(values))
    figure.axes[0].x.has_numbers = False
    axes.set(xlabel=result.loading_variable.label)
    return svg(figure, "Sweeps and residual of the contact solver against the loading, logarithmic."), caption
