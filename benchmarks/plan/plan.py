#!/usr/bin/env python3
# diptych: predictions of `diptych plan` compared with finer runs of samples that it has not seen
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: plan.py PROGRAM [--output DIR] [--scenes NAME ...] [--jobs N]

Plans every scene, then runs the planned settings and a finer reference with `diptych study`. Prints error, scatter and
CPU time, predicted and found."""
import argparse
import json
import os
import subprocess
import sys

ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
BENCHMARKS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
FRESH_SEEDS = "101-116"  # Samples of the grains that no pilot has seen.
FINER = 4
FINER_ELEMENTS = 3  # Their cost grows with the third power.

# Name: scene, accuracy, further settings.
SCENES = {
    "moreau_quick": ("moreau_quick/scene.prm", "5 %", {}),
    "dense_biaxial": ("dense_biaxial/scene.prm", "2 %", {"loading/axial_strain": 0.04}),
    "oblique": ("cosserat_band/oblique.prm", "2 %", {}),
    "slippery": ("plan/slippery.prm", "3 %", {}),
    "plane": ("plan/plane.prm", "3 %", {}),
    "tall": ("plan/tall.prm", "2 %", {}),
}


def read(*names):
    with open(os.path.join(*names), encoding="utf-8") as file:
        return json.load(file)


def call(words):
    """Output of a command that must succeed."""
    done = subprocess.run(words, env=ENVIRONMENT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}: exit code {done.returncode}: {done.stderr.strip()}")


def finer(panel):
    """Settings of the reference: a quarter of every size that the plan chose, a third of the elements' size."""
    planned = dict(setting.split(" = ") for setting in panel["settings"])
    if panel["panel"] == "discrete":
        return {"discrete/accuracy": max(0.001, float(planned["discrete/accuracy"]) / FINER)}
    size = float(planned.get("continuum/element_size", "nan"))
    step = float(planned["continuum/max_step"]) / FINER
    settings = {"continuum/max_step": step, "continuum/initial_step": min(step, 0.001), "continuum/tolerance": 1e-7}
    return settings if size != size else {**settings, "continuum/element_size": size / FINER_ELEMENTS}


def quantity(name, scene):
    """A quantity of a study, evaluated as in the plan."""
    panel, short = name.split(".")
    source = {"name": name, "limit": {"relative": 0.05}, **({"of": "continuum"} if panel == "continuum" else {})}
    if short == "peak_stress_ratio":
        return {**source, "column": "stress_ratio", "peak": 0.005}
    return {**source, "strength": [0.003, scene["end"]]}


def verify(program, folder, plan, panel, jobs):
    """Study of the planned settings and a reference on the same samples."""
    study = {"title": f"{plan['scene']}: {panel['panel']}", "scene": "planned.prm", "command": panel["command"],
             "reference": finer(panel), "axes": [{"name": "point", "points": [{"label": "planned", "set": {}}]}],
             "quantities": [quantity(q["name"], {"end": plan["end"]}) for q in panel["quantities"]]}
    if panel["panel"] == "discrete":
        study["seeds"] = FRESH_SEEDS
    file = os.path.join(folder, f"verify_{panel['panel']}.json")
    with open(file, "w", encoding="utf-8") as out:
        json.dump(study, out, indent=1)
    output = os.path.join(folder, f"verify_{panel['panel']}")
    call([program, "study", file, "--output", output, "--resume", *jobs])
    record, cost = read(output, "study.json"), read(output, "study_cost.json")
    place = next(k for k, point in enumerate(record["points"]) if point["family"] != "reference")
    return record["points"][place], next(one for one in cost["points"] if one["point"] == place)


def per_cent(value):
    return "-" if value is None else f"{100 * value:.2f}"


def row(name, panel, q, found, cpu_s):
    """One line of the table."""
    most = sum(part["error"] for part in q["parts"] if part["cause"] != "samples")
    error, scatter = found["error"], found["deviation"] and found["deviation"] / abs(found["mean"])
    interval = "" if error["low"] is None else f" ({per_cent(error['low'])} to {per_cent(error['high'])})"
    return (f"| {name} | {q['name']} | {per_cent(q['bias'])} | {per_cent(most)} | {per_cent(error['value'])}{interval} "
            f"| {per_cent(q['scatter'])} | "
            f"{per_cent(scatter) if panel['panel'] == 'discrete' else '-'} | {panel['cpu_s']:.3g} | {cpu_s:.3g} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--output", default="results/plans")
    parser.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    parser.add_argument("--jobs")
    options = parser.parse_args()
    jobs = ["--jobs", options.jobs] if options.jobs else []
    print("| scene | quantity | error of the method, expected, % | at most about, % | found, % (95 %) | scatter, "
          "predicted, % | found, % | CPU s a "
          "sample, predicted | found |\n|---|---|---|---|---|---|---|---|---|", flush=True)
    for name in options.scenes:
        scene, accuracy, settings = SCENES[name]
        folder = os.path.join(options.output, name)
        words = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
        call([options.program, "plan", os.path.join(BENCHMARKS, scene), "--accuracy", accuracy, "--output",
              os.path.join(folder, "plan"), "--resume", *jobs, *words])
        plan = read(folder, "plan", "plan.json")
        with open(os.path.join(folder, "plan", "planned.prm"), encoding="utf-8") as file:
            text = file.read()
        plan["end"] = next(float(line.split("=")[1]) for line in text.splitlines() if "set axial_strain" in line)
        with open(os.path.join(folder, "planned.prm"), "w", encoding="utf-8") as file:
            file.write(text)
        for panel in plan["panels"]:
            point, cost = verify(options.program, folder, plan, panel, jobs)
            for q, found in zip(panel["quantities"], point["quantities"]):
                print(row(name, panel, q, found, cost["cpu_s"]), flush=True)


if __name__ == "__main__":
    main()
