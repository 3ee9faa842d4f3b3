# diptych: result folders and comparisons as arrays
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Result folders of the program as arrays, and the comparison of both panels."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from . import _diptych, plotting, scenes
from .arrays import History, Mesh
from .panels import ContinuumPanel, DiscretePanel

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class PanelResults:
    """Results of one panel in a folder: `snapshots` (the prepared sample, then one per stage) and `history`."""

    def __init__(self, results: Any, described: dict[str, tuple[str, str]]) -> None:
        self._kept, self._described = results, described
        self.snapshots: list[Any] = results.snapshots

    @property
    def history(self) -> History:
        """Columns of discrete.csv or continuum.csv; .frame() makes a pandas.DataFrame."""
        return History(self._kept.history(), self._described)

    def _results(self) -> Any:
        return self._kept

    def __repr__(self) -> str:
        return f"<PanelResults: {len(self.snapshots)} snapshots, {len(self.history['step'])} steps>"


@dataclass(repr=False, kw_only=True)
class Results:
    """A result folder. A panel without results is None."""

    folder: str
    scene: dict[str, dict[str, Any]] | None
    discrete: PanelResults | None
    continuum: PanelResults | None
    coarse: PanelResults | None

    def summary(self) -> "pandas.DataFrame":
        """The numbers that a user asks for first, a row each: grains, continuum, difference (with ends of 95 %
        intervals where one sample gives them) and verdict. The verdict of the last row, "checks", counts the limits
        that the run breaks; compare() lists them. Raises FileNotFoundError without a comparison."""
        import pandas
        from .summaries import Summary

        return Summary(pandas.read_csv(os.path.join(self.folder, "summary.csv"), index_col="quantity"))

    def plot(self, column: str = "stress_ratio", ax: Axes | None = None) -> Axes:
        """Draws a column of the histories over the loading variable, for each panel that has it."""
        histories = {name: panel.history for name, panel in self._panels() if column in panel.history}
        if not histories:
            raise ValueError(f"column = '{column}' is not allowed: no panel has it")
        for name, history in histories.items():
            ax = history.plot(column, ax, label=name, **plotting.PANELS[name])
        ax.legend(frameon=False)
        return ax

    def __repr__(self) -> str:
        return f"<Results of {os.path.basename(os.path.normpath(self.folder))!r}: {' and '.join(dict(self._panels()))}>"

    def _panels(self) -> list[tuple[str, PanelResults]]:
        both = (("grains", self.discrete), ("continuum", self.continuum))
        return [(name, panel) for name, panel in both if panel is not None]


@dataclass(repr=False)
class Comparison:
    """The comparison of both panels: numbers as in comparison.json, fields of every stage as in comparison.h5."""

    numbers: dict[str, Any]
    # on the mesh of the continuum: name -> (k), (k, 2) or (k, 2, 2); nodes (m, 2), cells (k, 4)
    fields: list[dict[str, Any]]
    grid: list[dict[str, Any]]  # the same on the regular grid

    def mesh(self, stage: int = -1) -> Mesh:
        """The deformed mesh of the continuum at a stage."""
        return Mesh(self.fields[stage]["nodes"], self.fields[stage]["cells"])

    def __repr__(self) -> str:
        return f"<Comparison: {len(self.numbers['stages'])} stages, {len(self.numbers['windows'])} windows>"


_CAMPAIGNS = {"ensemble.json": "Campaign", "study.json": "Campaign", "calibration.json": "CalibrationResult",
              "plan.json": "PlanResult"}


def _panel(folder: str, name: str) -> PanelResults | None:
    if not os.path.exists(os.path.join(folder, name + ".h5")):
        return None
    if name == "discrete":
        return PanelResults(_diptych.read_grains(folder), _diptych.discrete_columns())
    return PanelResults(_diptych.read_nodes(folder), _diptych.continuum_columns())


def load(folder: str | os.PathLike[str]) -> Results:
    """Reads a result folder of `diptych run`, `discrete` or `continuum`: scene, snapshots and histories.

    Raises FileNotFoundError if there are no results. Raises ValueError, with file and array, if an array is damaged or
    a file does not have the checksum of provenance.json. Warns if provenance.json has no checksum for a file.
    """
    folder = os.fspath(folder)
    prm = os.path.join(folder, "scene.prm")
    results = Results(folder=folder, scene=scenes.read(prm).dict() if os.path.exists(prm) else None,
                      discrete=_panel(folder, "discrete"), continuum=_panel(folder, "continuum"),
                      coarse=_panel(os.path.join(folder, "coarse"), "continuum"))
    if results.discrete is None and results.continuum is None:
        cures = [f"; diptych.{kind}.load({folder!r}) reads its {name}" for name, kind in _CAMPAIGNS.items()
                 if os.path.exists(os.path.join(folder, name))]
        raise FileNotFoundError(f"{folder}: no discrete.h5 and no continuum.h5{''.join(cures)}")
    _diptych.check_files(folder)
    return results


def compare(folder: str | os.PathLike[str] | Results | None = None, *, scene: Any = None,
            discrete: DiscretePanel | PanelResults | None = None,
            continuum: ContinuumPanel | PanelResults | None = None,
            coarse: ContinuumPanel | PanelResults | None = None) -> Comparison:
    """Compares both panels at the same instants with the same operators: mapping, bands, strips, probes, intervals.

    Give either
    folder  a result folder, or the Results that load() returned; or, for panels of this process,
    scene, discrete, continuum, coarse  a dict or path, and the panels (`coarse`: on the coarse mesh, optional)

    Raises ValueError if the panels have no common stage after the start. For panels of this process, numbers that only
    the program measures (CPU time) are missing or zero.
    """
    place = ""
    if folder is not None:
        loaded = folder if isinstance(folder, Results) else load(folder)
        scene = loaded.scene if scene is None else scene
        discrete, continuum, coarse, place = loaded.discrete, loaded.continuum, loaded.coarse, loaded.folder
    if scene is None or discrete is None or continuum is None:
        raise ValueError("compare: a folder with scene.prm and both panels is needed, or scene, discrete and continuum")
    read = scenes.read(scene, compares=True)
    text, fields, grid = _diptych.compare(read, discrete._results(), continuum._results(),
                                          None if coarse is None else coarse._results(), place)
    return Comparison(json.loads(text), fields, grid)
