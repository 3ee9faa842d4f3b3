# diptych: bands of synthetic measured fields against the truth
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Displacements of a known band on a grid, averaged over subsets, with holes and two kinds of noise: fluctuations of
the grains, correlated over 5 to 10 d, and the error of every point. Prints the share of 95 % intervals that hold the
truth, and the errors of the conventions of thickness without noise.

    PYTHONPATH=build/release/python python3 benchmarks/measured/truth.py [CASES]
"""
import sys

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.ndimage import gaussian_filter
from scipy.optimize import brentq

from diptych.levelling import levelled, with_noise
from diptych.operators import find_bands
from diptych.thickness import CONVENTIONS, thicknesses

WIDTH, HEIGHT, D = 40.0, 80.0, 1.0  # of the sample
FRAME = {"mean_diameter": D, "centre": np.zeros(2), "width": WIDTH, "height": HEIGHT}
NAMES = ("angle_deg", "width_10_90", "offset")


class Band:
    """u = G x + (jump / 2) (cos, sin) tanh((n.x - offset) / delta) under a compression by 2 %."""

    def __init__(self, angle_deg, delta, offset):
        self.angle, self.delta, self.offset = np.radians(angle_deg), delta, offset
        self.along = np.array([np.cos(self.angle), np.sin(self.angle)])
        self.normal = np.array([-np.sin(self.angle), np.cos(self.angle)])

    def __call__(self, places):
        shear = 0.8 * np.tanh((places @ self.normal - self.offset) / self.delta)
        return places * np.array([0.004, -0.008]) - 0.5 * shear[:, None] * self.along

    def blurred_width(self, subset):
        """10-90 % width of the profile averaged over squares."""
        s = (np.arange(41) + 0.5) / 41 - 0.5
        shifts = subset * (s[:, None] * np.sin(self.angle) + s * np.cos(self.angle)).ravel()
        return 2 * brentq(lambda x: np.tanh((x + shifts) / self.delta).mean() - 0.8, 0, 20 * self.delta)


def points_of(spacing):
    x, y = (np.arange(-side / 2 + spacing / 2, side / 2, spacing) for side in (WIDTH, HEIGHT))
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def fluctuations(draw, length, size):
    """A random field of this standard deviation. Its correlation function has the area length^2 [d]."""
    axes = [np.arange(-side / 2 - 10, side / 2 + 11) for side in (WIDTH, HEIGHT)]
    smooth = [gaussian_filter(draw.standard_normal([len(axis) for axis in axes]), length / (2 * np.sqrt(np.pi)))
              for _ in range(2)]
    return RegularGridInterpolator(axes, size * np.stack([one / one.std() for one in smooth], axis=-1))


def case(seed):
    """(names held, whether a band was found) of one field."""
    draw = np.random.default_rng(seed)
    band = Band(draw.choice((-1, 1)) * draw.uniform(45, 65), draw.uniform(2, 5), draw.uniform(-4, 4))
    spacing, subset, noise = draw.uniform(0.8, 2), draw.uniform(1, 4), draw.uniform(0.005, 0.03)
    grains = fluctuations(draw, draw.uniform(5, 10), draw.uniform(0.01, 0.06))
    points = points_of(spacing)
    moved = levelled(lambda at: band(at) + grains(at), points, subset) + noise * draw.standard_normal(points.shape)
    hole = np.hypot(*(points - draw.uniform(-15, 15, 2)).T) < draw.uniform(0, 6)
    kept = ~hole & (draw.random(len(points)) > 0.05)
    deviation = np.full(kept.sum(), noise)
    options = {"band_resamples": 200}
    points, moved = points[kept], moved[kept]
    report = with_noise(find_bands(points, moved, **FRAME, **options), points, moved, deviation, options)
    if not report.bands:
        return None
    found = report.bands[0]
    truth = (np.degrees(band.angle), band.blurred_width(subset), band.offset)
    return [found.interval[name].low <= true <= found.interval[name].high for name, true in zip(NAMES, truth)]


def conventions():
    """Largest relative error of every convention over fields without noise and blur."""
    worst = dict.fromkeys(CONVENTIONS, 0.0)
    for angle in (35, 45, 55, 65):
        for delta in (2.0, 3.0, 5.0):
            band, points = Band(angle, delta, 1.3), points_of(0.5)
            report = find_bands(points, band(points), **FRAME, band_resamples=0)
            found = thicknesses(points, band(points), report.bands[0], 0.5)
            for name, (_, _, over_delta) in CONVENTIONS.items():
                worst[name] = max(worst[name], abs(found[name] / (over_delta * delta) - 1))
    return worst


def main():
    cases = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    found = [case(seed) for seed in range(cases)]
    held = np.array([one for one in found if one])
    print(f"{cases} fields, bands found in {len(held)}")
    for name, share in zip(NAMES, held.mean(axis=0)):
        print(f"{name:12s} 95 % interval holds the truth in {100 * share:.0f} %")
    for name, error in conventions().items():
        print(f"{name:15s} largest error without noise {100 * error:.1f} %")


if __name__ == "__main__":
    main()
