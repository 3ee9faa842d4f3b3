# diptych: statistics, histories and ensembles on values with known answers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Needs no run of the program."""

import math

import h5py
import numpy as np
import pandas as pd
import pytest
from scipy import stats

import diptych
from diptych import scenes
from diptych.arrays import short
from diptych.campaigns.calibration.calibration_runs import observe_history
from diptych.campaigns.calibration.grains import mean_of
from diptych.campaigns.calibration.noise import Observable
from diptych.campaigns.ensembles import ensemble
from diptych.campaigns.runs import histories, members
from diptych.campaigns.runs import statistics
from diptych.campaigns.ensembles.profiles import profile_arrays
from diptych.campaigns.runs.input_file import read_seeds
from diptych.campaigns.runs.members import member_of
from diptych.campaigns.studies.study_file import quantity

FOUR = [1, 2, 3, 4]  # mean 2.5, deviation sqrt(5/3): the standard error of the mean is half of that


@pytest.mark.parametrize("degrees", [1, 2, 2.5, 7, 30])
def test_quantiles_invert_students_distribution(degrees):
    assert stats.t.cdf(statistics.student_quantile(0.975, degrees), degrees) == pytest.approx(0.975, rel=1e-14)


def test_the_interval_of_a_mean_is_students():
    s = statistics.statistics(FOUR)
    low, high = stats.t.interval(0.95, 3, loc=np.mean(FOUR), scale=stats.sem(FOUR))
    assert s == pytest.approx((4, 2.5, math.sqrt(5 / 3), low, high), rel=1e-9)
    assert statistics.statistics([3])[:2] == (1, 3) and math.isnan(statistics.statistics([3]).low)
    assert statistics.statistics([math.nan]).n == 0


def test_lines_across_the_vertical_have_a_vertical_mean():
    """Turns from 90: -5, 5, 0; the deviation is sqrt(50 / 2)."""
    s = statistics.line_statistics([85, -85, 90])
    assert (abs(s.mean), s.deviation) == pytest.approx((90, 5)) and s.low < s.mean < s.high
    assert statistics.line_statistics([-43, -45, -47]) == pytest.approx(statistics.statistics([-43, -45, -47]))
    assert math.isnan(statistics.line_statistics([10, -80]).mean)
    s = statistics.line_statistics([40, 70])  # 55 +- 12.7 x 15
    assert (s.low, s.high) == pytest.approx((-35, 145))  # every line
    assert statistics.line_turn(80, -80) == -20 and statistics.line_turn(45, -45) == 90


@pytest.mark.parametrize("sign", [1, -1])
def test_equivalence_is_two_one_sided_tests(sign):
    """The margin at which the larger p-value of both tests of scipy is 5 % is the border of the verdict."""
    values = sign * np.array(FOUR)
    edge = 2.5 + stats.t.ppf(0.95, 3) * stats.sem(FOUR)
    found = statistics.paired(np.zeros(4), values)
    assert found.verdict(edge + 1e-6) == "equivalent" and found.verdict(edge - 1e-6) == "cannot tell"
    side = "less" if sign > 0 else "greater"
    assert stats.ttest_1samp(values, sign * edge, alternative=side).pvalue == pytest.approx(0.05)
    edge = 2.5 - stats.t.ppf(0.975, 3) * stats.sem(FOUR)
    assert found.verdict(edge - 1e-6) == "different" and found.verdict(edge + 1e-6) == "cannot tell"


def test_ends_of_the_relative_interval_are_those_of_paired_tests():
    """At the end q of Fieller's 90 % interval the one-sided test of continuum - (1 + q) grains has a p-value of 5 %."""
    grains, continuum = np.array([18, 15, 22, 11]), np.array([18, 18, 18.5, 18])
    e = statistics.paired(grains, continuum, "relative")
    for end in e.difference_90[1:]:
        assert stats.ttest_1samp(continuum - (1 + end) * grains, 0).pvalue == pytest.approx(0.1)
    for end in e.difference[1:]:
        assert stats.ttest_1samp(continuum - (1 + end) * grains, 0).pvalue == pytest.approx(0.05)
    assert e.difference.value == continuum.mean() / grains.mean() - 1


def test_relative_differences_at_their_limits():
    shared = statistics.paired([5, 10, 20, 8], [5.5, 11, 22, 8.8], "relative")  # the scatter of both cancels
    assert shared.difference == pytest.approx((0.1, 0.1, 0.1), abs=1e-6)
    # the mean may be zero
    assert np.isnan(statistics.paired([-2, 2, 0, 1], [1, 1, 1, 1], "relative").difference[1:]).all()
    assert statistics.paired([10], [12], "relative").difference.value == pytest.approx(0.2)
    assert statistics.paired([], [], "relative").n == 0
    assert statistics.paired([math.nan, 1, 2], [1, 2, math.nan]).n == 1


@pytest.mark.parametrize("order", [0.5, 1.0, 2.0, 3.7])
@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e5])
def test_power_laws_are_found_in_any_unit(order, unit):
    h = np.array([1, 0.5, 0.25, 0.125])
    fit = statistics.fit_convergence(unit * h, 3 - 0.2 * h**order)
    assert (fit.order, fit.limit) == (pytest.approx(order, abs=0.006), pytest.approx(3, abs=1e-3))
    assert fit.coefficient * unit**fit.order == pytest.approx(-0.2, abs=2e-3)


def test_three_points_give_richardsons_limit():
    """v = 1 + 2 h^2 at h = 4, 2, 1: the limit is (4 v(1) - v(2)) / 3."""
    assert statistics.fit_convergence([4, 2, 1], [33, 9, 3]) == pytest.approx((1, 2, 2), abs=1e-9)


@pytest.mark.parametrize("h, values", [([1, 2], [1, 2]), ([1, 2, 2], [1, 2, 2.1]), ([1, 2, 4], [5, 5, 5]),
                                       ([6, 4, 3, 2, 1.5, 1], [0.391, 0.399, 0.3995, 0.372, 0.376, 0.411]),
                                       ([1, 2, 4, 8], [0, 10, 15, 17.5])])
def test_without_a_power_law_there_is_no_order(h, values):
    assert statistics.fit_convergence(h, values) is None


def table(progress, **columns):
    return pd.DataFrame({"progress": progress, **columns}, dtype=float)


def test_reductions_of_a_broken_line():
    """y = x at uneven rows: means over a range are its middle, whatever the rows."""
    rows = table([0, 0.1, 0.15, 0.6, 1], y=[0, 0.1, 0.15, 0.6, 1])
    take = lambda how, **ends: histories.reduced(rows, quantity(reduction=how, column="y", **ends))
    assert take("mean", **{"from": 0.05, "to": 0.85}) == pytest.approx(0.45)
    assert take("at", **{"from": 0.4}) == pytest.approx(0.4)
    assert take("peak", to=0.2) == pytest.approx(0.9)
    assert (take("largest"), take("last")) == (1, 1)
    assert math.isnan(take("mean", **{"from": 0.5, "to": 1.1})) and math.isnan(take("at", **{"from": 1.1}))
    assert take("at", **{"from": 1 + 1e-12}) == 1  # progress is a sum of steps
    assert math.isnan(histories.reduced(None, quantity(reduction="last", column="y")))


def test_running_means_and_curves():
    rows = table([0, 1, 2, 3], y=[0, 2, 4, 6])
    mean = histories.running_mean(rows, "y", 2.0)
    assert np.isnan(mean[:2]).all() and mean[2:] == pytest.approx([2, 4])  # y = 2 x: the value in the middle
    curve = histories.curve_of(rows, "y", 2.0, np.array([1.5, 2, 2.5, 3, 3.5]))
    assert np.isnan(curve[[0, 4]]).all() and curve[1:4] == pytest.approx([2, 3, 4])


def test_strength_is_the_ratio_of_the_means():
    """Pure t = 1, s = 2 and then t = 3, s = 4 with equal weights: 4 / 6, not the mean of 1/2 and 3/4."""
    rows = table([0, 1, 1 + 1e-9, 2], sxx=[3, 3, 7, 7], syy=[1, 1, 1, 1], sxy=[0] * 4)
    assert histories.stress_ratio_of_means(rows, 0, 2) == pytest.approx(4 / 6)


# ---- ensembles
# --------------------------------------------------------------------------------------------------------------

MARGINS = {"margin_angle": 3, "margin_thickness": 0.2, "margin_peak_stress_ratio": 0.03,
           "margin_volumetric_strain": 0.002}


def band(angle, width):
    return {"angle_deg": {"value": angle, "low": angle - 1, "high": None}, "width_10_90_d": width, "offset_d": -2.0,
            "jump": 0.8 if angle < 0 else -0.8}


def comparison(seed, grains, continuum):
    """A comparison with one stage and one window, as the program writes it."""
    panels = {name: {"stress_ratio": 0.3, "bands": bands, "strips": {"angle_deg": [12]}}
              for name, bands in (("discrete", grains), ("continuum", continuum))}
    zone = {"name": "zone", "t_over_s": {"value": 0.4}, "interval": {"low": 1, "high": 2}, "s1": 2,
            "polygon": [[0, 0], [1, 1]]}
    stage = {"progress": 0.04 * (1 + 1e-9 * seed), "axial_strain": 0.04, "continuum": panels["continuum"],
             "discrete": {**panels["discrete"], "probes": [zone]},
             "difference": {"angle_deg": 3, "offset_d": None, "stress": [{"label": "6 d", "relative_l2": 0.2}]}}
    return {"seed": seed, "stages": [stage], "windows": [{"from": 0.0, "to": 0.04, **panels}],
            "cost": {"discrete_cpu_s": 1.5},
            "discrete_summary": {"peak_stress_ratio": 0.36 + 0.001 * seed, "ns_per_update": seed,
                                 "message": "finished"},
            "continuum_summary": {"peak_stress_ratio": 0.36, "finished": True}}


def ensemble_of(*comparisons, folded=False):
    return ensemble.evaluate([member_of(one, folded) for one in comparisons], MARGINS)


def named(record, key="name"):
    return {one[key]: one for one in record}


def test_numbers_are_found_by_their_place_and_only_those_that_have_a_mean():
    found = named(ensemble_of(comparison(1, [band(-44, 18)], []), comparison(2, [band(-46, 20)], []))["quantities"])
    assert found["stage 0.04 discrete stress_ratio"]["n"] == 2  # stages that differ by rounding are one
    assert found["window 0-0.04 discrete band angle_deg"]["mean"] == pytest.approx(-45)
    assert found["window 0-0.04 discrete band angle_deg"]["unit"] == "degrees"
    assert found["stage 0.04 discrete probe zone t_over_s"]["mean"] == 0.4
    assert found["stage 0.04 difference stress 6 d relative_l2"]["mean"] == 0.2
    for name, one in found.items():
        assert members.described(name)[1] == one["unit"], name
    assert members.described("stage 0.02 discrete force_chains inside mean")[1:] == ("-", False)
    assert members.described("stage 0.02 discrete probe zone direction_deg")[1:] == ("degrees", True)
    assert members.described("continuum_coarse window 0-0.01 band angle_deg")[2]
    assert members.described("window 0-0.04 dscrete band angle_deg") is None
    for word in ("cpu", "ns_per_update", "message", "finished", "strips", "polygon", "axial_strain", "interval"):
        assert not [name for name in found if word in name]


def test_only_members_with_a_band_count_for_it():
    record = ensemble_of(comparison(1, [band(-44, 18), band(40, 9)], [band(-45, 18)]),
                         comparison(2, [], [band(-45, 18)]), comparison(3, [band(-46, 22)], [band(-45, 18)]))
    width = named(record["quantities"])["window 0-0.04 discrete band width_10_90_d"]
    assert (width["n"], width["mean"]) == (2, 20) and math.isnan(width["values"][1])  # the strongest band is the first
    pairs = {name: one["n"] for name, one in named(record["verdicts"], "quantity").items()}
    assert pairs == {"peak_stress_ratio": 3, "peak_friction_angle_deg": 0, "peak_outline_stress_ratio": 0,
                     "peak_core_stress_ratio": 0, "peak_nominal_stress_ratio": 0, "friction_angle_deg": 0,
                     "strength": 0, "platen_force_pd": 0,
                     "final_volumetric_strain": 0,
                     "window 0-0.04 band angle_deg": 2, "window 0-0.04 band width_10_90_d": 2}
    assert {key: one["text"] for key, one in named(record["bands"]).items() if key.startswith("window")} == {
        "window 0-0.04 continuum": "one band in 3 of 3",
        "window 0-0.04 discrete": "one band in 1 of 3, two bands in 1, none in 1"}


def test_a_diffuse_zone_is_no_band_and_its_angle_is_called_diffuse():
    record = ensemble_of(comparison(1, [dict(band(-44, 18), diffuse=True)], [band(-45, 18)]))
    verdict = named(record["verdicts"], "quantity")["window 0-0.04 band angle_deg"]
    assert (verdict["n"], verdict["diffuse"], verdict["verdict"]) == (0, 1, "diffuse")
    assert named(record["bands"])["window 0-0.04 discrete"]["none"] == 1


def test_mirror_images_of_a_band_are_folded_together():
    """Chance decides between left and right: bands at 55 and -55 degrees are the same kind, and their jumps get one
    sign."""
    both = (comparison(1, [band(55, 10)], [band(-54, 10)]), comparison(2, [band(-53, 10)], [band(54, 10)]))
    record = ensemble_of(*both, folded=True)
    found = named(record["quantities"])
    assert found["window 0-0.04 discrete band angle_deg"]["mean"] == pytest.approx(54)
    assert found["window 0-0.04 discrete band offset_d"]["values"] == [2, 2]
    assert found["window 0-0.04 discrete band jump"]["values"] == [-0.8, -0.8]
    assert found["stage 0.04 difference angle_deg"]["mean"] == 3  # the program has compared mirrored bands
    turn = named(record["verdicts"], "quantity")["window 0-0.04 band angle_deg"]["difference"]
    assert turn.value == pytest.approx(0, abs=1e-12)  # 54 - 55 and 54 - 53


@pytest.mark.parametrize("keys, symmetric", [
    ({}, False), ({"loading/horizontal_over_vertical": 0}, True),
    ({"loading/horizontal_over_vertical": 0, "discrete/gravity_x": 0.1}, False),
    ({"loading/horizontal_over_vertical": 0, "discrete/lateral": "rigid_walls", "discrete/drive_left_x": "velocity 1"},
     False)])
def test_only_a_vertical_descent_is_its_own_mirror_image(keys, symmetric):
    from diptych import scenes

    assert scenes.read(keys).is_mirror_symmetric() == symmetric


def test_means_of_curves_need_all_members():
    mean, low, high = ensemble.with_means(np.array([[1.0, 2, np.nan], [3, 2, 1]]))
    half = stats.t.ppf(0.975, 1) * stats.sem([1, 3])
    assert (mean[0], low[0], high[0]) == pytest.approx((2, 2 - half, 2 + half))
    assert (mean[1], low[1], high[1]) == (2, 2, 2) and np.isnan([mean[2], low[2], high[2]]).all()


def test_profiles_are_averaged_over_the_samples_that_reach_a_strip(tmp_path):
    """Relative rotation of 41 strips k: k and k + 2 in two samples, the first without the last strip, the third without
    a band."""
    names = ("relative_rotation", "spin", "couple_stress", "solid_fraction", "velocity_fluctuation")
    for seed, n in enumerate((41, 41, 0)):
        (tmp_path / str(seed)).mkdir()
        with h5py.File(tmp_path / str(seed) / "comparison.h5", "w") as file:
            for group in (file.create_group(f"window_0/profile/{panel}") for panel in ("discrete", "continuum")):
                group["distance"] = np.arange(-20.0, 21)[:n]
                for name in names:
                    group[name] = np.tile(np.arange(41.0)[:n, None] + 2 * seed, 3)
                    group[name].attrs.update(title=np.bytes_(name), unit=np.bytes_("rad"))
                group["relative_rotation"][40 if n and not seed else n:] = np.nan
    arrays = profile_arrays([str(tmp_path / str(seed)) for seed in range(3)])
    mean, error, low = (arrays[f"window_0/profile/discrete/relative_rotation/{key}"][0]
                        for key in ("mean", "standard_error", "low"))
    # deviation sqrt(2) / sqrt(2)
    assert mean[:40] == pytest.approx(np.arange(40) + 1) and error[:40] == pytest.approx(1)
    assert low[:40] == pytest.approx(np.arange(40) + 1 - stats.t.ppf(0.975, 1)) and np.isnan([mean[40], error[40],
                                                                                              low[40]]).all()


def test_short_numbers_have_no_exponent():
    assert [short(value) for value in (110.3, 0.0354, 694)] == ["110", "0.035", "690"]


def test_lists_of_seeds():
    assert read_seeds("1-4") == [1, 2, 3, 4] and read_seeds("5-7,1,3") == [1, 3, 5, 6, 7]


@pytest.mark.parametrize("text", ["", "1,", "-3", "one", "1.5", "8-1", "1-3,2", "0-10000", "2147483648", "1-2-3"])
def test_invalid_lists_of_seeds_are_refused(text):
    with pytest.raises(diptych.SceneError, match="--seeds"):
        read_seeds(text)


def test_the_mean_of_calibrated_grains_keeps_the_columns_of_its_curves():
    table = pd.DataFrame({"progress": np.linspace(0, 0.03, 31)})
    table["stress_ratio"], table["volumetric_strain"] = 0.4 - table["progress"], -table["progress"]
    sample = observe_history(scenes.read({}), [Observable(kind="stress_ratio", low=0, high=0.03)], table)
    mean = mean_of([sample, sample], 0.005)
    for name in ("progress", "stress_ratio", "volumetric_strain", "bands"):
        assert getattr(mean, name) == pytest.approx(getattr(sample, name)), name
