# diptych: charts of energies, kinetic energy and contact solver over the loading
# SPDX-License-Identifier: LGPL-2.1-or-later

from matplotlib.figure import Figure

from .style import (CONTINUUM, FAINT, GRAINS, INK, PANEL_COLOURS, THIRD, chart, decades, logarithmic, ruled, svg,
                                         thin)
from ..data.numbers import plain

ENERGIES = {"discrete": (("external_work", "work of platens and pressure, grains", GRAINS, "-"),
                         ("friction_dissipation", "dissipated by friction, grains", THIRD, (0, (6, 1.5))),
                         ("rolling_dissipation", "dissipated by rolling resistance, grains", THIRD, (0, (1, 1))),
                         ("impact_dissipation", "dissipated by impacts, grains", INK, (0, (2, 1.2)))),
            "continuum": (("dissipation", "plastic work, continuum", CONTINUUM, (0, (5, 1.5))),)}


def figures(result):
    """List of (Picture or None, caption) in the order of the page."""
    return [_energies(result), _kinetic_energy(result)]


def _energies(result):
    caption = ("Energies since the start. Grains: work = friction + rolling resistance + impacts + change of kinetic "
               "energy; the accuracy table gives the residual. Continuum: plastic work.")
    figure, axes = chart(result, "energy (P d²)")
    unit = result.units.size("pressure length^2")
    for panel, lines in ENERGIES.items():
        for name, label, colour, dashes in lines:
            found = result.history(panel, name)
            if found is not None and (found[1] != 0).any():
                axes.plot(*thin(result.loading_variable.factor * found[0], found[1] / unit), color=colour,
                          linestyle=dashes, label=label)
    if not axes.lines:
        return None, caption
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(loc="upper left", handlelength=3)
    return svg(figure, "Work and dissipation of grains and continuum against the loading."), caption


def _kinetic_energy(result):
    caption = ("Kinetic energy of the grains over M|V|²/4 (half of the mass moving with the platen). A median above 2 "
               "indicates solver noise. Single peaks are rearrangements of the packing. The continuum is quasi-static "
               "and has no kinetic energy.")
    found = result.history("discrete", "kinetic_energy_ratio")
    if found is None or not (found[1] > 0).any():
        return None, caption
    good = found[1] > 0
    progress, ratio = result.loading_variable.factor * found[0][good], found[1][good]
    figure, axes = chart(result, "kinetic energy / (M|V|²/4)", log=True)
    axes.set_ylim(decades(ratio))
    axes.plot(*thin(progress, ratio), color=PANEL_COLOURS["discrete"], linewidth=0.6)
    median = plain(result.part("discrete_summary").get("kinetic_energy_ratio_median"))
    if median is not None:
        axes.axhline(median, color=INK, linewidth=1, label=f"median {median:.3g}")
    axes.axhline(2, color=FAINT, linewidth=1, linestyle="--", label="2: warning")
    axes.set_xlim(left=0)
    axes.legend(loc="upper right")
    words = "" if median is None else f"; median {median:.3g}"
    return svg(figure, f"Kinetic energy ratio against the loading, logarithmic{words}."), caption


def solver(result):
    """(Picture or None, caption): sweeps and residual of every step."""
    caption = ("Contact solver, every step: number of sweeps over the contacts, and the residual (natural map, "
               "relative), computed outside the solver.")
    sweeps, residual = (result.history("discrete", name) for name in ("sweeps", "residual"))
    if sweeps is None or residual is None:
        return None, caption
    figure = Figure(figsize=(4.5, 3.1))
    for k, ((progress, values), label) in enumerate(((sweeps, "sweeps"), (residual, "residual"))):
        axes = ruled(figure.add_axes([0.15, 0.6 - 0.43 * k, 0.825, 0.36]))
        good = values > 0
        axes.plot(*thin(result.loading_variable.factor * progress[good], values[good]), color=PANEL_COLOURS["discrete"],
                  linewidth=0.6)
        axes.set(ylabel=label, ylim=decades(values[good]))
        logarithmic(axes)
        axes.set_xlim(left=0)
        axes.tick_params(labelbottom=k == 1)
    axes.set_xlabel(result.loading_variable.label)
    return svg(figure, "Sweeps and residual of the contact solver against the loading, logarithmic."), caption
