# diptych: the keys of a scene with their ranges, from what the program explains; pairwise combinations
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing is listed twice: `diptych explain` tells the ranges and the words that a key takes."""

import dataclasses
import functools
import itertools
import random
import re

import bases
from running import setting


@dataclasses.dataclass(frozen=True)
class Key:
    name: str  # section/key
    default: str
    what: str  # a number, a whole number, a list of numbers, one of, true or false, text
    low: str = ""
    high: str = ""
    words: tuple = ()


def parsed(name, default, allowed):
    limits = re.search(r"(a whole number|a number|a list of numbers) from (\S+) to (\S+)", allowed)
    if limits:
        words = ("auto",) if allowed.startswith("auto or") else ()
        return Key(name, default, limits[1], limits[2], limits[3], words)
    if allowed.startswith("one of "):
        return Key(name, default, "one of", words=tuple(allowed[7:].split(", ")))
    if allowed == "true or false":
        return Key(name, default, "one of", words=("true", "false"))
    return Key(name, default, "text")


@functools.lru_cache(maxsize=None)
def all_keys():
    found, section = [], ""
    for line in bases.told("explain").splitlines():
        if re.match(r"[a-z]\w*$", line):
            section = line
        key = re.match(r"  (\w+) = (.*?)  \[.*?\]  (.*)$", line)
        if key:
            found.append(parsed(f"{section}/{key[1]}", key[2], key[3]))
    if len(found) < 100:
        raise RuntimeError(f"`diptych explain` tells only {len(found)} keys in a form that is understood")
    return tuple(found)


def names():
    return tuple(key.name for key in all_keys())


def next_outside(key):
    """The nearest values that a key must refuse."""
    low, high = float(key.low), float(key.high)
    if key.what == "a whole number":
        return [str(int(low) - 1), str(int(high) + 1), repr(low + 0.5)]

    def beyond(value, sign):
        return repr(value + sign * abs(value) * 1e-6) if value else repr(sign * 1e-9)
    return [beyond(low, -1), beyond(high, 1)]


def next_inside(key):
    low, high = float(key.low), float(key.high)
    if key.what == "a whole number":
        return [str(int(low)), str(int(low) + 1), str(int(high)), str(int(high) - 1)]
    between = (low * high) ** 0.5 if low > 0 else (low + high) / 2
    return [key.low, repr(low + abs(low) * 1e-6 if low else 1e-9), key.high, repr(high - abs(high) * 1e-6), repr(between)]


WRONG = ("nan", "inf", "-inf", "1e400", "word", "1 2", "1,2,x")
ODD = ("-0", "0x10", "", "1e-320", "+1", "1.", "auto", "true", "0", "ä", "a b # c", "x\\")


@functools.lru_cache(maxsize=None)
def all_values():
    """(key, value, whether it must be refused, words before it) of every key, in one order that does not change. Lower bounds come with the step
    of the small scenes, and with the one that the program chooses: what has no end with the one may end with the other."""
    found = []
    for key in all_keys():
        if key.low:
            found += [(key, value, False) for value in next_inside(key)]
            found += [(key, value, True) for value in [*next_outside(key), *WRONG] if key.what != "a list of numbers" or value != "1 2"]
        elif key.words:
            found += [(key, word, False) for word in key.words]
            found += [(key, value, True) for value in ("word", key.words[0].upper(), key.words[0] + "x", "nan", "")]
        found += [(key, value, False) for value in ODD]
    found = [(*one, ()) for one in found]
    bounds = [(key, next_inside(key)[:2]) for key in all_keys() if key.low and key.name != "discrete/step"]
    found += [(key, value, False, tuple(setting(discrete_step="auto"))) for key, values in bounds for value in values]
    random.Random("keys").shuffle(found)
    return tuple(found)


def pairs_of(factors):
    """Every pair of settings of two factors: ((factor, value), (factor, value))."""
    return {((a, x), (b, y)) for a, b in itertools.combinations(sorted(factors), 2) for x in factors[a] for y in factors[b]}


def greedy_row(factors, left, dice):
    """Begins with a pair that is left; each further factor takes the value that covers most pairs with those before it."""
    row = dict(dice.choice(sorted(left)))
    rest = [name for name in sorted(factors) if name not in row]
    dice.shuffle(rest)
    for name in rest:
        def gain(value):
            return sum(tuple(sorted([(name, value), other])) in left for other in row.items())
        values = list(factors[name])
        dice.shuffle(values)
        row[name] = max(values, key=gain)
    return row


def covering_rows(factors, dice):
    """Rows of settings in which every pair stands at least once."""
    left, rows = pairs_of(factors), []
    while left:
        row = greedy_row(factors, left, dice)
        left -= {pair for pair in left if all(row[name] == value for name, value in pair)}
        rows.append(row)
    return rows
