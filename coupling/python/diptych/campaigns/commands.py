# diptych: the commands of campaigns
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parses the words of a command and does it; pandas and SciPy load only then."""

import importlib
from collections.abc import Sequence
from typing import Any

from ..entries import described
from ..words import Parser
from . import arguments
from .runs.engine import Options

# command: function that adds its arguments; module and function that do it
COMMANDS = {"run": (arguments.add_run, "ensembles.ensemble", "run_ensemble"),
            "compare": (arguments.add_compare, "exchange.compare", "run_compare"),
            "study": (arguments.add_study, "studies.study", "run_study"),
            "plan": (arguments.add_plan, "plans.plan", "main_plan"),
            "calibrate": (arguments.add_calibrate, "calibration.calibration", "run_calibration"),
            "element": (arguments.add_element, "element.element", "run_element"),
            "homogenise": (arguments.add_homogenise, "element.homogenise", "run_homogenise"),
            "import": (arguments.add_import, "exchange.imports", "run_import"),
            "import field": (arguments.add_import_field, "exchange.fields", "run_import_field"),
            "export": (arguments.add_export, "exchange.exports", "run_export"),
            "report": (arguments.add_report, "exchange.reports", "run_report")}


def with_joined_per_cent(words: Sequence[str]) -> list[str]:
    """The words with --accuracy 2 % as one word less."""
    joined: list[str] = []
    for word in words:
        joined[-1:] = [joined[-1] + " %"] if word == "%" and joined else [*joined[-1:], word]
    return joined


def do(words: Sequence[str], pool: Any = None) -> None:
    """Does a command in this process, with runs also in `pool`. Raises SceneError for wrong words, or what failed."""
    name = " ".join(words[:2]) if " ".join(words[:2]) in COMMANDS else words[0]
    add_arguments, module, function = COMMANDS[name]
    parser = Parser(name, *([arguments.FIELD] if name == "import field" else []))
    add_arguments(parser)
    line = parser.parse(with_joined_per_cent(words[len(name.split()):]))
    loaded = importlib.import_module("." + module, __package__)
    shared = {name: value for name, value in vars(line).items() if name in Options.__dataclass_fields__}
    getattr(loaded, function)(line, Options(**shared, words=words, pool=pool))


def result_entries() -> list[dict[str, str]]:
    """Descriptions of the entries of all files that the commands write."""
    for _, module, _ in COMMANDS.values():
        importlib.import_module("." + module, __package__)
    return described()
