# diptych: every two choices of the scene's keys together, as far as they run
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A set of seeds begins with rows in which every pair of choices stands; a row that is refused is mended by its message. Then come bundles, few
pairs each, and what their mending loses is tried by itself. A pair is covered by a run that ended with 0 or 3; one that is refused by itself,
whatever else the refusal names, is a contradiction. All of it follows from the seed, so no case waits for what another one found."""

import functools
import os
import random
import re
import shutil

import bases
import keys
from bases import BOTH, NODES, RECTANGLE, TINY
from running import QUICK, setting

SET = 364  # seeds after which everything begins again with other rows: fewer than 10000 cases give this kind
ROWS = 64  # of these for rows: more than there ever are
BUNDLE = 8  # pairs that are tried together
MENDS = 10  # runs in which a row is mended
TRIES = 6  # runs of a pair by itself

SHORT = setting(loading_axial_strain=0.002, loading_stage_strain=0.001, comparison_window_edges="0,0.002")
FIXED = bases.without("continuum/mesh", RECTANGLE)
COMMANDS = {"discrete": TINY + SHORT, "continuum": NODES + SHORT, "run": BOTH + SHORT, "material-point": TINY + SHORT}
TIMES = setting(loading_mode="time", loading_duration=1, loading_stage_time=0.5, comparison_window_edges="0,1")
TABLE = setting(continuum_hardening="table", continuum_table_strain="0,0.1", continuum_table_friction_angle="30,20",
                continuum_table_dilatancy_angle="10,0", continuum_table_cohesion="0.01,0.01")


@functools.lru_cache(maxsize=None)
def factors():
    found = {key.name: key.words for key in keys.all_keys() if key.what == "one of" and key.name != "output/report"}
    return {**found, "continuum/mesh": ("outline", "rectangle"), "command": tuple(COMMANDS)}


@functools.lru_cache(maxsize=8)
def rows_of(number):
    rows = keys.covering_rows(factors(), random.Random(f"rows:{number}"))
    if len(rows) > ROWS:
        raise RuntimeError(f"{len(rows)} rows; the seeds of a set reach for {ROWS}")
    return rows


def command_for(pair):
    """The command that reads both keys, and no more than it must."""
    sections = {name.split("/")[0] for name in dict(pair)}
    return "run" if "comparison" in sections else "continuum" if "continuum" in sections else "discrete"


@functools.lru_cache(maxsize=1)
def bundles():
    """All pairs in the same order for all seeds, in rows of BUNDLE that do not clash, of one command each."""
    dice, waiting, done = random.Random("bundles"), {}, []
    pairs = sorted(keys.pairs_of(factors()))
    dice.shuffle(pairs)
    for pair in pairs:
        command = dict(pair).get("command", command_for(pair))
        open_ones = waiting.setdefault(command, [])
        fitting = (one for one in open_ones if all(one[0].get(name, value) == value for name, value in pair))
        row, members = bundle = next(fitting, None) or ({"command": command}, [])
        row.update(pair)
        members.append(pair)
        if len(members) == 1:
            open_ones.append(bundle)
        elif len(members) == BUNDLE:
            open_ones.remove(bundle)
            done.append(bundle)
    done += [bundle for command in sorted(waiting) for bundle in waiting[command]]
    if len(done) > SET - ROWS:
        raise RuntimeError(f"{len(done)} bundles; the seeds of a set reach for {SET - ROWS}")
    return done


def imported(folder):
    """Grains of another code (a sample 0.05 high), and the loading that they went through."""
    with open(os.path.join(folder, "scene.prm"), encoding="utf-8") as file:
        said = dict(re.findall(r"set (\w+) += (.*)", file.read()))
    return setting(discrete_file=os.path.join(folder, "discrete.h5"), loading_axial_strain=said["axial_strain"], loading_stages=said["stages"],
                   comparison_window_edges=said["window_edges"], continuum_element_size=0.01,
                   continuum_rectangle_width=0.04, continuum_rectangle_height=0.05)


def needs(case):
    """By choice: numbers and files without which it means nothing."""
    grains = case.base("grains")
    return {
        ("loading/mode", "time"): TIMES + ["--set", "discrete/drive_upper_y=velocity " + os.path.join(grains, "speed.csv")], ("continuum/hardening", "table"): TABLE,
        ("continuum/hardening", "critical_state"): setting(continuum_solid_fraction_start=0.82),
        ("discrete/method", "imported"): imported(os.path.join(case.base("imported"), "out")),
        ("sample/prepare_file", "true"): setting(sample_file=os.path.join(grains, "grains.csv")),
        ("sample/radius_distribution", "table"): setting(sample_radius_table=os.path.join(grains, "radii.csv"), sample_radius_min=0.3,
                                                         sample_radius_max=0.7),
    }


def tried(case, row):
    """(whether it ran, what a refusal says) of a row; the pairs of one that ran are covered."""
    out = case.path("out")
    shutil.rmtree(out, ignore_errors=True)
    choices = [word for name, value in sorted(row.items()) if name != "command" for word in ("--set", f"{name}={value}")]
    command, needed = row["command"], {choice: words for choice, words in needs(case).items() if choice in row.items()}
    outcome = case.run(command, QUICK, *COMMANDS[command], *FIXED, *choices, *sum(needed.values(), []), "--output", out, "--quiet", output=out,
                       names=keys.names(), patience=2)
    ran = outcome.code in (0, 3) or bool(outcome.sent)
    if ran:
        case.found["covered"] |= {(one, other) for one in row.items() for other in row.items() if one[0] < other[0]}
    refusal = "\n".join(line for line in outcome.errors.splitlines() if "warning:" not in line) if outcome.code == 2 else ""
    for (name, _), words in needed.items():  # a key that a choice needs speaks for it
        for key in re.findall(r"[a-z]+/\w+(?==)", " ".join(words)):
            refusal = re.sub(rf"\b{key}\b", name, refusal)
    return ran, refusal


def named(refusal):
    """Keys of choices in a refusal, in the order named."""
    return [name for name in dict.fromkeys(re.findall(r"\b[a-z]+/\w+", refusal)) if name in factors()]


def mended(case, row):
    """Tries a row; what a refusal names goes back to its default, one after the other; what is at its default becomes what the refusal demands."""
    row, known = dict(row), set()
    for _ in range(MENDS):
        ran, refusal = tried(case, row)
        if ran:
            return
        set_ones = [name for name in named(refusal) if name in row and (name, row[name]) not in known]
        if set_ones:
            del row[set_ones[0]]
            continue
        choice = demanded(refusal, row, (), known)
        if choice is None:
            return
        known.add(choice)
        row[choice[0]] = choice[1]


def demanded(refusal, row, pair, known):
    """A choice of what the refusal names beside the pair that was not tried: a word that it says, before others."""
    found = []
    for name in named(refusal):
        found += sorted(((name, word) for word in factors()[name]), key=lambda choice: not re.search(rf"\b{choice[1]}\b", refusal))
    found += [("command", word) for word in re.findall(r"`diptych ([\w-]+)", refusal) if word in COMMANDS]
    return next((one for one in found if one[0] not in dict(pair) and one not in known and row.get(one[0]) != one[1]), None)


def alone(case, pair):
    """The two keys set, all others default but for what refusals demand."""
    row, known = {"command": command_for(pair), **dict(pair)}, set()
    for _ in range(TRIES):
        ran, refusal = tried(case, row)
        if ran or not refusal:
            return
        choice = demanded(refusal, row, pair, known)
        if choice is None:
            case.found["contradicting"].add(pair)
            return
        known.add(choice)
        row[choice[0]] = choice[1]


def pairs(case):
    number, place = divmod(case.seed, SET)
    if place < ROWS:
        rows = rows_of(number)
        mended(case, rows[place % len(rows)])
        return
    row, members = bundles()[(place - ROWS) % len(bundles())]
    mended(case, row)
    for pair in members:
        if pair not in case.found["covered"] and not case.violations:
            alone(case, pair)


def told(found):
    """How far the cases of this kind came, as a line below the table."""
    every = keys.pairs_of(factors())
    covered = found["covered"] & every
    contradicting = (found["contradicting"] & every) - covered
    return (f"pairs: {len(every)} of two choices; {len(covered)} covered by a run that ended with 0 or 3, {len(contradicting)} refused by themselves, "
            f"{len(every) - len(covered) - len(contradicting)} left")


KINDS = {"pairs": pairs}
