# diptych: pages and pictures of result folders
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The modules here use the folders: page -> charts, tables -> data; data uses none of the others."""

import importlib
import sys

from ..errors import InputError

# picture -> (module with draw(folder), its input files); only a page also takes a folder of newer files
DRAWINGS = {
    "page": ("page.result_page", "comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json"),
    "movie": ("page.movie", "comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json"),
    "ensemble": ("ensemble", "ensemble.json, ensemble.h5"),
    "study": ("study", "study.json, study_cost.json, study.h5"),
    "calibration": ("calibration", "calibration.json, calibration_cost.json"),
    "element": ("element", "element.json, element.csv"),
    "measured": ("measured", "levelled.json, levelled.h5, provenance.json"),
    "homogenised": ("homogenised", "homogenised.json, fields_*.vtu, provenance.json"),
}


def draw(what, folder, *next_folder):
    """Draws the page of a folder, report.html, or another picture. The old one stays until the new one is complete.

    Raises InputError, with the file, if a file of the folder is missing, broken or has another format; OSError if a
    file cannot be written; ImportError if a module is missing.
    """
    module, inputs = DRAWINGS[what]
    try:
        importlib.import_module("." + module, __name__).draw(folder, *next_folder)
    except InputError:
        raise
    except ImportError as error:
        raise ImportError(f"{sys.executable} lacks a module: {error}. Install python3-h5py, python3-matplotlib, "
                          "python3-jinja2 and python3-meshio (Debian)") from error
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise InputError(f"{folder}: one of {inputs} has contents that this version does not write: "
                         f"{type(error).__name__}: {error}") from error
