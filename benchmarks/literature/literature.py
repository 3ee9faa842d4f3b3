#!/usr/bin/env python3
# diptych: figures of the literature for discs, measured again
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measures every claim on its seeds. --quick: one seed of the claims that take seconds; every row that differs needs
a line in README.md. PYTHONPATH: build/release/python."""
import functools
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass

import figures
import numpy
import samples
import stored
from samples import (FRICTIONS, HERE, OPTIONS, OTHERS, ambiguity, biaxial, claims, close, coordination, decay,
                     deep_share, exponent, final_height, forces, harmonic, pooled, power, radjai, run_out, shaebani,
                     solid_fraction, strength, stress, wall_deficit, weak_share)
from scipy.stats import t as student


@dataclass(frozen=True)
class Claim:
    """A figure of a source and the function that measures it on a seed."""
    says: str
    theirs: str  # with the tolerance; see band()
    ours: Callable[[int], float]
    seeds: int = 3
    quick: bool = False


def band(theirs):
    """Ends of "1.4 +- 0.15", "1.61 +- 5 %", "3 to 4", "above 0" or "below 0"."""
    words = theirs.split()
    if words[0] in ("above", "below"):
        return (float(words[1]), numpy.inf) if words[0] == "above" else (-numpy.inf, float(words[1]))
    if words[1] == "to":
        return float(words[0]), float(words[2])
    value, tolerance = float(words[0]), float(words[2])
    half = abs(value) * tolerance / 100 if words[-1] == "%" else tolerance
    return value - half, value + half


def each(name, says, theirs, function):
    """A claim for every (key, value) of `theirs`, measured by function(seed, key)."""
    return {f"{name}_{key}": Claim(says.format(key), value, lambda seed, key=key: function(seed, key))
            for key, value in theirs.items()}


def contacts_per_grain(seed, letter):
    sample = radjai(seed, letter)
    return len(forces(sample)[0]) / len(sample.radius)


def mean_friction(seed, letter):
    normal, tangential = forces(radjai(seed, letter))[:2]
    return tangential.mean() / normal.mean()


def change_of_fraction(setting):
    return lambda seed: solid_fraction(shaebani(seed, setting)) - solid_fraction(shaebani(seed))


CLAIMS = {"radjai": {
    **each("contacts", "contacts / grains, sample {}",
           {"A": "1.61 +- 5 %", "B": "1.64 +- 5 %", "C": "1.56 +- 5 %", "D": "1.46 +- 5 %"}, contacts_per_grain),
    **each("friction", "mean T / mean N, sample {}",
           {"A": "0.086 +- 10 %", "B": "0.085 +- 10 %", "C": "0.096 +- 10 %", "D": "0.092 +- 10 %"}, mean_friction),
    "normal_power": Claim("N below its mean: power", "-0.3 +- 0.1", lambda seed: power(pooled(seed)[0])),
    "normal_decay": Claim("N above its mean: rate of decay", "1.4 +- 0.15", lambda seed: decay(pooled(seed)[0])),
    "tangential_power": Claim("T below its mean: power", "-0.5 +- 0.1", lambda seed: power(pooled(seed)[1])),
    "tangential_decay": Claim("T above its mean: rate of decay", "1.0 +- 0.15", lambda seed: decay(pooled(seed)[1])),
    "weak": Claim("contacts below the mean force, sample D (\"more than 60 %\")", "0.6 to 0.65",
                  lambda seed: weak_share(seed, "D")),
    "nearly": Claim("the same, sample B (\"nearly 60 %\", Radjai & Richefeu 2009)", "0.55 to 0.6",
                    lambda seed: weak_share(seed, "B")),
    "uniform": Claim("T/N uniform up to mu: mean of T/(mu N)", "0.5 +- 0.05", lambda seed: pooled(seed)[2].mean()),
    "independent": Claim("T/N independent of N: T/(mu N) of strong / of weak contacts", "1 +- 0.1",
                         lambda seed: (lambda n, _, r: r[n > 1].mean() / r[n < 1].mean())(*pooled(seed))),
}, "cegeo": {
    "isotropic": Claim("z, isotropic, no friction", "4 +- 0.1", lambda seed: coordination(biaxial(seed).snapshots[0])),
    "shear": Claim("z in shear, 5 to 15 % of strain", "3 to 4",
                   lambda seed: numpy.mean([coordination(one) for one in biaxial(seed).snapshots[5:]])),
    "springs": Claim("T/S of springs / of contact dynamics, 0.5 to 4 % of strain (\"robust\")", "1 +- 0.05",
                     samples.springs_over_rigid),
}, "unger": {
    "unique": Claim("ambiguity without friction (theirs: 1e-7)", "0 +- 1e-5", lambda seed: ambiguity(seed, 0.)[-1]),
    "largest": Claim("log10 of the friction with the largest ambiguity (\"near 0.1\")", "-1 +- 0.5",
                     lambda seed: numpy.log10(max(FRICTIONS[1:], key=lambda mu: ambiguity(seed, mu)[-1]))),
    "large_friction": Claim("log10 of ambiguity at friction 1 / at 0.1 (it falls)", "below 0",
                            lambda seed: numpy.log10(ambiguity(seed, 1.)[-1] / ambiguity(seed, 0.1)[-1])),
    "degree": Claim("(2 contacts - 3 grains) / contacts, no friction", "0.5 +- 0.02", samples.indeterminacy),
    "practice": Claim("\"practically no indeterminacy\" (Radjai & Richefeu 2009): ambiguity at 0.3", "0 to 0.05",
                      lambda seed: ambiguity(seed, 0.3)[-1]),
}, "shaebani": {
    "diagonal": Claim("(sxx - syy) / 2P (theirs: 0.009)", "0 +- 0.02",
                      lambda seed: (stress(seed)[0, 0] - stress(seed)[1, 1]) / 2, 5, True),
    "shear": Claim("sxy / P (theirs: -0.0133)", "0 +- 0.02", lambda seed: stress(seed)[0, 1], 5, True),
    "second": Claim("contact directions: second harmonic", "0 +- 0.03", lambda seed: harmonic(seed, 2), 5, True),
    "fourth": Claim("contact directions: fourth harmonic (more along the periods)", "0 to 0.03",
                    lambda seed: harmonic(seed, 4), 5, True),
    "pressure": Claim("change of the solid fraction with P = 1e-4", "0 +- 0.005",
                      change_of_fraction("loading/pressure=1e-4")),
    "step": Claim("change of the solid fraction with half the step", "0 +- 0.005",
                  change_of_fraction("sample/preparation_step=0.1")),
}, "packings": {
    "two": Claim("close packing without skewness: two sizes 1:1.4", "0.840 +- 0.005", close, 3, True),
    **each("close", "close packing without skewness: {}", dict.fromkeys(
        ("uniform 3:7", "uniform 1:4", "two sizes 1:3"), "0.840 +- 0.005"), close),
    "skewness": Claim("it grows with skewness (0 to 2.7) at equal spread: two sizes 1:3", "above 0.005",
                      lambda seed: close(seed, "two sizes 1:3, 10 % large") - close(seed, "two sizes 1:3")),
    "lowest": Claim("two sizes are loosest near 1:1.4 in equal numbers: least of others - it", "above 0",
                    lambda seed: min(close(seed, other) for other in OTHERS) - close(seed)),
    "wall": Claim("walls, fraction = bulk - C/H: C at H = 8 d / at 24 d", "1 +- 0.2",
                  lambda seed: wall_deficit(seed, 8) / wall_deficit(seed, 24)),
    "depth": Claim("share of the deficit deeper than two small diameters (decay over about one)", "0 +- 0.14",
                   deep_share),
}, "strength": {
    "limit": Claim("shear / normal stress at I = 1e-4", "0.11 +- 0.005", lambda seed: strength(seed, 1e-4)),
}, "collapse": {
    "run_out": Claim("run-out / half width / a^(2/3), a = 5", "1.9 +- 0.2",
                     lambda seed: run_out(seed, 5) / 5 ** (2 / 3)),
    "run_out_power": Claim("power of the run-out, a = 3 to 8", "0.667 +- 0.1", lambda seed: exponent(seed, run_out)),
    "height": Claim("final height / half width / a^(2/5), a = 5", "1 +- 0.1",
                    lambda seed: final_height(seed, 5) / 5 ** 0.4),
    "height_power": Claim("power of the final height, a = 3 to 8", "0.4 +- 0.1",
                          lambda seed: exponent(seed, final_height)),
}}


def verdict(values, theirs):
    """Two one-sided tests at 5 %: equivalent, if the 90 % interval of the mean lies within the band of the claim;
    different, if it lies outside."""
    mean, error = claims.mean_and_error(values)
    half, (low, high) = student.ppf(0.95, len(values) - 1) * error, band(theirs)
    if low <= mean - half and mean + half <= high:
        return "equivalent"
    return "different" if mean + half < low or mean - half > high else "cannot tell"


def rows(source, part):
    """Rows of README.md: claim, theirs, ours, verdict."""
    for name, claim in CLAIMS[source].items():
        values = part["values"][name]
        mean, error = claims.mean_and_error(values)
        digits = ".1e" if 0 < abs(mean) < 1e-4 else ".4f" if error < 0.003 else ".3f"
        ours = f"{mean:{digits}} +- {error:{digits}} ({len(values)})"
        yield claim.says, claim.theirs, ours, verdict(values, claim.theirs)


def tables(source, part):
    return {source: stored.table("claim | theirs | ours (samples) | verdict", [*rows(source, part)])}


def measure(source, options):
    """Numbers and curves of one source."""
    vars(OPTIONS).update(vars(options))
    values = {name: [claim.ours(seed) for seed in range(1, claim.seeds + 1)] for name, claim in CLAIMS[source].items()}
    return {"values": values,
            "curves": {name: panel.curves() for name, panel in figures.PANELS.items() if panel.source == source}}


def quick(options, parts):
    """Quick claims whose first seed left the scatter of the stored ones (four deviations, at least 1 %), and different
    rows that README.md does not explain."""
    vars(OPTIONS).update(vars(options))
    for source, group in CLAIMS.items():
        for name in [name for name, claim in group.items() if claim.quick]:
            value, before = group[name].ours(1), numpy.array(parts[source]["values"][name])
            if abs(value - before[0]) > max(4 * before.std(ddof=1), 0.01 * abs(before.mean())):
                yield f"{source} {name}: {value:.4g}, stored {before[0]:.4g}"
    with open(os.path.join(HERE, "README.md"), encoding="utf-8") as file:
        text = " ".join(file.read().split())
    yield from (f"README.md has no line on: {row[0]}" for source in parts for row in rows(source, parts[source])
                if row[-1] == "different" and f"*{row[0]}*" not in text)


if __name__ == "__main__":
    sys.exit(stored.main(__doc__, HERE, {source: stored.Part(functools.partial(measure, source), functools.partial(
        tables, source)) for source in CLAIMS}, quick=quick, draw=figures.draw))
