# diptych: small scenes and result folders that cases start from, each made once
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A base is a folder below KEEP/bases that no case changes; processes that want the same one wait for each other."""

import fcntl
import functools
import json
import os
import re
import shutil
import signal
import subprocess
import time

import h5py

import judge
from running import ENVIRONMENT, PROGRAM, QUICK, SMALL, SOURCE, setting


def without(key, words):
    """Words of setting() but for one key."""
    return [word for pair in zip(words[::2], words[1::2]) if not pair[1].startswith(key + "=") for word in pair]


# Sixty grains: a tenth of a second. Of two settings of a key the later one holds.
TINY = SMALL + setting(sample_grains=60, output_report="false")
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=12, continuum_rectangle_height=18,
                    continuum_initial_step=0.0025, continuum_max_step=0.0025, comparison_coarse_element_size=0)
NODES = TINY + RECTANGLE + setting(continuum_element_size=3)
BOTH = TINY + setting(continuum_element_size=2.5, continuum_initial_step=0.0025, continuum_max_step=0.0025,
                      comparison_coarse_element_size=0, comparison_band_resamples=0, comparison_probe_resamples=0)
# Long enough to be interrupted, with a checkpoint at every step.
LONG = TINY + setting(loading_axial_strain=0.04, comparison_window_edges="0,0.04", discrete_checkpoint_minutes=0)
LONG_NODES = NODES + setting(loading_axial_strain=0.02, comparison_window_edges="0,0.02", continuum_initial_step=5e-4,
                             continuum_max_step=5e-4, continuum_checkpoint_minutes=0)
LONG_BOTH = BOTH + setting(loading_axial_strain=0.02, comparison_window_edges="0,0.02", continuum_initial_step=1e-3,
                           continuum_max_step=1e-3, discrete_checkpoint_minutes=0, continuum_checkpoint_minutes=0)
PROBLEM = os.path.join(SOURCE, "tests", "discrete", "contact_problems", "small.h5")
FOREIGN = os.path.join(SOURCE, "tests", "foreign")
FORMATS = {  # what a code writes: its format, which files in tests/foreign, and the words beside them
    "csv": ("csv", r"plain_csv/.*\.csv$", []),
    "lammps": ("lammps", r"lammps/(.*\.dump|walls\.txt)$", []),
    "liggghts": ("liggghts", r"liggghts/.*\.(dump|stl)$", ["--thickness", "1"]),
    "mercurydpm": ("mercurydpm", r"mercurydpm/Biaxial2D\.(data|fstat|ene|restart\.4)$", []),
    "yade": ("yade", r"yade/(spheres|contacts|walls)_\d\.txt$", ["--thickness", "1"]),
    "yade_vtk": ("yade", r"yade/rec-(spheres|intrs)\..*\.vt[up]$", ["--thickness", "1", "--walls-touch"]),
    "yade_vtk_ascii": ("yade", r"yade/rec-ascii-.*\.vt[up]$", ["--thickness", "1", "--walls-touch"]),
    "lmgc90": ("lmgc90", r"lmgc90/.*/(BODIES\.DAT|BULK_BEHAV\.DAT|DOF\.OUT\.\d|Vloc_Rloc\.OUT\.\d)$", []),
    "lmgc90_hdf5": ("lmgc90", r"lmgc90_hdf5/.*\.h5$|lmgc90/DATBOX/(BODIES|BULK_BEHAV)\.DAT$", []),
}
STUDY = {
    "title": "Steps", "scene": os.path.join(SOURCE, "benchmarks", "dense_biaxial", "scene.prm"), "command": "discrete",
    "set": {"sample/grains": 100, "loading/axial_strain": 0.005, "loading/stage_strain": 0.005}, "seeds": "1-2",
    "reference": {"discrete/step": 0.1, "discrete/tolerance": 1e-4},
    "axes": [{"key": "discrete/step", "values": [0.4, 0.2]}],
    "quantities": [{"column": "volumetric_strain", "at": 0.005}]}
CALIBRATION = {
    "targets": [{"name": "fitted", "scene": QUICK, "seeds": "1-2",
                 "set": {"sample/grains": 100, "loading/axial_strain": 0.01, "loading/stage_strain": 0.005,
                         "loading/inertial_number": 1e-3, "comparison/window_edges": "0, 0.01"}}],
    "quantities": ["stress_ratio"], "bins": [0.002, 0.005, 0.01],
    "parameters": [{"key": "friction_angle_peak", "start": 20, "low": 14, "high": 40}],
    "starts": 1, "load_step": 0.005, "check_samples": 0}


def done(folder, *words):
    """A run that must succeed, or there is nothing to start from."""
    result = subprocess.run([PROGRAM, *words], env=ENVIRONMENT, capture_output=True, text=True, cwd=folder, check=False)
    if result.returncode != 0:
        raise RuntimeError(" ".join(words) + f": exit code {result.returncode}\n{result.stderr}")
    return result.stdout


def stopped(folder, command, words, checkpoint):
    """A run that was interrupted for real, after a while of checkpoints."""
    process = subprocess.Popen([PROGRAM, command, QUICK, *words, "--output", "out", "--quiet"], env=ENVIRONMENT, cwd=folder,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    path, seen = os.path.join(folder, "out", checkpoint), set()
    while process.poll() is None and len(seen) < 4:
        try:
            seen.add(os.stat(path).st_mtime_ns)
        except FileNotFoundError:
            pass
        time.sleep(0.0005)
    process.send_signal(signal.SIGTERM)
    if process.wait() != 3 or not os.path.exists(path):
        raise RuntimeError(f"{command} was to be interrupted, but ended with {process.returncode}")


def write_table(folder):
    """The grains of a prepared sample as a table, with what tables of walls and radii need beside it."""
    with h5py.File(os.path.join(folder, "out", "discrete.h5"), "r") as file:
        grains = file["stage_0000/grains"]
        rows = [f"{x!r},{y!r},{r!r}" for (x, y, _), r in zip(grains["position"][()].tolist(), grains["radius"][()].tolist())]
    texts = {"grains.csv": ["x,y,r", *rows], "speed.csv": ["time,velocity", "0,0", "0.5,-0.001", "1,-0.001"],
             "radii.csv": ["radius,passing", "0.3,0", "0.4,0.3", "0.5,0.6", "0.7,1"]}
    for name, lines in texts.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write("\n".join(lines) + "\n")


def imported(folder):
    done(folder, "import", "csv", *foreign("csv"), "--output", "out", "--quiet")


def make_grains(folder):
    done(folder, "discrete", QUICK, *TINY, "--output", "out", "--quiet")
    write_table(folder)


def make_study(folder):
    with open(os.path.join(folder, "steps.json"), "w", encoding="utf-8") as file:
        json.dump(STUDY, file)
    done(folder, "study", "steps.json", "--output", "out", "--quiet", "--jobs", "1")


def make_calibration(folder):
    with open(os.path.join(folder, "one.json"), "w", encoding="utf-8") as file:
        json.dump(CALIBRATION, file)
    done(folder, "calibrate", "one.json", "--output", "out", "--quiet", "--jobs", "1")


def make_report(folder):
    done(folder, "run", QUICK, *BOTH, "--output", "out", "--quiet")
    done(folder, "report", "out", "--quiet")


def run_of(*words):
    return lambda folder: done(folder, *words, "--output", "out", "--quiet")


SEEDS = ["--seeds", "1-2", "--jobs", "1"]
PLAN = ["plan", QUICK, *TINY, "--accuracy", "0.5", "--for", "discrete.strength", "--jobs", "1"]
MAKE = {
    "grains": make_grains,
    "nodes": run_of("continuum", QUICK, *NODES),
    "both": run_of("run", QUICK, *BOTH),
    "report": make_report,
    "other_grains": run_of("discrete", QUICK, *TINY, *setting(sample_seed=2)),
    "other_both": run_of("run", QUICK, *BOTH, *setting(sample_seed=2)),
    "long_grains": run_of("discrete", QUICK, *LONG),
    "other_long_grains": run_of("discrete", QUICK, *LONG, *setting(sample_seed=2)),
    "long_nodes": run_of("continuum", QUICK, *LONG_NODES),
    "long_both": run_of("run", QUICK, *LONG_BOTH),
    "stopped_grains": lambda folder: stopped(folder, "discrete", LONG, "checkpoint.h5"),
    "stopped_nodes": lambda folder: stopped(folder, "continuum", LONG_NODES, "continuum_checkpoint.h5"),
    "ensemble": run_of("run", QUICK, *BOTH, *SEEDS),
    "study": make_study,
    "calibration": make_calibration,
    "imported": imported,
    "plan": run_of(*PLAN),
}


def foreign(kind):
    """The files of one kind, by their names in order."""
    found = [os.path.join(top, name) for top, _, names in os.walk(FOREIGN) for name in names]
    return sorted((path for path in found if re.match(FORMATS[kind][1], os.path.relpath(path, FOREIGN))), key=os.path.basename)


def prepared(keep, name):
    """The folder of a base; its result lies in `out`."""
    top = os.path.join(keep, "bases")
    os.makedirs(top, exist_ok=True)
    folder = os.path.join(top, name)
    with open(os.path.join(top, name + ".made"), "w", encoding="utf-8") as guard:
        fcntl.flock(guard, fcntl.LOCK_EX)
        if not os.path.isdir(folder):
            shutil.rmtree(folder + ".begun", ignore_errors=True)
            os.mkdir(folder + ".begun")
            MAKE[name](folder + ".begun")
            os.rename(folder + ".begun", folder)
    return folder


@functools.lru_cache(maxsize=None)
def documented(_):
    return judge.documented_no_numbers(told("explain", "results"))


@functools.lru_cache(maxsize=None)
def told(*words):
    return subprocess.run([PROGRAM, *words], env=ENVIRONMENT, capture_output=True, text=True, check=True).stdout
