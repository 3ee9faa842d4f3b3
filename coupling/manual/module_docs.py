#!/usr/bin/env python3
# diptych: what a Python package says of itself once it is imported, compiled parts included
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: PYTHONPATH=FOLDER module_docs.py PACKAGE

Prints Markdown: the package's own words, then every public class and function with its signature and words, in the order of __all__
or of the alphabet. What has no words is left out."""
import importlib
import inspect
import sys


def signature(name, thing):
    """As Python knows it; pybind11 puts it into the first line of the words instead."""
    try:
        return name + str(inspect.signature(thing))
    except (TypeError, ValueError):
        return name


def code(text):
    return "    " + inspect.cleandoc(text).replace("\n", "\n    ") + "\n"


def described(name, thing, level):
    """Markdown of a class with its public members, of a function, method or property."""
    words = inspect.getdoc(thing)
    if not words or name.startswith("_"):
        return []
    shown = name if inspect.isclass(thing) or isinstance(thing, property) else signature(name, thing)
    lines = ["#" * level + f" `{shown}`", "", code(words)]
    if inspect.isclass(thing):
        for member, value in vars(thing).items():
            lines += described(member, value, level + 1)
    return lines


def page(package):
    lines = [inspect.getdoc(package) or "", ""]
    for name in getattr(package, "__all__", None) or sorted(vars(package)):
        thing = getattr(package, name)
        if inspect.isclass(thing) or callable(thing):
            lines += described(name, thing, 3)
    return "\n".join(lines)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(page(importlib.import_module(sys.argv[1])))
