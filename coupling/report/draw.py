#!/usr/bin/env python3
# diptych: pages and pictures of results; usage: draw.py page|ensemble|study|calibration|step-study DIR [NEXT]
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exit codes: 0 done, 2 wrong input (usage, missing or broken file, another format), 4 a module is missing or a file cannot be written.
A new page replaces the old one only when it is complete."""

import gc
import os
import sys
import traceback

sys.dont_write_bytecode = True  # the source tree stays clean and may be read-only
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from diptych_report.data.input_error import InputError  # noqa: E402

INPUTS = {"page": "comparison.json, comparison.h5, discrete.csv, continuum.csv, provenance.json", "ensemble": "ensemble.json, ensemble.h5",
         "study": "study.json, study_cost.json, study.h5", "calibration": "calibration.json, calibration_cost.json",
         "step-study": "study_step.json, study_step.csv"}  # what to draw -> its input files


def draw(what, folder, next_folder):
    """Each branch imports only the modules that it needs. Only a page reads next_folder, which holds files newer than those of folder,
    and is written to it."""
    if what == "page":
        from diptych_report.page import result_page
        result_page.draw(folder, next_folder)
    elif what == "ensemble":
        from diptych_report.page import ensemble_page
        ensemble_page.draw(folder)
    elif what == "study":
        from diptych_report.page import study_page
        study_page.draw(folder)
    elif what == "calibration":
        from diptych_report.page import calibration_page
        calibration_page.draw(folder)
    else:
        from diptych_report.charts import step_study
        from diptych_report.data.step_study import load
        step_study.draw(load(folder), folder)


def main(arguments):
    if len(arguments) not in (2, 3) or arguments[0] not in INPUTS:
        print(f"report: usage: draw.py {'|'.join(INPUTS)} DIR [NEXT]", file=sys.stderr)
        return 2
    gc.disable()  # saves a tenth of the time: figures are thousands of small objects, and the program ends soon
    try:
        draw(arguments[0], arguments[1], arguments[-1])
    except InputError as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"report: {error}", file=sys.stderr)
        return 4
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        print(f"report: {arguments[1]}: one of {INPUTS[arguments[0]]} has contents that this version does not write: {type(error).__name__}: {error} "
              f"({os.path.basename(place.filename)}, line {place.lineno})", file=sys.stderr)
        return 2
    except ImportError as error:
        print(f"report: {sys.executable} lacks a module: {error}. Install python3-h5py, python3-matplotlib and python3-jinja2 (Debian)",
              file=sys.stderr)
        return 4
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
