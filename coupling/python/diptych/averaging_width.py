# diptych: dependence of the local stress of grains on the averaging width
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Smooths the stress of grains with kernels of several widths and looks for a plateau."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from scipy.ndimage import gaussian_filter

from .arrays import Array, periods_of
from .operators import map_stress
from .sheets import cell_of, outline_of, Sheet

WIDEST = 0.25  # of the smaller side of the sample: wider kernels give its mean everywhere
WIDTHS = (0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0)  # of the kernel: standard deviations in mean diameters
PLACES = {"middle": (0.5, 0.5), "upper left": (0.25, 0.75), "lower right": (0.75, 0.25)}  # shares of width and height
PLATEAU, LEAST_RATIO, LEAST_T_OVER_S = 0.05, 2.0, 0.1  # as in coupling/fields/resolution_study.h


def _plateau(rows: Sequence[dict[str, Any]]) -> list[float] | None:
    """The widest range of widths, by ratio, in which s and t/s of every place stay within 5 % of their means."""
    value = np.array([[[point["s"], point["t_over_s"]] for point in row["points"]] for row in rows])
    width = np.array([row["width_d"] for row in rows])
    found = []
    for first in range(len(rows)):
        for last in range(first, len(rows)):
            part = value[first:last + 1]
            mean = part.mean(0)
            size = np.maximum(np.abs(mean), [0, LEAST_T_OVER_S])
            if width[last] >= LEAST_RATIO * width[first] and np.all(np.abs(part - mean) <= PLATEAU * size):
                found.append((width[last] / width[first], -width[first], [width[first], width[last]]))
    return max(found)[2] if found else None


def _verdict(rows: Sequence[dict[str, Any]], plateau: list[float] | None) -> str:
    first, last = rows[0], rows[-1]
    scatter = [f"{100 * row['scatter_s']:.0f}" for row in (first, last)]
    text = (f"From w = {first['width_d']:g} to {last['width_d']:g} d the scatter of s over the sample goes from "
            f"{scatter[0]} to {scatter[1]} % of its mean: narrow kernels show single force chains, wide ones only the "
            "mean of the sample.")
    if plateau:
        return text + (f" From w = {plateau[0]:g} to {plateau[1]:g} d, s and t/s at {len(PLACES)} places stay within "
                       f"{100 * PLATEAU:g} % of their means (plateau): a local stress hardly depends on a width in "
                       "this range.")
    return text + (f" There is no plateau: no range of w of a factor of {LEAST_RATIO:g} keeps s and t/s at "
                   f"{len(PLACES)} places within {100 * PLATEAU:g} %. A local stress depends on w; state w with it. "
                   "Means over the sample do not depend on w.")


def _fine_sheet(snapshot: Any, outline: Sheet) -> Sheet:
    """Cells of d/4 over the box of the grains, over the whole period of a periodic sample."""
    d, periods = snapshot.mean_diameter, periods_of(snapshot)
    if len(periods) == 2:
        return cell_of(snapshot, d / 4)
    low, high = snapshot.position.min(0) - 0.6 * d, snapshot.position.max(0) + 0.6 * d
    if len(periods):
        low[0], high[0] = outline.left[0], outline.right[0]
    n_x, n_y = (max(2, round(4 * length / d)) for length in high - low)
    return Sheet(left=np.full(n_y + 1, low[0]), right=np.full(n_y + 1, high[0]),
                 height=np.linspace(low[1], high[1], n_y + 1), n_x=n_x)


def _lengths(fine: Sheet) -> Array:
    """(2): width and height of a sheet with straight sides, along its vectors."""
    shares = np.array([fine.right[0] - fine.left[0], fine.height[-1] - fine.height[0]])
    return np.asarray(shares * np.hypot(*fine.sides.T))


def _smoother(snapshot: Any, fine: Sheet, width: float) -> Callable[[Array], Array]:
    """Gaussian smoothing of values on the cells [rows, columns] to the standard deviation `width` along each axis."""
    periods, count = periods_of(snapshot), np.array([len(fine.height) - 1, fine.n_x])
    if len(periods) < 2:
        size = _lengths(fine)[::-1] / count
        sigma, mode = np.sqrt(width**2 - size**2 / 12) / size, ("constant", "wrap" if len(periods) else "constant")
        return lambda values: np.asarray(gaussian_filter(values, sigma, mode=mode))
    up, along = np.meshgrid(*(np.fft.fftfreq(n, 1 / n) for n in count), indexing="ij")  # waves per period
    waves = np.stack([along, up], axis=-1) @ np.linalg.inv(periods).T
    of_cells = ((along / count[1])**2 + (up / count[0])**2) / 12
    factor = np.exp(-2 * np.pi**2 * (width**2 * (waves**2).sum(-1) - of_cells))
    return lambda values: np.fft.ifft2(np.fft.fft2(values) * factor).real


def width_scan(snapshot: Any) -> dict[str, Any]:
    """Local stress at three places and its scatter over the sample, for Gaussian kernels of standard deviations w.

    The moments are cut by cells of d/4 (method `segments`), smoothed and divided by the smoothed area of the outline.
    The variance of a cell is taken from the kernel's. Keys as `resolution_study` in comparison.json; {} below 3 d."""
    d = snapshot.mean_diameter
    outline = cell_of(snapshot, d) if len(periods_of(snapshot)) == 2 else outline_of(snapshot, 1, 64)
    fine = _fine_sheet(snapshot, outline)
    n_x, n_y, lengths = fine.n_x, len(fine.height) - 1, _lengths(fine)
    stress = map_stress(snapshot, mesh=fine.mesh).symmetric.reshape(n_y, n_x, 2, 2)
    centre, across = outline.shares(fine.mesh.centres), outline.share_across(fine.mesh.centres)
    up = (centre[:, 1] - outline.height[0]) / (outline.height[-1] - outline.height[0])
    inside = ((across > 0) & (across < 1) & (up > 0) & (up < 1)).reshape(n_y, n_x)
    places = {name: fine.cell_of(outline.at(*share)[None])[0] for name, share in PLACES.items()}
    rows = []
    for width in WIDTHS:
        if width * d > WIDEST * min(lengths):
            continue
        smooth = _smoother(snapshot, fine, width * d)
        area = smooth(inside.astype(float))
        xx, yy, xy = (smooth(stress[:, :, a, b]) / np.maximum(area, 1e-9)
                      for a, b in ((0, 0), (1, 1), (0, 1)))
        s, t = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
        points = [{"name": name, "s": s.flat[k], "t_over_s": t.flat[k] / s.flat[k]} for name, k in places.items()]
        scatter = {"scatter_" + name: field[inside].std() / field[inside].mean()
                   for name, field in (("s", s), ("t", t))}
        rows.append({"width_d": width, **scatter, "points": points})
    if len(rows) < 2:
        return {}
    plateau = _plateau(rows)
    return {"kernel": rows, "plateau_d": plateau, "verdict": _verdict(rows, plateau)}
