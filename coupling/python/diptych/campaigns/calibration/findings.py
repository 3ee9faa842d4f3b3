# diptych: the results of a calibration as records, text and files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""calibration.json holds a dict: its keys are listed here, their meanings in README_calibration.md."""

import os
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
import scipy.stats

from ... import _diptych
from ...arrays import Array, Interval, ends_text
from ..runs.coordinates import Coordinates
from .noise import ANGLE, Noise, covariance, covariance_of_mean
from .posterior import Draws
from .observations import PEAK, Observation, Path
from .search import NORMAL, PRIOR, Fit, difference_jacobian
from .trials import Trials
from ..runs.folders import write_json, write_text
from ..runs.input_file import seeds_text
from ..runs.key_numbers import QUANTITIES
from ..runs.statistics import Difference, line_statistics, paired, statistics

NORMAL_95 = 1.6448536269514722  # 95 % quantile
WIDEST = 1.3  # deviations of posterior / prior; two valleys in one posterior can reach this
CUT = 0.04  # to a bound, in the unit cube: an interval ends there
LARGEST_SHARE = 2 / 3  # of the prior deviation that an identified parameter keeps
STRENGTHS = [key for key, one in QUANTITIES.items() if one["margin"] == QUANTITIES[PEAK]["margin"]]
NAMES = {**{key: one["name"] for key, one in QUANTITIES.items()}, "volumetric_strain": "volumetric strain, last bin",
         "width_10_90": "width 10–90, last window, d", "angle_deg": "inclination, last window, degrees"}
COLUMNS = ("kind", "from", "to", "count", "mean", "deviation", "deviation_of_mean", "before", "after",
           "parameter_deviation", "half_step", "counts", "discrepancy", "discrepancy_deviation")


def parameter_records(coordinates: Coordinates, draws: Array, best: Array) -> list[dict[str, Any]]:
    """Values of the best point, medians and 95 % intervals of the draws; numbers are those of the coordinates. A
    parameter that the data do not identify has no interval."""
    inner = np.quantile(draws, [0.025, 0.5, 0.975], axis=0)
    numbers = np.transpose([coordinates.numbers(one) for one in draws])
    prior = scipy.stats.truncnorm(-coordinates.start / PRIOR, (1 - coordinates.start) / PRIOR, scale=PRIOR).std()
    share = draws.std(0, ddof=1) / prior
    known = np.where(share < LARGEST_SHARE, 1, np.nan)
    of_values = np.quantile([coordinates.values(one) for one in draws], [0.025, 0.975], axis=0) * known
    low, median, high, at_best = (coordinates.numbers(one) for one in (*inner, best))
    low, high = low * known, high * known
    return [{"key": p.key, "targets": list(p.targets), "coordinate": p.coordinate, "of": p.other, "low": p.low,
             "high": p.high, "start": p.start, "number": at_best[k], "number_low": low[k], "number_median": median[k],
             "number_high": high[k], "value": value, "value_low": of_values[0, k], "value_high": of_values[1, k],
             "is_outside": bool(not inner[0, k] <= best[k] <= inner[2, k]),
             "share_known": share[k], "is_identified": bool(known[k] == 1),
             "is_cut": bool(inner[0, k] < CUT or inner[2, k] > 1 - CUT), "draws": numbers[k]}
            for k, (p, value) in enumerate(zip(coordinates.parameters, coordinates.values(best)))]


def name_of(parameter: dict[str, Any]) -> str:
    """The key of a parameter, and its targets if it is not common to all."""
    return parameter["key"] + (f" ({', '.join(parameter['targets'])})" if parameter["targets"] else "")


def doubts(parameters: Sequence[dict[str, Any]], has_converged: bool, emulator: dict[str, Any]) -> str:
    """The sentence that replaces all intervals if the posterior is none; empty if they hold."""
    outside, wide = ([name_of(p) for p in parameters if of(p)] for of in (
        lambda p: p["is_outside"], lambda p: p["share_known"] > WIDEST))
    reasons = [] if has_converged else ["the search has not converged"]
    reasons += [f"the best point lies outside its own posterior in {', '.join(outside)}"] if outside else []
    reasons += [f"the posterior is wider than the prior in {', '.join(wide)}"] if wide else []
    if 2 * emulator["failed"] > emulator["more_runs"]:
        reasons += [f"{emulator['failed']} of {emulator['more_runs']} runs at draws of the posterior failed"]
    return f"No intervals: {'; '.join(reasons)}." if reasons else ""


def finding_words(record: dict[str, Any]) -> list[str]:
    """Three lines: status, largest misfit, and the values that were kept. record["findings"]: why others were not."""
    found = [(abs(one["difference"].value) / one["margin"], one, path) for path in record["paths"]
             for one in path["predictions"] if np.isfinite(one["difference"].value)]
    counts = Counter(one["verdict"] for path in record["paths"] for one in path["predictions"])
    misfit = "largest misfit: no number could be compared"
    if found:
        size, one, path = max(found, key=lambda entry: entry[0])
        misfit = (f"largest misfit: {path['name']} ({one['use']}): {one['name']}: {one['after']:.4g} instead of "
                  f"{one['data']:.4g}, {size:.2g} times the margin, {one['verdict']}; all comparisons: "
                  + ", ".join(f"{count} {verdict}" for verdict, count in counts.items()))
    values = [name_of(p) + (" (not identified)" if not p["is_identified"] else " (its interval ends at a bound)"
                            if p["is_cut"] else "") for p in record["parameters"]]
    kept = ", ".join(map(name_of, record["parameters"]) if record["no_intervals"] else values)
    return [f"{record['no_intervals'] or 'Converged.'} chi^2 of {record['n_observables']} observables: "
            f"{_chi2(record['chi2_before'])} before, {_chi2(record['chi2'])} calibrated",
            misfit, "; ".join([f"kept in calibrated.prm: {kept}", *record["findings"]])]


def discrepancy_record(noise: Noise, draws: Draws, paths: int) -> dict[str, Any]:
    """Sizes of the discrepancy after the first strains and its correlation strain, before and after the data."""
    units = [noise.stress_discrepancy, noise.volume_discrepancy, 1]
    found = np.quantile(draws.sizes, [0.5, 0.025, 0.975], axis=0) * units
    names, before = ("stress_ratio", "volumetric_strain", "correlation_strain"), [*units[:2], draws.strain]
    return {"paths": paths, **{key: {"before": value, "found": Interval(*three)}
                               for key, value, three in zip(names, before, found.T)}}


def discrepancy_words(record: dict[str, Any], model: str) -> str:
    """The misfit of the model that scatter does not explain."""
    parts = [f"{name} {unit * found[0]:.2g}{ends_text(*(unit * end for end in found[1:]), '{:.2g}'.format)}"
             for key, name, unit in (("stress_ratio", "t/s", 1), ("volumetric_strain", "volume, %", 100))
             for found in [record[key]["found"]]]
    of = "law" if model == "continuum" else "grains"
    return (f"discrepancy of the {of}, deviation: {', '.join(parts)}"
            + ("; one path alone tells little of it" if record["paths"] == 1 else ""))


def widened(test: Difference, deviation: float) -> Difference:
    """The difference if its second part has an independent deviation. The squares of the half widths are added."""
    def wide(interval: Interval, half: float) -> Interval:
        value, low, high = interval
        return Interval(value, value - np.hypot(value - low, half), value + np.hypot(high - value, half))

    return Difference(test.n, wide(test.difference, NORMAL * deviation),
                      wide(test.difference_90, NORMAL_95 * deviation))


def measured(mean: float, deviation: float, now: float, kind: str) -> Difference:
    """now minus a measured mean with a known normal deviation, "relative" or "absolute". An end is NaN if the interval
    of a mean that is divided by reaches zero."""
    def interval(quantile: float) -> Interval:
        ends = np.array([mean, mean + quantile * deviation, mean - quantile * deviation])
        return Interval(*(now / np.where(ends > 0, ends, np.nan) - 1 if kind == "relative" else now - ends))

    return Difference(1, interval(NORMAL), interval(NORMAL_95))


def predictions(path: Path, runs: Sequence[Observation], deviations: Array) -> list[dict[str, Any]]:
    """Single numbers of a path with verdicts: two one-sided tests against the margins of the scene.

    deviations: (observables), of `after`: from the parameters if the path was not fitted, and from runs of grains; they
    widen the intervals. That of an angle that is no observable is unknown: the fit has no derivative. Near a flat peak
    the largest running mean moves as the largest mean over a bin does.
    The deviation given with a measurement replaces the scatter of samples; that of its peak is the one of its largest
    bin.
    """
    margins, (before, after) = path.scene.dict()["comparison"], runs
    places = {one.kind: k for k, one in enumerate(path.data.observables)}  # the last of each kind
    of_stress = [k for k, one in enumerate(path.data.observables) if one.kind == "stress_ratio"]
    found = []

    def add(quantity: str, values: Sequence[float], margin: str, kind: str, k: int | None, *,
            given: float = np.nan) -> None:
        """values: before, after, and of the samples. k: whose deviation counts. given: that of the data."""
        earlier, now, *grains = values
        mean, deviation = (line_statistics if kind == "line" else statistics)(grains).mean, np.nan
        test = measured(mean, given, now, kind) if np.isfinite(given) else paired(grains, [now] * len(grains), kind)
        if k is not None and deviations[k] != 0:  # NaN: unknown, and so is the interval
            deviation = deviations[k] * (1 / peak if quantity in STRENGTHS else now / mean if quantity == "width_10_90"
                                         else 1)
            test = widened(test, deviation)
        counts = k is not None and not path.left_out[k] and np.isfinite(path.data.mean[k])
        found.append({"quantity": quantity, "name": NAMES[quantity], "data": mean,
                      "use": "predicted" if not path.target.is_fitted else "fitted" if counts else "not fitted",
                      "before": earlier, "after": now, "difference": test.difference, "margin": margins[margin],
                      "verdict": test.verdict(margins[margin]), "parameter_deviation": deviation})

    everything = [before, after, *path.samples]
    peak = statistics([s.numbers.get(PEAK, np.nan) for s in path.samples]).mean
    for key in STRENGTHS:
        values = [s.numbers.get(key, np.nan) for s in everything]
        if np.isfinite(values[2:]).any():
            given = max([(path.data.mean[k], path.data.given[k]) for k in of_stress if np.isfinite(path.data.mean[k])],
                        default=(np.nan, np.nan))[1] if key == PEAK else np.nan
            add(key, values, QUANTITIES[key]["margin"], QUANTITIES[key]["difference"],
                max(of_stress, key=lambda k: after.values[k], default=None), given=given)
    if "volumetric_strain" in places:
        k = places["volumetric_strain"]
        add("volumetric_strain", [s.values[k] for s in everything], "margin_volumetric_strain", "absolute", k,
            given=path.data.given[k])
    if "ln_width" in places:  # in the fit only, half the height replaces a missing band
        k = places["ln_width"]
        widths = [float(np.exp(s.values[k])) for s in everything]
        widths[:2] = [width if np.isfinite(s.angle_deg) else np.nan for width, s in zip(widths, runs)]
        add("width_10_90", widths, "margin_thickness", "relative", k, given=widths[2] * path.data.given[k])
    if {"ln_width", ANGLE} & set(places):
        k = places.get(ANGLE)
        add("angle_deg", [s.angle_deg for s in everything], "margin_angle", "line", k,
            given=np.nan if k is None else path.data.given[k])
    return found


def path_record(path: Path, noise: Noise, runs: Sequence[Observation], deviations: Array) -> dict[str, Any]:
    """runs: before, calibrated, and calibrated with half the load step. deviations: (observables), from the parameters.
    Curves: mean of the samples, plus and minus two deviations of one sample, and of the model."""
    before, after, halved = runs
    data = path.data
    deviation, of_mean = (np.sqrt(np.diag(of(noise, data))) for of in (covariance, covariance_of_mean))
    own = np.hypot(np.zeros_like(deviations) if path.target.is_fitted else deviations,  # of `after`
                   np.sqrt(np.diag(covariance(noise, path.of_noise)) / data.runs) if data.runs else 0)
    observables = [{"kind": one.kind, "from": one.low,
                    "to": one.high, "count": int(data.count[k]), "mean": data.mean[k], "deviation": deviation[k],
                    "deviation_of_mean": of_mean[k], "before": before.values[k], "after": after.values[k],
                    "parameter_deviation": deviations[k], "half_step": halved.values[k] - after.values[k],
                    "counts": False, "discrepancy": np.nan, "discrepancy_deviation": np.nan,
                    "left_out": path.left_out[k]} for k, one in enumerate(data.observables)]
    record = {"name": path.target.name, "use": "fit" if path.target.is_fitted else "predict",
              "walk": path.scene.loading_variable(),
              "seeds": path.target.seeds, "curve": os.path.basename(path.target.measured or path.target.curve),
              "failed": after.failure, "observables": observables, "progress": path.samples[0].progress,
              "predictions": predictions(path, (before, after), own)}
    for name, key in (("stress_ratio", "stress_ratio"), ("volumetric_strain", "volume")):
        record |= with_scatter(key, np.array([getattr(s, name) for s in path.samples]))
        for end, o in (("_before", before), ("_after", after)):
            record[key + end] = [] if o.failure else getattr(o, name)
        if after.samples:
            record |= with_scatter(key + "_after", np.array([getattr(s, name) for s in after.samples]))
    return record


def with_scatter(key: str, curves: Array) -> dict[str, Array]:
    """Mean of curves (sample, point), plus and minus two deviations of one sample; NaN for a single one."""
    spread = 2 * curves.std(0, ddof=1) if len(curves) > 1 else np.full(curves.shape[1], np.nan)
    return {key: curves.mean(0), key + "_low": curves.mean(0) - spread, key + "_high": curves.mean(0) + spread}


def report(trials: Trials, best: Fit, searches: Sequence[Fit], draws: Draws) -> None:
    """searches: on the samples' own mesh and on the coarse mesh, or the only one."""
    record = trials.record
    record["parameters"] = parameter_records(trials.coordinates, draws.points, best.point)
    record["correlation"] = np.corrcoef(draws.points, rowvar=False).reshape(2 * (len(trials.coordinates),))
    record["discrepancy"] = discrepancy_record(trials.noise, draws, len(trials.fitted))
    meshes = [("on the samples' own mesh ", "fine_jacobians"), ("on the coarse mesh ", "jacobians")]
    meshes = meshes if len(searches) > 1 else [("", "jacobians")]
    record["has_converged"] = not all(fit.note for fit in searches)
    record["no_intervals"] = doubts(record["parameters"], not searches[0].note, record["emulator"])
    if record["no_intervals"]:
        for p in record["parameters"]:
            p |= dict.fromkeys(("number_low", "number_median", "number_high", "value_low", "value_high"), np.nan)
            p |= {"is_identified": False, "draws": []}
    else:
        record["words"].append(discrepancy_words(record["discrepancy"], record["model"]))
    record["words"] += [f"{mesh}{fit.note}; allow more Jacobians by `{key}`"
                        for (mesh, key), fit in zip(meshes, searches) if fit.note]
    record["words"] += trials.failure_words()


def predict(trials: Trials, best: Array, jacobian: Array, draws: Draws) -> None:
    """All paths on their own meshes: before, calibrated, and calibrated with half the load step."""
    trials.keep(best)
    jacobian = np.linalg.solve(trials.data.root, jacobian[:len(trials.data.mean)])  # of the observables
    spread, curve = np.atleast_2d(np.cov(draws.points, rowvar=False)), iter(draws.curve.T)
    if trials.record["no_intervals"]:
        spread = np.full_like(spread, np.nan)
    trials.record["other_runs"] += 3 * len(trials.paths)
    calibrated = [trials.settings(best, path.target.name) for path in trials.paths]
    step, uncalibrated = trials.calibration.load_step, [path.target.before for path in trials.paths]
    before, after = trials.run(trials.paths, [uncalibrated, calibrated], True, step)
    [halved] = trials.run(trials.paths, [calibrated], True, 0.5 * step)
    used = iter(trials.data.used)
    for path, *runs in zip(trials.paths, before, after, halved):
        here = _jacobian_on(trials, path, best, jacobian)
        deviations = np.sqrt(np.diag(here @ spread @ here.T))
        trials.record["paths"].append(path_record(path, trials.noise, runs, deviations))
        for one in trials.record["paths"][-1]["observables"] if path.target.is_fitted else ():
            one["counts"], (one["discrepancy"], one["discrepancy_deviation"]) = bool(next(used)), next(curve)
    for key, runs, words in (("chi2_before", before, "with the parameters before the calibration"),
                             ("chi2", after, "with the calibrated parameters")):
        values = [one.values for path, one in zip(trials.paths, runs) if path.target.is_fitted]
        chi2 = trials.chi2(trials.data.residual(np.concatenate(values)))
        if np.isfinite(chi2):  # else that of the search stays
            trials.record[key] = chi2
        trials.record["words"] += [f"{words} '{path.target.name}' did not finish: {one.failure}"
                                   for path, one in zip(trials.paths, runs) if one.failure]
    trials.record["findings"] = finding_words(trials.record)


def _jacobian_on(trials: Trials, path: Path, best: Array, jacobian: Array) -> Array:
    """(observables, parameters) of a path: the fit's if the path was fitted; else differences on the coarse mesh."""
    n, at = len(path.data.observables), 0
    for other in trials.fitted:
        same = all(p.is_of(path.target.name) == p.is_of(other.target.name) for p in trials.coordinates.parameters)
        if same and path.target.is_same_path(other.target):
            return jacobian[at:at + n]
        at += len(other.data.observables)

    def values(points: Sequence[Array]) -> list[Array]:
        return [runs[0].values for runs in trials.runs(points, [path], False, "other_runs")]

    here = values([best])[0]
    measured, result = np.isfinite(here), np.full((n, len(best)), np.nan)
    if measured.any():
        result[measured] = difference_jacobian(lambda points: [one[measured] for one in values(points)], best,
                                               here[measured], trials.difference)
    return result


def _chi2(value: float) -> str:
    return f"{value:.4g}" if np.isfinite(value) else "(not finished)"


def summary(record: dict[str, Any], cost: dict[str, float]) -> str:
    """The result for the terminal: findings first, then values, remarks and cost."""
    lines = [f"{record['title']}: {record['findings'][0]}", *("  " + words for words in record["findings"][1:])]
    for p in record["parameters"]:
        share = f" ({p['coordinate']} {p['of']} {p['number']:.3g})" if p["of"] else ""
        lines.append(f"  {name_of(p)} = {p['value']:.4g}{ends_text(p['value_low'], p['value_high'])}{share}")
    runs = (f"{record['coarse_runs']} coarse and {record['fine_runs']} fine runs, " if record["model"] == "continuum"
            else f"{record['coarse_runs']} runs of all seeds, ")
    return "\n".join([*lines, *("  " + words for words in record["words"]),
                      f"  {runs}{record['other_runs']} of predictions, {cost['total_cpu_s']:.3g} CPU s with all "
                      f"workers (grains {cost['grains_cpu_s']:.3g}, continuum {cost['continuum_cpu_s']:.3g})"])


def _origin(record: dict[str, Any]) -> str:
    """Paths, curves and seeds of the fit, in one line without the sign of a comment: a value in a scene file."""
    fitted = [path for path in record["paths"] if path["use"] == "fit"]
    paths = [", ".join(filter(None, [path["name"], path["curve"],
                                     path["seeds"] and f"seeds {seeds_text(path['seeds'])}"])) for path in fitted]
    status = "" if record["status"] == "finished" else f" ({record['status']})"
    return " ".join(f"calibrated on {'; '.join(paths) or record['title']}{status}".replace("#", "").split())


def _fragment(record: dict[str, Any]) -> str:
    """calibrated.prm. A run that takes a continuum from it shows its origin."""
    origin, section = _origin(record), "continuum" if record["model"] == "continuum" else "discrete"
    lines = [f"# {origin}, by diptych {_diptych.git_revision}"]
    if record["status"] == "finished":
        lines += [f"# chi^2 of {record['n_observables']} observables: {_chi2(record['chi2_before'])} before, "
                  f"{_chi2(record['chi2'])} now; calibration.json holds intervals"]
    lines += [f"subsection {section}", *("  set " + one.removeprefix(section + "/") for one in record["settings"])]
    lines += [f"  # {own['target']}: set {own['key'].removeprefix(section + '/')} = "
              f"{_diptych.text_of_number(own['value'])}"
              for own in record["own"]]
    if section == "continuum":
        lines += ["end", "", "subsection comparison", f"  set parameters_from = {origin}"]
    return "\n".join(lines + ["end", ""])


def posterior_table(coordinates: Coordinates, draws: Array) -> pd.DataFrame:
    """A row per draw, a column per parameter: values of the keys. Targets of an own value follow the key."""
    names = [name_of({"key": p.key, "targets": p.targets}) for p in coordinates.parameters]
    return pd.DataFrame([coordinates.values(point) for point in draws], columns=names)


def write_calibration(directory: str, record: dict[str, Any], cost: dict[str, float],
                      posterior: pd.DataFrame | None) -> None:
    """Writes calibration.json, calibration.csv (a row per observable), calibration_cost.json and calibrated.prm; and
    posterior.csv (a row per draw) if its intervals hold. One of an earlier run is removed."""
    rows = [{"path": path["name"], "use": path["use"], **one} for path in record["paths"]
            for one in path["observables"]]
    table = pd.DataFrame(rows, columns=["path", "use", *COLUMNS]).astype({"counts": int})
    write_json(directory + "/calibration.json", record)
    form, draws = "%.10g", directory + "/posterior.csv"
    write_json(directory + "/calibration_cost.json", cost)
    write_text(directory + "/calibration.csv", table.to_csv(index=False, float_format=form, na_rep="nan"))
    if posterior is not None and not record["no_intervals"]:
        write_text(draws, posterior.to_csv(index=False, float_format=form))
    elif os.path.exists(draws):
        os.remove(draws)
    write_text(directory + "/calibrated.prm", _fragment(record))
