# diptych: tables of a calibration
# SPDX-License-Identifier: LGPL-2.1-or-later

import numpy as np

from ...arrays import ends_text
from ..data.calibration import label, numbers

QUANTITIES = {"peak_stress_ratio": "peak t/s", "volumetric_strain": "volumetric strain, last bin",
              "width_10_90": "width 10–90, last window, d", "angle_deg": "inclination, last window, degrees"}
COORDINATES = {"value": "", "logarithm": "", "share_of": "share of ", "drop_from": "drop from "}
KINDS = {"stress_ratio": "rms of t/s", "volumetric_strain": "rms of volume", "ln_width": "rms of ln width",
         "rotation_profile": "rms of rotation profile"}


def text(value, digits=4):
    """A number with some significant digits and without an exponent below a million."""
    return "–" if value is None or not np.isfinite(value) else f"{float(f'{value:.{digits}g}'):g}".replace("-", "−")


def parameters(calibration):
    rows = []
    for p in calibration.parameters:
        ratio = COORDINATES[p["coordinate"]]
        number = text(p["number"], 3) if ratio else ""
        rows.append([label(p), text(p["value"]), f"{ratio}{p['of']}: {number}" if ratio else "",
                     f"{text(p['number_low'], 3)} … {text(p['number_high'], 3)}",
                     f"{text(p['low'], 3)} … {text(p['high'], 3)}", f"{100 * p['share_known']:.0f} %",
                     "yes" if p["is_identified"] else "not identified"])
    return {"head": ["continuum/" if calibration.model == "continuum" else "", "value", "fitted as", "95 %", "bounds",
                     "deviation left", "identified"], "rows": rows}


def predictions(calibration):
    rows = []
    for path in calibration.paths:
        for one in path["predictions"]:
            difference = one["difference"]
            ends = ends_text(difference["low"], difference["high"], lambda end: text(end, 2))
            rows.append([f"{path['name']} ({'fitted' if path['use'] == 'fit' else 'predicted'})",
                         QUANTITIES[one["quantity"]], *(text(one[of]) for of in ("data", "before", "after")),
                         text(difference["value"], 2) + ends, text(one["margin"], 2), one["verdict"]])
    return {"head": ["path", "", calibration.data, "before", "calibrated", "difference [95 %]", "margin", "verdict"],
            "rows": rows}


def misfits(calibration):
    """Root mean squares over the bins, before and after, and those from the standard deviation of the parameters."""
    rows = []
    for path in calibration.paths:
        for kind, label in KINDS.items():
            entries = [o for o in path["observables"] if o["kind"] == kind and o["mean"] is not None]
            if entries:
                mean = numbers([o["mean"] for o in entries])
                rows.append([path["name"], label,
                             *(_rms(numbers([o[when] for o in entries]) - mean) for when in ("before", "after")),
                             *(_rms(numbers([o[key] for o in entries]))
                               for key in ("deviation_of_mean", "parameter_deviation", "half_step"))])
    return {"head": ["path", "", "before", "calibrated", "deviation of the means",
                     "from the deviation of the parameters", "change with half the step"],
            "rows": rows}


def _rms(values):
    return text(np.sqrt(np.nanmean(values ** 2)), 2)


def minima(calibration):
    rows = [[f"start {k + 1}" + (" (best)" if m["is_best"] else ""), text(m["chi2"], 3), text(m.get("total"), 3),
             str(m["runs"]), *[text(n, 3) for n in m["numbers"]]]
            for k, m in enumerate(calibration.record["minima"])]
    return {"head": ["", "χ² of the data", "with prior", "runs", *map(label, calibration.parameters)], "rows": rows}


def cost(calibration):
    r = calibration.record
    rows = [["runs on the coarse mesh (search and emulator)", str(r["coarse_runs"])],
            ["runs on the fine mesh", str(r["fine_runs"])], ["runs for predictions", str(r["other_runs"])],
            ["CPU time of the continuum, s", text(calibration.cost["continuum_cpu_s"], 3)]]
    if calibration.model == "grains":
        rows = [["points of search and emulator, each with all seeds", str(r["coarse_runs"])],
                ["points of the comparison", str(r["other_runs"])]]
    return {"head": ["", ""], "rows": [*rows, ["CPU time of the grains, s", text(calibration.cost["grains_cpu_s"], 3)]]}
