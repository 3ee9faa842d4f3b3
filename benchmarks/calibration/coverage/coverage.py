#!/usr/bin/env python3
# diptych: how often the 95 % intervals of a calibration hold the truth
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: coverage.py [REPLICATES [SIZE [JOBS]]]. Draws parameters from the prior and four noisy samples of a material
point with them, and calibrates. SIZE: of the discrepancy in the data, in deviations assumed before (0). JOBS: processes
(2). Prints a row per parameter."""
import itertools
import os
import sys
from concurrent.futures import ProcessPoolExecutor

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "tests", "python"))
from calibration_test import SCENE, SIX, USUAL, calibrated, calibration, drawn, path_of, truth_of  # noqa: E402
from diptych.campaigns.runs.coordinates import Coordinates  # noqa: E402
from diptych.campaigns.calibration.noise import Data, Noise, discrepancy  # noqa: E402

CORRELATION_STRAIN = 0.005  # of the discrepancy in the data; the calibration assumes 0.7 % before


def replicate(seed, size):
    """Truth, ends of the interval and median of every parameter in the unit cube: (4, parameters)."""
    c, random, there = calibration(), np.random.default_rng(seed), Coordinates(SIX, {})
    c.noise, c.starts, observables, truth = Noise(), 2, calibration().observables_of(SCENE), np.array([np.nan])
    while not np.isfinite(truth).all():
        point = random.normal(there.start, 0.25)
        truth = truth_of(c, "", there.numbers(point)) if ((point > 0) & (point < 1)).all() else truth
    x = np.array([0.5 * (one.low + one.high) for one in observables])
    same = np.equal.outer(*[[one.kind for one in observables]] * 2) * np.exp(-np.abs(x[:, None] - x)
                                                                             / CORRELATION_STRAIN)
    deviation = size * np.sqrt(discrepancy(Noise(), Data(observables=observables, values=truth)))
    truth = truth + deviation * random.multivariate_normal(0 * x, same)
    found = calibrated(c, [path_of(c.targets[0], drawn(USUAL, observables, truth, 4, seed))])["parameters"]
    in_cube = [[(np.log(p[end]) if p["coordinate"] == "logarithm" else p[end]) for p in found]
               for end in ("number_low", "number_high", "number_median")]
    return np.array([point, *((np.array(in_cube) - there.low) / there.span)])


def main():
    given = [float(word) for word in sys.argv[1:]]
    n, size, jobs = (*given, *(40, 0, 2)[len(given):])
    with ProcessPoolExecutor(int(jobs)) as pool:
        found = np.array(list(pool.map(replicate, range(int(n)), itertools.repeat(size))))
    truth, low, high, median = found.swapaxes(0, 1)
    print(f"{np.isfinite(high).any(1).sum()} of {n:.0f} replicates have intervals")
    holds, known, rows = (low <= truth) & (truth <= high), np.isfinite(high), []
    for k, p in enumerate(SIX):
        rows.append((p.key, f"{holds[:, k].sum()} of {known[:, k].sum()}",
                     np.sqrt(np.nanmean((median - truth)[:, k] ** 2)), np.nanmean((high - low)[:, k]) / 3.92))
    print("| parameter | in the 95 % interval | rms error | mean deviation |\n|---|---|---|---|")
    for key, held, error, deviation in rows:
        print(f"| {key} | {held} | {error:.3f} | {deviation:.3f} |")
    print(f"| all | {100 * holds.sum() / known.sum():.1f} % | | |")


if __name__ == "__main__":
    main()
