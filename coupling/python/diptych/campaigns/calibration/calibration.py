# diptych: the command calibrate: parameters of a continuum from grains or curves, or of grains from curves
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Four phases: reading.py checks and takes the data, trials.py searches, posterior.py samples the posterior of the
parameters, findings.py computes the effect of load steps half as long and predictions on paths that were not fitted."""

import argparse
import json
import os
from typing import Any

import numpy as np
import pandas as pd

from ...entries import describe
from ...errors import NotConverged, Stopped
from ..runs.engine import Options, say, tell
from ..runs.folders import Folder, draw
from .calibration_file import read_calibration
from .calibration_runs import CalibrationRuns
from .findings import posterior_table, predict, report, summary, write_calibration
from .grains import GrainRuns
from .posterior import confirmed, sample_posterior
from .reading import check_data, checked, inputs_of, standard_contents, with_data
from .trials import Trials, search

describe("calibration.json", """\
format: version of this file's format
title (text): title of the calibration
model (text): continuum or grains: what the parameters belong to
status (text): finished, or the reason why it stopped early
settings (list): best settings so far: the keys of calibrated.prm
own/: values that belong to single targets
    target (text): target that the value belongs to
    key (text): key of the section continuum, or discrete/KEY
    value [as the key says]: best value so far
chi2_before: chi^2 before the calibration
chi2_coarse: chi^2 at the best point of the coarse mesh
chi2: chi^2 of the calibrated continuum or grains
n_observables: number of observables in the fit
coarse_runs: coarse runs of the fit and the emulator; of grains: points, each with all seeds
fine_runs: runs of the fit on the samples' own meshes
failed_runs: coarse and fine runs that were refused or did not finish; words tells the commonest reason
other_runs: runs for the predictions
noise/: scatter of one sample
    stress_level: standard deviation of the shift of a sample's whole t/s curve
    stress_shape: standard deviation of t/s about the shifted curve
    correlation_strain: strain over which the shape is correlated
    volume_start: standard deviation of the volumetric strain: constant part
    volume_growth: standard deviation of the volumetric strain: part that grows with strain, per strain
    ln_width: standard deviation of the logarithm of a band's width
    degrees_of_freedom: number of samples minus number of paths
no_intervals (text): why no interval is given; empty if the intervals hold
has_converged (yes or no): true if a search has converged, on the coarse mesh or on the samples' own
findings (list): status, largest misfit, and the values that were kept
words (list): remarks on data, runs and search
parameters/: fitted parameters
    key (text): key of the section continuum, or discrete/KEY
    targets (list): targets it belongs to; empty: one value for all
    coordinate (text): coordinate in which the search varies the key
    of (text): the key that a share or drop refers to
    low [as the coordinate says]: lower bound
    high [as the coordinate says]: upper bound
    start [as the coordinate says]: start of the first search
    number [as the coordinate says]: value of the coordinate at the most probable point, or that of the search
    number_low [as the coordinate says]: lower end of the 95 % interval of the posterior; null: not identified
    number_median [as the coordinate says]: median of the posterior
    number_high [as the coordinate says]: upper end of the same interval
    value [as the key says]: value of the key at that point
    value_low [as the key says]: lower end of the 95 % interval of the value
    value_high [as the key says]: upper end of the same interval
    share_known: deviation of the posterior / of the prior (a quarter of the range, cut at the bounds)
    is_identified (yes or no): true if the data leave less than two thirds of the prior deviation
    is_outside (yes or no): true if the best point lies outside the interval
    is_cut (yes or no): true if the interval ends at a bound
    draws (list) [as the coordinate says]: draws of the posterior; posterior.csv holds the values of the keys
correlation (list): correlation of the parameters in their coordinates, by the posterior
emulator/: emulator of the runs, and the sampling of the posterior
    runs: runs that carry the emulator: those of the search and more_runs that came to their end
    more_runs: coarse runs at points of a first, short sampling
    failed: more_runs that failed: their share of the posterior is cut off
    left_out: error of the last runs, each predicted from all others, in deviations of the data (rms)
    steps: steps of each of the 48 walkers; the second half counts
    acceptance: share of accepted steps
    autocorrelation [steps]: longest integrated autocorrelation of a parameter
discrepancy/: misfit of the law as a process over strain, estimated with the parameters
    paths: fitted paths on which it rests
""")
for name, meaning in (("stress_ratio", "deviation of the misfit of t/s after the first strains"),
                      ("volumetric_strain", "deviation of the misfit of the volumetric strain"),
                      ("correlation_strain", "strain over which the misfit is correlated")):
    describe("calibration.json", f"""\
{name}/: {meaning}
    before: its value before the data
    found (interval): median and interval of the posterior
""", below="discrepancy/")
describe("calibration.json", """\
minima/: one per start
    start (list) [as the coordinates say]: start of the search
    numbers (list) [as the coordinates say]: end of the search
    chi2: chi^2 of the data at the end, on the coarse mesh
    total: chi^2 of the data plus that of the prior, which the search minimises
    runs: runs of the continuum in this search
    is_best (yes or no): true if the search continued from here
    words (text): reason why the search did not converge; empty if it did
paths/: fitted and predicted paths
    name (text): name of the path
    use (text): fit or predict
    walk (text): loading variable of progress, from and to: axial_strain, shear_strain, path or time
    seeds (list): seeds of its samples of grains; empty if a continuum is fitted to a measured curve
    curve (text): file of the measured curve, or folder of the measured field; empty: the data are grains
    failed (text): reason why the calibrated continuum did not finish here; empty if it did
    observables/: numbers by which grains and continuum are compared
        kind (text): stress_ratio, volumetric_strain: mean over a bin; ln_width: logarithm of the band width in a \
            window, in mean diameters; angle: inclination of the band in degrees; strip_profile: displacement along \
            the band in a strip / travel
        from [strain or time]: start of the bin or window
        to [strain or time]: end of the bin or window
        count: samples that have this observable
        mean: mean of the grains over the samples, or of the measured curve
        deviation: standard deviation of one sample, by the noise model
        deviation_of_mean: standard deviation of the mean over the samples, with that of the grains that are fitted to \
            it
        before: value of the continuum before the calibration
        after: value of the calibrated continuum
        parameter_deviation: deviation of `after` that follows from the deviations of the parameters
        half_step: change of `after` if the load steps (the step of the grains) are half as long
        counts (yes or no): true if the fit uses this observable
        left_out (text): reason why the fit of its path does not use it; empty if it does
        discrepancy: estimated misfit of the law: model minus truth, mean of the posterior; null where the fit does \
            not use it
        discrepancy_deviation: its standard deviation
    predictions/: single numbers with verdicts
        quantity (text): peak_stress_ratio, peak_friction_angle_deg, peak_outline_stress_ratio, \
            peak_core_stress_ratio, peak_nominal_stress_ratio, friction_angle_deg, platen_force_pd, \
            volumetric_strain (last bin), width_10_90 (last window, mean diameters) or angle_deg
        name (text): its name on the page
        use (text): fitted, not fitted (the fit used only other kinds of observables of this path) or predicted
        data [as the quantity says]: mean of the grains
        before [as the quantity says]: value of the continuum before the calibration
        after [as the quantity says]: value of the calibrated continuum
        difference (interval) [as the margin says]: continuum minus grains; relative for strengths, force and width
        margin [as the quantity says]: largest difference that counts as equivalent
        verdict (text): equivalent, different or cannot tell; without a value not in both panels
        parameter_deviation [as the margin]: part of the deviation of the difference due to the parameters, or to the \
            scatter of fitted grains; null if the interval omits it (fitted paths, angles)
    progress (list) [strain or time]: loading variable at the points of the curves
""")
for name, meaning in (("stress_ratio", "t/s"), ("volume", "volumetric strain")):
    describe("calibration.json", f"""\
{name} (list): mean {meaning} of the grains
{name}_low (list): mean minus two standard deviations of one sample
{name}_high (list): mean plus two standard deviations of one sample
{name}_before (list): {meaning} of the continuum before the calibration
{name}_after (list): {meaning} of the calibrated continuum
{name}_after_low (list): fitted grains: mean minus two standard deviations of one sample
{name}_after_high (list): fitted grains: mean plus two standard deviations of one sample
""", below="paths/")

describe("calibration_cost.json", """\
continuum_cpu_s [s]: CPU time of all runs of the continuum
grains_cpu_s [s]: CPU time of all runs of the grains
total_cpu_s [s]: CPU time of this command with its workers, sampling included
""")


def empty_record(title: str, model: str = "continuum") -> dict[str, Any]:
    """calibration.json before the search. model: "grains" if their keys are fitted."""
    return {"format": 2, "title": title, "model": model, "status": "started",
            "settings": [], "own": [], "chi2_before": np.nan, "chi2_coarse": np.nan, "chi2": np.nan, "n_observables": 0,
            "coarse_runs": 0, "fine_runs": 0, "failed_runs": 0, "other_runs": 0, "noise": {},
            "no_intervals": "", "has_converged": False, "findings": [], "words": [],
            "parameters": [], "correlation": [], "emulator": {}, "discrepancy": {}, "minima": [], "paths": []}


def calibrate(trials: Trials) -> pd.DataFrame:
    """Fills the record; returns the draws of the posterior. Raises NotConverged if no start has a run."""
    fine, coarse = search(trials)
    draws = sample_posterior(trials, fine)
    best = confirmed(trials, fine, draws, fine is not coarse)
    report(trials, best, [fine, *([] if fine is coarse else [coarse])], draws)
    predict(trials, best.point, best.jacobian, draws)
    trials.record["status"] = "finished"
    return posterior_table(trials.coordinates, draws.points)


def run_calibration(line: argparse.Namespace, options: Options) -> None:
    """The command `diptych calibrate FILE`, or SCENE with --seeds. line: target, seeds, set, set_file and output.
    Raises Stopped or NotConverged, with the best point so far in the folder."""
    contents, before = standard_contents(line), sum(os.times()[:4])
    text = json.dumps(contents, indent=1) + "\n" if contents else ""
    calibration = read_calibration(line.target, contents)
    coordinates = checked(calibration)
    directory = line.output or f"results/{calibration.name}_calibration"
    record, posterior = empty_record(calibration.title, "grains" if calibration.of_grains else "continuum"), None
    ended: Stopped | NotConverged | None = None
    with Folder(directory) as folder:
        opened = folder.open_runs("calibration", line.target, options, lambda: inputs_of(calibration), text)
        if contents:
            say(options, f"standard parameters: {directory}/calibration_input.json")
        runs = (GrainRuns if calibration.of_grains else CalibrationRuns)(calibration, opened, options)
        try:
            paths = runs.paths()
            check_data(calibration, paths, runs, record)
            if not calibration.of_grains:
                coordinates.others["solid_fraction_start"] = runs.densest(paths)
            coordinates = with_data(coordinates, paths, record)
            posterior = calibrate(Trials(calibration, coordinates, paths, runs.evaluate, record,
                                         tell=lambda words: say(options, words)))
        except (Stopped, NotConverged) as error:
            record["status"], ended = error.why if isinstance(error, Stopped) else str(error), error
        opened.crew.close()
        cost = {"continuum_cpu_s": runs.cpu_s["continuum"], "grains_cpu_s": runs.cpu_s["discrete"],
                "total_cpu_s": sum(os.times()[:4]) - before}
        write_calibration(directory, record, cost, posterior)
        if not ended:
            tell(summary(record, cost))
            draw(options, directory, "calibration")
            say(options, f"{directory}/calibrated.prm, calibration.json, calibration.csv")
    if isinstance(ended, Stopped):
        raise Stopped(f"{ended.why}; what was found is kept in {directory}", options.again)
    if ended:
        raise NotConverged(f"{ended}; what was found is kept in {directory}; to go on: {options.again}")
    if not record["has_converged"]:
        raise NotConverged(f"the search has not converged; its best point is kept in {directory}; allow more Jacobians "
                           "in the calibration file, or change starts and bounds")
