# diptych: the types of results
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Histories, bands, meshes and stress maps."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import plotting

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

Array = NDArray[Any]


class History(dict[str, Array]):
    """Columns over steps: name -> (n) array. `unit` and `meaning` describe them; frame() makes a pandas.DataFrame."""

    def __init__(self, columns: Mapping[str, Any], described: Mapping[str, tuple[str, str]]) -> None:
        super().__init__((name, np.asarray(values)) for name, values in columns.items())
        self.unit = {name: described[name][0] for name in self if name in described}
        self.meaning = {name: described[name][1] for name in self if name in described}

    def frame(self) -> "pandas.DataFrame":
        """All columns as a pandas.DataFrame; frame.attrs["unit"] has the units."""
        import pandas

        frame = pandas.DataFrame(dict(self))
        frame.attrs["unit"] = self.unit
        return frame

    def plot(self, column: str = "stress_ratio", ax: Axes | None = None, **look: Any) -> Axes:
        """Draws a column over the loading variable. look: options of matplotlib's plot()."""
        return plotting.draw_history(self, column, ax, look)

    def __repr__(self) -> str:
        rows, names = len(next(iter(self.values()), ())), ", ".join([*self][:5])
        return f"<History: {rows} rows, {len(self)} columns: {names}, ...>"


class Interval(NamedTuple):
    """A value with the ends of its 95 % interval; NaN if unknown."""

    value: float
    low: float
    high: float

    def text(self) -> str:
        """ "0.35 [0.33, 0.37]", without ends that are unknown; "-" without a value """
        return f"{self.value:.4g}{ends_text(self.low, self.high)}" if math.isfinite(self.value) else "-"


def ends_text(low: float | None, high: float | None, form: Callable[[float], str] = "{:.4g}".format,
              between: str = ", ") -> str:
    """The interval behind a value, such as " [1.2, 3.4]"; empty if an end is unknown (None or NaN)."""
    if low is None or high is None or not (np.isfinite(low) and np.isfinite(high)):
        return ""
    return f" [{form(low)}{between}{form(high)}]"


def short(value: float) -> str:
    """A number with two digits, plainly: 110 and not 1.1e+02."""
    return f"{float(f'{value:.2g}'):g}"


def rms(values: Array) -> float:
    """Root mean square of the numbers that are known; NaN if none is."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known ** 2))) if known.size else math.nan


def plain(value: Any) -> Any:
    """The value as JSON has it: NaN is null, an interval an object."""
    if isinstance(value, Interval):
        return plain(value._asdict())
    if isinstance(value, Mapping):
        return {key: plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [plain(entry) for entry in value]
    if isinstance(value, np.generic):
        return plain(value.item())
    return None if isinstance(value, float) and not math.isfinite(value) else value


class Record(dict[str, Any]):
    """A dict whose entries are also attributes: probe.t_over_s."""

    def __getattr__(self, name: str) -> Any:
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"there is no '{name}'; there are {', '.join(self)}") from None

    def __repr__(self) -> str:
        return f"<Record: {', '.join(self)}>"


def periods_of(grains: Any) -> Array:
    """(k, 2): the periods of a snapshot [length]: none, (width, 0), or the two vectors of a cell, a row each."""
    width = getattr(grains, "cell_width", 0.0)
    if getattr(grains, "cell_a2_y", 0.0):
        return np.array([[grains.cell_a1_x, grains.cell_a1_y], [grains.cell_a2_x, grains.cell_a2_y]])
    return np.array([[width, 0.0]] if width else []).reshape(-1, 2)


class Mesh(NamedTuple):
    """Quadrilaterals: nodes (m, 2) [length]; cells (k, 4), corners anticlockwise."""

    nodes: Array
    cells: Array

    def __repr__(self) -> str:
        return f"<Mesh: {len(self.nodes)} nodes, {len(self.cells)} cells>"

    @property
    def polygons(self) -> Array:
        """(k, 4, 2): corners of every cell, for matplotlib's PolyCollection."""
        return np.asarray(self.nodes[self.cells])

    @property
    def centres(self) -> Array:
        """(k, 2): means of the corners."""
        return np.asarray(self.polygons.mean(axis=1))


# quantity -> label of its colour bar
_MAPS = {"t_over_s": "t/s", "s": "mean stress s [pressure]", "t": "shear stress t [pressure]",
         "solid_fraction": "solid fraction", "sxx": "sxx [pressure]", "sxy": "sxy [pressure]", "syx": "syx [pressure]",
         "syy": "syy [pressure]"}


def _shear(stress: Array) -> Array:
    """(s1 - s2)/2 of the symmetric part of (..., 2, 2)."""
    return np.asarray(0.5 * np.hypot(stress[..., 0, 0] - stress[..., 1, 1], stress[..., 0, 1] + stress[..., 1, 0]))


@dataclass(repr=False, kw_only=True)
class StressMap:
    """Stress of grains on the cells of a mesh, positive in compression; row index = component of the force."""

    mesh: Mesh
    stress: Array  # (k, 2, 2) [pressure], raw: not made symmetric
    couple_stress: Array  # (k, 2) [pressure length]: of the contacts' couples and of their forces about the centres
    area: Array  # (k) [length^2]
    solid_fraction: Array  # (k) exact: area of the discs in a cell over its area
    covered: Array  # (k) bool: grains cover at least half of the typical share
    outside_share: float  # share of |force| x branch outside the mesh, which went to boundary cells
    total_relative_error: float  # difference of the sums over cells and over contacts; round-off

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
        return _shear(self.stress)

    @property
    def t_over_s(self) -> Array:
        """(k): sine of the mobilised friction angle; NaN in cells that are not in compression."""
        return np.divide(self.t, self.s, out=np.full(len(self.area), np.nan), where=self.s > 0)

    @property
    def total(self) -> Array:
        """(2, 2): mean stress over all cells [pressure]."""
        return np.asarray(np.einsum("k,kab->ab", self.area, self.stress) / self.area.sum())

    def plot(self, quantity: str = "t_over_s", ax: Axes | None = None, **look: Any) -> Axes:
        """Draws the cells coloured by t_over_s, s, t, solid_fraction, sxx, sxy, syx or syy. Cells that grains do not
        cover are grey. look: options of matplotlib's PolyCollection, such as cmap and clim."""
        if quantity not in _MAPS:
            raise ValueError(f"quantity = '{quantity}' is not allowed; there are {', '.join(_MAPS)}")
        component = ["sxx", "sxy", "syx", "syy"].index(quantity) if len(quantity) == 3 else None
        values = getattr(self, quantity) if component is None else self.stress.reshape(-1, 4)[:, component]
        return plotting.draw_cells(self.mesh, np.where(self.covered, values, np.nan), _MAPS[quantity], ax, look)

    def __repr__(self) -> str:
        ratio = _shear(self.total) / (0.5 * np.trace(self.total))
        return f"<StressMap: {len(self.area)} cells, t/s of the mean stress {ratio:.3g}>"


@dataclass(repr=False, kw_only=True)
class Band:
    """A shear band: u = c + G x + (J/2) tanh((n.(x - centre) - offset) / half_width), n its normal with n_y >= 0."""

    angle_deg: float  # from the horizontal, in (-90, 90]
    width_10_90: float  # [length]
    half_width: float  # [length]
    offset: float  # from the centre of the sample along the normal [length]
    jump: float  # |J| / |platen increment|; positive if the side of the normal moves along (cos, sin)(angle)
    dilation_deg: float  # positive if the band opens
    r_squared: float
    r_squared_strips: float
    no_packs_because: str  # why this is no band between two packs; empty: it is one
    interval: dict[str, Interval]  # of angle_deg, width_10_90, half_width, offset, jump, dilation_deg
    centre: Array  # (2) of the sample [length]
    diffuse: bool = False  # wider than a third of the sample's narrower side: its angle means little

    @property
    def normal(self) -> Array:
        """(2): unit vector across the band."""
        angle = np.radians(self.angle_deg)
        return np.array([-np.sin(angle), np.cos(angle)])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the middle (solid) and the edges of the 10-90 % width (dashed), on a map or alone."""
        return plotting.draw_bands([self], ax, (6 * self.width_10_90, 6 * self.width_10_90))

    def __repr__(self) -> str:
        return f"<Band: angle {self.angle_deg:.1f} degrees, 10-90 % width {self.width_10_90:.3g}, jump {self.jump:.3g}>"

    def line(self, length: float, at: float = 0.0) -> Array:
        """(2, 2): ends of a line of this length along the middle of the band. `at` shifts the line across the band, in
        half widths (1.0986: the edge of the 10-90 % width)."""
        angle = np.radians(self.angle_deg)
        along = 0.5 * length * np.array([np.cos(angle), np.sin(angle)])
        middle = self.centre + (self.offset + at * self.half_width) * self.normal
        return np.array([middle - along, middle + along])


@dataclass(repr=False, kw_only=True)
class BandReport:
    """Bands of a displacement field, the strongest first. No band: the field is diffuse."""

    bands: list[Band]
    verdict: str
    converged: bool
    bic: Array  # (3): for no, one and two bands
    residual: Array  # (3): misfit / |platen increment|
    n_effective: float  # independent samples assumed
    frame: dict[str, Any]  # reference lengths: centre, width, height, ...

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws all bands as Band.plot() does; alone in a box as large as the sample."""
        return plotting.draw_bands(self.bands, ax, (self.frame["width"], self.frame["height"]))

    def __repr__(self) -> str:
        return f"<BandReport: {len(self.bands)} bands; {self.verdict}>"
