#!/usr/bin/env python3
# diptych: grains and continuum between platens of four kinds, and the default law in other tests
# SPDX-License-Identifier: LGPL-2.1-or-later
"""platens.py [table|figure FILE.png]

Sixteen samples of 1500 discs that no fit has seen, in vertical compression. table: differences between the panels.
Results are kept in results/platens. PYTHONPATH: build/release/python."""

import os
import sys

import diptych
import h5py
import numpy as np
from matplotlib.figure import Figure

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "calibration", "defaults"))
import defaults  # noqa: E402

SCENE = os.path.join(defaults.HERE, "vertical.prm")
SEEDS = range(17, 33)
FRICTIONS = (0.3, 0.5, 0.7)
KINDS = {"smooth": {"discrete/platen_friction": 0}, "flat": {}, "no rolling": {"discrete/platen_rolling_friction": 1}}
SIDES = {"discrete/side_motion": "pressure", "discrete/platen_friction": 0, "continuum/platens": "smooth"}
OTHERS = {"W/H 1.4": {"sample/width_over_height": 1.4}, "700 discs": {"sample/grains": 700},
          "4000 discs": {"sample/grains": 4000}, "rolling friction 0.1": {"discrete/rolling_friction": 0.1},
          "rigid smooth walls": {"discrete/lateral": "rigid_walls", "discrete/wall_friction": 0, **SIDES},
          "periodic sides": {"discrete/lateral": "periodic", **SIDES}}
COLOURS = dict(zip((*KINDS, "glued"), ("#0072B2", "#D55E00", "#007A5E", "#CC79A7")))


def ensemble(name, friction, settings):
    """Both panels of all samples; runs that are there are read."""
    return diptych.ensemble(SCENE, SEEDS, f"results/platens/{name.replace(' ', '_').replace('/', '_')}_{friction}",
                            set={"discrete/friction": friction, "comparison/coarse_element_size": 0,
                                 "output/report": False, **settings}, resume=True, jobs=2)


def glued(friction):
    """{key: values of the samples} of grains between platens of glued grains. The forces on those are not mapped, so
    they run alone; the continuum is that of the platens without rolling."""
    found = diptych.study(SCENE, f"results/platens/glued_{friction}", vary={"discrete/friction": [friction]},
                          set={"sample/rough_platens": True}, panels="discrete", seeds=SEEDS, resume=True, jobs=2)
    [point] = found.numbers["points"]
    return {asked["key"]: one["values"] for asked, one in zip(found.numbers["quantities"], point["quantities"])}


def mean_sxx(found):
    """Mean of (continuum - grains) / grains of the mean sxx, and its standard error; grains with sides at the outline.
    NaN without a pressure on the sides."""
    values = {row["name"]: np.array(row["values"], dtype=float) for row in found.numbers["quantities"]}
    if "discrete_summary mean_sxx" not in values:
        return np.nan, np.nan
    grains = values["discrete_summary mean_sxx"] + 1 - values["discrete_summary sides_sxx"]
    error = values["continuum_summary mean_sxx"] / grains - 1
    return error.mean(), error.std(ddof=1) / len(error)**0.5


def profiles(found):
    """{panel: (place, mean over the samples, its standard error)} of shear / normal stress along the platens."""
    curves = {}
    for panel in ("discrete", "continuum"):
        rows = []
        for folder in found.folders.values():
            with h5py.File(os.path.join(folder, "comparison.h5")) as file:
                place, ratio = (file[f"platens/{panel}/{name}"][()] for name in ("place", "stress_ratio"))
                rows.append(ratio)
        curves[panel] = place, np.mean(rows, axis=0), np.std(rows, axis=0, ddof=1) / len(rows)**0.5
    return curves


def table():
    """A line per test: differences, and the largest difference of the profiles in ten parts of a platen."""
    tests = [(kind, friction, settings) for kind, settings in KINDS.items() for friction in FRICTIONS]
    tests += [(name, 0.4, settings) for name, settings in OTHERS.items()]
    for name, friction, settings in tests:
        found = ensemble(name, friction, settings)
        value, error = mean_sxx(found)
        (_, grains, _), (_, law, _) = profiles(found).values()
        texts = [*defaults.differences(found), f"{value:+.1%} +- {error:.1%}", f"{np.abs(law - grains).max():.3f}"]
        print(f"| {name} | {friction} | " + " | ".join(texts) + " |", flush=True)
    for friction in FRICTIONS:
        texts = defaults.differences(ensemble("no rolling", friction, KINDS["no rolling"]), glued(friction))
        print(f"| glued | {friction} | " + " | ".join(texts) + " | | |", flush=True)


def figure(file):
    """Platen force and peak t/s over the friction, and shear / normal stress along the platens."""
    picture = Figure(figsize=(10, 3.4), layout="constrained")
    force, peak, along = picture.subplots(1, 3)
    for kind, settings in KINDS.items():
        found = [ensemble(kind, friction, settings) for friction in FRICTIONS]
        for axes, key in ((force, "platen_force_pd"), (peak, "peak_stress_ratio")):
            rows = [next(row for row in one.numbers["verdicts"] if row["key"] == key) for one in found]
            grains = np.array([row["discrete"] for row in rows])
            axes.errorbar(FRICTIONS, grains.mean(axis=1), 1.96 * grains.std(axis=1, ddof=1) / 4, fmt="o",
                          color=COLOURS[kind], capsize=2.5)
            axes.plot(FRICTIONS, [np.mean(row["continuum"]) for row in rows], "--", color=COLOURS[kind], label=kind)
        if kind == "no rolling":
            values = np.array([[glued(friction)[key] for key in ("platen_force_pd", "peak_stress_ratio")]
                               for friction in FRICTIONS])
            for k, axes in enumerate((force, peak)):
                axes.errorbar(np.add(FRICTIONS, 0.01), values[:, k].mean(axis=1),
                              1.96 * values[:, k].std(axis=1, ddof=1) / 4, fmt="s", capsize=2.5, color=COLOURS["glued"],
                              label="glued grains (no rolling)" if k == 0 else None)
        place, mean, error = profiles(found[1])["discrete"]
        along.errorbar(place, mean, 1.96 * error, fmt="o", color=COLOURS[kind], capsize=2.5)
        along.plot(*profiles(found[1])["continuum"][:2], "--", color=COLOURS[kind])
    force.set(xlabel="friction of the grains", ylabel="platen force (P d)")
    peak.set(xlabel="friction of the grains", ylabel="peak t/s of the sample")
    along.set(xlabel="place along the platen (half widths)", ylabel="shear / normal stress, friction 0.5")
    force.legend(title="platens; points: grains\ndashed: continuum", fontsize=8, title_fontsize=8)
    picture.savefig(file, dpi=150)


if __name__ == "__main__":
    {"table": table, "figure": figure}[sys.argv[1]](*sys.argv[2:])
