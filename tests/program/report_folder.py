# diptych: a tiny synthetic result folder for the tests of the report
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A sample of 5 x 8 d: a lattice of 40 grains, 2 x 3 cells, two stages and one window. The tests compare with the
numbers here."""

import json
import os
import subprocess
import sys

import h5py
import numpy as np

from diptych.thickness import CONVENTIONS

STAGES, WINDOWS, PROBES = 2, 1, 3
PLATEN = 0.5  # d per unit of progress, the reference of displacements
BAND = {"angle_deg": -45.0, "half_width_d": 1.0, "width_10_90_d": 2.197, "offset_d": 0.0, "jump": 0.9,
        "dilation_deg": 3.0, "r_squared": 0.98, "to_minor_stress_deg": 45.0}
STRIPS = {"angle_deg": -45.0, "edges_d": list(np.linspace(-4, 4, 17)), "mean": [None] + list(np.linspace(0, 1, 15)),
          "deviation": [None] + [0.1] * 15, "count": [0] + [2] * 15, "background": 0.5, "background_slope": 0.01}
ANGLES = list(range(0, 180, 30))
CIRCLE = {"centre": [2.5, 4.0], "radius": 2.0, "angles_deg": ANGLES, "normal": [2.0] * 6, "tangential": [0.0] * 6,
          "predicted_normal": [1.9] * 6, "predicted_tangential": [None] + [0.1] * 5, "normal_error": [0.1] * 5 + [None],
          "independent_blocks": 0.1}
# place below a panel of a stage or window -> unit
PANEL_UNITS = {"bands/angle_deg": "degrees", "bands/half_width_d": "mean diameters",
               "bands/width_10_90_d": "mean diameters", "bands/offset_d": "mean diameters",
               "bands/dilation_deg": "degrees", "bands/jump": "-", "probes/s1": "pressure", "probes/s2": "pressure",
               "probes/direction_deg": "degrees", "probes/fabric_direction_deg": "degrees",
               "probes/fabric_direction_error_deg": "degrees", "probes/fabric_to_stress_deg": "degrees",
               "probes/polygon": "length", "probes/grain_pressure/mean": "pressure", "circular_probe/centre": "length",
               "circular_probe/radius": "length", "circular_probe/normal": "pressure",
               "band_traction/normal": "pressure"}


def within(value, low, high):
    return {"value": value, "low": low, "high": high}


def numbers():
    """The list of numbers, as far as these tests need it."""
    entries = {f"{kind}/{panel}/{key}": {"unit": unit, "meaning": key.split("/")[-1], "kind": "number"}
               for kind in ("stages", "windows") for panel in ("discrete", "continuum")
               for key, unit in PANEL_UNITS.items()}
    for place, unit, meaning in (("discrete_summary/grains", "-", "grains"),
                                 ("discrete_summary/solver_noise", "-", "noise"),
                                 ("discrete_summary/initial_height", "length", "initial height"),
                                 ("stages/discrete/bands/angle_deg", "degrees", "inclination"),
                                 ("stages/discrete/probes/fabric_to_stress_deg", "degrees", "fabric to stress"),
                                 ("continuum_summary/element_size_d", "mean diameters", "element size"),
                                 ("continuum_summary/localisation_strain", "strain or time",
                                  "progress at the first loss")):
        entries[place] = {"unit": unit, "meaning": meaning, "kind": "number", "shape": "number"}
    return entries


def probe(name, y):
    return {"name": name, "polygon": [[1, y], [4, y], [4, y + 1.5], [1, y + 1.5]], "stress": [[1, 0], [0, 2]],
            "s1": 2.0, "s2": 1.0, "direction_deg": 90.0, "t_over_s": 1 / 3, "count": 12, "fabric_direction_deg": -88.0,
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
    found["probe_differences"] = [{"of": "zone", "and": "upper", "t_over_s": within(0.0, -0.1, 0.1),
                                   "verdict": "do not differ", "anisotropy": within(0.1, 0, 0.2),
                                   "direction_deg": within(1.0, -4, 6)}]
    side = {"grains": 20, "mean": 1.0, "share_above_mean": 0.4, "values": [0.1, 0.8, 2.0]}
    found["force_chains"] = {"inside": side, "outside": side, "quantiles": [0.0, 0.5, 0.9],
                             "largest_distance": within(0.05, 0.01, 0.1), "verdict": "the pattern ignores the zone"}
    return _common(found)


def continuum(bands):
    return _common(panel(bands))


def _common(found):
    return {**found, "circular_probe": {**CIRCLE, "relative_l2": within(0.05, 0.02, 0.09)},
            "dissipation": {"inside": 3.0, "outside": 1.0, "share_inside": 0.75, "area_share": 0.5,
                            "density_ratio": 3.0},
            "band_traction": {"edges_d": [-2, 0, 2], "normal": [1.0, 1.2], "shear": [0.4, 0.5], "variation_normal": 0.1,
                              "variation_shear": 0.2, "normal_error": [None, 0.1]}}


def store(group, path, values, unit="-", title="", *, meaning=""):
    group[path] = values
    group[path].attrs.update(unit=np.bytes_(unit), title=np.bytes_(title), meaning=np.bytes_(meaning))


def write_group(file, name, start, end, stress):
    """Continuum strains four times the grains'; the last grain is a rattler; one contact between two grains."""
    group = file.create_group(name)
    group.attrs.update({"from": start, "to": end, "displacement_unit": PLATEN * (end - start),
                        "velocity_unit": PLATEN * (end - start) / 10, "centre": [2.5, 4.0]})
    x, y = (v.ravel() + 0.5 for v in np.meshgrid(np.arange(5.0), np.arange(8.0)))
    store(group, "discrete/position", np.column_stack([x, y]), "length")
    store(group, "discrete/radius", np.full(40, 0.5), "length")
    store(group, "discrete/displacement_increment", np.column_stack([y, -y]) * (end - start), "length")
    store(group, "discrete/displacement_over_platen", np.linspace(0, 1, 40))
    store(group, "discrete/shear_strain_increment", np.linspace(0, 0.02, 40), meaning="around each grain")
    node = np.array([[2.5 * i, 8 / 3 * j] for j in range(4) for i in range(3)])
    cell = np.array([[3 * j + i, 3 * j + i + 1, 3 * j + i + 4, 3 * j + i + 3] for j in range(3) for i in range(2)])
    store(group, "nodes/position", node, "length")
    store(group, "nodes/displacement_increment", np.column_stack([node[:, 1], -node[:, 1]]) * (end - start), "length")
    for place in ("cells", "grid") if stress else ("cells",):
        store(group, place + "/node_position", node, "length")
        group[place + "/nodes"] = cell
        store(group, place + "/continuum_displacement_over_platen", np.linspace(0.1, 0.6, 6))
        store(group, place + "/continuum_shear_strain_increment", np.linspace(0, 0.08, 6))
        store(group, place + "/discrete_shear_strain_increment", np.array([0.01, np.nan, 0.01, 0.02, 0.01, 0.0]))
    for panel in ("discrete", "continuum") if end == 0.01 else ():  # where there is a band
        store(group, f"profile/{panel}/distance", np.arange(-20.0, 21.0), "mean diameters")
        for curve in ("relative_rotation", "spin", "couple_stress", "solid_fraction", "velocity_fluctuation"):
            known = panel == "discrete" or curve in ("spin", "solid_fraction")  # a classical continuum
            store(group, f"profile/{panel}/{curve}", np.tile([0.5, 0.4, 0.6] if known else [np.nan] * 3, (41, 1)),
                  "pressure length" if curve == "couple_stress" else "-")
    if stress:
        write_state(group)


def write_state(group):
    """Data of stages only: stress, velocities, stresses of single grains, contact forces. The grid has the same cells
    as the mesh."""
    tensor = np.tile(np.diag([1.0, 2.0]), (6, 1, 1))
    grains_to_continuum = np.array([0.5, np.nan, 1.0, 2.0, 1.0, 0.8])
    for place in ("cells", "grid"):
        for name, factor in (("discrete", grains_to_continuum), ("continuum", np.ones(6))):
            store(group, f"{place}/{name}_stress", tensor * factor[:, None, None], "pressure", "stress")
            store(group, f"{place}/{name}_mean_stress", 1.5 * factor, "pressure", "mean stress s")
            store(group, f"{place}/{name}_stress_ratio", factor / factor / 3, "-", "stress ratio t/s")
        for name, factor in (("discrete", 1.0), ("continuum", 0.5)):
            for turn, ends in (("rotation_increment", 0.01), ("spin_increment", 0.008), ("relative_rotation", 0.002)):
                store(group, f"{place}/{name}_{turn}", factor * np.linspace(-ends, ends, 6), "rad",
                      turn.replace("_", " "))
            store(group, f"{place}/{name}_couple_stress_size", factor * np.full(6, 0.1), "pressure length",
                  "couple stress")
            store(group, f"{place}/{name}_dissipation", factor * np.linspace(0, 0.001, 6), "pressure", "dissipation")
        store(group, place + "/discrete_displacement_over_platen", np.full(6, 0.3))
        store(group, place + "/discrete_speed_over_platen", np.full(6, 0.4))
        store(group, place + "/discrete_standard_error", np.linspace(0.1, 0.2, 6), "pressure", "standard error")
        store(group, place + "/discrete_coordination_number", np.full(6, 3.2))
        store(group, place + "/solid_fraction", np.full(6, 0.8))
    for key, value in (("major_stress", 2.0), ("minor_stress", 1.0), ("stress_direction", np.pi / 2)):
        unit = "rad" if key == "stress_direction" else "pressure"
        store(group, "discrete/" + key, np.full(40, value), unit)
        store(group, "cells/continuum_" + key, np.full(6, value), unit)
    store(group, "discrete/stress", np.tile(np.diag([1.0, 2.0]), (40, 1, 1)), "pressure", "stress")
    store(group, "discrete/mean_stress", np.full(40, 1.5), "pressure", "mean stress s")
    store(group, "discrete/stress_ratio", np.full(40, 1 / 3), "-", "stress ratio t/s")
    store(group, "discrete/velocity", np.full((40, 2), 0.001), "length/time")
    store(group, "discrete/speed_over_platen", np.full(40, 0.4))
    store(group, "discrete/rotation_increment", np.linspace(-0.1, 0.1, 40), "rad", "rotation increment")
    store(group, "window/point", np.array([[1.0, 0.5], [2.0, 0.5]]), "length")
    store(group, "window/force", np.array([[3.0, 0.0], [0.0, 0.0]]), "pressure length")


def comparison_of_two_stages():
    record = {"format": 2, "scene": "tiny", "seed": 3, "walk": "axial_strain", "mean_diameter": 1.0, "pressure": 1.0,
              "averaging_width": 0.005, "numbers": numbers()}
    record["stages"] = [
        {"progress": end, "axial_strain": end, "discrete": grains(bands), "continuum": continuum(bands),
         "mapping": {"method": "segments"},
         "difference": {"stress_ratio": 0.0, "angle_deg": None, "stress_verdict": "no more than sampling",
                        "stress": [{"resolution_d": 3.0, "label": "3 d", "relative_l2": 0.3, "sampling_alone": 0.2,
                                    "direction_deg": 9.0}]}}
        for end, bands in ((0.005, []), (0.01, [BAND]))]
    first = dict(BAND, angle_deg=within(-45.0, -46.5, -43.5), jump=within(0.9, 0.8, 1.0), resamples=200,
                 lost_share=0.02)
    record["windows"] = [{"from": 0.0, "to": 0.01, "discrete": panel([first]),
                          "continuum": panel([BAND, dict(BAND, angle_deg=44.0, diffuse=True)])}]
    record["continuum_coarse"] = {"element_size_d": 4.0, "windows": [{"from": 0.0, "to": 0.01, "bands": [BAND]}]}
    record["continuum_summary"] = {"element_size_d": 2.0, "platen_unbalance": 3e-4}
    record["discrete_summary"] = {"grains": 40, "residual_factor": None, "a_later_key": 1.5, "solver_noise": 0.0123,
                                  "initial_height": 8.0, "kinetic_energy_ratio_median": 1.2}
    record["checks"] = [{"key": "discrete_summary/solver_noise", "name": "noise", "value": 0.0123, "limit": 0.03,
                         "kept": True, "reason": "It is noise."},
                        {"key": "discrete_summary/spin", "name": "spin", "value": 0.002, "limit": 0.001, "kept": False,
                         "reason": "It spins."}]
    record["cost"] = {"discrete_cpu_s": 1.0}
    record["theory"] = {"coulomb_deg": 55.0, "roscoe_deg": 49.0, "arthur_deg": 52.0}
    rows = [{"width_d": width, "points": [{"name": "zone", "s": 1.5, "t_over_s": 0.3}], "scatter_s": 0.4,
             "scatter_t": 0.5}
            for width in (1, 2, 4)]
    record["resolution_study"] = {"kernel": rows, "cells": [{**row, "size_d": row["width_d"]} for row in rows],
                                  "verdict": "a plateau", "plateau_d": [1.0, 4.0]}
    return record


def write_arrays(folder):
    with h5py.File(os.path.join(folder, "comparison.h5"), "w") as file:
        file.attrs.update(mean_diameter=1.0, pressure=1.0, height0=8.0, width0=5.0)
        write_group(file, "stage_0001", 0.0, 0.005, True)
        write_group(file, "stage_0002", 0.005, 0.01, True)
        write_group(file, "window_0", 0.0, 0.01, False)
        for name in ("discrete", "continuum"):
            history = file.create_group("histories/" + name)
            store(history, "progress", 0.0005 * np.arange(1, 21), "strain or time")
            for mean in ("stress_ratio_mean", "lower_fy_mean", "upper_fy_mean", "platen_difference"):
                store(history, mean, np.append(np.full(9, np.nan), np.full(11, 0.3)))


def write_folder(folder):
    """Two stages (the first without bands) and one window."""
    write_arrays(folder)
    write_json(folder, "comparison.json", comparison_of_two_stages())
    phases = [{"name": "discrete", "cpu_s": 1.0, "peak_memory_mb": 100}]
    write_json(folder, "provenance.json", {"program": "diptych", "phases": phases})
    columns = ("progress,stress_ratio,volumetric_strain,lower_fy,upper_fy,axial_strain,shear_strain,time,walk,sweeps,"
               "residual,kinetic_energy_ratio,external_work,dissipation")
    for name in ("discrete.csv", "continuum.csv"):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
            stream.write(columns + "\n")
            for k in range(1, 21):
                row = [0.0005 * k, 0.3, -0.001 * k, 10, -10.05, 0.0005 * k, 0.0, k, "axial_strain", 20, 1e-5, 1.2,
                       0.1 * k, 0.1 * k]
                stream.write(",".join(map(str, row)) + "\n")


def write_levelled(folder):
    """A measurement beside both panels: 4 x 7 points, one band that is resolved in the measurement only."""
    ends = dict.fromkeys(("angle_deg", "width_10_90_d", "offset_d", "jump"), within(2.0, 1.5, 2.5))
    band = {**ends, "angle_deg": within(-45.0, -47.0, -43.0), "diffuse": False, "middle": [2.5, 4.0],
            "thickness_d": dict.fromkeys(CONVENTIONS, 2.0), "profile": {"distance_d": [-2, 2], "displacement": [0, 1]}}
    narrow = {**band, "width_10_90_d": within(None, None, None), "thickness_d": {}, "unresolved": "too narrow"}
    strains = {"volumetric_strain": -0.001, "shear_strain": 0.02}
    panes = {"measured": {"bands": [band], **strains}, "discrete": {"bands": [narrow], **strains},
             "continuum": {"bands": [], **strains}}
    unblurred = {panel: panes[panel] for panel in ("discrete", "continuum")}
    window = {"key": "window_0", "from": 0.0, "to": 0.01, "points": 28, "levelled": panes, "unblurred": unblurred,
              "difference": {panel: {"shear_strain": 0.0} for panel in unblurred}}
    row = {"quantity": "width", "unit": "mean diameters", "measured": within(2.0, 1.5, 2.5),
           "discrete": within(None, None, None), "continuum": within(3.0, None, None)}
    write_json(folder, "levelled.json", {
        "format": 1, "subset_d": 1.0, "spacing_d": 1.0, "resolution_d": 2.0, "summary": [row],
        "windows": [window], "history": {"axial_strain": [0, 0.01], "volumetric_strain": [0, -0.001]}})
    with open(os.path.join(folder, "comparison.json"), encoding="utf-8") as stream:
        comparison = json.load(stream)
    write_json(folder, "comparison.json", comparison | {"measured": [row]})
    x, y = (v.ravel() + 1.0 for v in np.meshgrid(np.arange(4.0), np.arange(7.0)))
    with h5py.File(os.path.join(folder, "levelled.h5"), "w") as file:
        group = file.create_group("window_0")
        store(group, "position", np.column_stack([x, y]), "length")
        for pane, end in (("measured", 0.02), ("discrete", 0.03), ("continuum", 0.04)):
            store(group, f"{pane}_shear_strain_increment", np.linspace(0, end, 28))
            store(group, f"{pane}_displacement_increment", np.column_stack([y, -y]) * 0.01, "length")


def write_json(folder, name, value):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
        json.dump(value, stream)


def run(folder, word="page"):
    return subprocess.run([sys.executable, "-B", "-m", "diptych.report", word, folder], capture_output=True, text=True,
                          check=False)


def read(folder):
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as stream:
        return stream.read()


def number_of_figures():
    """(pictures, canvases) of the page of the complete folder, with JavaScript.

    Pictures: 7 of histories, work, kinetic energy and solver; inclination, width, dissipation, stress difference: 4;
    pairs for the strips of every increment and the profiles of every window, and for chains + traction and the circles
    of every stage; one rose per probe and stage; resolution: 4. Canvases: 5 pairs of maps and the pair of the
    difference; 3 colour bars.
    """
    return 7 + 4 + 2 * (STAGES + WINDOWS) + 2 * WINDOWS + 4 * STAGES + PROBES * STAGES + 4, 2 * 6 + 3
