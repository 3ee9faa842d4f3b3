# diptych: the quantities that the maps can show
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A new quantity is one entry of QUANTITIES: its datasets and its colours. Titles, units and meanings are the datasets' own."""

from dataclasses import dataclass

import numpy as np

from diptych_report.data.panels import PANEL_NAMES
from diptych_report.tables.wording import suffix, typeset

PLACES = ("discs", "cells", "grid")  # the grains' panel: discs, or means on the mesh's cells or on a regular grid
BOTH = "{panel}_"                    # before the name of a cell's dataset, where both panels may have one
DEGREES = 180 / np.pi


@dataclass(frozen=True)
class Quantity:
    """name: of the dataset of grains, and with `prefix` before it of cells; continuum: the continuum's own where it differs.

    component: (row, column) of a tensor. home: the place shown first. Limits: from_zero, or else signed (symmetric about 0), or
    else percentiles at both ends; per_progress: an increment, whose limits grow with the progress it spans. of_state: a stage
    alone stores it; a window shows that of the stage it ends with. per_cent: a pure number shown times 100.
    """

    key: str
    group: str
    name: str
    continuum: str = ""
    prefix: str = BOTH
    component: tuple = ()
    title: str = ""
    colour_map: str = "viridis"
    home: str = "cells"
    from_zero: bool = False
    signed: bool = False
    per_progress: bool = False
    of_state: bool = False
    per_cent: bool = False
    grains_only: bool = False

    def path(self, place, panel):
        """Of the dataset below an increment's group."""
        if place == "discs" and panel == "discrete":
            return "discrete/" + self.name
        name = self.continuum or self.name if panel == "continuum" else self.name
        return f"{'grid' if place == 'grid' else 'cells'}/{self.prefix.format(panel=panel)}{name}"

    def values(self, increment, result, place, panel):
        """One number a grain or a cell; None if not stored. Place discs: the continuum's panel shows its cells."""
        if self.grains_only and panel == "continuum":
            return None
        path = self.path(place, panel)
        values = (increment.state if self.of_state else increment.arrays).get(path)
        if values is None or not np.isfinite(values).any():
            return None
        mesh = path.split("/")[0]
        if mesh != "discrete" and len(values) != len(corners(increment, mesh) if corners(increment, mesh) is not None else ()):
            return None
        values = np.asarray(values, dtype=float)
        return self.factor(result) * (values[(slice(None), *self.component)] if self.component else values)

    def described(self, result):
        """What the first of its datasets that is stored says of itself."""
        paths = [self.path(place, panel) for place in PLACES for panel in PANEL_NAMES]
        return next((result.arrays[path] for path in paths if path in result.arrays), None)

    def factor(self, result):
        said = self.described(result)
        return 100.0 if self.per_cent else DEGREES if said and said.unit == "rad" else 1.0

    def full_title(self, result):
        return self.title or getattr(self.described(result), "title", "") or self.key

    def label(self, result):
        """Of a colour bar: title and unit."""
        said = self.described(result)
        unit = "%" if self.per_cent else "degrees" if said and said.unit == "rad" else suffix(said.unit if said else "").strip()
        return self.full_title(result) + (f" ({unit})" if unit else "")

    def meaning(self, result, place):
        """What the datasets of a place say of themselves: "grains: ...; continuum: ..."."""
        said = []
        for panel, name in PANEL_NAMES.items():
            text = getattr(result.arrays.get(self.path(place, panel)), "meaning", "")
            if text and not (self.grains_only and panel == "continuum"):
                said.append(text if text.startswith(name.lower()) else f"{name.lower()}: {text}")
        sentence = typeset("; ".join(said))
        return sentence[:1].upper() + sentence[1:] + ("." if sentence else "")


def corners(increment, mesh):
    """(C, 4, 2) [d] of an increment's own mesh, or of the stage that it ends with."""
    own = increment.arrays.get(mesh + "/corners")
    return increment.state.get(mesh + "/corners") if own is None else own


MOTION = {"group": "Motion"}
TURN = {"group": "Motion", "colour_map": "RdBu_r", "signed": True, "per_progress": True}
STRESS = {"group": "Stress", "colour_map": "cividis", "of_state": True}
GRAINS_ONLY = {"group": "Grains only", "of_state": True, "grains_only": True}
QUANTITIES = (
    Quantity("shear", name="shear_strain_increment", title="shear strain increment ε₁ − ε₂", home="discs", from_zero=True,
             per_progress=True, per_cent=True, **MOTION),
    Quantity("displacement", name="displacement_over_platen", home="discs", from_zero=True, **MOTION),
    # The continuum is quasi-static: over the platen's, its velocity is its displacement increment.
    Quantity("velocity", name="speed_over_platen", continuum="displacement_over_platen", home="discs", from_zero=True,
             of_state=True, **MOTION),
    Quantity("rotation", name="rotation_increment", **TURN),
    Quantity("spin", name="spin_increment", **TURN),
    Quantity("turn", name="relative_rotation", **TURN),
    Quantity("s", name="mean_stress", **STRESS),
    Quantity("t_over_s", name="stress_ratio", from_zero=True, **STRESS),
    Quantity("xx", name="stress", component=(0, 0), title="stress σ_xx", **STRESS),
    Quantity("yy", name="stress", component=(1, 1), title="stress σ_yy", **STRESS),
    Quantity("xy", name="stress", component=(0, 1), title="stress σ_xy", signed=True, **{**STRESS, "colour_map": "RdBu_r"}),
    Quantity("yx", name="stress", component=(1, 0), title="stress σ_yx", signed=True, **{**STRESS, "colour_map": "RdBu_r"}),
    Quantity("couple", name="couple_stress_size", from_zero=True, **STRESS),
    Quantity("dissipation", name="dissipation", from_zero=True, **{**STRESS, "colour_map": "viridis"}),
    Quantity("solid_fraction", name="solid_fraction", prefix="", **GRAINS_ONLY),
    Quantity("coordination", name="coordination_number", **GRAINS_ONLY),
    Quantity("temperature", name="granular_temperature", from_zero=True, **GRAINS_ONLY),
    Quantity("error", name="standard_error", from_zero=True, **GRAINS_ONLY),
)
