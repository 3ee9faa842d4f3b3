#!/usr/bin/env python3
# diptych: the same discs by three methods: where each of them fails
# SPDX-License-Identifier: LGPL-2.1-or-later
"""three_methods.py PROGRAM EVENT_DRIVEN [--parts collisions,cooling,plane,shaken] [--seeds 1,2] [--output DIR]
[--reuse] [--figures DIR] [--quick]

Event-driven discs (EVENT_DRIVEN: build/release/benchmarks/event_driven_benchmark), contact dynamics and springs
(PROGRAM) on the same samples: collisions against closed forms, free cooling against Haff's law, the plane of solid
fraction and restitution, and the convection roll of a shaken box. --quick takes small samples without the box. Exit
code 1: a number is outside its interval."""
import argparse
import math
import os
import sys
import tempfile

import numpy

import methods
import shaken
from methods import claims

LAWS = ((1., -1., 0.), (0.9, 0.3, 0.2), (0.5, 0.5, 0.8), (0.1, 0., 0.4))  # e_n, e_t, friction
STEP = 0.1  # of contact dynamics in the tests of collisions
COOLING, E_COOLING, END_COOLING = 0.1, 0.9, 60.  # solid fraction, restitution, end in mean times between collisions
# Mean time between two collisions of a disc at the temperature 1, for discs of diameter 1 (Enskog; Henderson 1975).
UNIT_COOLING = math.pi / (16 * COOLING) * (1 - COOLING) ** 2 / (1 - 7 * COOLING / 16)
METHODS = ("contact dynamics", "springs")
UNITS, COLLISIONS, LIMIT = 20., 200., 0.1  # plane: end, most collisions of a disc in the search for a collapse, error
DENSE = ("sample/grains=600", "sample/width_over_height=0.3", "loading/duration=0.001", "loading/stage_time=0.001",
         "discrete/step=0.001", "discrete/tolerance=1e-4")


def walton(columns, normal, e_n, e_t, friction):
    """Velocities and spins after the collisions of the first half of the discs with the second half, in closed form."""
    first, second = numpy.split(columns.copy(), 2)
    mass = [math.pi * half[:, 2] ** 2 for half in (first, second)]
    inverse, tangent, u = 1 / mass[0] + 1 / mass[1], normal @ [[0, 1], [-1, 0]], first[:, 3:5] - second[:, 3:5]
    slip = (u * tangent).sum(axis=1) + first[:, 2] * first[:, 5] + second[:, 2] * second[:, 5]
    pressed = (1 + e_n) * (u * normal).sum(axis=1) / inverse
    rubbed = numpy.clip((1 + e_t) * slip / (3 * inverse), -friction * pressed, friction * pressed)
    given = pressed[:, None] * normal + rubbed[:, None] * tangent
    for half, m, sign in ((first, mass[0], -1), (second, mass[1], 1)):
        half[:, 3:5] += sign * given / m[:, None]
        half[:, 5] -= 2 * rubbed / (m * half[:, 2])
    return numpy.concatenate([first, second])[:, 3:]


def binary(options, law):
    """Largest difference from the closed form (events, contact dynamics): spinning discs fly into smaller ones at rest,
    at 17 angles. They touch in the middle of the first step."""
    angle = numpy.radians(numpy.linspace(-80, 80, 17))
    normal, count = numpy.column_stack([numpy.cos(angle), numpy.sin(angle)]), len(angle)
    columns = numpy.zeros((2 * count, 6))
    columns[count:, :2] = numpy.column_stack([6 * numpy.arange(count) + 3, numpy.full(count, 5.)])
    columns[:count, :2] = columns[count:, :2] - 0.8 * normal - [0.5 * STEP, 0]
    columns[:, 2] = numpy.repeat([0.5, 0.3], count)
    columns[:count, 3:] = 1, 0, 0.3
    sample, (e_n, e_t, friction) = methods.Sample(columns, 6 * count, 10), law
    runs = (sample.events(options, e_n=e_n, e_t=e_t, friction=friction, end=STEP),
            sample.nscd(options, f"pairs_{e_n:g}", STEP, step=STEP, e_n=e_n, extra=(
                f"discrete/tangential_restitution={e_t:g}", f"discrete/friction={friction:g}",
                "discrete/tolerance=1e-14")))
    return [abs(run["grains"][:, 3:] - walton(columns, normal, *law)).max() for run in runs]


def multiple(options, gap):
    """{method: velocities} after the first of three elastic discs in a row has hit the others."""
    columns = numpy.zeros((3, 6))
    columns[:, 0] = 3 + numpy.array([-0.5 * STEP, 1, 2 + gap])
    columns[:, 1:3] = 5, 0.5
    columns[0, 3] = 1
    sample, name = methods.Sample(columns, 20, 10), f"row_{gap:g}"
    runs = {"events": sample.events(options, end=1), "springs": sample.springs(options, name, 1., contact=1e-3, e_n=1),
            "contact dynamics": sample.nscd(options, name, 1., step=STEP, e_n=1, extra=("discrete/tolerance=1e-14",))}
    return {method: run["grains"][:, 3] for method, run in runs.items()}


def collisions(options):
    """Prints both tables. Returns whether the methods agree to round-off where they must."""
    worst = 0.
    print("pairs at 17 angles: largest difference from Walton's closed form\n"
          "e_n, e_t, friction   events   contact dynamics")
    for law in LAWS:
        events, steps = binary(options, law)
        worst = max(worst, events, steps)
        print(f"{law}".ljust(20), f"{events:8.1e} {steps:10.1e}")
    expected = {(0.25, "events"): (0, 0, 1), (0.25, "contact dynamics"): (0, 0, 1), (0, "events"): (0, 0, 1),
                (0, "contact dynamics"): (-1 / 3, 2 / 3, 2 / 3)}
    print("three elastic discs in a row: velocities after the impact")
    for gap in (0.25, 0):
        for method, v in multiple(options, gap).items():
            worst = max(worst, abs(v - expected.get((gap, method), v)).max())
            print(f"gap {gap:4g}, {method:16}" + " ".join(f"{x:9.6f}" for x in v))
    return worst < 1e-12


def haff(times):
    """(energy / first energy, collisions of a disc) at times in mean times between collisions. Haff (1983), with the
    fourth moment of the velocities (van Noije & Ernst 1998): T = (1 + g t)^-2."""
    e = E_COOLING
    excess = 16 * (1 - e) * (1 - 2 * e ** 2) / (57 - 25 * e + 30 * e ** 2 * (1 - e))
    g = 0.25 * (1 - e ** 2) * (1 + 3 * excess / 16)
    return (1 + g * times) ** -2, numpy.log(1 + g * times) / g


def law_of_haff(options):
    """Prints sixteen periodic event-driven runs over Haff's law. Returns (whether they follow it, their energy)."""
    runs = [methods.equal_discs(options.discs, COOLING).thermal(options, seed).events(
        options, platens=0, e_n=E_COOLING, end=END_COOLING * UNIT_COOLING, rows=60)["history"] for seed in range(1, 17)]
    energy, hits = haff(numpy.arange(61.))
    share = {"energy": numpy.array(runs)[:, 1:, 1] / options.discs / energy[1:],
             "collisions": numpy.array(runs)[:, 1:, 2] * 2 / options.discs / hits[1:]}
    print("free cooling, event-driven in a period of both directions over Haff's law, sixteen samples")
    for name, shares in share.items():
        for time in (12, 30, 60):
            mean, error = claims.mean_and_error(shares[:, time - 1])
            print(f"{name:10} at {time}: {mean:.4f} +- {error:.4f}")
    return (abs(share["energy"][:, 11].mean() - 1) < 0.03 and abs(share["collisions"][:, -1].mean() - 1) < 0.01,
            numpy.append(1, share["energy"].mean(axis=0) * energy[1:]))


def cooling(options):
    """Energy over time by all methods. Returns whether event-driven runs follow Haff's law, and contact dynamics and
    springs with the shortest steps these runs within 15 %."""
    unit, found, count = UNIT_COOLING, {}, options.discs
    end = END_COOLING * unit
    follows, periodic = law_of_haff(options)
    for seed in options.seeds:
        sample, name = methods.equal_discs(count, COOLING).thermal(options, seed), f"cooling_{seed}"
        runs = {"event-driven": sample.events(options, e_n=E_COOLING, end=end, rows=60)}
        for h in options.cooling_steps:
            runs[f"contact dynamics, h = {h:g}"] = sample.nscd(options, name, end, step=h * unit, e_n=E_COOLING)
        for c in options.cooling_contacts:
            runs[f"springs, tc = {c:g}"] = sample.springs(options, name, end, contact=c * unit, e_n=E_COOLING)
        for method, run in runs.items():
            if run:
                run["error"] = 100 * (run["energy"] / runs["event-driven"]["energy"] - 1)
                found.setdefault(method, []).append(run)
    print("the same between platens      E/E0 at 60           from event-driven [%]   step     CPU s")
    for method, runs in found.items():
        energy, error = (claims.mean_and_error([run[key] for run in runs]) for key in ("energy", "error"))
        print(f"{method:26} {energy[0] / count:9.5f} +- {energy[1] / count:.5f} {error[0]:10.1f} +- {error[1]:.1f}"
              f"{runs[0].get('step', math.nan) / unit:12.2g} {numpy.mean([run['seconds'] for run in runs]):9.3f}")
    if options.figures:
        draw_cooling(found, periodic, os.path.join(options.figures, "figure.png"))
    finest = [claims.mean_and_error([run["error"] for run in runs])[0] for name, runs in found.items() if name.endswith(
        (f"h = {options.cooling_steps[-1]:g}", f"tc = {options.cooling_contacts[-1]:g}"))]
    return follows and len(finest) == 2 and max(map(abs, finest)) < 15


def longest_step(runs, energy):
    """(step, CPU seconds) at which the error of the energy reaches the limit, between two runs; NaN: not even the
    shortest step is good enough. The longest one tried if all are."""
    good = None
    for run in runs:
        error = abs(run["energy"] / energy - 1) if run else math.inf
        if not error <= LIMIT:
            if good is None or not run:
                break
            share = math.log(LIMIT / good[0]) / math.log(error / good[0])
            return [good[1][key] ** (1 - share) * run[key] ** share for key in ("step", "seconds")]
        good = max(error, 1e-6), run
    return [good[1][key] if good else math.nan for key in ("step", "seconds")]


def point(options, sample, unit, e_n, name):
    """Numbers of one solid fraction and restitution. Steps and times are in mean times between collisions."""
    end, count = UNITS * unit, len(sample.columns)
    near = sample.events(options, e_n=e_n, end=end)
    far = sample.events(options, e_n=e_n, collisions=COLLISIONS * count / 2)
    steps = [sample.nscd(options, name, end, step=h * unit, e_n=e_n) for h in options.plane_steps]
    contacts = [sample.springs(options, name, end, contact=c * unit, e_n=e_n) for c in options.plane_contacts]
    # After a collapse the shortest step of contact dynamics is the reference of the others.
    energy = near["energy"] if not near["collapsed"] else steps[0]["energy"] if steps[0] else math.nan
    found = {"collapse": 2 * far["collisions"] / count if far["collapsed"] else math.inf,
             "events": math.nan if near["collapsed"] else near["seconds"],
             "time": (far["time"] if far["collapsed"] else math.inf) / unit}
    for method, runs in zip(METHODS, (steps, contacts)):
        step, found[method] = longest_step(runs, energy)
        found[method + " step"] = step / unit
        found[method + " errors"] = [100 * (run["energy"] / energy - 1) if run else math.nan for run in runs]
    return found


def plane(options):
    """Prints the table, for one sample. Returns whether events collapse at a restitution of 0.5 and not from 0.9 on."""
    found, seed = {}, options.seeds[0]
    dense = claims.Runs(options, seed, options.output).run(f"dense_{seed}", "discrete", methods.SCENE, *DENSE)
    print(f"contact dynamics: steps {options.plane_steps}, springs: contacts {options.plane_contacts}, to {UNITS:g}\n"
          "solid fraction, e | rate of a disc | collapse: collisions, time | longest step for 10 %: contact dynamics, "
          "springs\n | CPU s: event-driven, contact dynamics, springs | errors [%]: contact dynamics | springs")
    for fraction in options.solid_fractions:
        sample = methods.shrunk(dense, fraction).thermal(options, seed)
        unit = sample.events(options, collisions=10 * len(sample.columns))["time"] / 20
        for e_n in options.restitutions:
            one = point(options, sample, unit, e_n, f"plane_{seed}_{fraction:g}_{e_n:g}")
            numbers = [[1 / unit], [one["collapse"], one["time"]], [one[f"{method} step"] for method in METHODS],
                       [one[method] for method in ("events", *METHODS)],
                       *(one[f"{method} errors"] for method in METHODS)]
            print(f"{fraction:5g} {e_n:4g} |", " | ".join(" ".join(f"{x:8.3g}" for x in part) for part in numbers))
            found[fraction, e_n] = one
    if options.figures:
        draw_plane(found, os.path.join(options.figures, "plane.png"))
    return all(math.isinf(one["collapse"]) for (_, e_n), one in found.items() if e_n >= 0.9) and any(
        one["collapse"] < COLLISIONS for (_, e_n), one in found.items() if e_n == 0.5)


def draw_cooling(found, periodic, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9.5, 3.9), constrained_layout=True)
    left.loglog(haff(numpy.arange(61.))[0], "k-", label="Haff's law")
    left.loglog(periodic, "k.", markersize=4, label="event-driven, periodic")
    for method, colour in (("event-driven", "tab:green"), ("contact dynamics", "tab:blue"), ("springs", "tab:red")):
        named = {name: runs for name, runs in found.items() if name.startswith(method)}
        for (name, runs), line in zip(reversed(named.items()), ("-", "--", ":")):
            history = runs[0]["history"]
            left.loglog(history[1:, 0] / UNIT_COOLING, history[1:, 1] / len(runs[0]["grains"]), line, color=colour,
                        linewidth=1, label=name)
        error = numpy.array([claims.mean_and_error([run["error"] for run in runs]) for runs in named.values()]).T
        seconds = [numpy.mean([run["seconds"] for run in runs]) for runs in named.values()]
        right.errorbar(seconds, *error, fmt="o-", color=colour, capsize=3, label=method)
        for name, x, y in zip(named, seconds, error[0]):
            right.annotate(name.split(", ")[-1], (x, y), textcoords="offset points", xytext=(5, 6), fontsize=8)
    left.set(xlabel="time / first mean time between collisions", ylabel="energy / first energy", xlim=(0.9, 70))
    right.set(xscale="log", xlabel="CPU seconds", ylabel="error of the energy at the end [%]", xlim=(0.02, 5))
    for axis in (left, right):
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=110)


def draw_plane(found, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    fractions, restitutions = (sorted(set(column)) for column in zip(*found))
    names = ("collisions of a disc\nuntil event-driven collapses", "longest step of springs /\nof contact dynamics",
             "CPU s of contact dynamics /\nof springs", "CPU s of contact dynamics /\nof event-driven")
    values = (lambda one: one["collapse"], lambda one: one["springs step"] / one["contact dynamics step"],
              lambda one: one["contact dynamics"] / one["springs"], lambda one: one["contact dynamics"] / one["events"])
    figure, axes = pyplot.subplots(1, 4, figsize=(13, 3.4), constrained_layout=True, sharey=True)
    for axis, name, value in zip(axes, names, values):
        grid = numpy.array([[value(found[fraction, e_n]) for fraction in fractions] for e_n in restitutions])
        axis.imshow(numpy.log(numpy.where(numpy.isinf(grid), 2 * COLLISIONS, grid)), origin="lower", cmap="RdYlGn",
                    aspect="auto")
        for (row, column), x in numpy.ndenumerate(grid):
            axis.text(column, row, "none" if math.isinf(x) else "-" if math.isnan(x) else f"{x:.2g}", ha="center",
                      va="center", fontsize=8)
        axis.set(title=name, xticks=range(len(fractions)), xticklabels=fractions, yticks=range(len(restitutions)),
                 yticklabels=restitutions, xlabel="solid fraction")
        axis.title.set_fontsize(9)
    axes[0].set_ylabel("restitution")
    figure.savefig(path, dpi=110)


def main():
    parts = {"collisions": collisions, "cooling": cooling, "plane": plane, "shaken": shaken.roll_of_the_box}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("event_driven", type=os.path.abspath)
    parser.add_argument("--parts", type=lambda text: text.split(","))
    parser.add_argument("--seeds", type=lambda text: [int(word) for word in text.split(",")], default=[1, 2])
    parser.add_argument("--output", help="folder for the result folders; default: thrown away")
    parser.add_argument("--reuse", action="store_true", help="keep runs that are already in --output")
    parser.add_argument("--figures", help="folder for the figures (matplotlib)")
    parser.add_argument("--quick", action="store_true", help="small samples, no shaken box")
    options = parser.parse_args()
    sizes = {"set": [], "discs": 500, "cooling_steps": (0.1, 0.03, 0.01), "cooling_contacts": (0.1, 0.03),
             "plane_steps": (0.02, 0.06, 0.2), "plane_contacts": (0.1, 0.3, 1.),
             "solid_fractions": (0.1, 0.3, 0.5, 0.7, 0.8, 0.835), "restitutions": (1., 0.9, 0.7, 0.6, 0.5)}
    small = {"discs": 400, "cooling_steps": (0.03,), "cooling_contacts": (0.1,), "plane_steps": (0.1,),
             "plane_contacts": (0.3,), "solid_fractions": (0.835,), "restitutions": (0.9, 0.5), "seeds": [1]}
    vars(options).update(sizes, **(small if options.quick else {}))
    unknown = set(options.parts or ()) - set(parts)
    if unknown:
        sys.exit(f"three_methods.py: --parts {','.join(unknown)}: give some of {','.join(parts)}")
    wanted = options.parts or [part for part in parts if part != "shaken" or not options.quick]
    with tempfile.TemporaryDirectory() as scratch:
        options.output = options.output or scratch
        os.makedirs(options.output, exist_ok=True)
        try:
            wrong = [part for part in wanted if not parts[part](options)]
        except claims.RunFailed as failure:
            sys.exit(f"three_methods.py: {failure}")
    if wrong:
        sys.exit(f"three_methods.py: outside its interval: {', '.join(wrong)}")


if __name__ == "__main__":
    main()
