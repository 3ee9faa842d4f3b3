# diptych: the Python package
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Diptych: a granular sample as discs (contact dynamics) and as an elasto-plastic continuum, and their comparison.

Scenes are nested dicts or paths, checked like scene files (scene, keys). Panels are objects (DiscretePanel,
ContinuumPanel). Result folders of the program load as arrays (load, compare). Operators take arrays from any source:
map_stress, find_bands, strips, shear_strain, probe, integrate, biaxial, solve. The commands are functions: run,
ensemble, study, plan, calibrate, homogenise. dir(diptych) lists everything.

Two dimensions, unit thickness, any consistent units. Stress and strain are positive in compression, dilation is a
negative volumetric strain, angles are degrees from the horizontal, forces act on the first body.
"""

import sys

try:
    from ._diptych import Contacts, ContinuumSnapshot, DiscreteSnapshot, __version__
    from .arrays import Band, BandReport, History, Interval, Mesh, Record, StressMap
except ImportError as error:
    raise ImportError(f"diptych does not load in {sys.executable}: {error}. Use the Python of the build (Debian: "
                      "/usr/bin/python3).") \
        from error
from .errors import NotConverged, SceneError, SceneWarning, Stopped
from .laws import biaxial, integrate, principal
from .operators import (contacts, displacement_gradient, find_bands, grid, increment, map_stress, platen_friction,
                        probe, shear_strain, strips, theory_lines)
from .panels import ContinuumPanel, DiscretePanel
from .problems import solve
from .results import Comparison, PanelResults, Results, compare, load
from .scenes import keys, scene
from .shipped import benchmarks_dir, notebooks_dir


def __getattr__(name: str) -> object:
    """Campaigns and homogenise() need pandas and SciPy, which load only with them."""
    if name in ("Homogenised", "homogenise"):
        from . import homogenisation

        return getattr(homogenisation, name)
    if name in ("CalibrationResult", "Campaign", "PlanResult", "calibrate", "ensemble", "plan", "run", "study"):
        from .campaigns import api

        return getattr(api, name)
    raise AttributeError(f"module 'diptych' has no attribute '{name}'")


def __dir__() -> list[str]:
    return __all__


__all__ = [
    "Band", "BandReport", "CalibrationResult", "Campaign", "Comparison", "Contacts", "ContinuumPanel",
    "ContinuumSnapshot", "DiscretePanel", "DiscreteSnapshot", "History", "Homogenised", "Interval", "Mesh",
    "NotConverged", "PanelResults", "PlanResult", "Record", "Results", "SceneError", "SceneWarning", "Stopped",
    "StressMap", "__version__", "benchmarks_dir", "biaxial", "calibrate", "compare", "contacts",
    "displacement_gradient", "ensemble", "find_bands", "grid", "homogenise", "increment", "integrate", "keys",
    "load", "map_stress", "notebooks_dir", "plan", "platen_friction", "principal", "probe", "run", "scene",
    "shear_strain", "solve", "strips", "study", "theory_lines",
]
