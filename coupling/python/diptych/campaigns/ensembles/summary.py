# diptych: the numbers of an ensemble that a user asks for first
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the summary of a single run, with means over the samples, their 95 % intervals and verdicts."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ... import _diptych
from ...entries import describe
from ..measured.folder import PANES
from ..runs.engine import columns_text
from ..runs.key_numbers import QUANTITIES
from ..runs.statistics import Interval, line_statistics, statistics, words_of

MEAN = """\
unit (text): unit of the quantity
n: number of members with a value
mean [as in unit]: mean over the members
deviation [as in unit]: standard deviation of one member
low [as in unit]: lower end of the 95 % Student interval of the mean
high [as in unit]: upper end of the same interval
"""

describe("ensemble.json", """\
format: version of this file's format
scene (text): name of the scene
seeds (list): requested seeds
folders (list): result folders of the members, in the order of seeds
done (list): seeds of the finished members
failed/: seeds whose run ended with an exit code other than 0
    seed: seed of the member
    exit_code: exit code of its run; 128 + signal if a signal ended it
    message (text): last line of its log
interrupted (list): seeds that were stopped or not started
margins/: margins of the scene
    margin_angle [degrees]: largest difference of the bands' inclinations that counts as equivalent in an ensemble of \
        seeds
    margin_thickness: largest difference of the bands' 10-90 % widths that counts as equivalent in an ensemble of \
        seeds, relative to the mean of the grains
    margin_peak_stress_ratio: largest difference of peak stress ratios, and of strengths (T/S beyond 0.3 % strain), \
        that counts as equivalent in an ensemble of seeds, relative to the mean of the grains
    margin_volumetric_strain: largest difference of the volumetric strains at the end that counts as equivalent in an \
        ensemble of seeds (absolute)
walk (text): loading variable: axial_strain, shear_strain or time
folded (yes or no): true if mirror images of bands were folded together
student_t_95: half width of the intervals in standard errors; null for less than two members
summary/: the numbers that a user asks for first, with the rows of the summary of a single run
    key (text): key of the quantity
    quantity (text): name of the quantity
    unit (text): unit of the numbers
    grains (interval) [as unit says]: mean of the grains over the samples
    continuum (interval) [as unit says]: mean of the continuum over the samples
    difference (interval) [as unit says]: mean of continuum minus grains, sample by sample
    verdict (text): equivalent, different or cannot tell, with the margin; or diffuse; or not in both panels
checks/: limits within which the results of a member are reliable; with --levels without that of the impacts
    key (text): place of the checked number in comparison.json
    name (text): name of the checked number
    limit: largest magnitude at which the results are reliable
    reason (text): meaning of a value beyond the limit
    n: number of members with the check
    broken (list): seeds of the members that break it
levels/: with --levels only: means of the grains in the limit of short steps
    cheap: discrete/accuracy of all samples
    fine: discrete/accuracy of the second run of some samples, the pairs
    seeds (list): seeds of the pairs
    quantities/: quantities of the grains whose bias follows the rule of the step
        key (text): key of the quantity
        quantity (text): name of the quantity
        unit (text): unit of the quantity
        n: number of samples with a value
        pairs: number of pairs with both values
        ratio: expected error of the fine setting divided by that of the cheap one
        cheap [as in unit]: mean of all samples at the cheap setting
        difference [as in unit]: mean of cheap minus fine over the pairs
        limit (interval) [as in unit]: mean in the limit of short steps
        error_samples [as in unit]: standard error of the limit due to the scatter of samples and pairs
        error_order [as in unit]: standard error of the limit due to the order of the bias in the step
        fine (list) [as in unit]: values at the fine setting, in the order of done; null without a pair
quantities/: every number of comparison.json that may be averaged
    name (text): name of the quantity: stage or window, panel and key of comparison.json
""")
describe("ensemble.json", MEAN, below="quantities/")
describe("ensemble.json", """\
quantities/values (list) [as in unit]: values of the members, in the order of done; null if a member has none
bands/: number of bands found
    name (text): window and panel
    none: number of members without a band
    one: number of members with one band
    two: number of members with two bands
    text (text): the same as text
verdicts/: verdicts on the differences of the panels
    key (text): key of the quantity in summary; a band has one verdict per window
    window (text): window of a band, as in its name; empty: the panel's whole run
    quantity (text): compared quantity: continuum minus grains, member by member
    unit (text): unit of the quantity
    margin [as in unit]: largest difference that counts as equivalent
    relative (yes or no): true if margin and difference are relative to the mean of the grains
    difference (interval) [as in unit]: mean difference; the interval holds all known parts of u_val
    difference_90 (interval) [as in unit]: mean difference with its 90 % interval, on which the verdict equivalent rests
    n: number of pairs
    diffuse: number of members without an angle, because the zone is diffuse
    verdict (text): equivalent, different or cannot tell; without a pair diffuse or not in both panels
    discrete (list) [as in unit]: values of the grains, in the order of done
    continuum (list) [as in unit]: values of the continuum, in the order of done
validation/: errors and standard uncertainties as in ASME V&V 20, in the order of verdicts
    key (text): key of the quantity, as in verdicts
    quantity (text): compared quantity
    unit (text): unit of the quantity
    n: number of samples with a value in both panels
    S [as in unit]: mean of the continuum over these samples
    D [as in unit]: mean of the grains over the same samples
    E (interval) [as in unit]: error S - D; the interval holds all known parts of u_val
    u_num [as in unit]: uncertainty of the numerical methods: the known ones of the parts; null if none is known
    u_input [as in unit]: uncertainty of the calibrated parameters; null without posterior.csv
    u_D [as in unit]: standard error of the mean difference over the samples; null for less than two
    u_val [as in unit]: root of the sum of squares of u_num, u_input and u_D; parts that are not known count as 0
    ratio: |E| / u_val
    parts/: parts of u_num; null if not known
        grains_step [as in unit]: uncertainty from the time step of the grains
        mesh [as in unit]: uncertainty from the mesh of the continuum
        load_step [as in unit]: uncertainty from the load step of the continuum
    not_known (list): parts that are not known
    verdict (text): equivalent, different or cannot tell
continuum_runs/: runs of the continuum on the coarse mesh for load step and parameters
    seed: seed of their sample; null without runs
    scenes (list): hashes of their scenes: half the load step, then draws of the parameters
    quantities (list): names of the quantities
    values (list): a row per run with the values of the quantities; null without a value
""")

describe("ensemble.csv", "quantity: stage or window, panel and key of comparison.json; the members are columns seed_N",
         "column")
describe("ensemble.csv", MEAN, "column")

describe("ensemble.h5", """\
progress (numbers) [strain or time]: progress; points of the curves
seeds (whole numbers): seeds; seeds of the members, one per row
averaging_width (attribute, number) [strain or time]: width of the running means
""")

describe("ensemble.h5, groups PANEL/stress_ratio and PANEL/volumetric_strain", """\
members (rows of numbers): every member; running mean, one row per seed; nan beyond the end of a history
mean (numbers): mean; mean over all members; nan if a member has no value
low (numbers): lower end; lower end of the 95 % Student interval of the mean; nan like the mean
high (numbers): upper end; upper end of the same interval; nan like the mean
""")

describe("ensemble.h5, groups window_N/profile/PANEL", """\
distance (numbers) [mean diameters]: distance from the band; middles of the strips, along the band's normal
""")

describe("ensemble.h5, groups window_N/profile/PANEL/CURVE", """\
mean (numbers) [as in comparison.h5]: mean; mean over the members with a value; nan: fewer than two
standard_error (numbers) [as in comparison.h5]: standard error; standard error of this mean; nan: fewer than two
low (numbers) [as in comparison.h5]: low; lower end of its 95 % Student interval; nan: fewer than two
high (numbers) [as in comparison.h5]: high; upper end of the same interval; nan: fewer than two
""")


def summary(member: Mapping[str, dict[str, Any]], record: dict[str, Any]) -> list[dict[str, Any]]:
    """One row per quantity in the summary of a member's comparison.json, by key. record: quantities and verdicts as in
    ensemble.json.

    Differences are continuum - grains in the unit of the row; verdicts are those of the record, with their margins."""
    # A band has a verdict per window; that of the last window replaces the earlier ones.
    verdicts, validation = ({one["key"]: one for one in record[part]} for part in ("verdicts", "validation"))
    return [{"key": key, "quantity": row["quantity"], "unit": row["unit"],
             "grains": _mean(key, verdicts[key]["discrete"]), "continuum": _mean(key, verdicts[key]["continuum"]),
             "difference": validation[key]["E"], "verdict": words_of(verdicts[key])} for key, row in member.items()]


def _mean(key: str, values: Sequence[float]) -> Interval:
    return (line_statistics if QUANTITIES[key]["difference"] == "line" else statistics)(values).interval()


def checks_of(members: Mapping[int, Sequence[dict[str, Any]]]) -> list[dict[str, Any]]:
    """The entry checks of ensemble.json. members: those of comparison.json by seed."""
    every = [(seed, check) for seed, checks in members.items() for check in checks]
    first = {check["key"]: check for _, check in reversed(every)}
    return [{**{name: check[name] for name in ("key", "name", "limit", "reason")},
             "n": sum(one["key"] == key for _, one in every),
             "broken": [seed for seed, one in every if one["key"] == key and not one["kept"]]}
            for key, check in sorted(first.items())]


def text_of_checks(checks: Sequence[dict[str, Any]]) -> str:
    """The count, and a line per check that a member breaks."""
    broken = [one for one in checks if one["broken"]]
    lines = [f"{one['name']}, limit {one['limit']:.2g}, in {len(one['broken'])} of {one['n']} samples: {one['reason']}"
             for one in broken]
    return "\n  ".join([_diptych.count_of_checks(len(broken), len(checks)), *lines])


def table_of(record: Mapping[str, Any]) -> pd.DataFrame:
    """summary.csv, with the columns of a single run; the last row counts the checks."""
    parts = ("grains", "continuum", "difference")
    rows = [[row["quantity"], row["unit"], *(end for part in parts for end in row[part]), row["verdict"]]
            for row in record["summary"]]
    ends = [part + end for part in parts for end in ("", "_low", "_high")]
    count = text_of_checks(record["checks"]).partition("\n")[0]
    table = pd.DataFrame(rows, columns=["quantity", "unit", *ends, "verdict"])
    against = pd.DataFrame([{"quantity": row["quantity"], "unit": row["unit"], "measured": row["D"],
                             PANES[row["panel"]]: row["S"], "difference": row["E"].value,
                             "difference_low": row["E"].low, "difference_high": row["E"].high,
                             "verdict": row["verdict"]}
                            for row in record.get("measured", {}).get("rows", [])])
    return pd.concat([table, against, pd.DataFrame([{"quantity": "checks", "unit": "-", "verdict": count}])])


def text_of(rows: Sequence[dict[str, Any]]) -> str:
    """The table of a terminal, one line per quantity."""
    return columns_text([["", "grains", "continuum", "difference [95 %]", "verdict"],
                         *([row["quantity"] + ("" if row["unit"] == "-" else f" [{row['unit']}]"),
                            *(row[key].text() for key in ("grains", "continuum", "difference")), row["verdict"]]
                           for row in rows)])
