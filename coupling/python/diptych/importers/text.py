# diptych: lines of text files, packed or not, in the encodings that programs write
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Text files as lists of lines."""

import gzip
import os
import re
import zlib
from typing import Sequence

import numpy as np

from .frames import refused


def read_lines(path: str) -> list[str]:
    """Lines of a text file in UTF-8, UTF-16 with its mark or Latin 1; also packed by gzip. Raises SceneError."""
    try:
        with open(path, "rb") as file:
            data = file.read()
        if data[:2] == b"\x1f\x8b":
            data = gzip.decompress(data)
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except (EOFError, gzip.BadGzipFile, zlib.error) as error:
        raise refused(path, f"cannot be unpacked ({error}); is it truncated?") from error
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    if "\0" in text:
        raise refused(path, "contains a byte 0; a text file is needed")
    if not text.strip():
        raise refused(path, "is empty; leave it out, or write at least the names of its columns")
    return text.replace("\r\n", "\n").replace("\r", "\n").rstrip("\n").split("\n")


def number_in_name(path: str) -> int:
    """The last number in a file name, which counts frames: 12 of contacts_12.txt or contacts_12.csv.gz; else -1."""
    numbers = re.findall(r"\d+", re.sub(r"\.gz$", "", os.path.basename(path)))
    return int(numbers[-1]) if numbers else -1


def float_of(path: str, line: int, word: str, what: str) -> float:
    """A finite number, also with Fortran's exponent D. Raises SceneError naming file, line and `what`."""
    try:
        value = float(word.replace("D", "E").replace("d", "e"))
    except ValueError:
        raise refused(path, f"{what} = '{word[:60]}' is not a number", line) from None
    if not np.isfinite(value):
        raise refused(path, f"{what} = '{word}' is not finite", line)
    return value


def int_of(path: str, line: int, word: str, what: str) -> int:
    """A whole number; loops in Python write 12.0."""
    value = float_of(path, line, word, what)
    if value != int(value):
        raise refused(path, f"{what} = '{word}' is not a whole number", line)
    return int(value)


def floats_of(path: str, line: int, words: Sequence[str], what: str) -> list[float]:
    """Several finite numbers, as float_of() reads one."""
    return [float_of(path, line, word, what) for word in words]
