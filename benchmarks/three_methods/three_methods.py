#!/usr/bin/env python3
# diptych: the same discs by three methods: where each of them fails
# SPDX-License-Identifier: LGPL-2.1-or-later
"""three_methods.py PROGRAM EVENT_DRIVEN [--parts collisions cooling plane shaken] [--output DIR] [--quick]

Event-driven discs (EVENT_DRIVEN: build/release/benchmarks/event_driven_benchmark), contact dynamics and springs
(PROGRAM) on the same samples: collisions against closed forms, free cooling against Haff's law, the plane of solid
fraction and restitution, and the convection roll of a shaken box. --quick takes small samples without the box. Exit
code 1: a number is outside its interval."""
import argparse
import math
import os
import sys
import tempfile

import methods
import numpy
import shaken
from matplotlib import colormaps
from matplotlib.figure import Figure
from methods import claims

LAWS = ((1., -1., 0.), (0.9, 0.3, 0.2), (0.5, 0.5, 0.8), (0.1, 0., 0.4))  # e_n, e_t, friction
STEP = 0.1  # of contact dynamics in the tests of collisions
COOLING, E_COOLING, END_COOLING = 0.1, 0.9, 60.  # solid fraction, restitution, end in mean times between collisions
# Mean time between two collisions of a disc at the temperature 1, for discs of diameter 1 (Enskog; Henderson 1975).
UNIT_COOLING = math.pi / (16 * COOLING) * (1 - COOLING) ** 2 / (1 - 7 * COOLING / 16)
METHODS, COLOURS = ("contact dynamics", "springs"), ("#007A5E", "#0072B2", "#D55E00")
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
    for seed in options.cooling_seeds:
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
    if not options.quick:
        draw_cooling(found, periodic)
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
             "events": math.nan if near["collapsed"] else near["seconds"]}
    for method, runs in zip(METHODS, (steps, contacts)):
        step, found[method] = longest_step(runs, energy)
        found[method + " step"] = step / unit
        found[method + " errors"] = [100 * (run["energy"] / energy - 1) if run else math.nan for run in runs]
    return found


def plane(options):
    """Prints the table. Returns whether events collapse at a restitution of 0.5 and not from 0.9 on."""
    found, rates = {}, {}
    for seed in options.plane_seeds:
        dense = claims.Runs(options, seed, options.output).run(f"dense_{seed}", "discrete", methods.SCENE, *DENSE)
        for fraction in options.solid_fractions:
            sample = methods.shrunk(dense, fraction).thermal(options, seed)
            unit = sample.events(options, collisions=10 * len(sample.columns))["time"] / 20
            rates.setdefault(fraction, []).append(1 / unit)
            for e_n in options.restitutions:
                one = point(options, sample, unit, e_n, f"plane_{seed}_{fraction:g}_{e_n:g}")
                found.setdefault((fraction, e_n), []).append(one)
                print(seed, fraction, e_n, *(f"{name}: {numpy.round(x, 4)}" for name, x in one.items()), flush=True)
    print("longest step of contact dynamics; of springs, in mean times between collisions")
    print(" | ".join(["| fraction | rate", *(f"e = {e_n:g}" for e_n in options.restitutions)]), "|")
    for fraction in options.solid_fractions:
        print(" | ".join([f"| {fraction:g}", with_error(rates[fraction]), *("; ".join(
            with_error([one[f"{method} step"] for one in found[fraction, e_n]]) for method in METHODS)
            for e_n in options.restitutions)]), "|")
    if not options.quick:
        draw_plane(found)
    collapses = {e_n: [one["collapse"] for (_, e), group in found.items() if e == e_n for one in group]
                 for e_n in options.restitutions}
    return min(collapses[0.5]) < COLLISIONS and all(min(collapses[e]) == math.inf for e in collapses if e >= 0.9)


def with_error(values):
    """Mean +- standard error of those that are numbers; their number if some are none."""
    good = [value for value in values if not math.isnan(value)]
    if not good:
        return "none"
    mean, error = claims.mean_and_error(good)
    scatter = f" +- {error:.1g}" if error > 1e-9 * mean else ""
    return f"{mean:.3g}{scatter}" + (f" ({len(good)} of {len(values)})" if len(good) < len(values) else "")


def draw_cooling(found, periodic):
    figure = Figure(figsize=(10, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    times = numpy.arange(1, 61)
    law = haff(times)[0]
    left.semilogx(times, periodic[1:] / law, "k.", markersize=4, label="event-driven, periodic")
    for method, colour in zip(("event-driven", *METHODS), COLOURS):
        named = {name: runs for name, runs in found.items() if name.startswith(method)}
        for (name, runs), line in zip(reversed(named.items()), ("-", "--", ":")):
            energy = numpy.mean([numpy.interp(times * UNIT_COOLING, *run["history"].T[:2]) for run in runs], axis=0)
            left.plot(times, energy / len(runs[0]["grains"]) / law, line, color=colour, label=name)
        error = numpy.array([claims.mean_and_error([run["error"] for run in runs]) for runs in named.values()]).T
        seconds = [numpy.mean([run["seconds"] for run in runs]) for runs in named.values()]
        right.errorbar(seconds, *error, fmt="o-", color=colour, capsize=3, label=method)
        for name, x, y in zip(named, seconds, error[0]):
            right.annotate(name.split(", ")[-1], (x, y), (-8, -4), textcoords="offset points", fontsize=8, ha="right")
    left.set(ylim=(0.6, 1.1), xlabel="time / first mean time between collisions", ylabel="energy / Haff's law")
    right.set(xscale="log", xlabel="CPU seconds", ylabel="energy at 60 from event-driven [%]")
    right.margins(x=0.35)
    for axis in (left, right):
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    figure.savefig(os.path.join(methods.HERE, "figure.png"), dpi=100)


def draw_plane(found):
    """A point per sample, a line through the means over them."""
    fractions, restitutions = (sorted(set(column)) for column in zip(*found))
    panels = {"collisions of a disc until event-driven collapses":
              (lambda one: min(one["collapse"], 2 * COLLISIONS), {20: "20", 50: "50", 100: "100", 400: "none"}),
              **{f"longest step of {method} /\nmean time between collisions": (
                  (lambda method: lambda one: one[f"{method} step"])(method), {x: x for x in (0.005, 0.02, 0.05, 0.2)})
                 for method in METHODS},
              "CPU s of contact dynamics / springs":
              (lambda one: one["contact dynamics"] / one["springs"], {x: x for x in (0.5, 1, 2, 4)}),
              "CPU s of contact dynamics / event-driven":
              (lambda one: one["contact dynamics"] / one["events"], {x: x for x in (5, 10, 20, 40)})}
    figure = Figure(figsize=(11, 6.4), layout="constrained")
    axes = figure.subplots(2, 3).ravel()
    for axis, (name, (value, ticks)) in zip(axes, panels.items()):
        for k, e_n in enumerate(restitutions):
            place, colour = numpy.arange(len(fractions)) + 0.1 * (k - 2), colormaps["viridis"](k / len(restitutions))
            values = numpy.ma.masked_invalid([[value(one) for one in found[f, e_n]] for f in fractions])
            axis.plot(place, values, "o", color=colour, markersize=3.5)
            axis.plot(place, values.mean(axis=1), "-", color=colour, linewidth=1, label=f"restitution {e_n:g}")
        axis.set_title(name, fontsize=9)
        axis.set(yscale="log", xticks=range(len(fractions)), xticklabels=fractions, xlabel="solid fraction")
        axis.set_yticks([], minor=True)
        axis.set_yticks([*ticks], ticks.values())
        axis.grid(alpha=0.3)
    axes[5].axis("off")
    axes[5].legend(*axes[4].get_legend_handles_labels(), loc="center")
    figure.savefig(os.path.join(methods.HERE, "plane.png"), dpi=90)


def main():
    parts = {"collisions": collisions, "cooling": cooling, "plane": plane, "shaken": shaken.roll_of_the_box}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("event_driven", type=os.path.abspath)
    parser.add_argument("--parts", nargs="+", choices=parts, help="default: all of them")
    parser.add_argument("--output", help="folder of the runs, which are kept and reused; default: a temporary one")
    parser.add_argument("--quick", action="store_true", help="small samples, no shaken box, no figures")
    options = parser.parse_args()
    sizes = {"set": [], "reuse": True, "discs": 500, "cooling_steps": (0.1, 0.03, 0.01),
             "cooling_contacts": (0.1, 0.03), "plane_steps": (0.02, 0.06, 0.2),
             "plane_contacts": (0.1, 0.3, 1.), "solid_fractions": (0.1, 0.3, 0.5, 0.7, 0.8, 0.835),
             "restitutions": (1., 0.9, 0.7, 0.6, 0.5), "cooling_seeds": (1, 2, 3, 4), "plane_seeds": (1, 2, 3),
             "shaken_seeds": (1, 2, 3)}
    small = {"discs": 400, "cooling_steps": (0.03,), "cooling_contacts": (0.1,), "plane_steps": (0.1,),
             "plane_contacts": (0.3,), "solid_fractions": (0.835,), "restitutions": (0.9, 0.5), "cooling_seeds": (1,),
             "plane_seeds": (1,)}
    vars(options).update(sizes, **(small if options.quick else {}))
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
