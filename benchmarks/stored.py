# diptych: benchmarks that keep their numbers, and write the tables of README.md and the figures from them
# SPDX-License-Identifier: LGPL-2.1-or-later
import argparse
import json
import os
import re
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass

import claims
import numpy


@dataclass(frozen=True)
class Part:
    measure: Callable[[argparse.Namespace], dict]  # numbers: nested dicts, lists, arrays
    tables: Callable[[dict], dict]  # {mark in README.md: text} from the stored numbers
    wrong: Callable[[dict], list] = lambda found: []  # sentences about measured numbers outside their interval


def rounded(found):
    """The numbers with five digits, for JSON; NaN is None."""
    if isinstance(found, dict):
        return {key: rounded(one) for key, one in found.items()}
    if isinstance(found, (list, tuple, numpy.ndarray)):
        return [rounded(one) for one in found]
    if isinstance(found, (float, numpy.floating)):
        return None if numpy.isnan(found) else float(f"{found:.5g}")
    return found


def table(head, rows):
    """Markdown table of the head "a | b" and rows of words and texts."""
    lines = [head, "|".join(["---"] * (head.count("|") + 1)), *(" | ".join(map(str, row)) for row in rows)]
    return "\n".join("|" + line + "|" if line.startswith("---") else f"| {line} |" for line in lines)


def has_tables(path, texts, write):
    """Whether a README.md has these texts {mark: text}, each between `<!-- mark -->` and an empty line. `write`: gives
    it them."""
    with open(path, encoding="utf-8") as file:
        before = after = file.read()
    for name, text in texts.items():
        after = re.sub(rf"(<!-- {name} -->\n).*?(?=\n\n)", lambda mark: mark[1] + text, after, flags=re.DOTALL)
    if write:
        with open(path, "w", encoding="utf-8") as file:
            file.write(after)
    return before == after


def parsed(doc, parts, arguments, settings):
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    for word in arguments:
        parser.add_argument(word, type=os.path.abspath)
    parser.add_argument("--only", nargs="*", choices=parts, default=[*parts], metavar="PART",
                        help=f"measure these parts of {', '.join(parts)}; without words only write and draw again")
    parser.add_argument("--output", type=os.path.abspath,
                        help="folder of the runs, which are kept and reused; default: a temporary one")
    parser.add_argument("--quick", action="store_true", help="measure a little and compare; write nothing")
    return parser.parse_args(namespace=argparse.Namespace(set=[], reuse=True, **settings))


def main(doc, folder, parts, *, quick, draw, arguments=("program",), **settings):
    """Entry point. results.json holds {part: numbers and cpu_s}. quick(options, stored) returns sentences about what is
    wrong, draw(stored) draws the figures. `settings` are added to the options. Returns the exit code: 1 if something is
    wrong."""
    options, path = parsed(doc, parts, arguments, settings), os.path.join(folder, "results.json")
    with open(path, encoding="utf-8") as file:
        stored = json.load(file)
    with tempfile.TemporaryDirectory() as scratch:
        options.output = options.output or scratch
        os.makedirs(options.output, exist_ok=True)
        try:
            wrong = [*quick(options, stored)] if options.quick else []
            for name in options.only if not options.quick else ():
                begin, found = sum(os.times()[:4]), parts[name].measure(options)
                wrong += parts[name].wrong(found)
                stored[name] = {**rounded(found), "cpu_s": round(sum(os.times()[:4]) - begin)}
                with open(path, "w", encoding="utf-8") as file:
                    file.write("{" + ",\n".join(f'"{key}": {json.dumps(stored[key])}' for key in stored) + "}\n")
        except claims.RunFailed as failure:
            sys.exit(f"{os.path.basename(sys.argv[0])}: {failure}")
    cost = {name: part["cpu_s"] for name, part in stored.items()}
    texts = {"cost": f"CPU seconds on one thread: {sum(cost.values())} ("
             + ", ".join(f"{name} {seconds}" for name, seconds in cost.items()) + ")."}
    for name in stored:
        texts |= parts[name].tables(stored[name])
    if not has_tables(os.path.join(folder, "README.md"), texts, write=not options.quick) and options.quick:
        wrong.append("README.md has other tables than results.json")
    if not options.quick:
        draw(stored)
    print("\n".join(wrong) or "nothing wrong")
    return 1 if wrong else 0
