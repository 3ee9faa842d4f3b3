# diptych: a tiny result folder, written by hand, for the tests of the report
# SPDX-License-Identifier: LGPL-2.1-or-later
"""5 x 8 d: a lattice of 40 grains, 2 x 3 cells; two stages and one window. Every number that a test asks for is set here."""

import json
import os
import subprocess
import sys

import h5py
import numpy as np

REPORT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "coupling", "report", "report.py")
STAGES, WINDOWS, PROBES = 2, 1, 3
BAND = {"angle_deg": -45.0, "half_width_d": 1.0, "width_10_90_d": 2.197, "offset_d": 0.0, "jump": 0.9,
        "dilation_deg": 3.0, "r_squared": 0.98}
STRIPS = {"angle_deg": -45.0, "edges_d": list(np.linspace(-4, 4, 17)), "mean": [None] + list(np.linspace(0, 1, 15)),
          "deviation": [None] + [0.1] * 15, "count": [0] + [2] * 15}
ANGLES = list(range(0, 180, 30))
CIRCLE = {"centre": [2.5, 4.0], "radius": 2.0, "angles_deg": ANGLES, "normal": [2.0] * 6, "tangential": [0.0] * 6,
          "predicted_normal": [1.9] * 6, "predicted_tangential": [None] + [0.1] * 5, "normal_error": [0.1] * 5 + [None],
          "independent_blocks": 0.1}


def within(value, low, high):
    return {"value": value, "low": low, "high": high}


def probe(name, y):
    return {"name": name, "polygon": [[1, y], [4, y], [4, y + 1.5], [1, y + 1.5]], "stress": [[1, 0], [0, 2]],
            "s1": 2.0, "s2": 1.0, "direction_deg": 90.0, "t_over_s": 1 / 3, "fabric_direction_deg": -88.0,
            "fabric_direction_error_deg": 4.0, "anisotropy": 0.3, "anisotropy_error": 0.05, "normals_24": [3] * 24,
            "contacts": 36}


def panel(bands):
    return {"stress_ratio": 0.3, "volumetric_strain": -0.001, "bands": bands, "strips": STRIPS,
            "probes": [probe(name, y) for name, y in (("upper", 5.5), ("zone", 3.0), ("lower", 0.5))]}


def grains(bands):
    """Panel of the grains with everything that may come with an interval."""
    found = panel(bands)
    found["stress_ratio"] = within(0.3, 0.28, 0.33)
    for entry in found["probes"]:
        entry.update(s1=within(2.0, 1.8, 2.3), direction_deg=within(90.0, 85.0, None),
                     fabric_to_stress_deg=within(2.0, -3.0, 7.0),
                     grain_pressure={"mean": 1.5, "deviation": 0.7, "percentiles": {"5": 0.1, "50": 1.4, "95": 3.0}})
    found["probe_differences"] = [{"of": "zone", "and": "upper", "t_over_s": within(0.0, -0.1, 0.1), "verdict": "do not differ",
                                   "anisotropy": within(0.1, 0, 0.2), "direction_deg": within(1.0, -4, 6)}]
    side = {"grains": 20, "mean": 1.0, "share_above_mean": 0.4, "values": [0.1, 0.8, 2.0]}
    found["force_chains"] = {"inside": side, "outside": side, "quantiles": [0.0, 0.5, 0.9],
                             "largest_distance": within(0.05, 0.01, 0.1), "verdict": "the pattern ignores the zone"}
    return _common(found)


def continuum(bands):
    return _common(panel(bands))


def _common(found):
    return {**found, "circular_probe": {**CIRCLE, "relative_l2": within(0.05, 0.02, 0.09)},
            "dissipation": {"inside": 3.0, "outside": 1.0, "share_inside": 0.75, "area_share": 0.5},
            "band_traction": {"edges_d": [-2, 0, 2], "normal": [1.0, 1.2], "shear": [0.4, 0.5], "variation_normal": 0.1,
                              "variation_shear": 0.2, "normal_error": [None, 0.1]}}


def write_group(file, name, start, end, stress):
    """Continuum strains four times the grains'; the last grain is a rattler; one contact between two grains."""
    group = file.create_group(name)
    group.attrs.update({"from": start, "axial_strain": end})
    x, y = (v.ravel() + 0.5 for v in np.meshgrid(np.arange(5.0), np.arange(8.0)))
    group["discrete/position"] = np.column_stack([x, y])
    group["discrete/radius"] = np.full(40, 0.5)
    group["discrete/displacement_increment"] = np.column_stack([y, -y]) * (end - start)
    group["discrete/shear_strain_increment"] = np.linspace(0, 0.02, 40)
    corners = np.array([[[2.5 * (i + a), 8 / 3 * (j + b)] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                        for j in range(3) for i in range(2)])
    nodes = np.unique(corners.reshape(-1, 2), axis=0)
    group["nodes/position"] = nodes
    group["nodes/displacement_increment"] = np.column_stack([nodes[:, 1], -nodes[:, 1]]) * (end - start)
    if stress:  # a window ends with a stage, whose mesh is its own
        group["cells/corners"] = corners
    group["cells/continuum_shear_strain_increment"] = np.linspace(0, 0.08, 6)
    group["cells/discrete_shear_strain_increment"] = np.array([0.01, np.nan, 0.01, 0.02, 0.01, 0.0])
    if stress:
        write_state(group, corners)


def write_state(group, corners):
    """What stages alone hold: stress, velocities, single-grain moments, contact forces; the same cells again as the grid."""
    tensor = np.tile(np.diag([1.0, 2.0]), (6, 1, 1))
    group["grid/corners"] = corners
    for place in ("cells", "grid"):
        group[place + "/continuum_stress"] = tensor
        group[place + "/discrete_stress"] = tensor * np.array([0.5, np.nan, 1.0, 2.0, 1.0, 0.8])[:, None, None]
        for panel_name, factor in (("discrete", 1.0), ("continuum", 0.5)):
            group[f"{place}/{panel_name}_rotation_increment"] = factor * np.linspace(-0.01, 0.01, 6)
            group[f"{place}/{panel_name}_spin_increment"] = factor * np.linspace(-0.008, 0.012, 6)
            if place == "grid":  # on the mesh's cells the corners' own is taken
                group[f"{place}/{panel_name}_displacement_increment"] = factor * np.full((6, 2), 0.01)
            group[f"{place}/{panel_name}_couple_stress"] = factor * np.full((6, 2), 0.1)
            group[f"{place}/{panel_name}_dissipation"] = factor * np.linspace(0, 0.001, 6)
        group[place + "/discrete_velocity"] = np.full((6, 2), 0.001)
        group[place + "/discrete_standard_error"] = np.linspace(0.1, 0.2, 6)
        group[place + "/discrete_coordination_number"] = np.full(6, 3.2)
    group["discrete/velocity"] = np.full((40, 2), 0.001)
    group["discrete/rotation_increment"] = np.linspace(-0.1, 0.1, 40)
    group["discrete/internal_moment"] = np.tile(np.diag([1.0, 2.0]) * np.pi / 4, (40, 1, 1))
    group["discrete/rattler"] = np.arange(40) == 39
    group["contacts/point"] = np.array([[1.0, 0.5], [2.0, 0.5]])
    group["contacts/force"] = np.array([[3.0, 0.0], [0.0, 0.0]])
    group["contacts/i"], group["contacts/j"] = np.array([0, 1]), np.array([1, 2])


def comparison_of_two_stages():
    record = {"format": 1, "scene": "tiny", "seed": 3}
    record["stages"] = [
        {"axial_strain": end, "discrete": grains(bands), "continuum": continuum(bands), "mapping": {"method": "segments"},
         "difference": {"stress_ratio": 0.0, "angle_deg": None, "stress_verdict": "no more than sampling",
                        "stress": [{"resolution_d": 3.0, "label": "3 d", "relative_l2": 0.3, "sampling_alone": 0.2,
                                    "direction_deg": 9.0}]}}
        for end, bands in ((0.005, []), (0.01, [BAND]))]
    first = dict(BAND, angle_deg=within(-45.0, -46.5, -43.5), jump=within(0.9, 0.8, 1.0), resamples=200, lost_share=0.02)
    record["windows"] = [{"from": 0.0, "to": 0.01, "discrete": panel([first]),
                          "continuum": panel([BAND, dict(BAND, angle_deg=44.0)])}]
    record["continuum_coarse"] = {"element_size_d": 4.0, "windows": [{"from": 0.0, "to": 0.01, "bands": [BAND]}]}
    record["continuum_summary"] = {"element_size_d": 2.0, "law": {"friction_angle_peak": 20.5}}
    record["discrete_summary"] = {"grains": 40, "residual_factor": None, "a_later_key": 1.5}
    record["cost"] = {"discrete_cpu_s": 1.0}
    record["theory"] = {"coulomb_deg": 55.0, "roscoe_deg": 49.0, "arthur_deg": 52.0}
    rows = [{"width_d": width, "points": [{"name": "zone", "s": 1.5, "t_over_s": 0.3}], "scatter_s": 0.4, "scatter_t": 0.5}
            for width in (1, 2, 4)]
    record["resolution_study"] = {"kernel": rows, "cells": [{**row, "size_d": row["width_d"]} for row in rows],
                                  "verdict": "a plateau", "plateau_d": [1.0, 4.0]}
    return record


def write_folder(folder, complete=True):
    """Two stages (the first one diffuse in both panels) and one window; without optional keys if not complete."""
    comparison = comparison_of_two_stages() if complete else {"format": 1, "scene": "tiny", "seed": 3}
    with h5py.File(os.path.join(folder, "comparison.h5"), "w") as file:
        if complete:
            file.attrs.update(mean_diameter=1.0, pressure=1.0, height0=8.0, width0=5.0)
            write_group(file, "stage_0001", 0.0, 0.005, True)
            write_group(file, "stage_0002", 0.005, 0.01, True)
            write_group(file, "window_0", 0.0, 0.01, False)
    write_json(folder, "comparison.json", comparison)
    write_json(folder, "provenance.json", {"phases": [{"name": "discrete", "cpu_s": 1.0}]} if complete else {})
    columns = "axial_strain,stress_ratio,volumetric_strain,lower_fy,upper_fy" + (
        ",time,sweeps,residual,kinetic_energy_ratio,external_work,dissipation" if complete else "")
    for name in ("discrete.csv", "continuum.csv"):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
            stream.write(columns + "\n")
            for k in range(1, 21):
                row = [0.0005 * k, 0.3, -0.001 * k, 10, -10.05] + ([k, 20, 1e-5, 1.2, 0.1 * k, 0.1 * k] if complete else [])
                stream.write(",".join(map(str, row)) + "\n")


def write_json(folder, name, value):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
        json.dump(value, stream)


def run(folder):
    return subprocess.run([sys.executable, REPORT, folder], capture_output=True, text=True, check=False)


def read(folder):
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as stream:
        return stream.read()


def number_of_figures():
    """(pictures, canvases) of the complete folder's page for a reader with scripts.

    Pictures: 4 histories, work and kinetic energy, solver: 7; inclination, width, dissipation, stress difference: 4; strips of
    every increment, chains + traction and both circles of every stage: pairs; roses: one a probe and stage; resolution: 4.
    Canvases: 5 pairs of maps and the pair of the difference; 3 colour bars.
    """
    return 7 + 4 + 2 * (STAGES + WINDOWS) + 4 * STAGES + PROBES * STAGES + 4, 2 * 6 + 3
