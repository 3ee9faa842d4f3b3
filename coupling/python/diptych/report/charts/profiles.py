# diptych: charts of the profiles across the band, both panels with the same axes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Relative rotation, couple stress, solid fraction and fluctuation of velocity over the distance from the band."""

import numpy as np

from .drawing import Figure
from .style import FAINT, PANEL_COLOURS, Pair, signed, svg
from ...arrays import ends_text, short
from ..data.numbers import interval, plain
from ..data.panels import PANEL_NAMES

# array -> label of its axis, number of the profile that belongs to it and its name
ROWS = {"relative_rotation": ("rotation (rad)", "rotation_amplitude", "rotation − spin,"),
        "couple_stress": ("couple stress (P d)", "couple_stress_peak", "peak"),
        "solid_fraction": ("solid fraction", "loosening", "loosening"),
        "velocity_fluctuation": ("rms fluctuation / platen", None, "")}
NONE = {"velocity_fluctuation": "a continuum has no fluctuations"}
CLASSICAL = "a classical continuum has none"
HEIGHT = 8.65  # of the figure [inch]
MOST_ALIKE = 10  # ratio of the couple stresses beyond which the page says that the mechanisms differ


def pair(increment):
    """Both panels on the same axes; None in place of a panel without a profile."""
    curves = {panel: _curves(increment.arrays, panel) for panel in PANEL_NAMES}
    if not all(curves.values()):
        return Pair(None, None, "No band in this increment.")
    numbers = {panel: increment.panel(panel).get("profile") or {} for panel in PANEL_NAMES}
    limits = _limits(curves)
    angles = [f"{PANEL_NAMES[panel].lower()} {signed(format(numbers[panel]['angle_deg'], '.1f'))}°"
              for panel in PANEL_NAMES
              if "angle_deg" in numbers[panel]]
    couples, turns = ([plain(numbers[panel].get(key)) for panel in PANEL_NAMES]
                      for key in ("couple_stress_peak", "rotation_amplitude"))
    return Pair(*[_panel(panel, curves[panel], numbers[panel], limits, increment.title) for panel in PANEL_NAMES],
                caption=f"Profile across a band of inclination: {', '.join(angles)}; {increment.title}."
                + regularisation(couples, turns))


def regularisation(couples, turns=(None, None)):
    """A sentence if the couple stress of the continuum is not that of the grains.

    couples, turns: numbers of grains and continuum or None."""
    if None in couples or not abs(couples[1]) > MOST_ALIKE * abs(couples[0]):
        return ""
    more = "" if None in turns else f", rotation − spin {turns[0]:.2g} and {turns[1]:.2g} rad"
    return signed(f" The internal length regularises the law and is no mechanism of these grains: couple stress "
                  f"{couples[0]:.2g} P d in the grains and {couples[1]:.2g} P d in the continuum{more}.")


def of_means(curves, title):
    """Pictures of profiles that are means over samples. curves: {panel: {"distance": (n), name: (n, 3)}}."""
    limits = _limits(curves)
    return Pair(*[_panel(panel, curves[panel], {}, limits, title) for panel in PANEL_NAMES])


def _curves(arrays, panel):
    start = f"profile/{panel}/"
    found = {path.removeprefix(start): np.asarray(values, dtype=float) for path, values in arrays.items()
             if path.startswith(start)}
    return found if len(found.get("distance", ())) else {}


def _limits(curves):
    """{row: (low, high)} that hold both panels."""
    limits = {}
    for name in ROWS:
        keys = (name, "spin") if name == "relative_rotation" else (name,)
        drawn = [one[key] for one in curves.values() for key in keys]
        known = np.concatenate([values[np.isfinite(values)] for values in drawn])
        margin = 0.08 * (np.ptp(known) or 1) if len(known) else 0.1
        limits[name] = (known.min() - margin, known.max() + margin) if len(known) else (0, 1)
    return limits


def _panel(panel, curves, numbers, limits, title):
    boxes = [[0.175, 1 - (0.5 + (k + 1) * 1.66 + k * 0.32) / HEIGHT, 0.805, 1.66 / HEIGHT] for k in range(len(ROWS))]
    figure = Figure((4.5, HEIGHT), boxes)
    x, colour = curves["distance"], PANEL_COLOURS[panel]
    for (name, (label, key, word)), axes in zip(ROWS.items(), figure.axes):
        value, low, high = curves[name].T
        if name == "relative_rotation":
            axes.plot(x, curves["spin"][:, 0], linewidth=0.9, linestyle=(0, (4, 2)), label="spin")
        if np.isfinite(value).any():
            axes.fill_between(x, low, high, color=colour, alpha=0.25)
            axes.plot(x, value, color=colour, marker=".", markersize=3.5, linewidth=1.2,
                      label=_label(name, numbers.get(key), word))
        else:
            axes.text(0.5, 0.5, NONE.get(name, CLASSICAL))
        axes.axvline(0, color=FAINT, linewidth=0.7)
        axes.set(ylabel=label, xlim=(x.min() - 0.5, x.max() + 0.5), ylim=limits[name])
        axes.x.has_numbers = axes is figure.axes[-1]
        axes.legend()
    figure.axes[0].title(PANEL_NAMES[panel])
    axes.set(xlabel="distance from the band / d")
    return svg(figure, f"{PANEL_NAMES[panel]}: rotation minus spin, couple stress, solid fraction and fluctuation of "
               f"velocity over the distance from the band, with 95 % intervals, {title}.")


def _label(name, number, word):
    value = plain(number)
    if value is None:
        return "rotation − spin" if name == "relative_rotation" else "mean of a strip"
    return signed(f"{word} {short(value)}" + ends_text(*(interval(number) or (None, None)), short))
