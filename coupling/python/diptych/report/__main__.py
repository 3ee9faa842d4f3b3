# diptych: pages and pictures; python3 -m diptych.report page|movie|ensemble|study|calibration|element|homogenised DIR [NEXT]
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exit codes: 0 done, 2 wrong input (usage, missing or broken file, another format), 4 a module is missing or a file cannot be
written. A new page replaces the old one only when it is complete."""

import gc
import importlib
import sys

from . import InputError

# what to draw -> (module with draw(folder), its input files); only a page also takes a folder of newer files
DRAWINGS = {
    "page": ("page.result_page", "comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json"),
    "movie": ("page.movie", "comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json"),
    "ensemble": ("page.ensemble_page", "ensemble.json, ensemble.h5"),
    "study": ("page.study_page", "study.json, study_cost.json, study.h5"),
    "calibration": ("page.calibration_page", "calibration.json, calibration_cost.json"),
    "element": ("page.element_page", "element.json, element.csv"),
    "homogenised": ("page.homogenised_page", "homogenised.json, fields_*.vtu, provenance.json"),
}


def main(arguments):
    if len(arguments) not in (2, 3) or arguments[0] not in DRAWINGS:
        print(f"report: usage: python3 -m diptych.report {'|'.join(DRAWINGS)} DIR [NEXT]", file=sys.stderr)
        return 2
    module, inputs = DRAWINGS[arguments[0]]
    gc.disable()  # saves a tenth of the time: figures are thousands of small objects, and the program ends soon
    try:
        folders = arguments[1:] if arguments[0] == "page" else arguments[1:2]
        importlib.import_module("." + module, __package__).draw(*folders)
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"report: {error}", file=sys.stderr)
        return 4
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        print(f"report: {arguments[1]}: one of {inputs} has contents that this version does not write: "
              f"{type(error).__name__}: {error}", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"report: {sys.executable} lacks a module: {error}. Install python3-h5py, python3-matplotlib, python3-jinja2 and "
              "python3-meshio (Debian)", file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
