#!/usr/bin/env python3
# diptych: two programs on the same scenes: the same bits of the grains, the same numbers of the comparison
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: same_results.py PROGRAM OTHER_PROGRAM SOURCE_DIR [--keep DIR] [--relative R] [CASE ...]

For a change that must change no result: OTHER_PROGRAM was built from the revision before. Every case is run by both. Compared
are all datasets and attributes of discrete.h5 (bit by bit), the datasets of the last stage of continuum.h5 and every number of
comparison.json except costs (equal, or within R relative). What is new is told; what is gone counts as a difference. Exit codes:
0 the same, 1 a difference, 2 a run failed.
--keep DIR: run folders stay there, and those of OTHER_PROGRAM that are there already are not run again.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

import h5py
import numpy

# What a clock measured, what names the program itself, and sentences.
NOT_RESULTS = ("cost", "ns_per_update", "solver_share_of_cpu", "units", "numbers", "format", "message")

SMALL = {"sample/grains": 300, "loading/inertial_number": 1e-3, "loading/axial_strain": 0.01, "discrete/step": 0.1,
         "discrete/tolerance": 1e-4, "discrete/snapshot_max_sweeps": 200, "discrete/reference_sweeps": 0,
         "comparison/window_edges": "0,0.01", "output/report": "false"}
FIXED_WIDTH = {"discrete/lateral": "periodic", "discrete/side_motion": "velocity"}

# name: (scene, keys). The quick scene whole on two samples, and every loading mode, condition at the sides, law and averaging
# method on a small one.
CASES = {
    "quick_1": ("moreau_quick", {"output/report": "false"}),
    "quick_2": ("moreau_quick", {"output/report": "false", "sample/seed": 2}),
    "descent": ("moreau_quick", SMALL),
    "shear": ("moreau_quick", {**SMALL, **FIXED_WIDTH, "loading/mode": "shear"}),
    "plane_shear": ("moreau_quick", {**SMALL, **FIXED_WIDTH, "loading/mode": "plane_shear"}),
    "time": ("moreau_quick", {**SMALL, "loading/mode": "time", "loading/duration": 4, "loading/stage_time": 2,
                              "comparison/window_edges": "0,4", "discrete/lateral": "rigid_walls",
                              "continuum/initial_step": 0.5, "continuum/max_step": 0.5, "continuum/min_step": 0.01,
                              "discrete/drive_upper_y": "velocity -0.02"}),
    "rigid_walls": ("rigid_walls", SMALL),
    "periodic": ("periodic_sides", {**SMALL, "sample/grains": 400}),
    "penalty": ("moreau_quick", {**SMALL, "sample/grains": 100, "discrete/method": "penalty"}),
    "nsgs": ("moreau_quick", {**SMALL, "sample/grains": 150, "discrete/solver": "nsgs", "discrete/max_sweeps": 200000}),
    "friction": ("moreau_quick", {**SMALL, "sample/target_solid_fraction": 0.82, "sample/radius_distribution": "uniform_by_mass"}),
    "restitution": ("moreau_quick", {**SMALL, "discrete/normal_restitution": 0.3, "discrete/tangential_restitution": 0.2,
                                     "discrete/penetration_correction": "soft_velocity"}),
    "mapped_adaptive": ("moreau_quick", {**SMALL, "continuum/initial_stress": "mapped", "continuum/refinement": "adaptive"}),
    "mohr_coulomb": ("moreau_quick", {**SMALL, "continuum/law": "mohr_coulomb", "continuum/viscosity": 1e-4}),
    "drucker_prager": ("moreau_quick", {**SMALL, "continuum/law": "drucker_prager", "continuum/element": "q1_bbar",
                                        "continuum/geometry": "small_strain"}),
    **{method: ("moreau_quick", {**SMALL, "comparison/averaging": method}) for method in
       ("centroid", "laguerre", "kernel", "projection")},
}


def run(program, source, name, folder):
    scene, keys = CASES[name]
    words = [program, "run", os.path.join(source, "benchmarks", scene, "scene.prm"), "--quiet", "--output", folder]
    for key, value in keys.items():
        words += ["--set", f"{key}={value}"]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{name}: {program} ended with exit code {done.returncode}: {done.stderr}")


def bits(path):
    """Every dataset and attribute as (shape, bytes), by name."""
    found = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = (item.shape, item[()].tobytes())
        for key, value in item.attrs.items():
            if key == "meaning":  # words
                continue
            found[name + "@" + key] = (numpy.shape(value), numpy.asarray(value).tobytes())

    with h5py.File(path, "r") as file:
        file.visititems(add)
    return found


def numbers(value, place=""):
    """Every leaf of comparison.json by its place."""
    if isinstance(value, dict) and "value" in value and value["value"] is None:
        return {place: None}
    if isinstance(value, dict):
        items = value.items()
    elif isinstance(value, list):
        items = enumerate(value)
    else:
        return {place: value}
    return {at: leaf for key, part in items if key not in NOT_RESULTS for at, leaf in numbers(part, f"{place}/{key}").items()}


def comparison(folder):
    with open(os.path.join(folder, "comparison.json"), encoding="utf-8") as file:
        return numbers(json.load(file))


def walked(name):
    place = name.split("/")
    walks = place[-1] == "axial_strain" and place[1] == "stages" or place[1:] == ["continuum_summary", "reached_axial_strain"]
    return name.replace("axial_strain", "progress") if walks else name


def same(a, b, relative):
    if isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        return a == b or math.isclose(a, b, rel_tol=relative, abs_tol=relative * 1e-3)
    return a == b


def continuum_arrays(folder):
    """Datasets of the last stage by name."""
    with h5py.File(os.path.join(folder, "continuum.h5"), "r") as file:
        last, found = file[sorted(name for name in file if name.startswith("stage_"))[-1]], {}
        last.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def compare(one, other, relative):
    """Sentences about what differs, and about what only one of the two has."""
    different, new, gone, largest = [], [], [], 0.0
    a, b = (bits(os.path.join(folder, "discrete.h5")) for folder in (one, other))
    different += [f"discrete.h5 {name}" for name in sorted(a.keys() & b.keys()) if a[name] != b[name]]
    new += [f"discrete.h5 {name}" for name in sorted(a.keys() - b.keys())]
    gone += [f"discrete.h5 {name}" for name in sorted(b.keys() - a.keys())]
    a, b = continuum_arrays(one), continuum_arrays(other)
    different += [f"continuum.h5 {name}" for name in sorted(a.keys() & b.keys())
                  if a[name].shape != b[name].shape
                  or not numpy.allclose(a[name], b[name], rtol=relative, atol=relative * numpy.abs(b[name]).max(initial=0))]
    gone += [f"continuum.h5 {name}" for name in sorted(b.keys() - a.keys())]
    a, b = comparison(one), comparison(other)
    if "/stages/0/progress" in a and "/stages/0/progress" not in b:  # before format 2 both were called axial strain
        b = {walked(name): value for name, value in b.items()}
    for name in sorted(a.keys() & b.keys()):
        if not same(a[name], b[name], relative):
            different.append(f"comparison.json {name}: {a[name]} for {b[name]}")
        elif isinstance(a[name], float) and a[name] != b[name]:
            size = max(abs(a[name]), abs(b[name]))
            largest = max(largest, abs(a[name] - b[name]) / size if size > 1e-9 else 0)
    new += [f"comparison.json {name}" for name in sorted(a.keys() - b.keys())]
    gone += [f"comparison.json {name}" for name in sorted(b.keys() - a.keys())]
    return different, new, gone, largest, len(a.keys() & b.keys())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("other_program")
    parser.add_argument("source")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--keep")
    parser.add_argument("--relative", type=float, default=0.0)
    words = parser.parse_intermixed_args()
    unknown = [name for name in words.cases if name not in CASES]
    if unknown:
        parser.error(f"no case {', '.join(unknown)}; there are {', '.join(CASES)}")
    failed = False
    with tempfile.TemporaryDirectory() as scratch:
        root = words.keep or scratch
        for name in words.cases or CASES:
            one, other = os.path.join(root, "this", name), os.path.join(root, "other", name)
            run(words.program, words.source, name, one)
            if not os.path.exists(os.path.join(other, "comparison.json")):
                run(words.other_program, words.source, name, other)
            different, new, gone, largest, count = compare(one, other, words.relative)
            failed = failed or bool(different or gone)
            print(f"{name}: {count} numbers, {len(different)} differ" + (f" (rest within {largest:.1e})" if largest else "")
                  + f", {len(gone)} gone, {len(new)} new")
            for text in different[:12] + ["gone: " + text for text in gone[:12]] + ["new: " + text for text in new[:12]]:
                print("    " + text)
            sys.stdout.flush()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
