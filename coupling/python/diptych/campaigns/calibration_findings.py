# diptych: the results of a calibration as records, text and files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""calibration.json holds a dict: its keys are listed here, their meanings in README_calibration.md."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .. import _diptych
from ..arrays import Array, Interval
from .calibration_coordinates import Coordinates
from .calibration_noise import NoiseModel, covariance
from .calibration_runs import Observation, Path
from .calibration_search import LARGEST_SHARE, NORMAL, Knowledge
from .folders import write_json, write_text
from .input_file import listed
from .statistics import Difference, line_statistics, paired, statistics

NORMAL_95 = 1.6448536269514722  # 95 % quantile
CLOSE = 1e-3  # to a bound, in the unit cube
COLUMNS = ("kind", "from", "to", "count", "mean", "deviation", "deviation_of_mean", "before", "after", "parameter_deviation",
           "half_step", "counts")


def parameter_records(coordinates: Coordinates, knowledge: Knowledge, point: Array) -> list[dict[str, Any]]:
    """Values with 95 % intervals; numbers are those of the coordinates."""
    reach = knowledge.quantile * knowledge.deviation
    ends = [coordinates.numbers(np.clip(point + side * reach, 0, 1)) for side in (-1, 0, 1)]
    return [{"key": p.key, "targets": list(p.targets), "coordinate": p.coordinate, "of": p.other, "low": p.low, "high": p.high,
             "start": p.start, "number": ends[1][k], "number_low": ends[0][k], "number_high": ends[2][k], "value": value,
             "share_known": share, "is_identified": bool(share < LARGEST_SHARE),
             "at_bound": bool(not CLOSE <= point[k] <= 1 - CLOSE),
             "is_cut": bool(point[k] < reach[k] or point[k] + reach[k] > 1),
             "profile_number": [], "profile_chi2": [], "profile_expected": []}
            for k, (p, value, share) in enumerate(zip(coordinates.parameters, coordinates.values(point),
                                                      knowledge.share_known))]


def parameter_words(parameters: Sequence[dict[str, Any]]) -> list[str]:
    """Findings on parameters that are not identified or lie at a bound."""
    words = []
    for p in parameters:
        name = p["key"] + (f" ({listed(p['targets'])})" if p["targets"] else "")
        if not p["is_identified"]:
            words.append(f"{name} is not identified: its uncertainty is still {100 * p['share_known']:.0f} % of what it was "
                         "before")
        if p["at_bound"]:
            words.append(f"{name} lies at its bound; widen low and high, or fix it")
        elif p["is_cut"]:
            words.append(f"the interval of {name} ends at its bound, so this end comes from the bound and not from the data")
    return words


def _prediction(quantity: str, grains: Sequence[float], before: float, after: float, margin: float, kind: str) -> dict[str,
                                                                                                                       Any]:
    test = paired(grains, [after] * len(grains), kind)
    finite = [x for x in grains if np.isfinite(x)]
    return {"quantity": quantity, "data": (line_statistics if kind == "line" else statistics)(finite).mean, "before": before,
            "after": after, "difference": test.difference, "margin": margin, "verdict": test.verdict(margin),
            "parameter_deviation": np.nan, "test": test}


def predictions(path: Path, before: Observation, after: Observation) -> list[dict[str, Any]]:
    """Single numbers of a path with verdicts: two one-sided tests against the margins of the scene."""
    margins, samples = path.scene.dict()["comparison"], path.samples

    def numbers(name: str) -> tuple[list[float], float, float]:
        return [getattr(s, name) for s in samples], getattr(before, name), getattr(after, name)

    found = []
    if np.isfinite([s.peak_stress_ratio for s in samples]).any():
        found.append(_prediction("peak_stress_ratio", *numbers("peak_stress_ratio"), margins["margin_peak_stress_ratio"],
                                 "relative"))
    places = {one.kind: k for k, one in enumerate(path.data.observables)}  # the last of each kind
    if "volumetric_strain" in places:
        k = places["volumetric_strain"]
        found.append(_prediction("volumetric_strain", [s.values[k] for s in samples], before.values[k], after.values[k],
                                 margins["margin_volumetric_strain"], "absolute"))
    if "ln_width" in places:
        k = places["ln_width"]  # in the fit only, half the height replaces a missing band
        b, a = (float(np.exp(o.values[k])) if np.isfinite(o.angle_deg) else np.nan for o in (before, after))
        found.append(_prediction("width_10_90", [float(np.exp(s.values[k])) for s in samples], b, a,
                                 margins["margin_thickness"],
                                 "relative"))
        found.append(_prediction("angle_deg", *numbers("angle_deg"), margins["margin_angle"], "line"))
    return found


def _curves(path: Path, before: Observation, after: Observation) -> dict[str, Any]:
    """Mean of the samples, plus and minus two deviations of one sample, and both curves of the continuum."""
    record: dict[str, Any] = {"progress": path.samples[0].progress}
    for name, key in (("stress_ratio", "stress_ratio"), ("volumetric_strain", "volume")):
        curves = np.array([getattr(s, name) for s in path.samples])
        spread = 2 * curves.std(0, ddof=1) if len(curves) > 1 else np.full(curves.shape[1], np.nan)
        record |= {key: curves.mean(0), key + "_low": curves.mean(0) - spread, key + "_high": curves.mean(0) + spread,
                   key + "_before": getattr(before, name) if not before.failure else [],
                   key + "_after": getattr(after, name) if not after.failure else []}
    return record


def path_record(path: Path, noise: NoiseModel, runs: Sequence[Observation], deviations: Array) -> dict[str, Any]:
    """runs: before, calibrated, and calibrated with half the load step. deviations: (observables), from the parameters."""
    before, after, halved = runs
    data, deviation = path.data, np.sqrt(np.diag(covariance(noise, path.data)))
    observables = [
        {"kind": one.kind, "from": one.low, "to": one.high, "count": int(data.count[k]), "mean": data.mean[k],
         "deviation": deviation[k], "deviation_of_mean": deviation[k] / np.sqrt(max(1, data.count[k])),
         "before": before.values[k],
         "after": after.values[k], "parameter_deviation": deviations[k], "half_step": halved.values[k] - after.values[k],
         "counts": False, "left_out": path.left_out[k]} for k, one in enumerate(data.observables)]
    return {"name": path.target.name, "use": "fit" if path.target.is_fitted else "predict", "seeds": path.target.seeds,
            "failed": after.failure, "observables": observables, "predictions": predictions(path, before, after),
            **_curves(path, before, after)}


def widened(test: Difference, deviation: float, quantile: float) -> Difference:
    """The same if its second part has an independent uncertainty, given by a deviation and a 97.5 % quantile. The squares of
    the half widths are added."""
    def wide(interval: Interval, half: float) -> Interval:
        value, low, high = interval
        return Interval(value, value - np.hypot(value - low, half), value + np.hypot(high - value, half))

    # Student's quantile shrinks more from 97.5 to 95 % than the normal one, so this is conservative.
    return Difference(test.n, wide(test.difference, quantile * deviation),
                      wide(test.difference_90, quantile * NORMAL_95 / NORMAL * deviation))


def widen_predictions(record: dict[str, Any], quantile: float) -> None:
    """Widens the predictions of a path that was not fitted by the deviation of the parameters. The angle is not widened,
    because the fit has no derivative of it. The peak is the largest value of the curve: near a flat peak it moves as the curve
    does."""
    last: dict[str, dict[str, Any]] = {}
    for one in record["observables"]:
        if one["kind"] != "stress_ratio" or one["kind"] not in last or one["after"] > last[one["kind"]]["after"]:
            last[one["kind"]] = one
    kinds = {"peak_stress_ratio": "stress_ratio", "volumetric_strain": "volumetric_strain", "width_10_90": "ln_width"}
    for p in record["predictions"]:
        by = last.get(kinds.get(p["quantity"], ""))
        if by is None or not np.isfinite(by["parameter_deviation"]):
            continue
        scale = {"peak_stress_ratio": 1 / p["data"], "width_10_90": p["after"] / p["data"]}.get(p["quantity"], 1)
        p["parameter_deviation"] = by["parameter_deviation"] * scale
        p["test"] = widened(p["test"], p["parameter_deviation"], quantile)
        p["difference"], p["verdict"] = p["test"].difference, p["test"].verdict(p["margin"])


def summary(record: dict[str, Any], cpu_s: float) -> str:
    """The result for the terminal."""
    lines = [f"{record['title']}: chi^2 of {record['n_observables']} observables {record['chi2_before']:.4g} -> "
             f"{record['chi2']:.4g}; "
             f"{record['coarse_runs']} coarse and {record['fine_runs']} fine runs, {record['other_runs']} of predictions, "
             f"{cpu_s:.4g} CPU s"]
    for p in record["parameters"]:
        share = f"{p['coordinate']} {p['of']} {p['number']:.3g} " if p["of"] else ""
        lines.append(f"  {p['key']} = {p['value']:.4g} {share}[{p['number_low']:.4g}, {p['number_high']:.4g}]"
                     f"{'' if p['is_identified'] else ', not identified'}")
    for path in record["paths"]:
        lines += [f"  {path['name']} ({path['use']}): {one['quantity']} {one['data']:.4g}, before {one['before']:.4g}, "
                  f"after {one['after']:.4g}: {one['verdict']}" for one in path["predictions"]]
    return "\n".join(lines + ["  " + words for words in record["words"]])


def _fragment(record: dict[str, Any]) -> str:
    status = "" if record["status"] == "finished" else ": " + record["status"]
    lines = [f"# {record['title']}, by diptych {_diptych.git_revision}{status}"]
    lines += [f"# fitted on {path['name']}" + (f", seeds {' '.join(map(str, path['seeds']))}" if path["seeds"] else "")
              for path in record["paths"] if path["use"] == "fit"]
    lines += ["subsection continuum", *("  set " + one.removeprefix("continuum/") for one in record["settings"])]
    lines += [f"  # {own['target']}: set {own['key']} = {_diptych.text_of_number(own['value'])}" for own in record["own"]]
    return "\n".join(lines + ["end", ""])


def _table(record: dict[str, Any]) -> str:
    def text(value: Any) -> str:
        return str(int(value)) if isinstance(value, bool) else f"{value:.10g}" if isinstance(value,
                                                                                             (float,
                                                                                              np.floating)) else str(value)

    rows = [",".join([path["name"], path["use"], *(text(one[name]) for name in COLUMNS)])
            for path in record["paths"] for one in path["observables"]]
    return "\n".join([",".join(["path", "use", *COLUMNS]), *rows, ""])


def write_calibration(directory: str, record: dict[str, Any], cpu_s: dict[str, float]) -> None:
    """Writes calibration.json, calibration.csv (a row per observable), calibration_cost.json and calibrated.prm."""
    paths = [{**path, "predictions": [{key: value for key, value in one.items() if key != "test"}
                                      for one in path["predictions"]]}
             for path in record["paths"]]
    write_json(directory + "/calibration.json", {**record, "paths": paths})
    write_json(directory + "/calibration_cost.json", {"continuum_cpu_s": cpu_s["continuum"], "grains_cpu_s": cpu_s["discrete"]})
    write_text(directory + "/calibration.csv", _table(record))
    write_text(directory + "/calibrated.prm", _fragment(record))
