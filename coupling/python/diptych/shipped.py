# diptych: scenes and notebooks that come with the package
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds the shipped scenes and notebooks, in an installation or in the source tree."""

import os

_PACKAGE = os.path.dirname(os.path.realpath(__file__))  # the build tree links to the sources


def _shipped(installed: str, source: str) -> str:
    places = [os.path.normpath(os.path.join(_PACKAGE, *[".."] * 4, "share", "diptych", installed)),
              os.path.normpath(os.path.join(_PACKAGE, source))]
    for place in places:
        if os.path.isdir(place):
            return place
    raise FileNotFoundError(f"diptych: no folder {installed} in {places[0]} or {places[1]}")


def benchmarks_dir() -> str:
    """Folder of shipped scenes: benchmarks_dir() + "/moreau_quick/scene.prm". Raises FileNotFoundError."""
    return _shipped("benchmarks", os.path.join("..", "..", "..", "benchmarks"))


def notebooks_dir() -> str:
    """Folder of the shipped notebooks and their data. Raises FileNotFoundError if there is none."""
    return _shipped("notebooks", os.path.join("..", "notebooks"))
