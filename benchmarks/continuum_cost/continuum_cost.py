#!/usr/bin/env python3
# diptych: cost of the continuum panel and the accuracy it buys
# SPDX-License-Identifier: LGPL-2.1-or-later
"""continuum_cost.py PROGRAM [--only targets,accuracy,phases,samples,growth] [--results DIR] [--figure figure.png]

Runs variants of scene.prm one after the other and prints a table per part. Seconds are CPU seconds of the continuum
phase (provenance.json). --results keeps the runs and does not repeat existing ones. Needs numpy, h5py, matplotlib."""
import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from types import SimpleNamespace

from refined_band import band_thickness

HERE = os.path.dirname(os.path.abspath(__file__))
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
FINEST = {"element_size": 0.75, "max_step": 0.001}
# Reference of the stress ratio at 8 %. In FINEST a node of a free side reaches a platen just there, and the ratio jumps
# by 0.6 %.
FINEST_AT_END = {"element_size": 1, "max_step": 0.001}
# Steps end at every stage, and a step of half a stage does not grow to a whole one: larger steps need larger stages.
LONG_STAGES = {"stage_strain": 0.04}
STEPS = {"0.02": {"max_step": 0.02, "loading": LONG_STAGES}, "0.01": {"max_step": 0.01, "loading": LONG_STAGES},
         "0.01, stages of 1 %": {"max_step": 0.01}, "0.005": {}, "0.0025": {"max_step": 0.0025},
         "0.001": {"max_step": 0.001}}
VERY_SHORT = ("0.0005", {"max_step": 0.0005, "initial_step": 0.0005})
# Name on the chart, label of a point -> keys of the section continuum. Other keys are those of scene.prm.
VARIANTS = {
    "element size h": {f"{h:g}": {"element_size": h} for h in (4, 3, 2, 1.5, 1)},
    "max_step, h = 2": {step: {"element_size": 2, **keys} for step, keys in [*STEPS.items(), VERY_SHORT]},
    "max_step, h = 1": {step: {"element_size": 1, **keys} for step, keys in STEPS.items()},
    "adaptive levels, h = 2": {f"{n}": {"refinement": "adaptive", "refinement_levels": n} for n in (1, 2)},
    "adaptive levels, h = 1": {f"{n}": {"refinement": "adaptive", "refinement_levels": n, "element_size": 1}
                               for n in (1, 2)},
    "viscosity, h = 2": {f"{eta:g}": {"viscosity": eta} for eta in (0.002, 0.01)},
    "linear_solver = amg": {f"h = {h}": {"linear_solver": "amg", "element_size": h} for h in (2, 1)},
    "small strain, h = 2": {"small_strain": {"geometry": "small_strain"}},
}
LOCAL = {f"{element}, h = {h}": {"law": "mohr_coulomb", "element": element, "element_size": h}
         for element, sizes in (("q2", (4, 2)), ("q1_bbar", (4, 2, 1))) for h in sizes}


class Runs:
    """Runs of the program, each in its own folder."""

    def __init__(self, program, folder):
        self.program, self.folder, self.revisions = program, folder, set()

    def run(self, strain=0.08, processes=1, loading=None, **continuum):
        settings = [f"continuum/{key}={value}" for key, value in continuum.items()]
        settings += [f"loading/{key}={value}" for key, value in (loading or {}).items()]
        if strain != 0.08:
            settings += [f"loading/axial_strain={strain}", f"loading/stage_strain={min(strain, 0.01)}",
                         f"comparison/window_edges=0,{strain}"]
        name = "_".join([s.split("/")[1].replace("=", "_") for s in settings if not s.startswith("comp")]) or "scene"
        output = os.path.join(self.folder, name + (f"_np_{processes}" if processes > 1 else ""))
        if not os.path.exists(os.path.join(output, "exit.json")):
            self.start(output, processes, settings)
        r = result(output)
        self.revisions.add(r.revision)
        r.has_window = "stage_strain" not in (loading or {})
        r.element_size, r.refined = continuum.get("element_size", 2), "refinement" in continuum
        return r

    def start(self, output, processes, settings):
        words = [word for setting in settings for word in ("--set", setting)]
        parallel = ["mpirun", "-np", str(processes)] if processes > 1 else []
        errors = os.path.join(self.folder, "stderr.txt")
        with open(errors, "w") as file:
            child = subprocess.Popen([*parallel, self.program, "continuum", os.path.join(HERE, "scene.prm"), "--output",
                                      output, "--overwrite",
                                      "--quiet", *words], stdout=subprocess.DEVNULL, stderr=file, env=ENVIRONMENT)
            _, status, usage = os.wait4(child.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        with open(errors) as file:
            message = file.read().strip()
        if code not in (0, 3):
            sys.exit(f"continuum_cost.py: {output}: exit code {code}: {message}")
        with open(os.path.join(output, "exit.json"), "w") as file:
            json.dump({"code": code, "message": message, "cpu_s": usage.ru_utime + usage.ru_stime}, file)


def result(folder):
    """Cost, sizes and history of a finished run."""
    with open(os.path.join(folder, "provenance.json")) as file:
        provenance = json.load(file)
    with open(os.path.join(folder, "exit.json")) as file:
        ended = json.load(file)
    with open(os.path.join(folder, "continuum.csv")) as file:
        rows = [{key: float(value) for key, value in row.items() if key != "walk"} for row in csv.DictReader(file)]
    phase = next(p for p in provenance["phases"] if p["name"] == "continuum")
    facts = provenance["continuum"]
    return SimpleNamespace(folder=folder, rows=rows, last=rows[-1], seconds=phase["cpu_s"], wall=phase["wall_s"],
                           start_up=ended["cpu_s"] - sum(p["cpu_s"] for p in provenance["phases"]),
                           memory=phase["peak_memory_mb"], finished=facts["finished"],
                           strain=facts["reached_axial_strain"],
                           unknowns=facts["unknowns"], message=ended["message"], cut_backs=int(rows[-1]["cut_backs"]),
                           peak=max(row["stress_ratio"] for row in rows), revision=provenance["git_revision"])


def thickness_of(r):
    """Thickness of the band [length]. NaN without a stage at 7 %."""
    if r.last["axial_strain"] < 0.08 or not r.has_window:
        return float("nan")
    return band_thickness(r.folder, r.element_size if r.refined else None)


def percent(value, reference):
    return 100 * (value / reference - 1)


def print_header(line):
    print(line + "\n" + "|---" * (line.count("|") - 1) + "|")


def targets(runs):
    print("\n## Targets")
    coarse, fine = runs.run(element_size=2), runs.run(element_size=1)
    thick = [thickness_of(r) for r in (coarse, fine)]
    far = runs.run(strain=0.3)
    vertical = runs.run(loading={"horizontal_over_vertical": 0})
    wide = runs.run(rectangle_width=120, rectangle_height=120, internal_length=4, element_size=3)
    tiny = [runs.run(strain=1e-6, element_size=h) for h in (2, 1)]
    far_fine = runs.run(strain=0.3, element_size=1)
    checks = [(f"h = 2, {coarse.unknowns} unknowns, CPU s", coarse.seconds, 6),
              (f"h = 1, {fine.unknowns}, CPU s", fine.seconds, 30),
              ("cut-backs, h = 2", coarse.cut_backs, 0), ("cut-backs, h = 1", fine.cut_backs, 0),
              (f"thickness {thick[0]:.2f} / {thick[1]:.2f} d: difference, %", abs(percent(thick[0], thick[1])), 3),
              (f"30 % strain, h = 2 ({far.seconds:.1f} s, {far.cut_backs} cut-backs): missing strain, %",
               100 * (0.3 - far.strain), 0),
              (f"30 % strain, h = 1 ({far_fine.seconds:.1f} s, {far_fine.cut_backs} cut-backs): missing strain, %",
               100 * (0.3 - far_fine.strain), 0),
              (f"vertical (strain {vertical.strain:g}, {vertical.cut_backs} cut-backs), CPU s", vertical.seconds, 8),
              (f"W = H = 120, l = 4, h = 3 ({wide.unknowns}; strain {wide.strain:g}), CPU s", wide.seconds, 15),
              *((f"start-up, h = {h}, to a strain of 1e-6: CPU s in all", r.seconds + r.start_up, 2)
                for h, r in zip((2, 1), tiny))]
    print("| | found | at most | |\n|---|---|---|---|")
    for name, value, limit in checks:
        print(f"| {name} | {value:.3g} | {limit} | {'met' if value <= limit + 1e-9 else 'not met'} |")
    print(f"Before the phase (reading, meshing): {coarse.start_up:.2f} s at h = 2, {fine.start_up:.2f} s at h = 1.")
    for r in (coarse, fine, far, far_fine, vertical, wide, *tiny):
        if r.message:
            print("said:", r.message)


def accuracy(runs):
    """{series: [(label, run, errors in peak, ratio at the end, thickness [%])]}"""
    print("\n## Accuracy")
    finest, at_end = runs.run(**FINEST), runs.run(**FINEST_AT_END)
    values = (finest.peak, at_end.last["stress_ratio"], thickness_of(finest))
    print(f"finest run {FINEST}: {finest.unknowns} unknowns, {finest.seconds:.1f} s, peak {values[0]:.4f}, thickness "
          f"{values[2]:.2f} d, "
          f"at 8 % {finest.last['stress_ratio']:.4f}, one step before {finest.rows[-2]['stress_ratio']:.4f}; taken at "
          "8 %: " f"{FINEST_AT_END}, {at_end.seconds:.1f} s, {values[1]:.4f}")
    print_header("| | | unknowns | CPU s | cut-backs | peak | at 8 % | thickness [d] | viscous share | axial force |")
    series = {}
    for name, variants in VARIANTS.items():
        for label, keys in variants.items():
            r = runs.run(**keys)
            thickness = thickness_of(r)
            errors = [percent(a, b) for a, b in zip((r.peak, r.last["stress_ratio"], thickness), values)]
            series.setdefault(name, []).append((label, r, errors))
            print(f"| {name} | {label} | {r.unknowns} | {r.seconds:.1f} | {r.cut_backs} | {r.peak:.4f} "
                  f"({errors[0]:+.2f} %) | "
                  f"{r.last['stress_ratio']:.4f} ({errors[1]:+.2f} %) | {thickness:.2f} ({errors[2]:+.2f} %) | "
                  f"{100 * r.last['viscous_share']:.2f} % | {-r.last['upper_fy']:.2f} | {r.message}", flush=True)
    print("\nlocal law mohr_coulomb (no thickness: the mesh sets it)")
    print_header("| | unknowns | CPU s | cut-backs | strain | peak | at the end |")
    for label, keys in LOCAL.items():
        r = runs.run(**keys)
        print(f"| {label} | {r.unknowns} | {r.seconds:.1f} | {r.cut_backs} | {r.strain:.4f} | {r.peak:.4f} | "
              f"{r.last['stress_ratio']:.4f} | {r.message}", flush=True)
    return series


PARTS = ("points", "assembly", "geometry", "solve", "rest")


def shares(r):
    """CPU seconds of PARTS."""
    parts = [r.last[f"{name}_cpu_s"] for name in ("point", "assembly", "geometry", "solve")]
    return parts + [r.seconds - sum(parts)]


def phases(runs):
    print("\n## Where the time goes")
    print_header("| | " + " | ".join(PARTS) + " | CPU s | steps | Newton | GMRES | factorisations |")
    found = {}
    for h in (2, 1):
        r = runs.run(element_size=h)
        found[h] = shares(r)
        parts = " | ".join(f"{s:.2f} ({100 * s / r.seconds:.0f} %)" for s in found[h])
        print(f"| h = {h} | {parts} | {r.seconds:.2f} | {r.last['step']:.0f} | {r.last['newton_iterations']:.0f} | "
              f"{r.last['linear_iterations']:.0f} | {r.last['factorisations']:.0f} |")
    return found


def samples(runs):
    """{mesh: [(width, run)]}"""
    print("\n## Size of the sample, h = 2, l = 2")
    print_header("| W = H | mesh | unknowns | CPU s | cut-backs | thickness [d] | at 8 % | "
                 "against uniform: CPU, thickness, stress ratio |")
    found = {}
    for width in (60, 120, 180):
        uniform = None
        for mesh, keys in (("uniform", {}), ("adaptive, 1 level", {"refinement": "adaptive"}),
                           ("adaptive, 2 levels", {"refinement": "adaptive", "refinement_levels": 2})):
            size = {} if width == 60 else {"rectangle_width": width, "rectangle_height": width}
            r = runs.run(**size, **keys)
            r.thickness, r.ratio = thickness_of(r), r.last["stress_ratio"]
            uniform = uniform or r
            found.setdefault(mesh, []).append((width, r))
            print(f"| {width} | {mesh} | {r.unknowns} | {r.seconds:.1f} | {r.cut_backs} | {r.thickness:.2f} | "
                  f"{r.ratio:.4f} | "
                  f"{r.seconds / uniform.seconds:.2f}, {percent(r.thickness, uniform.thickness):+.1f} %, "
                  f"{percent(r.ratio, uniform.ratio):+.1f} % | {r.message}", flush=True)
    return found


def growth(runs):
    """{solver: [(unknowns, CPU s per Newton iteration, memory [MB])]}"""
    print("\n## Growth, to 1 % strain")
    print_header("| h | unknowns | solver | CPU s | Newton | GMRES per Newton | factorisations | cut-backs | s per "
                 "Newton iteration | of it solve | MB |")
    found = {}
    for h in (4, 2, 1.5, 1, 0.75, 0.5, 0.4):
        for solver in ("direct", "amg"):
            r = runs.run(strain=0.01, element_size=h, linear_solver=solver)
            n = r.last["newton_iterations"]
            found.setdefault(solver, []).append((r.unknowns, r.seconds / n, r.last["solve_cpu_s"] / n, r.memory))
            print(f"| {h} | {r.unknowns} | {solver} | {r.seconds:.1f} | {n:.0f} | "
                  f"{r.last['linear_iterations'] / n:.1f} | "
                  f"{r.last['factorisations']:.0f} | {r.cut_backs} | {r.seconds / n:.3f} | "
                  f"{r.last['solve_cpu_s'] / n:.3f} | {r.memory:.0f} | {r.message}", flush=True)
    print()
    print_header("| h | processes | wall s | CPU s | largest difference in stress ratio |")
    for h in (1, 0.5):
        one, two = (runs.run(strain=0.01, element_size=h, linear_solver="direct", processes=n) for n in (1, 2))
        difference = max((abs(a["stress_ratio"] - b["stress_ratio"]) for a, b in zip(one.rows, two.rows)), default=0)
        same = [row["axial_strain"] for row in one.rows] == [row["axial_strain"] for row in two.rows]
        for n, r in ((1, one), (2, two)):
            steps = "" if same else " (other steps)"
            print(f"| {h} | {n} | {r.wall:.1f} | {r.seconds:.1f} | {difference:.1e}{steps} |")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--only", default="targets,accuracy,phases,samples,growth")
    parser.add_argument("--results")
    parser.add_argument("--figure")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    with tempfile.TemporaryDirectory() as scratch:
        runs = Runs(program, options.results or scratch)
        os.makedirs(runs.folder, exist_ok=True)
        found = {name: globals()[name](runs) for name in options.only.split(",")}
        print("\nrevisions of the program:", ", ".join(sorted(runs.revisions)))
        if options.figure:
            from figure import draw
            draw(found, options.figure)


if __name__ == "__main__":
    main()
