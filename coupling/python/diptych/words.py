# diptych: command lines: options, their values, help and refusals
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A parser whose help and refusals look as those of the commands in C++; types of options that name what is allowed."""

import argparse
import re
import textwrap
from collections.abc import Callable, Sequence
from typing import Any, NoReturn

from . import _diptych
from .errors import SceneError


class _Once(argparse.Action):
    """Stores a value; a second one is refused."""

    def __call__(self, parser: argparse.ArgumentParser, namespace: argparse.Namespace, values: Any,
                 option: Any = None) -> None:
        if option and option in namespace.given:
            raise argparse.ArgumentError(self, "is given more than once")
        namespace.given.append(option)
        setattr(namespace, self.dest, values)


class Parser(argparse.ArgumentParser):
    """The words of one command. about: its description; an epilog replaces its example."""

    def __init__(self, name: str, about: str = "compute many samples, and the statistics of all") -> None:
        super().__init__(prog="diptych " + name, allow_abbrev=False, add_help=False,
                         description=_diptych.commands().get(name, about))
        self.name = name
        self.register("action", None, _Once)
        self._negative_number_matcher = re.compile(r"-[\d.]")  # --gravity -9.81,0
        self.add_argument("-h", "--help", action="help", help="Print this help message and exit")

    def parse(self, words: Sequence[str]) -> argparse.Namespace:
        """Raises SceneError for words that are wrong."""
        line, unused = self.parse_known_intermixed_args(words, argparse.Namespace(given=[]))
        if unused:
            options = [name for action in self._actions for name in action.option_strings]
            near = _diptych.nearest_name(unused[0].partition("=")[0], options)
            told = f"the nearest option is '{near}'; " if unused[0].startswith("--") else \
                f"write --set before every key: --set {unused[0]}; " if "=" in unused[0] and "--set" in options else ""
            raise SceneError(f"{self.name}: unexpected argument '{' '.join(unused)}'; {told}options: "
                             f"{' '.join(options)}")
        return line

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        if action.choices and value not in action.choices:
            names = list(action.choices)
            raise argparse.ArgumentError(action, f"'{value}' is none of {', '.join(names)}; the nearest is "
                                                 f"'{_diptych.nearest_name(value, names)}'")

    def error(self, message: str) -> NoReturn:
        required = re.sub(r"the following arguments are required: (.*)", r"\1 is required", message)
        raise SceneError(f"{self.name}: {re.sub(r'^argument (-h/)?', '', required)}")

    def format_help(self) -> str:
        named = [one for one in self._actions if one.option_strings]
        places = [one for one in self._actions if not one.option_strings]
        usage = " ".join([self.prog, "[OPTIONS]", *(str(one.metavar).split()[0] for one in places)])
        blocks = [_block(title, rows) for title, rows in (("Positionals", places), ("Options", named)) if rows]
        return "\n".join([f"{self.description}\nUsage: {usage}\n", *blocks,
                          (self.epilog or _diptych.example_of(self.name)) + "\n"])


def _block(title: str, actions: Sequence[argparse.Action]) -> str:
    lines = [title + ":"]
    for one in actions:
        value = f"{{{','.join(one.choices)}}}" if one.choices else one.metavar if one.nargs != 0 else ""
        head = "  " + " ".join(filter(None, [",".join(one.option_strings), value, "REQUIRED" if one.required else ""]))
        meaning = textwrap.wrap(str(one.help), 90, initial_indent=" " * 30, subsequent_indent=" " * 30)
        meaning[0] = head.ljust(29) + " " + meaning[0].strip() if len(head) < 29 else head + "\n" + meaning[0]
        lines += meaning
    return "\n".join(lines) + "\n"


def number(low: float, high: float, is_whole: bool = False) -> Callable[[str], Any]:
    """The type of an option with a range."""
    kind, texts = ("a whole number" if is_whole else "a number"), [f"{end:.15g}" for end in (low, high)]

    def read(text: str) -> Any:
        try:
            value = int(text) if is_whole else float(text)
        except ValueError:
            value = float("nan")
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"'{text}' is not allowed; give {kind} from {texts[0]} to {texts[1]}")
        return value

    return read


def filled(text: str) -> str:
    """The type of an option that names a file or folder. An empty name comes from an unset variable of the shell."""
    if not text:
        raise argparse.ArgumentTypeError("a name is needed")
    return text


def add_output(parser: Parser, meaning: str, required: bool = False) -> None:
    parser.add_argument("--output", metavar="DIR", type=filled, required=required, help=meaning)


def add_quiet(parser: Parser) -> None:
    parser.add_argument("--quiet", action="store_true", help="print neither progress nor notes")


def add_overwrite(parser: Any) -> None:
    parser.add_argument("--overwrite", action="store_true",
                        help="rename results in the folder to DIR.1 and begin again")
