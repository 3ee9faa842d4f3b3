#!/usr/bin/env python3
# diptych: the same discs by three methods: where each of them fails
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Event-driven discs (event_driven: build/release/benchmarks/event_driven_benchmark), contact dynamics and springs
(program) on the same samples: collisions against closed forms, free cooling against Haff's law, the plane of solid
fraction and restitution, and the convection roll of a shaken box. --quick: small samples, no box."""
import math
import sys

import charts
import methods
import numpy
import shaken
from methods import METHODS, claims, stored

LAWS = ((1., -1., 0.), (0.9, 0.3, 0.2), (0.5, 0.5, 0.8), (0.1, 0., 0.4))  # e_n, e_t, friction
STEP = 0.1  # of contact dynamics in the tests of collisions
COOLING, E_COOLING, END_COOLING = 0.1, 0.9, 60  # solid fraction, restitution, end in mean times between collisions
# Mean time between two collisions of a disc at the temperature 1, for discs of diameter 1 (Enskog; Henderson 1975).
UNIT_COOLING = math.pi / (16 * COOLING) * (1 - COOLING) ** 2 / (1 - 7 * COOLING / 16)
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
    """Velocities after the first of three elastic discs in a row has hit the others: events, contact dynamics,
    springs."""
    columns = numpy.zeros((3, 6))
    columns[:, 0] = 3 + numpy.array([-0.5 * STEP, 1, 2 + gap])
    columns[:, 1:3] = 5, 0.5
    columns[0, 3] = 1
    sample, name = methods.Sample(columns, 20, 10), f"row_{gap:g}"
    runs = (sample.events(options, end=1),
            sample.nscd(options, name, 1., step=STEP, e_n=1, extra=("discrete/tolerance=1e-14",)),
            sample.springs(options, name, 1., contact=1e-3, e_n=1))
    return [run["grains"][:, 3].tolist() for run in runs]


def collisions(options):
    return {"pairs": [[", ".join(f"{x:g}" for x in law), *binary(options, law)] for law in LAWS],
            "apart": multiple(options, 0.25), "touching": multiple(options, 0)}


def differences(found):
    """Methods must agree to round-off in pairs and with the closed forms of discs in a row."""
    rows = (*found["apart"][:2], *found["touching"][:2])
    expected = (0, 0, 1), (0, 0, 1), (0, 0, 1), (-1 / 3, 2 / 3, 2 / 3)
    worst = max(abs(numpy.subtract(rows, expected)).max(), *(max(row[1:]) for row in found["pairs"]))
    return [] if worst < 1e-12 else [f"collisions differ by {worst}"]


def collision_tables(found):
    def velocities(row):
        return ", ".join(f"{x + 0.:.3f}" for x in numpy.round(row, 3))
    return {"pairs": stored.table("e_n, e_t, friction | event-driven | contact dynamics",
                                  [(law, *(f"{x:.1e}" for x in errors)) for law, *errors in found["pairs"]]),
            "row": stored.table("gap | event-driven | contact dynamics | springs, contact of 1e-3", [
                (gap, *map(velocities, found[key])) for gap, key in (("0.25 d", "apart"), ("they touch", "touching"))])}


def haff(times):
    """(energy / first energy, collisions of a disc) at times in mean times between collisions. Haff (1983), with the
    fourth moment of the velocities (van Noije & Ernst 1998): T = (1 + g t)^-2."""
    e = E_COOLING
    excess = 16 * (1 - e) * (1 - 2 * e ** 2) / (57 - 25 * e + 30 * e ** 2 * (1 - e))
    g = 0.25 * (1 - e ** 2) * (1 + 3 * excess / 16)
    return (1 + g * times) ** -2, numpy.log(1 + g * times) / g


def cooling(options):
    """Energy over Haff's law at 1, 2 ... END_COOLING: of event-driven runs with two periods, and of all methods between
    platens. Runs that end early do not count."""
    unit, count, times = UNIT_COOLING, options.discs, numpy.arange(1, END_COOLING + 1)
    end, (energy, hits) = END_COOLING * unit, haff(times)
    periodic = numpy.array([methods.equal_discs(count, COOLING).thermal(options, seed).events(
        options, platens=0, e_n=E_COOLING, end=end, rows=END_COOLING)["history"] for seed in range(1, 17)])[:, 1:]
    found = {"energy": claims.mean_and_error(periodic[:, :, 1] / count / energy),
             "collisions": claims.mean_and_error(periodic[:, :, 2] * 2 / count / hits), "methods": {}}
    for seed in options.cooling_seeds:
        sample, name = methods.equal_discs(count, COOLING).thermal(options, seed), f"cooling_{seed}"
        exact = sample.events(options, e_n=E_COOLING, end=end, rows=END_COOLING)
        runs = {"event-driven": exact}
        for h in options.cooling_steps:
            runs[f"contact dynamics, h = {h:g}"] = sample.nscd(options, name, end, step=h * unit, e_n=E_COOLING)
        for c in options.cooling_contacts:
            runs[f"springs, tc = {c:g}"] = sample.springs(options, name, end, contact=c * unit, e_n=E_COOLING)
        for method, run in runs.items():
            found["methods"].setdefault(method, []).extend([] if not run else [{
                "error": 100 * (run["energy"] / exact["energy"] - 1), "seconds": run["seconds"],
                "step": run.get("step", math.nan) / unit,
                "share": numpy.interp(times * unit, *run["history"].T[:2]) / count / energy}])
    found["methods"] = {method: {key: numpy.mean([run[key] for run in runs], axis=0) if key != "error" else
                                 [run[key] for run in runs] for key in runs[0]}
                        for method, runs in found["methods"].items() if runs}
    return found


def far_from_haff(found):
    """Event-driven runs follow the law, and contact dynamics and springs with the shortest steps these runs."""
    finest = {method.split(",")[0]: numpy.mean(one["error"]) for method, one in found["methods"].items()}
    numbers = {"energy": (found["energy"][0][11] - 1, 0.03), "collisions": (found["collisions"][0][-1] - 1, 0.01),
               **{method: (finest.get(method, math.nan), 15) for method in METHODS}}
    return [f"cooling, {name}: off by {value}" for name, (value, limit) in numbers.items() if not abs(value) < limit]


def cooling_tables(found):
    law = [(time, *("{:.3f} +- {:.3f}".format(*(part[time - 1] for part in found[key])) for key in (
        "energy", "collisions"))) for time in (12, 30, 60)]
    rows = [
        (f"{method} ({len(one['error'])})", *(
            ("{:+.1f} +- {:.1f} %".format(*claims.mean_and_error(one["error"])), f"{one['step']:.2g}")
            if one["step"] else ("reference", "")), f"{one['seconds']:.2g}")
        for method, one in found["methods"].items()]
    return {"law": stored.table("time | energy / law | collisions / law", law),
            "methods": stored.table("method (samples) | energy at 60, from event-driven | step | CPU s", rows)}


def longest_step(runs, energy):
    """Step and CPU seconds at which the error of the energy reaches the limit, between two runs. `cut`: no longer step
    was tried, or the next run ended early. None: not even the shortest step is good enough."""
    good = None
    for run in runs:
        error = abs(run["energy"] / energy - 1) if run else math.inf
        if not error <= LIMIT:
            if not good or not run:
                break
            share = math.log(LIMIT / good[0]) / math.log(error / good[0])
            return {"cut": False, **{key: good[1][key] ** (1 - share) * run[key] ** share
                                     for key in ("step", "seconds")}}
        good = max(error, 1e-6), run
    return {"cut": True, "step": good[1]["step"], "seconds": good[1]["seconds"]} if good else None


def point(options, sample, unit, e_n, name):
    """Numbers of one solid fraction and restitution. Steps and times are in mean times between collisions."""
    end, count = UNITS * unit, len(sample.columns)
    near = sample.events(options, e_n=e_n, end=end)
    far = sample.events(options, e_n=e_n, collisions=COLLISIONS * count / 2)
    steps = [sample.nscd(options, name, end, step=h * unit, e_n=e_n) for h in options.plane_steps]
    contacts = [sample.springs(options, name, end, contact=c * unit, e_n=e_n) for c in options.plane_contacts]
    # After a collapse the shortest step of contact dynamics is the reference of the others.
    energy = near["energy"] if not near["collapsed"] else steps[0]["energy"] if steps[0] else math.nan
    found = {"collapse": 2 * far["collisions"] / count if far["collapsed"] else None,
             "events": None if near["collapsed"] else near["seconds"]}
    for method, runs in zip(METHODS, (steps, contacts)):
        found[method] = longest_step(runs, energy)
        if found[method]:
            found[method]["step"] /= unit
        found[method + " errors"] = [100 * (run["energy"] / energy - 1) if run else None for run in runs]
    return found


def plane(options):
    """{"fraction": rates of a disc, "fraction, restitution": points}, over the samples."""
    found = {"rates": {}, "points": {}}
    for seed in options.plane_seeds:
        dense = claims.Runs(options, seed, options.output).run(f"dense_{seed}", "discrete", methods.SCENE, *DENSE)
        for fraction in options.solid_fractions:
            sample = methods.shrunk(dense, fraction).thermal(options, seed)
            unit = sample.events(options, collisions=10 * len(sample.columns))["time"] / 20
            found["rates"].setdefault(f"{fraction:g}", []).append(1 / unit)
            for e_n in options.restitutions:
                one = point(options, sample, unit, e_n, f"plane_{seed}_{fraction:g}_{e_n:g}")
                found["points"].setdefault(f"{fraction:g}, {e_n:g}", []).append(one)
    return found


def unexpected_collapses(found):
    """Events collapse at a restitution of 0.5 and not from 0.9 on."""
    at = {float(name.split()[1]) for name, group in found["points"].items() for one in group if one["collapse"]}
    return [] if 0.5 in at and max(at) < 0.9 else [f"collapses at restitutions of {at}"]


def of_samples(steps):
    """Mean +- standard error of the longest steps, ">=" if one of them was cut, and the number of them."""
    good = [step for step in steps if step]
    if not good:
        return "none"
    mean, error = claims.mean_and_error([step["step"] for step in good])
    scatter = f" +- {error:.1g}" if error > 1e-9 * mean else ""
    return ((f">= {mean:.2g}" if any(step["cut"] for step in good) else f"{mean:.2g}{scatter}")
            + (f" ({len(good)} of {len(steps)})" if len(good) < len(steps) else ""))


def plane_tables(found):
    restitutions = [*dict.fromkeys(name.split(", ")[1] for name in found["points"])]
    return {"plane": stored.table(" | ".join(["fraction | rate | collapse", *(f"e = {e_n}" for e_n in restitutions)]), [
        (fraction, "{:.3g} +- {:.1g}".format(*claims.mean_and_error(rates)),
         ", ".join(f"{one['collapse']:.0f}" if one["collapse"] else "none"
                   for one in found["points"][f"{fraction}, 0.5"]),
         *("; ".join(of_samples([one[method] for one in found["points"][f"{fraction}, {e_n}"]]) for method in METHODS)
           for e_n in restitutions)) for fraction, rates in found["rates"].items()])}


PARTS = {"collisions": stored.Part(collisions, collision_tables, differences),
         "cooling": stored.Part(cooling, cooling_tables, far_from_haff),
         "plane": stored.Part(plane, plane_tables, unexpected_collapses),
         "shaken": stored.Part(shaken.measure, shaken.tables, shaken.rises)}
SIZES = {"discs": 500, "cooling_steps": (0.1, 0.03, 0.01), "cooling_contacts": (0.1, 0.03),
         "plane_steps": (0.02, 0.06, 0.2), "plane_contacts": (0.1, 0.3, 1.), "restitutions": (1., 0.9, 0.7, 0.6, 0.5),
         "solid_fractions": (0.1, 0.3, 0.5, 0.7, 0.8, 0.835), "cooling_seeds": (1, 2, 3, 4), "plane_seeds": (1, 2, 3)}
QUICK = {"discs": 400, "cooling_steps": (0.03,), "cooling_contacts": (0.1,), "plane_steps": (0.1,),
         "plane_contacts": (0.3,), "solid_fractions": (0.835,), "restitutions": (0.9, 0.5), "cooling_seeds": (1,),
         "plane_seeds": (1,)}


def quick(options, _):
    vars(options).update(QUICK)
    for part in [*PARTS.values()][:3]:
        yield from part.wrong(part.measure(options))


if __name__ == "__main__":
    sys.exit(stored.main(__doc__, methods.HERE, PARTS, quick=quick, draw=charts.draw,
                         arguments=("program", "event_driven"), **SIZES))
