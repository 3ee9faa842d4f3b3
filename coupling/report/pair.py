# diptych: two pictures of one instant, grains left and continuum right
# SPDX-License-Identifier: LGPL-2.1-or-later

from dataclasses import dataclass


@dataclass(frozen=True)
class Pair:
    """A picture is None where its data are not stored. extra: one that belongs to both or to the grains alone."""

    left: object
    right: object
    caption: str = ""
    extra: object = None
