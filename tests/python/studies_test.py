# diptych: studies: files, points, errors, classes and costs with known answers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Only the last four tests run the program."""

import glob
import itertools
import json
import math
import os
import signal
import subprocess
import threading
import time

import numpy as np
import pytest
from conftest import QUICK, SMALL, explained

import diptych
from diptych import _diptych
from diptych.campaigns import api
from diptych.campaigns.runs.input_file import Setting, read_seeds
from diptych.campaigns.studies import effects
from diptych.campaigns.studies import evaluation
from diptych.campaigns.runs import engine, statistics
from diptych.campaigns.runs.folders import Folder, SceneRun
from diptych.campaigns.studies.points import Point, RunResult, points_of
from diptych.campaigns.studies.study_file import Axis, AxisPoint, Family, Study, quantity, read_study


def study_of(n, **changes):
    """A quantity with a limit of 2 %, four samples, one axis of n points h = 1, 2, 4 ..."""
    axis = Axis(name="step", points=[AxisPoint(str(k), [], 2.0**k) for k in range(n)], converges=True)
    strength = quantity("strength", **{"limit": 0.02, **changes})
    return Study(seeds=[1, 2, 3, 4], reference=[], families=[Family(axes=[axis])], quantities=[strength])


def points_on(n):
    return [Point(runs=[SceneRun(command="run", name="reference")]),
            *(Point(family=0, reference=0, places=(k,), labels=[str(k)], settings=[],
                    runs=[SceneRun(command="run", name=str(k))])
                                                         for k in range(n))]


def runs(share, cpu_s=1.0, **changes):
    """Four samples around 0.4, all changed by the same share."""
    phases = [{"name": "discrete", "cpu_s": cpu_s, "peak_memory_mb": 100},
              {"name": "report", "cpu_s": 9, "peak_memory_mb": 100}]
    return [RunResult(**{"known": True, "values": [value * (1 + share)], "phases": phases, **changes})
            for value in (0.38, 0.40, 0.41, 0.43)]


def point(results, study=None, reference=None):
    study = study or study_of(1)
    return evaluation.evaluate(study, points_on(1), [reference or runs(0)[:len(results)], results])[1]


def test_errors_are_paired_by_sample():
    """The samples scatter by 5 %. The change of 1 % is visible because it is the same in each sample."""
    found = point(runs(0.01))
    assert found["quantities"][0]["error"] == pytest.approx((0.01, 0.01, 0.01), abs=1e-9)
    assert found["quantities"][0]["scatter"] == pytest.approx(np.std([0.38, 0.4, 0.41, 0.43], ddof=1) / 0.405)
    assert (found["class"], found["certain"], found["quantities"][0]["pairs"]) == ("right", True, 4)


def test_errors_that_scatter_leave_a_doubt():
    scattered = runs(0.01)
    scattered[0].values[0] *= 1.05
    scattered[1].values[0] *= 0.95
    found = point(scattered)
    assert (found["class"], found["certain"], found["quantities"][0]["verdict"]) == ("right", False, "cannot tell")


@pytest.mark.parametrize("changes, expected", [
    ({}, "silently wrong"), ({2: {"warned": True}}, "wrong, warned"), ({3: {"exit_code": 3, "words": "no"}}, "stopped"),
    ({3: {"exit_code": 3}, 0: {"exit_code": 2}}, "refused"), ({0: {"exit_code": 2}, 1: {"known": False}}, "not run")])
def test_the_worst_run_decides(changes, expected):
    results = runs(0.03)
    for k, change in changes.items():
        vars(results[k]).update(change)
    assert point(results)["class"] == expected


def test_a_point_that_halved_steps_struggled():
    assert point(runs(0, halved_steps=3))["class"] == point(runs(0, cut_backs=1.0))["class"] == "struggled"


def test_a_value_that_only_the_reference_has_is_beyond_any_limit():
    none = runs(0, values=[math.nan])
    assert point(none)["class"] == "silently wrong"
    assert point(none, reference=none)["class"] == "unjudged"
    assert point(runs(0.5), study_of(1, limit=None))["class"] == "unjudged"


def test_an_unknown_interval_leaves_a_doubt_unless_there_is_one_sample():
    study = study_of(1)
    study.seeds = [1]
    found = point(runs(0.05)[:1], study)
    assert (found["class"], found["certain"]) == ("silently wrong", False)
    study.seeds = []
    assert point(runs(0.05)[:1], study)["certain"]


def test_lines_are_compared_by_their_turn():
    study = study_of(1, line=True, relative=False, limit=5)
    found = point(runs(0, values=[-88.0]), study, runs(0, values=[89.0]))
    assert found["quantities"][0]["error"].value == pytest.approx(3)


def test_orders_are_fitted_along_axes_that_converge():
    study, points = study_of(4), points_on(4)
    results = [runs(0), *(runs(0.01 * 2**k) for k in range(4))]
    order, = evaluation.orders_of(study, points, evaluation.evaluate(study, points, results))
    assert order["order"].value == pytest.approx(1, abs=0.02)
    assert order["limit"].value == pytest.approx(0.405, abs=1e-3) and order["limit"].low < 0.405 < order["limit"].high


def cost(n, results, study=None, points=None):
    study, points = study or study_of(n), points or points_on(n)
    return evaluation.cost_of(study, points, results, evaluation.evaluate(study, points, results), {})


def test_the_cheapest_right_point_is_found_and_the_reference_does_not_compete():
    found = cost(3, [runs(0, 0.1), runs(0.005, 8), runs(-0.015, 2), runs(0.04, 1)])
    cheapest = {(one["quantity"], one["accuracy"]): one["point"] for one in found["cheapest"]}
    assert [cheapest["strength", accuracy] for accuracy in (0.05, 0.02, 0.01)] == [3, 2, 1]
    assert cheapest["", 0.5] == 1
    assert found["points"][2]["cpu_s"] == 2 and found["phases"] == ["discrete"]  # the report does not count
    assert [one["front_of"] for one in found["points"]] == [[], ["strength"], ["strength"], ["strength"]]


def test_a_point_that_costs_more_and_is_worse_is_not_on_the_front():
    found = cost(2, [runs(0), runs(0.01, 1), runs(0.02, 2)], study_of(2, limit=None))
    assert [one["front_of"] for one in found["points"]] == [[], ["strength"], []]
    assert found["cheapest"] == []


def test_points_compete_only_with_those_of_the_same_reference():
    points = [Point(runs=[SceneRun(command="run", name="other")]), *points_on(2)]
    points[1].reference = points[3].reference = 1
    found = cost(2, [runs(0), runs(1), runs(0.01, 1), runs(1.01, 2)], points=points)
    assert [one["front_of"] for one in found["points"][2:]] == [["strength"], ["strength"]]
    assert len(found["cheapest"]) == 12 and found["cheapest"][-1]["point"] == 3


def test_other_work_on_the_machine_is_noticed():
    assert not RunResult(load=2.3, at_once=2).disturbed and RunResult(load=3.1, at_once=2).disturbed


def change(values, **changes):
    """The change of a quantity with values (points, samples) in a study without a reference."""
    study = study_of(len(values), **{"limit": None, **changes})
    study.reference = None
    points = points_on(len(values))[1:]
    results = [[RunResult(known=True, values=[value]) for value in samples] for samples in values]
    return effects.changes_of(study, points, evaluation.evaluate(study, points, results))[0]


def test_an_effect_on_every_sample_is_resolved_although_the_samples_scatter_more():
    """The samples differ by 0.05, the points by 0.01. With two points the interval is Student's of the paired
    differences."""
    samples, other = np.array([0.38, 0.40, 0.41, 0.43]), np.array([1, -1, 2, -1]) * 1e-3
    found = change([samples, samples + 0.01 + other])
    assert (found["verdict"], found["smallest_at"], found["largest_at"], found["samples"]) == ("resolved", "0", "1", 4)
    assert found["change"] == pytest.approx(statistics.paired(samples, samples + 0.01 + other).difference, rel=1e-6)


def test_an_absent_effect_looks_resolved_in_one_study_of_twenty():
    """Five points that differ by scatter alone. Student's interval of the two extreme points would call 18 %
    resolved."""
    random = np.random.default_rng(1)
    found = [effects.change_between(random.normal(size=(5, 4)))[0].low > 0 for _ in range(2000)]
    assert 0.035 < np.mean(found) < 0.065


def test_as_many_samples_are_asked_for_as_resolve_the_change():
    """Paired differences of 1 +- 2: t(0.975, n - 1) 2 / sqrt(n) is 1.028 for 17 samples and 0.995 for 18."""
    differences = 1 + math.sqrt(3) * np.array([-1, 1, -1, 1])
    found = change([np.array([3, 1, 4, 1]), np.array([3, 1, 4, 1]) + differences])
    assert (found["verdict"], found["samples_needed"]) == ("not resolved", 18)


def test_a_change_of_lines_is_a_turn_and_a_sample_without_a_value_does_not_count():
    found = change([[89, 88, math.nan, 89.5], [-89, -90, 80, -89]], line=True)
    assert found["change"].value == pytest.approx(11 / 6) and found["samples"] == 3 and found["verdict"] == "resolved"
    assert change([[1, math.nan, 3, math.nan], [math.nan, 1, 2, 4]])["verdict"] == "unknown"
    assert change([[1, 2, 3, 4]] * 2)["verdict"] == "no change"


AXES = [{"key": "discrete/step", "values": [0.1, 0.2]}, {"key": "discrete/friction", "values": [0.3, 0.4, 0.5]}]
FILE = {"scene": "scene.prm", "command": "discrete", "axes": AXES, "reference": {"discrete/step": 0.1},
        "quantities": [{"strength": [0.005, 0.02]}]}


@pytest.fixture
def read(tmp_path):
    """Points of a study file with other entries."""
    (tmp_path / "scene.prm").write_text("subsection sample\n  set grains = 100\nend\n")

    def read_points(**changes):
        entries = {**FILE, **changes}
        (tmp_path / "study.json").write_text(json.dumps({k: v for k, v in entries.items() if v is not None}, indent=1))
        return points_of(read_study(str(tmp_path / "study.json")))

    read_points.folder = tmp_path
    return read_points


def test_a_grid_has_every_pair_the_last_axis_fastest(read):
    points = read()
    assert [one.labels for one in points] == [[]] + [[a, b] for a in ("0.1", "0.2") for b in ("0.3", "0.4", "0.5")]
    scene = points[6].runs[0].scene.dict()
    assert scene["discrete"]["friction"] == 0.5 and not scene["output"]["report"]
    assert points[0].runs[0].name == points[2].runs[0].name != points[1].runs[0].name  # the default friction is 0.4


def test_a_list_moves_its_axes_together(read):
    axes = [AXES[0], {**AXES[1], "values": [0.3, 0.4]}]
    assert [one.labels for one in read(combine="list", axes=axes)[1:]] == [["0.1", "0.3"], ["0.2", "0.4"]]
    with pytest.raises(diptych.SceneError, match="'step' has 2, 'friction' 3"):
        read(combine="list")


def test_an_axis_may_have_a_reference_of_its_own_at_each_point(read):
    points = read(axes=[{**AXES[1], "values": [0.3, 0.5], "own_reference": True}, {**AXES[0], "values": [0.2, 0.4]}])
    assert [one.labels for one in points[:2]] == [["friction 0.3"], ["friction 0.5"]]
    reference = points[1].runs[0].scene.dict()["discrete"]
    assert (reference["friction"], reference["step"]) == (0.5, 0.1)
    assert [one.reference for one in points] == [0, 1, 0, 0, 1, 1]


def test_seeds_are_samples_and_replace_the_word_in_file_names(read):
    points = read(seeds="3-5")
    assert [run.scene.dict()["sample"]["seed"] for run in points[1].runs] == [3, 4, 5]
    (read.folder / "grains_7.csv").write_text("x,y,r\n0,0.5,0.5\n1,0.5,0.5\n")
    scene = read(seeds="7-7", set={"sample/file": "grains_{seed}.csv"})[1].runs[0].scene
    assert scene.dict()["sample"]["file"] == str(read.folder / "grains_7.csv")


def test_contradictory_settings_refuse_only_their_point(read):
    """No whole number of stages fits into 0.013."""
    points = read(set={"loading/stage_strain": 0.005}, axes=[{"key": "loading/axial_strain", "values": [0.01, 0.013]}])
    assert points[1].runs[0].scene and points[2].runs[0].scene is None and "0.013" in points[2].runs[0].refusal


@pytest.mark.parametrize("changes, words", [
    ({"scene": "none.prm"}, ["line 2", "none.prm"]), ({"seed": 3}, ["seed: unknown key", "'seeds'"]),
    ({"seeds": "5-3"}, ["5-3", "ascend"]), ({"seeds": 3}, ["line 3", "3-3"]),
    ({"command": "runn"}, ["line 3", "runn", "material-point"]),
    ({"axes": [{"key": "discrete/friction", "values": [0.1, -1]}]}, ["discrete/friction = '-1'", "a number from"]),
    ({"axes": [{"key": "discrete/step", "values": [0.1, 0.1]}]}, ["'0.1'"]),
    ({"axes": [{"key": "discrete/method", "values": ["nscd"], "converges": True}]}, ["converges", "nscd"]),
    ({"quantities": [{"column": "stres_ratio", "last": True}]}, ["stres_ratio", "stress_ratio"]),
    ({"quantities": [{"strength": [0.02, 0.01]}]}, ["ascending"]),
    ({"quantities": [{"last": True, "largest": True, "column": "time"}]}, ["exactly one of"]),
    ({"quantities": []}, ["quantities", "missing or empty"]),
    ({"reference": None, "quantities": [{"strength": [0, 1], "limit": {"relative": 1}}]},
     ["limit", "'reference' is missing"]),
    ({"quantities": [{"of": "continuum", "strength": [0.005, 0.02]}]}, ["discrete does not write", "continuum"]),
    ({"reference": {"loading/axial_strain": 0.013, "loading/stage_strain": 0.005}},
     ["the reference is refused", "0.013"]),
    ({"command": "run", "quantities": [{"number": "window 0-0.01 discrete band width"}]}, ["'width'", "nearest"]),
    ({"command": "run", "quantities": [{"number": "band angle"}]}, ["'band angle'", "'angle_deg'", "ensemble.csv"]),
    ({"cost": ["discret"]}, ["'discret'", "'discrete'"])])
def test_wrong_keys_and_values_are_named_with_their_lines(read, changes, words):
    with pytest.raises(diptych.SceneError) as refused:
        read(**changes)
    for word in [*words, "study.json"]:
        assert word in str(refused.value)


def test_ctrl_c_keeps_an_ensemble_of_a_dict_and_the_same_call_goes_on(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def stop():
        while not glob.glob("out/runs/*/"):
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=stop).start()
    with pytest.raises(diptych.Stopped, match="resume=True"):
        diptych.ensemble(SMALL, [1, 2, 3], "out", jobs=1)
    assert diptych.Campaign.load("out").numbers["interrupted"][-1] == 3  # on a busy machine the first may have ended
    found = diptych.ensemble(SMALL, range(1, 4), "out", resume=True)
    assert diptych.load(found.folders[2]).scene["sample"]["seed"] == 2
    assert found.numbers["done"] == [1, 2, 3] and found.numbers["scene"] == "out" and len(found.verdicts) == 11
    with pytest.raises(diptych.SceneError, match=r"range\(1, 4\) for 3 samples"):
        diptych.ensemble(SMALL, 3, "out")
    with pytest.raises(AttributeError, match="verdicts"):
        found.points


def test_run_is_the_command_and_can_be_stopped(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def stop():
        while not glob.glob("out/discrete.csv"):
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    begin = subprocess.Popen
    with monkeypatch.context() as changed, pytest.raises(diptych.Stopped, match="stopped on request"):
        changed.setattr(subprocess, "Popen",
                        lambda *words, **ways: (begin(*words, **ways), os.kill(os.getpid(), signal.SIGTERM))[0])
        diptych.run(SMALL, "out")
    threading.Thread(target=stop).start()
    with pytest.raises(diptych.Stopped, match="kept in out"):
        diptych.run(SMALL, "out")
    found = diptych.run(SMALL, "out", resume=True)
    summary = found.summary()
    assert f"{summary.loc['peak t/s', 'grains']:.4g}" in str(summary) and max(map(len, str(summary).split("\n"))) <= 80
    assert summary.loc["peak t/s", "grains"] > 0.1 and found.scene["sample"]["grains"] == 300
    assert os.listdir() == ["out"]
    for call, text in ((lambda: diptych.run(SMALL, "out", set={"discrete/friction": 0.2}), "--overwrite"),
                       (lambda: diptych.run({"sample": {"grians": 3}}), "grains"),
                       (lambda: diptych.run(SMALL, "out", seeds=range(1, 4)), "ensemble")):
        with pytest.raises(diptych.SceneError, match=text):
            call()
    assert read_seeds(api._seeds([4])) == [4]


def expect_explained(found):
    def keys(record, place=""):
        for key, value in record.items():
            yield place + key
            for entry in value if isinstance(value, list) else [value]:
                if isinstance(entry, dict) and set(entry) != {"value", "low", "high"}:
                    yield from keys(entry, f"{place}{key}/")

    for file, record in (("study.json", found.numbers), ("study_cost.json", found.cost)):
        assert set(keys(record)) <= explained(file)


def test_parameters_of_a_dict_give_means_and_changes(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    scene = {"sample": {"grains": 150}, "loading": {"axial_strain": 0.01, "inertial_number": 1e-3}}
    found = diptych.study(scene, "out", vary={"discrete/friction": [0.1, 0.6]}, seeds=range(1, 4), panels="discrete")
    peaks = found.effects[found.effects.quantity == "peak t/s"]
    assert list(peaks["discrete/friction"]) == [0.1, 0.6] and list(peaks.n) == [3, 3] and set(peaks.panel) == {"grains"}
    assert found.changes["change.value"][0] == pytest.approx(peaks["mean"].iloc[1] - peaks["mean"].iloc[0])
    assert found.changes["verdict"][0] == "resolved"
    expect_explained(found)
    with pytest.raises(AttributeError, match="effects"):
        found.points


def test_a_worker_lives_as_long_as_the_runs_of_its_folder_are_open(tmp_path, monkeypatch):
    started, popen = [], subprocess.Popen
    monkeypatch.setattr(engine.subprocess, "Popen", lambda *a, **b: started.append(popen(*a, **b)) or started[-1])
    options = engine.Options(jobs=1, quiet=True)
    with Folder(str(tmp_path)) as folder:
        runs = folder.open_runs("test", QUICK, options, list)
        for k in (1, 2, 3):
            scene = _diptych.read_changed_scene(QUICK, [Setting("loading", "axial_strain", f"0.0{k}", "test")], False)
            run = SceneRun(command="material-point", name=f"run_{k}", scene=scene)
            assert runs.do([run], options)[run.name].exit_code == 0
        assert len(started) == 1 and started[0].poll() is None
    assert started[0].returncode == 0  # it ended, and was waited for, before the lock


def test_a_worker_that_was_asked_to_stop_does_the_next_run(tmp_path, monkeypatch):
    def does(command):
        folder, log = (str(tmp_path / name) for name in (f"out_{next(count)}", "log"))
        run = engine.Run(command=command, scene=QUICK, name="quick", label="", folder=folder, log=log)
        return worker.run(run.line(1))

    worker, count = engine.Worker(), itertools.count()
    assert does("material-point") == (0, False)
    monkeypatch.setattr(_diptych, "stop_requested", lambda: True)
    assert does("discrete") == (engine.NOT_CONVERGED, True)
    monkeypatch.undo()
    assert does("material-point") == (0, False)
    worker.close()


def test_a_study_of_a_dict_gives_data_frames_and_explained_keys(tmp_path):
    steps = {"scene": os.path.join(diptych.benchmarks_dir(), "moreau_quick", "scene.prm"), "command": "material-point",
             "set": {"loading/axial_strain": 0.02}, "reference": {"continuum/initial_step": 1e-5},
             "axes": [{"key": "continuum/initial_step", "values": [4e-4, 2e-4, 1e-4], "converges": True}],
             "quantities": [{"name": "peak", "column": "stress_ratio", "largest": True, "limit": {"relative": 0.01}}]}
    with pytest.raises(diptych.SceneError, match="'quantities'"):
        diptych.study({**steps, "quantity": []}, tmp_path / "out")
    found = diptych.study(steps, tmp_path / "out", jobs=2)
    assert list(found.points["class"]) == ["right"] * 4 and found.points["peak"][0] == 0
    assert len(found.table) == 4 and found.cost["runs"] == 4
    assert found.numbers["points"][1]["quantities"][0]["error"]["low"] is None  # one sample has no interval
    expect_explained(found)
    with pytest.raises(diptych.SceneError, match="--resume"):
        diptych.study(steps, tmp_path / "out")
    assert diptych.Campaign.load(tmp_path / "out").numbers == found.numbers
