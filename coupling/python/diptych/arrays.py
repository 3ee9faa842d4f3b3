# diptych: what results are handed over in
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Columns of a history, bands, meshes and maps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas

Array = NDArray[Any]


class History(dict[str, Array]):
    """name of the column -> (n) array. `unit` and `meaning` say what a column is; frame() makes a pandas.DataFrame of it."""

    def __init__(self, columns: Mapping[str, Any], told: Mapping[str, tuple[str, str]]) -> None:
        super().__init__((name, np.asarray(values)) for name, values in columns.items())
        self.unit = {name: told[name][0] for name in self if name in told}
        self.meaning = {name: told[name][1] for name in self if name in told}

    def frame(self) -> "pandas.DataFrame":
        """All columns as a pandas.DataFrame; frame.attrs["unit"] has the units."""
        import pandas

        frame = pandas.DataFrame(dict(self))
        frame.attrs["unit"] = self.unit
        return frame


class Interval(NamedTuple):
    """A value with the ends of its 95 % interval; NaN where they are not known."""

    value: float
    low: float
    high: float


class Record(dict[str, Any]):
    """A dict whose entries can be read as attributes: probe.t_over_s."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no '{name}'; there are {', '.join(self)}") from None


class Mesh(NamedTuple):
    """Quadrilaterals: nodes (m, 2) [length]; cells (k, 4), corners anticlockwise."""

    nodes: Array
    cells: Array

    @property
    def polygons(self) -> Array:
        """(k, 4, 2): corners of every cell, for matplotlib's PolyCollection."""
        return np.asarray(self.nodes[self.cells])

    @property
    def centres(self) -> Array:
        """(k, 2): means of the corners."""
        return np.asarray(self.polygons.mean(axis=1))


@dataclass
class StressMap:
    """Stress of grains on the cells of a mesh, positive in compression; row index = component of the force."""

    mesh: Mesh
    stress: Array  # (k, 2, 2) [pressure], raw: not made symmetric
    area: Array  # (k) [length^2]
    solid_fraction: Array  # (k) exact: area of the discs in a cell over its area
    covered: Array  # (k) bool: grains cover at least half of what is typical
    outside_share: float  # of |force| x branch, what lay outside the mesh and went to a boundary cell
    total_relative_error: float  # of the sum over the cells from the sum over the contacts; round-off

    @property
    def symmetric(self) -> Array:
        """(k, 2, 2): the symmetric part."""
        return np.asarray(0.5 * (self.stress + self.stress.transpose(0, 2, 1)))

    @property
    def s(self) -> Array:
        """(k): mean stress (s1 + s2)/2 [pressure]."""
        return np.asarray(0.5 * np.trace(self.stress, axis1=1, axis2=2))

    @property
    def t(self) -> Array:
        """(k): shear stress (s1 - s2)/2 >= 0 [pressure]."""
        sym = self.symmetric
        return np.asarray(np.hypot(0.5 * (sym[:, 0, 0] - sym[:, 1, 1]), sym[:, 0, 1]))

    @property
    def t_over_s(self) -> Array:
        """(k): sine of the mobilised friction angle; NaN where a cell is not in compression."""
        return np.divide(self.t, self.s, out=np.full(len(self.area), np.nan), where=self.s > 0)

    @property
    def total(self) -> Array:
        """(2, 2): mean stress over all cells [pressure]."""
        return np.asarray(np.einsum("k,kab->ab", self.area, self.stress) / self.area.sum())


@dataclass
class Band:
    """A shear band: u = c + G x + (J/2) tanh((n.(x - centre) - offset) / half_width), n its normal with n_y >= 0."""

    angle_deg: float  # of the band from the horizontal, in (-90, 90]
    width_10_90: float  # [length]
    half_width: float  # [length]
    offset: float  # from the centre of the sample along the normal [length]
    jump: float  # |J| / |platen increment|, positive when the side of the normal moves along (cos, sin)(angle)
    dilation_deg: float  # positive when the band opens
    r_squared: float
    r_squared_strips: float
    no_packs_because: str  # what speaks against a zone between two packs; empty: nothing does
    interval: dict[str, Interval]  # of angle_deg, width_10_90, half_width, offset, jump, dilation_deg
    centre: Array  # (2) of the sample [length]

    @property
    def normal(self) -> Array:
        """(2): unit vector across the band."""
        angle = np.radians(self.angle_deg)
        return np.array([-np.sin(angle), np.cos(angle)])

    def line(self, length: float, at: float = 0.0) -> Array:
        """(2, 2): ends of a line of this length along the band's middle; `at` moves it by so many half widths (1.0986: the edge
        of the 10-90 % zone)."""
        angle = np.radians(self.angle_deg)
        along = 0.5 * length * np.array([np.cos(angle), np.sin(angle)])
        middle = self.centre + (self.offset + at * self.half_width) * self.normal
        return np.array([middle - along, middle + along])


@dataclass
class BandReport:
    """Bands of a displacement field, the strongest first; none: diffuse."""

    bands: list[Band]
    verdict: str
    converged: bool
    bic: Array  # (3): of no, one and two bands
    residual: Array  # (3): misfit / |platen increment|
    n_effective: float  # independent samples assumed
    frame: dict[str, Any] = field(repr=False)  # what lengths were measured against: centre, width, height, ...
