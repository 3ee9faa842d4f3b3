# diptych: both panels as objects
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The discrete and the continuum panel: prepare, advance from stage to stage, read snapshots."""

import os
from collections.abc import Callable, Mapping
from typing import Any, Optional

import numpy as np

from . import _diptych, scenes
from .arrays import Array, History, Record
from .compiled import continuum
from .errors import NotConverged

OnStep = Optional[Callable[[dict[str, Any]], Any]]

_diptych.DiscreteSnapshot.__repr__ = (
    lambda s: f"<DiscreteSnapshot: {len(s.position)} grains, progress {s.progress:.4g}>")
_diptych.ContinuumSnapshot.__repr__ = (
    lambda s: f"<ContinuumSnapshot: {len(s.position)} nodes, progress {s.progress:.4g}>")
_diptych.Contacts.__repr__ = lambda contacts: f"<Contacts: {len(contacts)}>"


class _Panel:
    """The common part of both panels."""

    _columns: Callable[[], dict[str, tuple[str, str]]]
    _save: Callable[[Any, str], None]

    def __init__(self, scene: _diptych.Scene, make: Callable[[], Any], on_step: OnStep) -> None:
        self._scene, self._make, self._panel, self._prepared = scene, make, make(), False
        self.on_step = on_step
        self.status = "new"
        self.snapshots: list[Any] = []

    @property
    def scene(self) -> dict[str, dict[str, Any]]:
        """The checked scene with every key."""
        return self._scene.dict()

    @property
    def stages(self) -> Array:
        """(m): progress at the stages 1 ... m: axial strain, shear strain or time, depending on the loading."""
        return np.array(self._scene.stages())

    @property
    def stage(self) -> int:
        """Number of stages reached."""
        return int(self._panel.stage())

    @property
    def history(self) -> History:
        """Columns of discrete.csv or continuum.csv, one row per step; .frame() makes a pandas.DataFrame."""
        return History(self._panel.history(), type(self)._columns())

    @property
    def report(self) -> Record:
        """The facts of the run so far, with the names of provenance.json: reached_progress, step, message and more."""
        return Record(self._panel.report())

    def snapshot(self) -> Any:
        """The present instant; may be called from on_step. Its arrays are read only and share its memory."""
        return self._panel.snapshot()

    def prepare(self) -> str:
        """Prepares the sample and keeps its snapshot. Returns "finished". Raises NotConverged. After an interruption
        the next call starts the preparation again."""
        if self._prepared:
            raise RuntimeError("the sample is prepared already")
        if self.status != "new":
            self._panel = self._make()
        self.status = "stopped"
        status = self._checked(self._panel.prepare(self.on_step))
        self._prepared = True
        self.snapshots.append(self.snapshot())
        return status

    def advance(self, stage: int | None = None) -> str:
        """Loads the sample up to a stage (1, 2, ...; default: the next one) and keeps a snapshot of each stage on the
        way. Prepares the sample first if necessary.

        Returns "finished", or "stopped" if on_step returned False. Another advance() then continues, with the same bits
        as a run without the stop. Raises NotConverged. Exceptions of on_step and KeyboardInterrupt are raised after the
        present step; the panel can continue."""
        last = self.stage + 1 if stage is None else stage
        if not 1 <= last <= len(self.stages):
            raise ValueError(f"stage = {last}: the loading has stages 1 ... {len(self.stages)}")
        if not self._prepared and self.prepare() != "finished":
            return self.status
        while self.stage < last:
            before, self.status = self.stage, "stopped"
            try:
                status = self._panel.advance(before + 1, self.on_step)
            finally:
                if self.stage > before:
                    self.snapshots.append(self.snapshot())
            if self._checked(status) != "finished":
                break
        return self.status

    def run(self) -> str:
        """Prepares the sample and loads it through all stages. Returns as advance() does."""
        return self.advance(len(self.stages))

    def write(self, folder: str | os.PathLike[str]) -> None:
        """Writes snapshots and history like the program (.h5, .pvd, .csv). Raises FileNotFoundError if the folder does
        not exist. Raises FileExistsError for a result folder of the program, whose files have checksums."""
        if not os.path.isdir(folder):
            raise FileNotFoundError(f"{os.fspath(folder)}: no such folder")
        for name in ("scene.prm", "ensemble.prm", "study_input.json", "calibration_input.json"):
            if os.path.exists(os.path.join(folder, name)):
                raise FileExistsError(f"{os.fspath(folder)}: holds {name}, a result of diptych; name another folder")
        self._save(self._results(), os.fspath(folder))

    def _results(self) -> Any:
        return self._panel.results(self.snapshots)

    def _checked(self, status: str) -> str:
        self.status = status
        if status == "not_converged":
            raise NotConverged(self._panel.report()["message"])
        return status

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self.status}, stage {self.stage} of {len(self.stages)}>"


class DiscretePanel(_Panel):
    """A sample of grains loaded through the stages of a scene (Non-Smooth Contact Dynamics, Moreau 1988; Jean 1999).

    scene    dict or path, see scene()
    on_step  called with every row of the history, a dict with the columns of discrete.csv: one row per step, for
             springs one per discrete/history_interval. Return False to stop. The GIL is released during the steps. The
             callback may call snapshot() but not advance().
    grains   {"position": (n, 2) [length], "radius": (n) [length]}: replaces the prepared sample; platens and sides are
             placed as for a sample from a file

    Raises SceneError, and ValueError for contradictory options. The numbers are bit by bit those of the program.

    >>> panel = DiscretePanel({"sample": {"grains": 200}, "loading": {"axial_strain": 0.01, "stage_strain": 0.005}})
    >>> panel.run()
    'finished'
    """

    _columns = staticmethod(_diptych.discrete_columns)
    _save = staticmethod(_diptych.write_grains)

    def __init__(self, scene: scenes.SceneLike, on_step: OnStep = None,
                 grains: Mapping[str, Any] | None = None) -> None:
        read = scenes.read(scene)
        own = (None, None) if grains is None else (grains["position"], grains["radius"])
        super().__init__(read, lambda: _diptych.GrainPanel(read, *own), on_step)


class ContinuumPanel(_Panel):
    """The same sample as an elasto-plastic continuum on a mesh (deal.II), loaded through the same stages.

    scene    dict or path, see scene()
    grains   snapshot of the prepared grains (DiscretePanel.snapshots[0]). continuum/mesh = outline, the default, needs
             it: its outline is meshed, and its stress and solid fraction are mapped if the scene asks for that.
    on_step  called with every row of the history, a dict with the columns of continuum.csv; return False to stop

    The first panel starts MPI, unless mpi4py did; the end of the process ends it. Raises SceneError and ValueError.
    """

    _columns = staticmethod(_diptych.continuum_columns)
    _save = staticmethod(_diptych.write_nodes)

    def __init__(self, scene: scenes.SceneLike, grains: Any = None, on_step: OnStep = None) -> None:
        read = scenes.read(scene)
        compiled = continuum("ContinuumPanel")
        super().__init__(read, lambda: compiled.ContinuumPanel(read, grains), on_step)
