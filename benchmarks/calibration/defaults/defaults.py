#!/usr/bin/env python3
# diptych: the default law of the continuum: its calibrations by friction, and a check on other samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""defaults.py calibrate|platens|check [FRICTION...]

calibrate and platens print the numbers of the table in coupling/scene/derived_keys.cc. check prints what the default
law predicts for samples that no fit has seen. PYTHONPATH: build/release/python."""

import os
import sys

import diptych
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
LOADINGS = ("vertical", "oblique")
RESULTS = "results/defaults"
FRICTIONS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.8)


def calibration(friction):
    """Five parameters from eight cells without edges; eight other cells are predicted."""
    def target(name, seeds, **use):
        settings = {"discrete/friction": friction}
        return {"name": name, "scene": f"{HERE}/cell.prm", "seeds": seeds, "set": settings, **use}

    return {
        "targets": [target("cells", "1-8"), target("other cells", "9-16", use="predict")],
        "quantities": ["stress_ratio", "volumetric_strain"],
        "bins": [0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.0125, 0.015, 0.0175, 0.02, 0.0225, 0.025, 0.0275,
                 0.03, 0.035, 0.04],
        "set": {"continuum/hardening": "mobilisation", "continuum/softening_strain": 0.3, "continuum/cohesion": 0.01,
                "continuum/mobilisation_strain": 0.007},
        "load_step": 0.0004,
        "parameters": [
            {"key": "friction_angle_peak", "start": 25, "low": 12, "high": 45},
            {"key": "friction_angle_residual", "start": 0.5, "low": 0.05, "high": 0.9},
            {"key": "friction_angle_start", "start": 0.7, "low": 0.2, "high": 1},
            {"key": "dilatancy_angle_peak", "of": "friction_angle_start", "start": 0.5, "low": 0.05, "high": 1},
            {"key": "youngs_modulus", "start": 2000, "low": 200, "high": 100000}]}


def calibrate(friction):
    """A row of the table: friction, peak, start / peak, residual / peak, dilatancy / start, modulus."""
    found = diptych.calibrate(calibration(friction), f"{RESULTS}/calibration_{friction}", resume=True).parameters
    value = dict(zip(found["key"], found["value"]))
    peak, start = value["friction_angle_peak"], value["friction_angle_start"]
    row = (friction, peak, start / peak, value["friction_angle_residual"] / peak, value["dilatancy_angle_peak"] / start,
           value["youngs_modulus"])
    print("{" + ", ".join(f"{x:.3g}" for x in row) + "}", flush=True)


def parts_of(folder, n=5):
    """Normal force, shear force and slip per unit strain of a sample's flat platens in n parts from the middle to the
    end, all stages together; (3, n)."""
    snapshots, sums = diptych.load(folder).discrete.snapshots, np.zeros((3, n))
    for before, after in zip(snapshots, snapshots[1:]):
        window, grains = after.window, len(after.radius)
        for upper in (0, 1):
            at = window.j == grains + upper
            grain, force, normal = window.i[at], window.force[at], window.normal[at]
            x = window.point[at, 0]
            middle, half = (x.max() + x.min()) / 2, (x.max() - x.min()) / 2
            load, side = (force * normal).sum(axis=1), np.sign(x - middle)
            part = np.minimum((np.abs(x - middle) / half * n).astype(int), n - 1)
            slip = (after.displacement - before.displacement)[grain, 0] / (after.progress - before.progress)
            for row, value in zip(sums, (load, -side * force[:, 0], side * load * slip)):
                np.add.at(row, part, value)
    return sums


def platens(friction):
    """Fits shear / normal = mu tanh(v / (mu L)) to eight samples; standard errors by the jackknife."""
    scene = {"sample": {"grains": 1500}, "loading": {"inertial_number": 1e-3, "horizontal_over_vertical": 0}}
    study = diptych.study(scene, f"{RESULTS}/platens_{friction}", vary={"discrete/friction": [friction]},
                          panels="discrete", seeds=range(1, 9), resume=True)
    samples = [parts_of(os.path.join(study.folder, folder)) for folder in study.table["folder"]]

    def fit(kept):
        normal, shear, slip = sum(kept)
        ratio, v = shear / normal, slip / normal

        def with_scale(scale):
            shape = np.tanh(v / scale)
            mu = (normal * ratio * shape).sum() / (normal * shape**2).sum()
            return (normal * (ratio - mu * shape)**2).sum(), mu, scale / mu
        return min(map(with_scale, np.abs(v).max() * np.geomspace(0.01, 100, 2000)))[1:]

    left_out = np.array([fit(samples[:k] + samples[k + 1:]) for k in range(len(samples))])
    errors = np.sqrt((len(samples) - 1) * left_out.var(axis=0))
    texts = [f"{value:.3g} +- {error:.2g}" for value, error in zip(fit(samples), errors)]
    print(f"| {friction} | " + " | ".join(texts) + " |", flush=True)


def check(friction):
    """Differences continuum - grains, means of sixteen samples with standard errors; volume absolute."""
    shown = {"platen_force_pd": "relative", "strength": "relative", "peak_outline_stress_ratio": "relative",
             "peak_core_stress_ratio": "relative", "peak_nominal_stress_ratio": "relative",
             "final_volumetric_strain": "absolute"}
    for loading in LOADINGS:
        found = diptych.ensemble(f"{HERE}/{loading}.prm", range(17, 33), f"{RESULTS}/check_{friction}_{loading}",
                                 set={"discrete/friction": friction, "comparison/coarse_element_size": 0,
                                      "output/report": False}, resume=True)
        rows = {row["key"]: row for row in found.numbers["verdicts"] if not row["window"]}
        texts = []
        for key, kind in shown.items():
            grains, law = (np.array(rows[key][panel]) for panel in ("discrete", "continuum"))
            scale = grains.mean() if kind == "relative" else 1
            error = (law - grains).std(ddof=1) / len(grains)**0.5 / scale
            texts.append(f"{(law - grains).mean() / scale:+.1%} +- {error:.1%}" if kind == "relative"
                         else f"{(law - grains).mean():+.2%} +- {error:.2%}")
        print(f"| {loading} | {friction} | " + " | ".join(texts) + " |", flush=True)


if __name__ == "__main__":
    for f in map(float, sys.argv[2:] or FRICTIONS):
        {"calibrate": calibrate, "platens": platens, "check": check}[sys.argv[1]](f)
