# diptych: the Python sources: length of lines and functions, arguments, order of rooms, records by name
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers are those that CONTRIBUTING.md states."""

import ast
import glob
import os
import tempfile
import unittest

from house_test import allowed, FOLDERS
from running import content, SOURCE, write

PACKAGE = os.path.join(SOURCE, "coupling", "python", "diptych")

# The rooms of the package from the ground up: a folder or a module. A room imports itself and those before it.
ROOMS = ("errors", "words", "files", "entries", "compiled", "scenes", "plotting", "arrays", "sheets", "operators",
         "laws", "panels", "problems", "summaries", "results", "averaging_width", "homogenisation", "shipped",
         "measurement", "levelling", "thickness", "importers", "importers/fields", "report/data", "report/charts",
         "report/tables", "report/page", "report", "campaigns/runs", "campaigns/measured", "campaigns/studies",
         "campaigns/ensembles", "campaigns/calibration", "campaigns/plans", "campaigns/exchange", "campaigns/element",
         "campaigns", "")


def sources(root=SOURCE, folders=FOLDERS):
    return sorted(path for top in folders for path in glob.glob(os.path.join(root, top, "**", "*.py"), recursive=True))


def functions(text):
    """(name, lines of the body, arguments that may be given by position) of every function."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef):
            names = [one.arg for one in node.args.posonlyargs + node.args.args if one.arg not in ("self", "cls")]
            yield node.name, node.end_lineno - node.lineno, len(names)


def room_of(module):
    """campaigns/runs of campaigns/runs/engine.py, arrays of arrays.py, "" of __init__.py and __main__.py."""
    folder, name = os.path.split(module)
    return folder or ("" if name.startswith("__") else name.removesuffix(".py"))


def imports(root, path):
    """The modules of the package that a module imports outside of type checks, as paths below the package."""
    here = [part for part in os.path.relpath(os.path.dirname(path), root).split(os.sep) if part != "."]
    tree = ast.parse(content(path).decode())
    typing_only = {child for node in ast.walk(tree) if isinstance(node, ast.If)
                   and "TYPE_CHECKING" in ast.dump(node.test)
                   for child in ast.walk(node)}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level and node not in typing_only:
            base = here[:len(here) - node.level + 1]
            named = [base + node.module.split(".")] if node.module else [base + [alias.name] for alias in node.names]
            for parts in named:
                for place in (os.path.join(*parts) + ".py", os.path.join(*parts, "__init__.py")):
                    if os.path.exists(os.path.join(root, place)):
                        yield place


def wrong_arrows(root, rooms=ROOMS):
    """Imports that run upward, and rooms that the order does not know."""
    found = []
    for path in sources(root, ("",)):
        module = os.path.relpath(path, root)
        for target in imports(root, path):
            here, there = room_of(module), room_of(target)
            if here not in rooms or there not in rooms or rooms.index(there) > rooms.index(here):
                found.append(f"{module} imports {target}")
    return found


def records_by_position(text):
    """Data classes of which more than three fields may be given by position."""
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.ClassDef):
            continue
        marks = [ast.dump(mark) for mark in node.decorator_list if "dataclass" in ast.dump(mark)]
        fields = [ast.unparse(part.annotation) for part in node.body if isinstance(part, ast.AnnAssign)]
        if marks and len(fields) > 3 and "kw_only" not in marks[0] and "KW_ONLY" not in fields[:4]:
            yield node.name


class PythonHouse(unittest.TestCase):
    def judge(self, finds, paths, broken):
        """finds(text): violations. There are none in the paths, and one in the text `broken`."""
        self.assertGreater(len(paths), 100)
        found = {os.path.relpath(path, SOURCE): list(finds(content(path).decode())) for path in paths}
        self.assertEqual({path: names for path, names in found.items() if names}, {})
        self.assertEqual(len(list(finds(broken))), 1)

    def test_no_line_is_longer_than_allowed(self):
        most, = allowed(r"Python lines have at most (\d+) characters")
        self.judge(lambda text: [line for line in text.split("\n") if len(line) > most], sources(), "#" * (most + 1))

    def test_no_function_is_longer_or_takes_more_than_allowed(self):
        lines, = allowed(r"functions of about \d+ lines \((\d+) at most")
        product = sources(folders=("coupling",))
        self.judge(lambda text: [name for name, length, _ in functions(text) if length > lines], product,
                   "def f():\n" + "    pass\n" * (lines + 1))
        self.judge(lambda text: [name for name, _, count in functions(text) if count > 5], sources(),
                   "def f(a, b, c, d, e, f):\n    pass\n")

    def test_records_of_more_than_three_fields_are_made_by_name(self):
        self.judge(records_by_position, sources(folders=("coupling",)),
                   "@dataclass\nclass A:\n    a: int\n    b: int\n    c: int\n    d: int\n")

    def test_rooms_of_the_package_import_only_those_below(self):
        self.assertEqual(wrong_arrows(PACKAGE), [])
        with tempfile.TemporaryDirectory() as root:  # it can fail
            for name, text in (("low.py", "from .high import b\n"), ("high.py", "from . import low\n")):
                write(os.path.join(root, name), text)
            self.assertEqual(wrong_arrows(root, ("low", "high")), ["low.py imports high.py"])
