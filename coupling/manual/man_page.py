#!/usr/bin/env python3
# diptych: the page that `man diptych` shows
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: man_page.py PROGRAM OUTPUT.gz

Reads the output of `diptych --help` and `diptych COMMAND --help`. The page holds no date: the same program gives the
same bytes."""
import gzip
import os
import re
import sys

import reference


def escaped(text):
    """Text with roff's special characters escaped."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.MULTILINE)


def command_section(name, text):
    """Lines of one command: usage, meaning, arguments and options."""
    first, rest = text.split("\n", 1)
    usage = re.search(r"^Usage: (.*)$", rest, re.MULTILINE)[1]
    lines = [f'.SS "diptych {name}"', ".B " + escaped(usage), ".PP", escaped(first[:1].upper() + first[1:]) + "."]
    for head, meaning in reference.options(rest):
        lines += [".TP", ".B " + escaped(head), escaped(meaning) or "\\ "]
    return lines


def page(commands, version):
    """The whole page; version is the output of `diptych --version`."""
    title, _ = commands.overview.split("\n", 1)
    codes = re.search(r"^Exit codes: (.*)\Z", commands.overview.strip(), re.DOTALL | re.MULTILINE)[1]
    lines = ['.TH DIPTYCH 1 "" "' + escaped(version.split("\n")[0]) + '" "User Commands"', ".SH NAME",
             "diptych \\- " + escaped(title[:1].lower() + title[1:]),
             ".SH SYNOPSIS", ".B diptych", "\\fICOMMAND\\fR [\\fIOPTIONS\\fR]", ".br", ".B diptych",
             "\\-\\-help | \\-\\-version",
             ".SH DESCRIPTION", "Computes a granular sample twice, as discs with Non\\-Smooth Contact Dynamics and as "
             "an elasto\\-plastic continuum, and compares "
             "both. A scene is a text file of keys. Each run writes a result folder with the page report.html.",
             ".SH COMMANDS"]
    for name in commands.names:
        lines += command_section(name, commands.helps[name])
    lines += [".SH EXIT STATUS"]
    for code, meaning in re.findall(r"(\d) (.*?)(?=,\s+\d |\Z)", codes, re.DOTALL):
        lines += [".TP", ".B " + code, escaped(" ".join(meaning.split()))]
    lines += [".SH SCENES", "\\fBdiptych explain\\fR lists every key of a scene, \\fBdiptych explain results\\fR every "
              "column and dataset.", ".SH VERSION", ".nf", escaped(version.strip()), ".fi"]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    text = page(reference.Commands(sys.argv[1]), reference.output_of(sys.argv[1], "--version"))
    with open(sys.argv[2] + ".part", "wb") as file:
        file.write(gzip.compress(text.encode(), mtime=0))
    os.rename(sys.argv[2] + ".part", sys.argv[2])
