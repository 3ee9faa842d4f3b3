#!/usr/bin/env python3
# diptych: the default law of the continuum: its calibrations by friction, and a check on other samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""defaults.py calibrate|platens|check [FRICTION[/ROLLING_FRICTION]...]

calibrate and platens print the numbers of the table in coupling/scene/derived_keys.cc. check prints what the default
law predicts for samples that no fit has seen. PYTHONPATH: build/release/python."""

import os
import sys

import diptych
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LOADINGS = ("vertical", "oblique")
SHOWN = ("platen_force_pd", "strength", "peak_outline_stress_ratio", "peak_core_stress_ratio",
         "peak_nominal_stress_ratio", "final_volumetric_strain")
RESULTS = "results/defaults"
FRICTIONS = [f"{friction}{rolling}" for rolling in ("", "/0.05", "/0.1", "/0.2", "/0.3")
             for friction in (0.2, 0.3, 0.4, 0.5, 0.6, 0.8)]


def grains(word):
    """The two keys of "0.4/0.1" or "0.4"."""
    friction, _, rolling = word.partition("/")
    return {"discrete/friction": float(friction), "discrete/rolling_friction": float(rolling or 0)}


def place(*words):
    return os.path.join(RESULTS, "_".join(words).replace("/", "_rolling_"))


def calibration(word):
    """Five parameters from eight cells without edges; eight other cells are predicted."""
    def target(name, seeds, **use):
        return {"name": name, "scene": f"{HERE}/cell.prm", "seeds": seeds, "set": grains(word), **use}

    return {
        "targets": [target("cells", "1-8"), target("other cells", "9-16", use="predict")],
        "quantities": ["stress_ratio", "volumetric_strain"],
        "bins": [0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.0125, 0.015, 0.0175, 0.02, 0.0225, 0.025, 0.0275,
                 0.03, 0.035, 0.04],
        "set": {"continuum/hardening": "mobilisation", "continuum/softening_strain": 0.3, "continuum/cohesion": 0.01,
                "continuum/mobilisation_strain": 0.007},
        "load_step": 0.0004,
        "parameters": [
            {"key": "friction_angle_peak", "start": 25, "low": 12, "high": 60},
            {"key": "friction_angle_residual", "start": 0.5, "low": 0.05, "high": 0.9},
            {"key": "friction_angle_start", "start": 0.7, "low": 0.2, "high": 1},
            {"key": "dilatancy_angle_peak", "of": "friction_angle_start", "start": 0.5, "low": 0.05, "high": 1},
            {"key": "youngs_modulus", "start": 2000, "low": 200, "high": 100000}]}


def calibrate(word):
    """A row of the table: both frictions, peak, start / peak, residual / peak, dilatancy / start, modulus."""
    found = diptych.calibrate(calibration(word), place("calibration", word), resume=True).parameters
    value = dict(zip(found["key"], found["value"]))
    peak, start = value["friction_angle_peak"], value["friction_angle_start"]
    row = (*grains(word).values(), peak, start / peak, value["friction_angle_residual"] / peak,
           value["dilatancy_angle_peak"] / start, value["youngs_modulus"])
    print("{" + ", ".join(f"{x:.3g}" for x in row) + "}", flush=True)


def platens(word):
    """Friction and slip length of the platens from eight samples, in five parts of a half platen; 95 % intervals."""
    scene = {"sample": {"grains": 1500}, "loading": {"inertial_number": 1e-3, "horizontal_over_vertical": 0}}
    study = diptych.study(scene, place("platens", word), vary={key: [value] for key, value in grains(word).items()},
                          panels="discrete", seeds=range(1, 9), resume=True)
    samples = [diptych.load(os.path.join(study.folder, folder)).discrete.snapshots for folder in study.table["folder"]]
    found = diptych.platen_friction(samples)
    texts = [f"{value:.3g} [{low:.2g}, {high:.2g}]" for value, low, high in (found.friction, found.slip_length)]
    print(f"| {word} | " + " | ".join(texts) + " |", flush=True)


def differences(found, others=None):
    """Texts of the differences continuum - grains of an ensemble: means with standard errors; volume absolute.
    others: {key: values of other grains with the same seeds}."""
    rows, texts = {row["key"]: row for row in found.numbers["verdicts"] if not row["window"]}, []
    for key in SHOWN:
        grains, law = (np.array(one, dtype=float) for one in ((others or {key: rows[key]["discrete"]})[key],
                                                              rows[key]["continuum"]))
        scale, digits = (1, 2) if key == "final_volumetric_strain" else (grains.mean(), 1)
        error = (law - grains).std(ddof=1) / len(grains)**0.5 / scale
        texts.append(f"{(law - grains).mean() / scale:+.{digits}%} +- {error:.{digits}%}")
    return texts


def check(word):
    """Sixteen other samples."""
    for loading in LOADINGS:
        found = diptych.ensemble(f"{HERE}/{loading}.prm", range(17, 33), place("check", word, loading),
                                 set={**grains(word), "comparison/coarse_element_size": 0,
                                      "output/report": False}, resume=True)
        print(f"| {loading} | {word} | " + " | ".join(differences(found)) + " |", flush=True)


if __name__ == "__main__":
    for one in sys.argv[2:] or FRICTIONS:
        {"calibrate": calibrate, "platens": platens, "check": check}[sys.argv[1]](one)
