#!/usr/bin/env python3
# diptych: figures of the literature for discs, measured again
# SPDX-License-Identifier: LGPL-2.1-or-later
"""literature.py [PROGRAM [--output DIR] [--only SOURCES]] [--quick]

With PROGRAM, measures every claim on its seeds, keeps the numbers in results.json, and writes the table of README.md
and figure.png from them. Without, it only writes these again. --only measures the claims of these. --quick
measures one seed of the claims that take seconds and changes no file. Exit code 1: with --quick, a number left the
scatter of the stored ones or README.md has another table; otherwise a gate differs without a recorded reason.
PYTHONPATH: build/release/python."""
import argparse
import json
import os
import sys
import tempfile
import textwrap
import time
from collections.abc import Callable
from dataclasses import dataclass

import figures
import numpy
from samples import (HERE, OTHERS, COST, OPTIONS, ambiguity, biaxial, claims, close, coordination, decay, deep_share,
                     exponent, final_height, forces, harmonic, indeterminacy, most_ambiguous, pooled, power, radjai,
                     run_out, shaebani, solid_fraction, springs_over_rigid, strength, stress, wall_deficit)
from scipy.stats import t as student

STORED, README = os.path.join(HERE, "results.json"), os.path.join(HERE, "README.md")
MARKS = "<!-- written by literature.py -->\n", "<!-- end -->\n"

# Title, and the setting: first what differs here.
SOURCES = {
    "radjai": ("Radjai, Jean, Moreau & Roux, PRL 77 (1996) 274", """
        Here the lid has the friction of the base (0.5, theirs 0), because platens share it. The duration of the shear,
        the speed and the first density are ours. As there: contact dynamics, friction 0.2 between grains, 0 at the
        walls, three of the four samples with their sizes, sheared by the base, then relaxed under a lid, no gravity.
        Exponents: largest likelihood over 0.01 to 1 mean force and above 1, samples A, B and D together."""),
    "cegeo": ("CEGEO (Saint-Cyr et al.), EPL 98 (2012) 44008, arXiv 1208.0499", """
        Here the inertial number is 1e-3; theirs is not known to us. 2000 discs, theirs 5000. As there: R from Rmin to
        3 Rmin, uniform by volume, friction 0.5, smooth walls, constant lateral stress. Springs: 1000 of these discs,
        kn/P = 2000, the same samples. z counts grains that carry a force, beyond 2 d from the walls."""),
    "unger": ("Unger, Kertesz & Wolf, PRL 94 (2005) 178001", """
        Here two smooth-faced platens with the friction of the grains bound the packing; theirs is a slice of a larger
        one. As there: about 200 discs, radii uniform in R to 2R, period 42 R, prepared with the friction. Five
        solutions from random forces; ambiguity: rms scatter of the force of a contact over the mean force. A solution
        ends at a residual of 1e-10, or after 10000 sweeps with friction and 300000 without."""),
    "shaebani": ("Shaebani, Unger & Kertesz, IJMPC 20 (2009) 847, arXiv 0803.3566", """
        Here all three components of the cell are free, so that its stress is isotropic. As there: 1000 discs, radii
        uniform in 0.8 to 1.2, friction 0.5, P = 1, periodic in both directions, from a dilute state, five samples."""),
    "packings": ("Packings: arXiv 2404.02316 (close packing), 0903.0864 (walls), 1602.01685 (two sizes)", """
        Here discs are compressed under a pressure from solid fraction 0.5; theirs swell at constant volume.
        Frictionless cells of 1000 discs; slabs between smooth platens, 40 d wide. Their abstracts were read, not their
        tables."""),
    "strength": ("Clark, Thompson, Shattuck, Ouellette & O'Hern, arXiv 1706.09465", """
        Here the speed is given and the stress fluctuates; there the stress is given, and the limit is that above which
        no packing holds. 400 discs of benchmarks/plane_shear without friction; steps as for `accuracy` 0.05."""),
    "collapse": ("Lube, Huppert, Sparks & Freundt, PRE 72 (2005) 041301, as quoted by others", """
        Here discs in two dimensions; there sand in a channel, and the figures are quoted at second hand. Columns 14 d
        wide with two free sides, friction 0.5, no restitution. Grains do not roll on the base, but on each other. The
        front is the last place that a layer of one d covers."""),
}


@dataclass(frozen=True)
class Claim:
    """A figure of a source and the function that measures it on a seed. The key of a claim begins with its source."""
    mark: str  # F: read in full text, a gate; A: from an abstract or a quotation, shown
    says: str
    theirs: str  # with the tolerance that was chosen before the measurement; see band()
    ours: Callable[[int], float]
    seeds: int = 3
    quick: bool = False
    differs: str = ""  # the reason, of a row that differs


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


CLAIMS = {
    **{f"radjai.contacts_{letter}": Claim("F", f"contacts / grains, sample {letter}", f"{value} +- 5 %", relaxed(
        letter, lambda n, t, s: len(n) / len(s.radius))) for letter, value in zip("ABD", (1.61, 1.64, 1.46))},
    **{f"radjai.friction_{letter}": Claim("F", f"mean T / mean N, sample {letter}", f"{value} +- 10 %", relaxed(
        letter, lambda n, t, s: t.mean() / n.mean())) for letter, value in zip("ABD", (0.086, 0.085, 0.092))},
    "radjai.normal_power": Claim(
        "F", "normal forces below their mean: power", "-0.3 +- 0.1", lambda seed: power(pooled(seed)[0])),
    "radjai.normal_decay": Claim(
        "F", "normal forces above their mean: rate of decay", "1.4 +- 0.15", lambda seed: decay(pooled(seed)[0])),
    "radjai.tangential_power": Claim(
        "F", "tangential forces below their mean: power", "-0.5 +- 0.1", lambda seed: power(pooled(seed)[1])),
    "radjai.tangential_decay": Claim(
        "F", "tangential forces above their mean: rate of decay", "1.0 +- 0.15", lambda seed: decay(pooled(seed)[1])),
    "radjai.weak": Claim("F", "contacts below the mean force, sample D (\"more than 60 %\")", "0.6 to 0.65", relaxed(
        "D", lambda n, t, s: (n < n.mean()).mean())),
    "radjai.uniform": Claim(
        "F", "T/N uniform up to mu: mean of T/(mu N)", "0.5 +- 0.05", lambda seed: pooled(seed)[2].mean()),
    "radjai.independent": Claim(
        "F", "T/N independent of N: T/(mu N) of strong / of weak contacts", "1 +- 0.1",
        lambda seed: (lambda n, _, r: r[n > 1].mean() / r[n < 1].mean())(*pooled(seed)),
        differs="reason not known. Strong contacts are less mobilised on every seed."),
    "radjai.sliding": Claim("F", "contacts that slide during the shear, sample D (\"up to 50 %\")", "0 to 0.5",
                            lambda seed: forces(radjai(seed, "D")[0])[2].mean()),
    "cegeo.isotropic": Claim(
        "F", "z, isotropic, no friction", "4 +- 0.1", lambda seed: coordination(biaxial(seed).snapshots[0])),
    "cegeo.shear": Claim("F", "z in shear, 5 to 15 % of strain", "3 to 4", lambda seed: numpy.mean(
        [coordination(one) for one in biaxial(seed).snapshots[5:]])),
    "cegeo.springs": Claim("F", "strength of springs / contact dynamics (\"robust\")", "1 +- 0.05", springs_over_rigid),
    "unger.unique": Claim(
        "F", "ambiguity without friction (theirs: 1e-7)", "0 +- 1e-5", lambda seed: ambiguity(seed, 0.), 4,
        differs="in two of four packings some solutions do not reach a residual of 1e-10 within 300000 sweeps. Their "
        "forces still differ. The other two packings give 4e-8 and 3e-7."),
    "unger.largest": Claim(
        "F", "log10 of the friction with the largest ambiguity (\"near 0.1\")", "-1 +- 0.5", most_ambiguous, 4,
        differs="reason not known. Our starts have T anywhere up to mu N, so they spread more at large friction. We do "
        "not know the starts of the source."),
    "unger.large_friction": Claim("F", "ambiguity at friction 1 / at 0.1 (it falls)", "0 to 1",
                                  lambda seed: ambiguity(seed, 1.) / ambiguity(seed, 0.1), 4,
                                  differs="as in the row above."),
    "unger.degree": Claim("F", "(2 contacts - 3 grains) / contacts, no friction", "0.5 +- 0.02", indeterminacy),
    "unger.practice": Claim(
        "F", "\"practically no indeterminacy\" (Radjai & Richefeu 2009): ambiguity at 0.3", "0 to 0.05",
        lambda seed: ambiguity(seed, 0.3), 4,
        differs="the two sources contradict each other; ours sides with Unger et al."),
    "shaebani.diagonal": Claim("F", "(sxx - syy) / 2P (theirs: 0.009)", "0 +- 0.02",
                               lambda seed: (stress(seed)[0, 0] - stress(seed)[1, 1]) / 2, 5, True),
    "shaebani.shear": Claim(
        "F", "sxy / P (theirs: -0.0133)", "0 +- 0.02", lambda seed: stress(seed)[0, 1], 5, True),
    "shaebani.second": Claim(
        "F", "contact directions: second harmonic", "0 +- 0.03", lambda seed: harmonic(seed, 2), 5, True),
    "shaebani.fourth": Claim("F", "contact directions: fourth harmonic (more along the periods)", "0 to 0.03",
                             lambda seed: harmonic(seed, 4), 5, True),
    **{f"shaebani.{name}": Claim("F", f"change of the solid fraction with {words}", "0 +- 0.005", (
        lambda setting: lambda seed: solid_fraction(shaebani(seed, setting)) - solid_fraction(shaebani(seed)))(setting))
       for name, words, setting in (("pressure", "P = 1e-4", "loading/pressure=1e-4"),
                                    ("step", "half the step", "sample/preparation_step=0.1"))},
    **{f"packings.{name}": Claim("A", f"close packing without skewness: {mixture}", "0.840 +- 0.005", (
        lambda mixture: lambda seed: close(seed, mixture))(mixture), 3, name == "two")
       for name, mixture in (("two", "two sizes 1:1.4"), ("narrow", "uniform 3:7"), ("wide", "uniform 1:4"))},
    "packings.skewness": Claim("A", "it grows with skewness: log-normal 0.5 - two sizes 1:1.4", "above 0",
                               lambda seed: close(seed, "log-normal 0.5") - close(seed)),
    "packings.lowest": Claim("A", "two sizes are loosest near 1:1.4 in equal numbers: least of others - it", "above 0",
                             lambda seed: min(close(seed, other) for other in OTHERS) - close(seed)),
    "packings.wall": Claim("A", "walls, fraction = bulk - C/H: C at H = 8 d / at 24 d", "1 +- 0.2",
                           lambda seed: wall_deficit(seed, 8) / wall_deficit(seed, 24)),
    "packings.depth": Claim(
        "A", "share of the deficit deeper than two small diameters (decay over about one)", "0 +- 0.14", deep_share),
    "strength.limit": Claim(
        "A", "shear / normal stress at I = 1e-4", "0.11 +- 0.005", lambda seed: strength(seed, 1e-4, 0.6), 2),
    "strength.line": Claim("A", "the line of plane_shear ends too high: 0.138 - ours", "above 0",
                           lambda seed: 0.138 - strength(seed, 1e-4, 0.6), 2),
    "collapse.run_out": Claim("A", "run-out / half width / a^(2/3), a = 5", "1.9 +- 0.2",
                              lambda seed: run_out(seed, 5) / 5 ** (2 / 3), 2),
    "collapse.run_out_power": Claim(
        "A", "power of the run-out, a = 3 to 8", "0.667 +- 0.1", lambda seed: exponent(seed, run_out), 2),
    "collapse.height": Claim("A", "final height / half width / a^(2/5), a = 5", "1 +- 0.1",
                             lambda seed: final_height(seed, 5) / 5 ** 0.4, 2),
    "collapse.height_power": Claim(
        "A", "power of the final height, a = 3 to 8", "0.4 +- 0.1", lambda seed: exponent(seed, final_height), 2),
}


def verdict(values, claim):
    """Two one-sided tests at 5 %: equivalent, if the 90 % interval of the mean lies within the band of the claim;
    different, if it lies outside."""
    mean, error = claims.mean_and_error(values)
    half, (low, high) = student.ppf(0.95, len(values) - 1) * error, band(claim.theirs)
    if low <= mean - half and mean + half <= high:
        return "equivalent"
    return "different" if mean + half < low or mean - half > high else "cannot tell"


def of(source, stored):
    """{key: claim} of a source that have stored values."""
    return {name: claim for name, claim in CLAIMS.items() if name.startswith(source + ".") and name in stored["values"]}


def section(source, stored):
    """Lines of README.md: setting, table and reasons of a source."""
    title, setting = SOURCES[source]
    yield f"### {title}\n\n" + textwrap.fill(" ".join(setting.split()), 118)
    yield "\n| | claim | theirs | ours (samples) | verdict |\n|---|---|---|---|---|"
    reasons = []
    for name, claim in of(source, stored).items():
        values = stored["values"][name]
        mean, error = claims.mean_and_error(values)
        digits = "{:.1e} +- {:.0e}" if abs(mean) < 1e-4 else "{:.4f} +- {:.4f}" if error < 0.003 else "{:.3f} +- {:.3f}"
        judged = verdict(values, claim)
        yield (f"| {claim.mark} | {claim.says} | {claim.theirs} | {digits.format(mean, error)} ({len(values)}) "
               f"| {judged} |")
        if judged == "different" or claim.differs:
            reasons.append(textwrap.fill(f"- *{claim.says}*: {claim.differs or 'reason not known.'}", 118,
                                         subsequent_indent="  ") + "\n")
    yield "\n" + "".join(reasons) + "\n" * bool(reasons) + f"CPU time: {stored['cpu_s'][source]:.0f} s.\n"


def readme(stored):
    """README.md with the tables of the stored numbers."""
    with open(README, encoding="utf-8") as file:
        before, rest = file.read().split(MARKS[0])
    judged = [verdict(stored["values"][name], claim) for source in stored["cpu_s"] for name, claim in
              of(source, stored).items()]
    counts = ", ".join(f"{judged.count(word)} {word}" for word in ("equivalent", "different", "cannot tell"))
    total = (f"{len(judged)} of {len(CLAIMS)} figures measured: {counts}. "
             f"CPU time: {sum(stored['cpu_s'].values()):.0f} s on one thread.\n\n")
    tables = "\n".join(line for source in stored["cpu_s"] for line in section(source, stored))
    return before + MARKS[0] + total + tables + MARKS[1] + rest.split(MARKS[1])[1]


def measure(stored, source):
    """Measures the claims and the curves of one source and stores them."""
    start = time.process_time() + COST[0]
    for name, claim in CLAIMS.items():
        if name.startswith(source + "."):
            stored["values"][name] = [float(f"{claim.ours(seed):.6g}") for seed in range(1, claim.seeds + 1)]
            print(name, stored["values"][name], verdict(stored["values"][name], claim), flush=True)
    stored["curves"][source] = figures.CURVES[source]()
    stored["cpu_s"][source] = round(time.process_time() + COST[0] - start, 1)
    stored["cpu_s"] = {key: stored["cpu_s"][key] for key in SOURCES if key in stored["cpu_s"]}
    parts = (f'"{key}": {{\n' + ",\n".join(f"{json.dumps(name)}: {json.dumps(value)}" for name, value in part.items())
             + "}" for key, part in stored.items())
    with open(STORED, "w", encoding="utf-8") as file:
        file.write("{" + ",\n".join(parts) + "}\n")


def quick(stored):
    """Quick claims whose first seed left the scatter of the stored ones (four deviations, at least 1 %)."""
    for name, claim in CLAIMS.items():
        if claim.quick:
            value, before = claim.ours(1), numpy.array(stored["values"][name])
            outside = abs(value - before[0]) > max(4 * before.std(ddof=1), 0.01 * abs(before.mean()))
            print(f"{name:20}{value:12.4g}, stored {before[0]:12.4g}" + ("   OUTSIDE" if outside else ""))
            if outside:
                yield name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", help="folder of the runs, which are kept and reused; default: a temporary one")
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(SOURCES), help="sources: radjai,...")
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
            measure(stored, source)
    text = readme(stored)
    with open(README, "w", encoding="utf-8") as file:
        file.write(text)
    figures.draw(stored["curves"])
    gates = [name for source in SOURCES for name, claim in of(source, stored).items() if claim.mark == "F"
             and not claim.differs and verdict(stored["values"][name], claim) == "different"]
    print("gates that differ without a recorded reason: " + (", ".join(gates) or "none"))
    return 1 if gates else 0


if __name__ == "__main__":
    sys.exit(main())
