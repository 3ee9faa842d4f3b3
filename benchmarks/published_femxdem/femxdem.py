#!/usr/bin/env python3
# diptych: the biaxial test of Guo & Zhao's FEM x DEM, as grains and as a continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calibrates the law, runs both panels and keeps the numbers. --quick: a short run of both panels. PYTHONPATH:
build/release/python."""
import functools
import itertools
import json
import os
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402
import stored  # noqa: E402

CONTACTS = {"rigid": {}, "soft": {"discrete/method": "compliant", "discrete/penalty_stiffness": 300}}
SAMPLES = {2000: range(1, 5), 4000: (1, 2), 8000: (1,)}  # Discs: seeds.
WIDTH = 31.2 / 2000**0.5  # Of one disc [d].
PANELS = ("grains", "8 x 16", "16 x 32")
STYLES, COLOURS = dict(zip(PANELS, ("-", ":", "--"))), {"rigid": "#0072B2", "soft": "#D55E00"}
NUMBERS = {"peak": ("peak t/s", 1, 3), "at": ("at, %", 100, 1), "residual": ("t/s, 9-10 %", 1, 3),
           "volume": ("volume, %", 100, 2), "bands": ("bands", 1, 1), "angle": ("angle, degrees", 1, 1),
           "width": ("width, d", 1, 1), "cpu_s": ("CPU s", 1, 1)}
BINS = [0.001, 0.002, 0.003, 0.004, 0.006, 0.008, *(k / 200 for k in range(2, 7)), *(k / 100 for k in range(4, 11))]
# Start, low, high, of.
FITTED = {"friction_angle_peak": (25, 12, 60), "friction_angle_residual": (0.5, 0.05, 0.9),
          "friction_angle_start": (0.7, 0.2, 1), "dilatancy_angle_peak": (0.5, 0.05, 1, "friction_angle_start"),
          "mobilisation_strain": (0.007, 0.0005, 0.2), "softening_strain": (0.3, 0.02, 2),
          "youngs_modulus": (1000, 50, 20000)}


def calibrated(contacts, folder):
    """The law fitted to eight cells of their size, with its curves; eight other cells are predicted."""
    import diptych
    targets = [{"name": name, "scene": f"{HERE}/cell.prm", "seeds": seeds, "set": CONTACTS[contacts], "use": use}
               for name, seeds, use in (("cells", "1-8", "fit"), ("other cells", "9-16", "predict"))]
    found = diptych.calibrate({
        "targets": targets, "quantities": ["stress_ratio", "volumetric_strain"], "bins": BINS,
        "load_step": 0.0005, "check_samples": 0,
        "set": {"continuum/hardening": "mobilisation", "continuum/cohesion": 0.01},
        "parameters": [{"key": key, **dict(zip(("start", "low", "high", "of"), one))} for key, one in FITTED.items()]},
        os.path.join(folder, f"cells_{contacts}"), resume=True)
    keys = ("kind", "from", "to", "mean", "deviation", "after")
    law = {f"continuum/{one.key}": one.value for one in found.parameters.itertuples()}
    return {"law": {"continuum/hardening": "mobilisation", **law},
            "curves": {path["name"]: [{key: one[key] for key in keys} for one in path["observables"]]
                       for path in found.numbers["paths"]}}


def measured(result, panel):
    """NUMBERS and curves. t/s from the force on the platens and the present width, as their script stores them;
    grains in running means over 0.5 % of strain. Bands: of the displacements in the second half."""
    import diptych
    name = "discrete" if panel == "grains" else "continuum"
    columns, snapshots = result.columns(f"{name}.csv"), getattr(diptych.load(result.folder), name).snapshots
    stress = (columns["lower_fy"] - columns["upper_fy"]) / 2 / columns["width"]
    strain, ratio, volume = columns["axial_strain"], (stress - 1) / (stress + 1), columns["volumetric_strain"]
    end, mean = claims.running_mean(strain, ratio) if panel == "grains" else (strain, ratio)
    moved = diptych.increment(snapshots[len(snapshots) // 2], snapshots[-1])
    bands = diptych.find_bands(**{"mean_diameter": 1, **moved}, band_resamples=0).bands
    found = {"peak": mean.max(), "at": end[mean.argmax()], "volume": volume[-1], "bands": len(bands),
             "cpu_s": result.seconds(name), "residual": claims.between(strain, ratio, 0.9 * strain[-1], strain[-1]),
             "angle": numpy.mean([abs(band.angle_deg) for band in bands] or numpy.nan),
             "width": numpy.mean([band.width_10_90 for band in bands] or numpy.nan)}
    even = numpy.linspace(0.0025, strain[-1], 40)
    return {**found, "curve": numpy.interp(even, end, mean), "volumes": numpy.interp(even, strain, volume)}


def run(options, law, case, seed, *settings):
    """Numbers of a case (contacts, discs, panel); those of the continuum with this law."""
    (contacts, discs, panel), width = case, WIDTH * case[1]**0.5
    words = {"sample/grains": discs, **CONTACTS[contacts]} if panel == "grains" else {
        **law, "continuum/mesh": "rectangle", "continuum/rectangle_width": width,
        "continuum/rectangle_height": 2 * width, "continuum/element_size": width / int(panel.split()[0])}
    result = claims.Runs(options, seed, options.output).run(
        f"{contacts}, {discs}, {panel}, {seed}", "discrete" if panel == "grains" else "continuum", f"{HERE}/scene.prm",
        *(f"{key}={value}" for key, value in words.items()), *settings)
    return measured(result, panel)


def measure(contacts, options):
    found = calibrated(contacts, options.output)
    return {**found, "runs": {f"{discs}, {panel}": [
        run(options, found["law"], (contacts, discs, panel), seed) for seed in (seeds if panel == "grains" else (1,))]
        for (discs, seeds), panel in itertools.product(SAMPLES.items(), PANELS)}}


def short(options):
    """Peak and volume of short runs."""
    with open(f"{HERE}/results.json") as file:
        law = json.load(file)["rigid"]["law"]
    found = {panel: run(options, law, ("rigid", 500, panel), 1, "loading/axial_strain=0.02") for panel in PANELS[:2]}
    return {"numbers": {f"{panel}, {key}": one[key] for panel, one in found.items() for key in ("peak", "volume")}}


def quick(options, parts):
    for name, value in short(options)["numbers"].items():
        before = parts["quick"]["numbers"][name]
        if abs(value / before - 1) > (0.05 if name.startswith("grains") else 0.01):
            yield f"{name}: {value}, stored {before}"


def mean_and_error(found, key):
    """Over the seeds in which the number exists."""
    return claims.mean_and_error([one[key] for one in found if one[key] is not None] or [numpy.nan])


def table(contacts, part):
    head = " | ".join([f"{contacts}: discs, panel (samples)", *(label for label, _, _ in NUMBERS.values())])
    return {contacts: stored.table(head, [(f"{name} ({len(found)})", *(" +- ".join(
        f"{scale * value:.{digits}f}" for value in mean_and_error(found, key)[:len(found)])
        for key, (_, scale, digits) in NUMBERS.items())) for name, found in part["runs"].items()])}


def draw(parts):
    """figure.png: 2000 discs with 1.96 standard errors of the mean, and the cells with their laws."""
    from matplotlib.figure import Figure
    picture = Figure(figsize=(13, 4.2), layout="constrained")
    axes = dict(zip(("curve", "volumes", "cells"), picture.subplots(1, 3)))
    labels = "nominal t/s, 2000 discs", "volumetric strain (%), 2000 discs; dilation < 0", "t/s, 400-disc cells"
    even = numpy.linspace(0.25, 10, 40)[1:]  # The first running mean ends at 0.5 %.
    for key, contacts, panel in itertools.product(("curve", "volumes"), CONTACTS, PANELS):
        mean, error = mean_and_error(parts[contacts]["runs"][f"2000, {panel}"], key)
        mean, error = numpy.multiply((mean, error), 1 if key == "curve" else 100)[..., 1:]
        axes[key].plot(even, mean, STYLES[panel], color=COLOURS[contacts], label=f"{contacts}, {panel}")
        axes[key].fill_between(even, mean - 1.96 * error, mean + 1.96 * error, color=COLOURS[contacts], alpha=0.2)
    for contacts in CONTACTS:
        rows = [row for row in parts[contacts]["curves"]["cells"] if row["kind"] == "stress_ratio"]
        place = [50 * (row["from"] + row["to"]) for row in rows]
        mean, deviation, law = ([row[key] for row in rows] for key in ("mean", "deviation", "after"))
        axes["cells"].errorbar(place, mean, deviation, fmt="o", capsize=2, color=COLOURS[contacts],
                               label=f"{contacts}: eight cells, deviation of one")
        axes["cells"].plot(place, law, "--", color=COLOURS[contacts], label=f"{contacts}: law")
    for axis, label in zip(axes.values(), labels):
        axis.set(xlabel="axial strain (%)", ylabel=label)
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    picture.savefig(f"{HERE}/figure.png", dpi=90)


PARTS = {**{contacts: stored.Part(functools.partial(measure, contacts), functools.partial(table, contacts))
            for contacts in CONTACTS}, "quick": stored.Part(short, lambda found: {})}

if __name__ == "__main__":
    sys.exit(stored.main(__doc__, HERE, PARTS, quick=quick, draw=draw))
