#!/usr/bin/env python3
# diptych: the default law of the continuum: its calibrations by friction, and a check on other samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""defaults.py calibrate|check [FRICTION...]: prints the rows of the table in coupling/scene/derived_keys.cc, or what
the default law predicts for samples and frictions that no calibration has seen. PYTHONPATH: build/release/python."""

import os
import subprocess
import sys

import diptych
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LOADINGS = ("oblique", "vertical")
RESULTS = "results/defaults"
PROGRAM = os.environ.get("DIPTYCH_PROGRAM", "build/release/diptych")


def calibration(friction):
    """Six parameters from eight samples in two loadings; eight other samples are predicted."""
    def target(loading, seeds, **use):
        return {"name": f"{loading}, seeds {seeds}", "scene": f"{HERE}/{loading}.prm", "seeds": seeds,
                "set": {"discrete/friction": friction, "continuum/element_size": 2}, **use}
    return {
        "targets": [target(loading, "1-8") for loading in LOADINGS] +
                   [target(loading, "9-16", use="predict") for loading in LOADINGS],
        "quantities": ["stress_ratio", "volumetric_strain", "ln_width"],
        "bins": [0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.0125, 0.015, 0.0175, 0.02, 0.0225, 0.025, 0.0275,
                 0.03, 0.035, 0.04],
        "set": {"continuum/hardening": "mobilisation", "continuum/softening_strain": 0.3, "continuum/cohesion": 0.01,
                "continuum/mobilisation_strain": 0.007},
        "load_step": 0.0012, "coarse_element_size": 3.5,
        "parameters": [
            {"key": "friction_angle_peak", "start": 25, "low": 12, "high": 45},
            {"key": "friction_angle_residual", "start": 0.5, "low": 0.05, "high": 0.9},
            {"key": "friction_angle_start", "start": 0.7, "low": 0.2, "high": 1},
            {"key": "dilatancy_angle_peak", "of": "friction_angle_start", "start": 0.5, "low": 0.05, "high": 1},
            {"key": "internal_length", "start": 1.5, "low": 0.6, "high": 8},
            {"key": "youngs_modulus", "start": 2000, "low": 200, "high": 100000}]}


def calibrate(friction):
    """A row of the table: friction, peak, start / peak, residual / peak, dilatancy / start, length, modulus."""
    found = diptych.calibrate(calibration(friction), f"{RESULTS}/calibration_{friction}", resume=True).parameters
    value = dict(zip(found["key"], found["value"]))
    peak, start = value["friction_angle_peak"], value["friction_angle_start"]
    row = (friction, peak, start / peak, value["friction_angle_residual"] / peak, value["dilatancy_angle_peak"] / start,
           value["internal_length"], value["youngs_modulus"])
    print("{" + ", ".join(f"{x:.3g}" for x in row) + "}", flush=True)


def check(friction):
    """Differences continuum - grains of peak t/s (relative) and volume (absolute): mean of 16 samples, its standard
    error."""
    for loading in LOADINGS:
        differences = []
        for seed in range(17, 33):
            folder = f"{RESULTS}/check_{friction}_{loading}_{seed}"
            subprocess.run([PROGRAM, "run", f"{HERE}/{loading}.prm", "--output", folder, "--set",
                            f"discrete/friction={friction}",
                            "--set", f"sample/seed={seed}", "--set", "output/report=false", "--quiet"], check=True)
            s = diptych.load(folder).summary()
            differences.append((s.loc["peak t/s", "difference"] / s.loc["peak t/s", "grains"],
                                s.loc["volumetric strain at the end", "difference"]))
        mean, deviation = np.mean(differences, axis=0), np.std(differences, axis=0, ddof=1)
        print(f"| {loading} | {friction} | {mean[0]:+.1%} +- {deviation[0] / 4:.1%} | {deviation[0]:.1%} | "
              f"{mean[1]:+.2%} +- {deviation[1] / 4:.2%} |", flush=True)


if __name__ == "__main__":
    for f in map(float, sys.argv[2:] or (0.2, 0.3, 0.4, 0.5, 0.6, 0.8)):
        {"calibrate": calibrate, "check": check}[sys.argv[1]](f)
