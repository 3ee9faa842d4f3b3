#!/usr/bin/env python3
# diptych: figures of the literature for discs, measured again
# SPDX-License-Identifier: LGPL-2.1-or-later
"""literature.py [PROGRAM [--output DIR] [--only SOURCES]] [--quick]

With PROGRAM, measures every claim on its seeds, keeps the numbers in results.json, and writes the tables of README.md
and figure.png from them. Without, it only writes these again. --quick measures one seed of the claims that take
seconds and changes no file. Exit code 1: with --quick, a number left the scatter of the stored ones or README.md has
another table; otherwise a row differs and README.md has no line on it. PYTHONPATH: build/release/python."""
import argparse
import json
import os
import re
import sys
import tempfile
import textwrap
import time
from collections.abc import Callable
from dataclasses import dataclass

import figures
import numpy
from samples import (COST, FRICTIONS, HERE, OPTIONS, OTHERS, ambiguity, biaxial, claims, close, coordination, decay,
                     deep_share, exponent, final_height, forces, harmonic, indeterminacy, pooled, power, radjai,
                     run_out, shaebani, solid_fraction, springs_over_rigid, strength, stress, wall_deficit)
from scipy.stats import t as student

STORED, README = os.path.join(HERE, "results.json"), os.path.join(HERE, "README.md")


@dataclass(frozen=True)
class Claim:
    """A figure of a source and the function that measures it on a seed."""
    mark: str  # F: read in full text, a gate; A: from an abstract or a quotation, shown
    says: str
    theirs: str  # with the tolerance; see band()
    ours: Callable[[int], float]
    seeds: int = 3
    quick: bool = False


def band(theirs):
    """Ends of "1.4 +- 0.15", "1.61 +- 5 %", "3 to 4" or "above 0"."""
    words = theirs.split()
    if words[0] == "above":
        return float(words[1]), float("inf")
    if words[1] == "to":
        return float(words[0]), float(words[2])
    value, tolerance = float(words[0]), float(words[2])
    half = abs(value) * tolerance / 100 if words[-1] == "%" else tolerance
    return value - half, value + half


def relaxed(letter, function):
    """function(normal, tangential forces, sample) of a relaxed sample of Radjai et al."""
    def measured(seed):
        sample = radjai(seed, letter)[1]
        return function(*forces(sample)[:2], sample)
    return measured


CLAIMS = {"radjai": {
    **{f"contacts_{letter}": Claim("F", f"contacts / grains, sample {letter}", f"{value} +- 5 %", relaxed(
        letter, lambda n, t, s: len(n) / len(s.radius))) for letter, value in zip("ABCD", (1.61, 1.64, 1.56, 1.46))},
    **{f"friction_{letter}": Claim("F", f"mean T / mean N, sample {letter}", f"{value} +- 10 %", relaxed(
        letter, lambda n, t, s: t.mean() / n.mean())) for letter, value in zip("ABCD", (0.086, 0.085, 0.096, 0.092))},
    "normal_power": Claim("F", "normal forces below their mean: power", "-0.3 +- 0.1",
                          lambda seed: power(pooled(seed)[0])),
    "normal_decay": Claim("F", "normal forces above their mean: rate of decay", "1.4 +- 0.15",
                          lambda seed: decay(pooled(seed)[0])),
    "tangential_power": Claim("F", "tangential forces below their mean: power", "-0.5 +- 0.1",
                              lambda seed: power(pooled(seed)[1])),
    "tangential_decay": Claim("F", "tangential forces above their mean: rate of decay", "1.0 +- 0.15",
                              lambda seed: decay(pooled(seed)[1])),
    "weak": Claim("F", "contacts below the mean force, sample D (\"more than 60 %\")", "0.6 to 0.65", relaxed(
        "D", lambda n, t, s: (n < n.mean()).mean())),
    "uniform": Claim("F", "T/N uniform up to mu: mean of T/(mu N)", "0.5 +- 0.05",
                     lambda seed: pooled(seed)[2].mean()),
    "independent": Claim("F", "T/N independent of N: T/(mu N) of strong / of weak contacts", "1 +- 0.1",
                         lambda seed: (lambda n, _, r: r[n > 1].mean() / r[n < 1].mean())(*pooled(seed))),
    "sliding": Claim("F", "contacts that slide during the shear, sample D (\"up to 50 %\")", "0 to 0.5",
                     lambda seed: forces(radjai(seed, "D")[0])[2].mean()),
}, "cegeo": {
    "isotropic": Claim("F", "z, isotropic, no friction", "4 +- 0.1",
                       lambda seed: coordination(biaxial(seed).snapshots[0])),
    "shear": Claim("F", "z in shear, 5 to 15 % of strain", "3 to 4",
                   lambda seed: numpy.mean([coordination(one) for one in biaxial(seed).snapshots[5:]])),
    "springs": Claim("F", "T/S of springs / of contact dynamics, 0.5 to 4 % of strain (\"robust\")", "1 +- 0.05",
                     springs_over_rigid),
}, "unger": {
    "unique": Claim("F", "ambiguity without friction (theirs: 1e-7)", "0 +- 1e-5", lambda seed: ambiguity(seed, 0.), 4),
    "largest": Claim("F", "log10 of the friction with the largest ambiguity (\"near 0.1\")", "-1 +- 0.5",
                     lambda seed: numpy.log10(max(FRICTIONS[1:], key=lambda mu: ambiguity(seed, mu))), 4),
    "large_friction": Claim("F", "ambiguity at friction 1 / at 0.1 (it falls)", "0 to 1",
                            lambda seed: ambiguity(seed, 1.) / ambiguity(seed, 0.1), 4),
    "degree": Claim("F", "(2 contacts - 3 grains) / contacts, no friction", "0.5 +- 0.02", indeterminacy),
    "practice": Claim("F", "\"practically no indeterminacy\" (Radjai & Richefeu 2009): ambiguity at 0.3", "0 to 0.05",
                      lambda seed: ambiguity(seed, 0.3), 4),
}, "shaebani": {
    "diagonal": Claim("F", "(sxx - syy) / 2P (theirs: 0.009)", "0 +- 0.02",
                      lambda seed: (stress(seed)[0, 0] - stress(seed)[1, 1]) / 2, 5, True),
    "shear": Claim("F", "sxy / P (theirs: -0.0133)", "0 +- 0.02", lambda seed: stress(seed)[0, 1], 5, True),
    "second": Claim("F", "contact directions: second harmonic", "0 +- 0.03", lambda seed: harmonic(seed, 2), 5, True),
    "fourth": Claim("F", "contact directions: fourth harmonic (more along the periods)", "0 to 0.03",
                    lambda seed: harmonic(seed, 4), 5, True),
    **{name: Claim("F", f"change of the solid fraction with {words}", "0 +- 0.005", (
        lambda setting: lambda seed: solid_fraction(shaebani(seed, setting)) - solid_fraction(shaebani(seed)))(setting))
       for name, words, setting in (("pressure", "P = 1e-4", "loading/pressure=1e-4"),
                                    ("step", "half the step", "sample/preparation_step=0.1"))},
}, "packings": {
    **{name: Claim("A", f"close packing without skewness: {mixture}", "0.840 +- 0.005", (
        lambda mixture: lambda seed: close(seed, mixture))(mixture), 3, name == "two")
       for name, mixture in (("two", "two sizes 1:1.4"), ("narrow", "uniform 3:7"), ("wide", "uniform 1:4"))},
    "skewness": Claim("A", "it grows with skewness: log-normal 0.5 - two sizes 1:1.4", "above 0",
                      lambda seed: close(seed, "log-normal 0.5") - close(seed)),
    "lowest": Claim("A", "two sizes are loosest near 1:1.4 in equal numbers: least of others - it", "above 0",
                    lambda seed: min(close(seed, other) for other in OTHERS) - close(seed)),
    "wall": Claim("A", "walls, fraction = bulk - C/H: C at H = 8 d / at 24 d", "1 +- 0.2",
                  lambda seed: wall_deficit(seed, 8) / wall_deficit(seed, 24)),
    "depth": Claim("A", "share of the deficit deeper than two small diameters (decay over about one)", "0 +- 0.14",
                   deep_share),
}, "strength": {
    "limit": Claim("A", "shear / normal stress at I = 1e-4", "0.11 +- 0.005", lambda seed: strength(seed, 1e-4)),
    "line": Claim("A", "the line of plane_shear ends too high: 0.138 - ours", "above 0",
                  lambda seed: 0.138 - strength(seed, 1e-4)),
}, "collapse": {
    "run_out": Claim("A", "run-out / half width / a^(2/3), a = 5", "1.9 +- 0.2",
                     lambda seed: run_out(seed, 5) / 5 ** (2 / 3)),
    "run_out_power": Claim("A", "power of the run-out, a = 3 to 8", "0.667 +- 0.1",
                           lambda seed: exponent(seed, run_out)),
    "height": Claim("A", "final height / half width / a^(2/5), a = 5", "1 +- 0.1",
                    lambda seed: final_height(seed, 5) / 5 ** 0.4),
    "height_power": Claim("A", "power of the final height, a = 3 to 8", "0.4 +- 0.1",
                          lambda seed: exponent(seed, final_height)),
}}


def verdict(values, claim):
    """Two one-sided tests at 5 %: equivalent, if the 90 % interval of the mean lies within the band of the claim;
    different, if it lies outside."""
    mean, error = claims.mean_and_error(values)
    half, (low, high) = student.ppf(0.95, len(values) - 1) * error, band(claim.theirs)
    if low <= mean - half and mean + half <= high:
        return "equivalent"
    return "different" if mean + half < low or mean - half > high else "cannot tell"


def judged(stored):
    """(source, claim, its values, verdict) of every stored figure."""
    return [(source, CLAIMS[source][name], values, verdict(values, CLAIMS[source][name]))
            for source, part in stored.items() for name, values in part["values"].items()]


def table(rows):
    """Table of (claim, values, verdict) in README.md."""
    yield "| | claim | theirs | ours (samples) | verdict |\n|---|---|---|---|---|"
    for claim, values, word in rows:
        mean, error = claims.mean_and_error(values)
        digits = "{:.1e} +- {:.0e}" if abs(mean) < 1e-4 else "{:.4f} +- {:.4f}" if error < 0.003 else "{:.3f} +- {:.3f}"
        ours = f"{digits.format(mean, error)} ({len(values)})"
        yield f"| {claim.mark} | {claim.says} | {claim.theirs} | {ours} | {word} |"


def readme(stored):
    """README.md with the tables of the stored numbers, each between its mark and a blank line."""
    with open(README, encoding="utf-8") as file:
        text = file.read()
    words = [word for *_, word in judged(stored)]
    seconds = {source: part["cpu_s"] for source, part in stored.items()}
    blocks = {"all": textwrap.fill(
        f"{len(words)} figures: "
        + ", ".join(f"{words.count(word)} {word}" for word in ("equivalent", "different", "cannot tell"))
        + f". CPU seconds on one thread: {sum(seconds.values()):.0f} ("
        + ", ".join(f"{source} {s:.0f}" for source, s in seconds.items()) + ").", 118)}
    for source in stored:
        blocks[source] = "\n".join(table([row for of, *row in judged(stored) if of == source]))
    for name, block in blocks.items():
        text = re.sub(rf"(<!-- {name} -->\n).*?(?=\n\n)", lambda mark: mark[1] + block, text, flags=re.DOTALL)
    return text


def measure(source):
    """Numbers, curves and CPU seconds of one source."""
    start = time.process_time() + COST[0]
    values = {}
    for name, claim in CLAIMS[source].items():
        values[name] = [float(f"{claim.ours(seed):.6g}") for seed in range(1, claim.seeds + 1)]
        print(source, name, values[name], verdict(values[name], claim), flush=True)
    curves = figures.CURVES[source]()
    return {"values": values, "curves": curves, "cpu_s": round(time.process_time() + COST[0] - start, 1)}


def quick(stored):
    """Quick claims whose first seed left the scatter of the stored ones (four deviations, at least 1 %)."""
    for source, group in CLAIMS.items():
        for name in [name for name, claim in group.items() if claim.quick]:
            value, before = group[name].ours(1), numpy.array(stored[source]["values"][name])
            outside = abs(value - before[0]) > max(4 * before.std(ddof=1), 0.01 * abs(before.mean()))
            print(f"{source} {name:12}{value:12.4g}, stored {before[0]:12.4g}" + ("   OUTSIDE" if outside else ""))
            if outside:
                yield name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", help="folder of the runs, which are kept and reused; default: a temporary one")
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(CLAIMS), help="sources: radjai,...")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    with open(STORED, encoding="utf-8") as file:
        stored = json.load(file)
    with tempfile.TemporaryDirectory() as scratch:
        OPTIONS.program, OPTIONS.output = options.program, os.path.abspath(options.output or scratch)
        if options.quick:
            with open(README, encoding="utf-8") as file:
                same = file.read() == readme(stored)
            print("README.md has the tables of results.json" if same else "README.md has OTHER TABLES")
            return 1 if [*quick(stored)] or not same else 0
        for source in options.only if options.program else ():
            stored[source] = measure(source)
            with open(STORED, "w", encoding="utf-8") as file:
                file.write("{" + ",\n".join(f'"{name}": {json.dumps(part)}' for name, part in stored.items()) + "}\n")
    text = readme(stored)
    with open(README, "w", encoding="utf-8") as file:
        file.write(text)
    figures.draw(stored)
    silent = [claim.says for _, claim, _, word in judged(stored)
              if word == "different" and f"*{claim.says}*" not in text]
    print("rows that differ without a line in README.md: " + ("; ".join(silent) or "none"))
    return 1 if silent else 0


if __name__ == "__main__":
    sys.exit(main())
