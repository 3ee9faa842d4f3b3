# diptych: small scenes and result folders that cases start from
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A base is a folder below KEEP/bases. It is made once, and no case changes it."""

import contextlib
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

from running import ENVIRONMENT, PROGRAM, QUICK, SMALL, SOURCE, setting, write


# Sixty grains take a tenth of a second. If a key is set twice, the later value holds.
TINY = SMALL + setting(sample_grains=60, output_report="false")
RECTANGLE = setting(continuum_mesh="rectangle", continuum_rectangle_width=12, continuum_rectangle_height=18,
                    continuum_initial_step=0.0025, continuum_max_step=0.0025, comparison_coarse_element_size=0)
NODES = TINY + RECTANGLE + setting(continuum_element_size=3)
BOTH = TINY + setting(continuum_element_size=2.5, continuum_initial_step=0.0025, continuum_max_step=0.0025,
                      comparison_coarse_element_size=0, comparison_band_resamples=0, comparison_probe_resamples=0)
TIMES = setting(loading_mode="time", loading_duration=1, loading_stage_time=0.5, comparison_window_edges="0,1")
# Long enough to be interrupted, with a checkpoint at every step.
LONG = TINY + setting(loading_axial_strain=0.04, comparison_window_edges="0,0.04", discrete_checkpoint_minutes=0)
LONG_NODES = NODES + setting(loading_axial_strain=0.02, comparison_window_edges="0,0.02", continuum_initial_step=5e-4,
                             continuum_max_step=5e-4, continuum_checkpoint_minutes=0)
LONG_BOTH = BOTH + setting(loading_axial_strain=0.02, comparison_window_edges="0,0.02", continuum_initial_step=1e-3,
                           continuum_max_step=1e-3, discrete_checkpoint_minutes=0, continuum_checkpoint_minutes=0)
OTHER_BOTH = LONG_BOTH + setting(continuum_friction_angle_peak=30)
PROBLEM = os.path.join(SOURCE, "tests", "discrete", "contact_problems", "small.h5")
FOREIGN = os.path.join(SOURCE, "tests", "foreign")
FORMATS = {  # format of `diptych import`, files in tests/foreign, options
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
    "parameters": [{"key": "friction_angle_peak", "start": 21, "low": 14, "high": 40}],
    "starts": 1, "load_step": 0.005, "check_samples": 0}


def done(folder, *words):
    """A run that must succeed."""
    result = subprocess.run([PROGRAM, *words], env=ENVIRONMENT, capture_output=True, text=True, cwd=folder, check=False)
    if result.returncode != 0:
        raise RuntimeError(" ".join(words) + f": exit code {result.returncode}\n{result.stderr}")
    return result.stdout


def stopped(command, words, checkpoint):
    """Makes a base: a run that is interrupted at its fourth checkpoint."""
    def make(folder):
        process = subprocess.Popen([PROGRAM, command, QUICK, *words, "--output", "out", "--quiet"], env=ENVIRONMENT,
                                   cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        path, seen = os.path.join(folder, "out", checkpoint), set()
        while process.poll() is None and len(seen) < 4:
            with contextlib.suppress(FileNotFoundError):
                seen.add(os.stat(path).st_mtime_ns)
            time.sleep(0.0005)
        process.send_signal(signal.SIGTERM)
        if process.wait() != 3 or not os.path.exists(path):
            raise RuntimeError(f"{command} ended with {process.returncode} before its interruption")
    return make


def make_grains(folder):
    """A prepared sample, and beside it tables of its grains, of a wall's velocity and of radii."""
    done(folder, "discrete", QUICK, *TINY, "--output", "out", "--quiet")
    with h5py.File(os.path.join(folder, "out", "discrete.h5"), "r") as file:
        grains = file["stage_0000/grains"]
        rows = [f"{x!r},{y!r},{r!r}" for (x, y, _), r in zip(grains["position"][()].tolist(),
                                                             grains["radius"][()].tolist())]
    for name, lines in {"grains.csv": ["x,y,r", *rows], "speed.csv": ["time,velocity", "0,0", "0.5,-0.001", "1,-0.001"],
                        "radii.csv": ["radius,passing", "0.3,0", "0.4,0.3", "0.5,0.6", "0.7,1"]}.items():
        write(os.path.join(folder, name), "\n".join(lines) + "\n")


def of_file(command, name, content):
    """Makes a base: the runs that a JSON file describes."""
    def make(folder):
        write(os.path.join(folder, name), json.dumps(content))
        done(folder, command, name, "--output", "out", "--quiet", "--jobs", "1")
    return make


def run_of(*words):
    return lambda folder: done(folder, *words, "--output", "out", "--quiet")


def foreign(kind):
    """The files of a format in the order of their names."""
    found = [os.path.join(top, name) for top, _, names in os.walk(FOREIGN) for name in names]
    return sorted((path for path in found if re.match(FORMATS[kind][1], os.path.relpath(path, FOREIGN))),
                  key=os.path.basename)


SEEDS = ["--seeds", "1-2", "--jobs", "1"]
MAKE = {
    "grains": make_grains,
    "both": run_of("run", QUICK, *BOTH),
    "other_grains": run_of("discrete", QUICK, *TINY, *setting(sample_seed=2)),
    "other_both": run_of("run", QUICK, *BOTH, *setting(sample_seed=2)),
    "long_grains": run_of("discrete", QUICK, *LONG),
    "other_long_grains": run_of("discrete", QUICK, *LONG, *setting(sample_seed=2)),
    "long_nodes": run_of("continuum", QUICK, *LONG_NODES),
    "long_both": run_of("run", QUICK, *LONG_BOTH),
    "other_nodes": run_of("run", QUICK, *OTHER_BOTH),
    "stopped_grains": stopped("discrete", LONG, "checkpoint.h5"),
    "stopped_nodes": stopped("continuum", LONG_NODES, "continuum_checkpoint.h5"),
    "ensemble": run_of("run", QUICK, *BOTH, *SEEDS),
    "study": of_file("study", "steps.json", STUDY),
    "calibration": of_file("calibrate", "one.json", CALIBRATION),
    "imported": run_of("import", "csv", *foreign("csv")),
}


def made_once(keep, name, make):
    folder = os.path.join(keep, "bases", name)
    os.makedirs(os.path.dirname(folder), exist_ok=True)
    with open(folder + ".lock", "w", encoding="utf-8") as guard:
        fcntl.flock(guard, fcntl.LOCK_EX)
        if not os.path.isdir(folder):
            shutil.rmtree(folder + ".begun", ignore_errors=True)
            os.mkdir(folder + ".begun")
            make(folder + ".begun")
            os.rename(folder + ".begun", folder)
    return folder


def prepared(keep, name):
    """The folder of a base. Its results are in `out`."""
    return made_once(keep, name, MAKE[name])


def whole(keep, name, words, base="", to="out"):
    """The output of a command on undamaged files: words("out") runs once, in a copy of the base."""
    def make(folder):
        if base:
            shutil.copytree(prepared(keep, base), folder, dirs_exist_ok=True)
        done(folder, *words("out"))
    return os.path.join(made_once(keep, "whole_" + name, make), to)


@functools.lru_cache(maxsize=None)
def printed(*words):
    return done(".", *words)
