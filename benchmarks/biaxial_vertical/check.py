#!/usr/bin/env python3
# diptych: platens that move vertically shear a sample in two crossing bands
# SPDX-License-Identifier: LGPL-2.1-or-later
"""check.py PROGRAM [--seeds 1,2,3] [--output DIR] [--reuse] [--set section/key=value] [--figure figure.png]

Runs scene.prm for every seed and compares bands and forces of both panels with the claims of the README. Exit code 1: a
number is outside its interval; 2: a run failed. Needs h5py and numpy, the figure matplotlib."""
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402
import maps  # noqa: E402

SCENE = os.path.join(HERE, "scene.prm")
LATE = 2  # Index of the window from 2 to 3 % strain.

# Mean and four standard deviations over fifteen seeds (1-8, 11-14, 21-23; of the continuum over seeds 1-8), narrower
# where the claim is stricter. The claim: two crossing bands in the last window, each with more than a third of the
# platen's travel. The interval of the platen forces is from eight seeds.
CLAIMS = [("grains: windows of 3 with two bands", 2, 3), ("continuum: windows of 3 with two bands", 3, 3),
          ("grains, 2-3 %: bands that cross", 2, 2),
          ("grains, 2-3 %: rising, degrees", 22, 70), ("grains, 2-3 %: falling, degrees", -66, -24),
          ("grains, 2-3 %: weaker jump", 0.32, 1.14), ("grains, 2-3 %: mean width, d", 4, 32),
          ("continuum, 2-3 %: bands that cross", 2, 2), ("continuum, 2-3 %: rising, degrees", 43.9, 52.1),
          ("continuum, 2-3 %: falling, degrees", -51.6, -44.4), ("continuum, 2-3 %: mean width, d", 17, 19.3),
          ("grains: mean |Fx / Fy| of the upper platen", 0, 0.031), ("grains: peak t/s", 0.312, 0.415),
          ("continuum: peak t/s", 0.3509, 0.3584), ("grains: steps with platen forces within 1 %", 0.59, 1)]


def crossing(panel, name):
    """Bands of one panel in one window: their number, both inclinations, the weaker jump."""
    bands = panel["bands"]
    rising = [a for a in claims.angles(bands) if a > 0]
    falling = [a for a in claims.angles(bands) if a < 0]
    crossed = len(bands) == 2 and len(rising) == 1
    return {f"{name}: bands": len(bands), f"{name}: bands that cross": 2 if crossed else 0,
            f"{name}: rising, degrees": rising[0] if crossed else float("nan"),
            f"{name}: falling, degrees": falling[0] if crossed else float("nan"),
            f"{name}: weaker jump": min(abs(claims.value(b["jump"])) for b in bands) if bands else 0,
            f"{name}: mean width, d": sum(claims.value(b["width_10_90_d"]) for b in bands) / max(1, len(bands))}


def measure(runs):
    result = runs.run("scene", "run", SCENE)
    comparison, history = result.comparison, result.grains
    windows = comparison["windows"]
    figures = {**crossing(windows[LATE]["discrete"], "grains, 2-3 %"),
               **crossing(windows[LATE]["continuum"], "continuum, 2-3 %")}
    for name, panel in (("grains", "discrete"), ("continuum", "continuum")):
        figures[name + ": windows of 3 with two bands"] = sum(len(w[panel]["bands"]) == 2 for w in windows)
    loaded = history["axial_strain"] > 0.002
    across, along = (history[name][loaded].mean() for name in ("upper_fx", "upper_fy"))
    figures["grains: mean |Fx / Fy| of the upper platen"] = abs(across / along)
    figures["grains: peak t/s"] = claims.running_mean(history["axial_strain"], history["stress_ratio"])[1].max()
    figures["continuum: peak t/s"] = comparison["continuum_summary"]["peak_stress_ratio"]
    figures["grains: steps with platen forces within 1 %"] = (claims.platen_difference(history)[loaded] < 0.01).mean()
    return figures


def draw(folder, path):
    maps.draw_window(os.path.join(folder, "scene"), LATE, path)


if __name__ == "__main__":
    sys.exit(claims.main(__doc__, measure, CLAIMS, draw))
