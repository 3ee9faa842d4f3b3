#!/usr/bin/env python3
# diptych: two programs on the same scenes: the same bits of the grains, the same numbers of the comparison
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: same_results.py PROGRAM OTHER_PROGRAM SOURCE_DIR [--keep DIR] [--relative R] [CASE ...]

For a change that must change no result: OTHER_PROGRAM was built from the revision before. Both run every case. The
script compares all datasets and attributes of discrete.h5 bit by bit. The histories, the last stage of continuum.h5,
the datasets of comparison.h5 and the numbers of comparison.json, except costs, must be equal, or within R relative. A
name that is gone counts as a difference, a new one does not. Exit codes: 0 the same, 1 a difference or a failed run.
--keep DIR: run folders stay there, and those of OTHER_PROGRAM that are there already are not run again.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from typing import NamedTuple

import h5py
import numpy

# Costs, the program's own name and sentences.
NOT_RESULTS = ("cost", "ns_per_update", "solver_share_of_cpu", "units", "numbers", "format", "message")


class Case(NamedTuple):
    scene: str
    keys: dict
    command: str = "run"


SMALL = {"sample/grains": 300, "loading/inertial_number": 1e-3, "loading/axial_strain": 0.01, "discrete/step": 0.1,
         "discrete/tolerance": 1e-4, "discrete/snapshot_max_sweeps": 200, "discrete/reference_sweeps": 0,
         "comparison/window_edges": "0,0.01", "output/report": "false"}
FIXED_WIDTH = {"discrete/lateral": "periodic", "discrete/side_motion": "velocity"}
FREE_WIDTH = {"discrete/lateral": "periodic", "discrete/side_motion": "pressure", "continuum/platens": "smooth"}
ROLLING = {"discrete/rolling_friction": 0.2, "discrete/platen_rolling_friction": 0.1}
TIME = {"loading/mode": "time", "loading/duration": 4, "loading/stage_time": 2, "comparison/window_edges": "0,4",
        "discrete/lateral": "rigid_walls", "continuum/initial_step": 0.5, "continuum/max_step": 0.5,
        "continuum/min_step": 0.01}
CELL = {"sample/grains": 150, "loading/axial_strain": 0.01, "loading/stages": "0.005,0.01", "discrete/step": 0.1,
        "discrete/tolerance": 1e-4}
CRITICAL = {"continuum/hardening": "critical_state", "continuum/youngs_modulus": 2000}
TABLE = {"continuum/hardening": "table", "continuum/table_strain": "0,0.02,0.1",
         "continuum/table_friction_angle": "15,24,20", "continuum/table_dilatancy_angle": "0,5,2",
         "continuum/table_cohesion": "0.01,0.01,0.005"}

# Files that the keys below name as {inputs}/NAME; law.so is compiled from SOURCE_DIR.
INPUTS = {"platen.csv": "time,velocity\n0,0\n1,-0.02\n10,-0.02\n12,0.02\n20,0.02\n",
          "side.csv": "time,force\n0,-20\n2,-15\n4,-25\n",
          "cycle.csv": "progress,eyy,sxx,exy\n0,0,1,0\n0.01,0.01,1,0\n0.02,0,1,0\n0.03,0.01,1,0\n",
          "path.csv": "progress,sxx,syy,sxy\n0,1,1,0\n0.005,0.8,1.2,0.05\n0.01,0.9,1.1,0.1\n"}
LAW = os.path.join("benchmarks", "own_law", "mohr_coulomb.cc")


def small(**keys):
    return Case("moreau_quick", {**SMALL, **keys})


def law(name, **keys):
    return small(**{"continuum/law": name, **keys})


def cell(**keys):
    return Case("element", {**CELL, **keys}, "discrete")


def point(name, path, **keys):
    """A law without grains: one row of material_point.csv per step of the path."""
    keys = {"continuum/law": name, "loading/path": path, "loading/axial_strain": 0.03, **keys}
    return Case("element", keys, "material-point")


# The quick scene whole; then each loading mode, condition at the sides, method, law, hardening and averaging method on
# a small one.
CASES = {
    "quick": Case("moreau_quick", {"output/report": "false"}),
    "descent": small(),
    "plane_shear": small(**FIXED_WIDTH, **{"loading/mode": "plane_shear"}),
    "time": small(**TIME, **{"discrete/drive_upper_y": "velocity -0.02"}),
    "rigid_walls": Case("rigid_walls", SMALL),
    "side_tables": Case("moreau_quick", {**SMALL, **TIME, "discrete/drive_upper_y": "velocity {inputs}/platen.csv",
                                         "discrete/drive_right_x": "force {inputs}/side.csv"}, "discrete"),
    "reversal": Case("reversal", {**SMALL, "sample/width": 12, "sample/height": 12, "loading/duration": 20,
                                  "loading/stages": "10,20", "discrete/drive_upper_y": "velocity {inputs}/platen.csv",
                                  "comparison/window_edges": "0,20", "continuum/mesh": "outline",
                                  "continuum/element_size": 4}),
    "periodic": Case("periodic_sides", {**SMALL, "sample/grains": 400}),
    "periodic_free": small(**FREE_WIDTH),
    "periodic_penalty": small(**FREE_WIDTH, **{"sample/grains": 100, "discrete/method": "penalty"}),
    "cell": cell(),
    "cell_path": cell(**ROLLING, **{"loading/path": "{inputs}/path.csv"}),
    "cell_shear": cell(**{"loading/path": "simple_shear", "discrete/method": "compliant"}),
    "cell_penalty": cell(**{"loading/path": "constant_volume", "discrete/method": "penalty"}),
    "penalty": small(**ROLLING, **{"sample/grains": 100, "discrete/method": "penalty"}),
    "compliant": small(**{"discrete/method": "compliant"}),
    "compliant_rolling": small(**ROLLING, **{"discrete/method": "compliant", "sample/grains": 150}),
    "rolling": small(**ROLLING),
    "nsgs": small(**{"sample/grains": 150, "discrete/solver": "nsgs", "discrete/max_sweeps": 200000}),
    "friction": small(**{"sample/target_solid_fraction": 0.82, "sample/radius_distribution": "uniform_by_mass"}),
    "restitution": small(**{"discrete/normal_restitution": 0.3, "discrete/tangential_restitution": 0.2,
                            "discrete/penetration_correction": "soft_velocity"}),
    "mapped_adaptive": small(**{"continuum/initial_stress": "mapped", "continuum/refinement": "adaptive"}),
    "mohr_coulomb": law("mohr_coulomb", **{"continuum/viscosity": 1e-4, "continuum/hardening": "exponential"}),
    "drucker_prager": law("drucker_prager", **TABLE, **{"continuum/element": "q1_bbar",
                                                        "continuum/geometry": "small_strain"}),
    "gradient": law("gradient_drucker_prager"),
    "critical_state": law("cosserat_drucker_prager", **CRITICAL),
    "library": law("library", **{"continuum/law_library": "{inputs}/law.so", "continuum/law.friction_angle": 25}),
    **{method: small(**{"comparison/averaging": method}) for method in
       ("centroid", "laguerre", "kernel", "projection")},
    "point_kinematic": point("cosserat_drucker_prager", "{inputs}/cycle.csv"),
    "point_plane_kinematic": point("drucker_prager", "constant_volume"),
    "point_shear": point("cosserat_mohr_coulomb", "simple_shear"),
    "point_table": point("mohr_coulomb", "drained", **TABLE),
    "point_critical": point("mohr_coulomb", "constant_mean_stress", **CRITICAL),
    "point_gradient": point("gradient_mohr_coulomb", "drained", **{"continuum/hardening": "exponential"}),
    "point_elastic": point("linear_elastic", "drained"),
    "point_library": point("library", "drained", **{"continuum/law_library": "{inputs}/law.so"}),
}


def write_inputs(source, folder):
    os.makedirs(folder, exist_ok=True)
    for name, text in INPUTS.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
            stream.write(text)
    subprocess.run(["c++", "-std=c++17", "-shared", "-fPIC", "-O2", "-I" + os.path.join(source, "continuum", "laws"),
                    os.path.join(source, LAW), "-o", os.path.join(folder, "law.so")], check=True)


def run(words, name, program, folder):
    case = CASES[name]
    scene = os.path.join(words.source, "benchmarks", case.scene, "scene.prm")
    line = [program, case.command, scene, "--quiet", "--output", folder]
    for key, value in case.keys.items():
        line += ["--set", f"{key}={value}".replace("{inputs}", words.inputs)]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{name}: {program} ended with exit code {done.returncode}: {done.stderr}")


def bits(path):
    """Every dataset and attribute, by name."""
    found = {}

    def add(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = item[()]
        for key, value in item.attrs.items():
            if key != "meaning":  # words
                found[name + "@" + key] = value

    with h5py.File(path, "r") as file:
        file.visititems(add)
    return found


def datasets(group):
    found = {}
    group.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def arrays(path):
    with h5py.File(path, "r") as file:
        return datasets(file)


def last_stage(path):
    with h5py.File(path, "r") as file:
        return datasets(file[max(name for name in file if name.startswith("stage_"))])


def columns(path):
    with open(path, newline="", encoding="utf-8") as stream:
        names, *rows = csv.reader(stream)
    return {name: numpy.array(column) for name, *column in zip(names, *rows) if not name.endswith("cpu_s")}


def numbers(value, place=""):
    """Every leaf of comparison.json by its place; rows of a list by their key."""
    if isinstance(value, dict) and "value" in value and value["value"] is None:
        return {place: None}
    if isinstance(value, dict):
        items = value.items()
    elif isinstance(value, list):
        items = [(part.get("key", k) if isinstance(part, dict) else k, part) for k, part in enumerate(value)]
    else:
        return {place: value}
    return {at: leaf for key, part in items if key not in NOT_RESULTS
            for at, leaf in numbers(part, f"{place}/{key}").items()}


def json_numbers(path):
    with open(path, encoding="utf-8") as file:
        return numbers(json.load(file))


READERS = {"discrete.h5": bits, "discrete.csv": columns, "continuum.h5": last_stage, "continuum.csv": columns,
           "comparison.h5": arrays, "comparison.json": json_numbers, "material_point.csv": columns}


def same(a, b, relative):
    a, b = numpy.asarray(a), numpy.asarray(b)
    if a.shape != b.shape:
        return False
    if relative == 0 or b.size == 0:
        return bool((a == b).all()) if a.dtype == object else a.tobytes() == b.tobytes()
    try:
        a, b = a.astype(float), b.astype(float)
    except (TypeError, ValueError):  # words
        return bool((a == b).all())
    size = max(1e-3, numpy.nanmax(abs(b), initial=0))
    return numpy.allclose(a, b, rtol=relative, atol=relative * size, equal_nan=True)


def read_all(folder):
    """Every compared entry of a run folder by (file, name)."""
    paths = [os.path.join(folder, file) for file in READERS]
    return {(file, name): value for (file, read), path in zip(READERS.items(), paths) if os.path.exists(path)
            for name, value in read(path).items()}


def compare(one, other, relative):
    """What differs, what is gone and what is new, and how many entries both have."""
    a, b = read_all(one), read_all(other)
    common = [key for key in b if key in a]
    different = [key for key in common if not same(a[key], b[key], 0 if key[0] == "discrete.h5" else relative)]
    return different, [key for key in b if key not in a], [key for key in a if key not in b], len(common)


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
        root = os.path.abspath(words.keep or scratch)
        words.inputs = os.path.join(root, "inputs")
        write_inputs(words.source, words.inputs)
        for name in words.cases or CASES:
            one, other = os.path.join(root, "this", name), os.path.join(root, "other", name)
            run(words, name, words.program, one)
            if not os.path.exists(os.path.join(other, "provenance.json")):
                run(words, name, words.other_program, other)
            different, gone, new, count = compare(one, other, words.relative)
            failed = failed or bool(different or gone)
            print(f"{name}: {count} entries, {len(different)} differ, {len(gone)} gone, {len(new)} new")
            for label, keys in (("", different), ("gone: ", gone), ("new: ", new)):
                for file, entry in keys[:12]:
                    print(f"    {label}{file} {entry}")
            sys.stdout.flush()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
