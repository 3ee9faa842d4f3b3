# diptych: the files of a calibration, standard parameters of a scene, and when no interval holds
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Only reads files; nothing runs."""

import itertools
import os
import subprocess

import numpy as np
import pytest
from conftest import QUICK, SOURCE

import diptych
from diptych.campaigns.calibration.calibration import empty_record
from diptych.campaigns.calibration.calibration_file import Target, read_calibration, read_curve
from diptych.campaigns.calibration.findings import doubts, predictions
from diptych.campaigns.calibration.noise import Data, Observable
from diptych.campaigns.calibration.observations import Observation, Path, read_target
from diptych.campaigns.calibration.reading import checked, with_data
from diptych.campaigns.calibration.standard import PARAMETERS, standard_calibration
from diptych.campaigns.runs.coordinates import Coordinates, Parameter
from diptych.campaigns.runs.input_file import Setting

CURVE = """# drained biaxial test
axial_strain,stress_ratio,stress_ratio_deviation,volumetric_strain
0,0,0.01,0
0.01,0.3,0.01,-0.002
0.02,0.4,0.02,-0.004
"""


@pytest.mark.parametrize("text, words", [
    ("strain,stress_ratio\n0,0\n1,1\n", "must name axial_strain"),
    ("axial_strain\n0\n1\n", "stress_ratio or volumetric_strain"),
    ("# a test\n\naxial_strain;stress_ratio\n0;0\n0,01;x\n", "line 5: column stress_ratio = 'x'"),
    ("axial_strain,stress_ratio\n0.01,0\n0,1\n", "line 3: axial_strain = 0 must be larger"),
    ("axial_strain,stress_ratio,stress_ratio_deviation\n0,0,0\n1,1,1\n", "line 2: stress_ratio_deviation = 0")])
def test_a_wrong_curve_is_refused(tmp_path, text, words):
    (tmp_path / "lab.csv").write_text(text)
    with pytest.raises(diptych.SceneError, match=words):
        read_curve(str(tmp_path / "lab.csv"))


def test_a_file_with_a_curve_is_read(tmp_path, capfd):
    """As a spreadsheet writes it, with a remark and without a row in the second bin."""
    rows = [line + ",a remark" for line in CURVE.splitlines()[1:]]
    (tmp_path / "lab.csv").write_text("\n".join(rows).replace(",", ";").replace(".", ","))
    text = ('{"targets": [{"name": "lab", "scene": "%s", "curve": "lab.csv"%s}], "quantities": ["stress_ratio"], '
            '"bins": [0, 0.012, 0.018], "parameters": [{"key": "friction_angle_peak", "start": 25, "low": 12, "high": '
            '40}]}')
    (tmp_path / "c.json").write_text(text % (QUICK, ""))
    c = read_calibration(str(tmp_path / "c.json"))
    assert os.path.samefile(c.targets[0].curve, tmp_path / "lab.csv") and c.targets[0].seeds == []
    told = capfd.readouterr().err
    assert "no row lies in the bin from 0.012 to 0.018" in told and told.count("warning") == 1
    (tmp_path / "c.json").write_text(text % (QUICK, ', "seeds": "1-1"'))
    with pytest.raises(diptych.SceneError, match="replaces grains"):
        read_calibration(str(tmp_path / "c.json"))


def test_a_scene_with_seeds_has_standard_parameters():
    contents = standard_calibration(QUICK, "1-4", [])
    c = read_calibration(QUICK, contents)
    assert [p.key for p in c.parameters] == ["friction_angle_peak", "friction_angle_residual", "friction_angle_start",
                                             "mobilisation_strain", "dilatancy_angle_peak", "internal_length",
                                             "youngs_modulus"]
    assert c.kinds == ["stress_ratio", "volumetric_strain", "ln_width"] and c.targets[0].seeds == [1, 2, 3, 4]
    assert c.bins[0] == pytest.approx(0.025 * 0.03) and c.bins[-1] == 0.03  # the loading ends at 3 %
    assert c.load_step == pytest.approx(0.03 / 40) and c.coarse_element_size == 4
    plain = standard_calibration(QUICK, "1,3", [Setting("continuum", "law", "mohr_coulomb", "")])
    assert plain["quantities"] == ["stress_ratio", "volumetric_strain"]
    assert "internal_length" not in [p["key"] for p in plain["parameters"]]
    with pytest.raises(diptych.SceneError, match="two seeds"):
        standard_calibration(QUICK, "1-1", [])


def test_a_point_has_neither_band_nor_length_and_its_bins_end_where_the_path_turns(tmp_path):
    """The path takes 0.01, 0.02 and 0.02 of strain, so that 15 parts are 3, 6 and 6; the first does not count."""
    table = tmp_path / "path.csv"
    table.write_text("eyy,sxx,exy\n0,1,0\n0.01,1,0\n-0.01,1,0\n0.01,1,0\n")
    words = {"path": str(table), "axial_strain": "3", "stage_strain": "1"}
    contents = standard_calibration(os.path.join(SOURCE, "benchmarks", "element", "scene.prm"), "1-2",
                                    [Setting("loading", key, value, "") for key, value in words.items()])
    assert contents["bins"] == pytest.approx([1 / 3, 2 / 3, *np.arange(1, 3.01, 1 / 6)], rel=1e-5)
    assert "internal_length" not in [p["key"] for p in contents["parameters"]]
    assert contents["quantities"] == ["stress_ratio", "volumetric_strain"] and contents["load_step"] == 0.00125


def law_of(**keys):
    return [Setting("continuum", key, str(value), "") for key, value in keys.items()]


@pytest.mark.parametrize("hardening", PARAMETERS)
def test_the_law_of_the_scene_stays_and_no_point_between_the_bounds_is_refused(hardening):
    """The corners of the bounds are the hardest points; 0.87 is denser than discs of two sizes pack."""
    settings = law_of(law="drucker_prager", hardening=hardening, cohesion=0.02, softening_strain=0.1)
    c = read_calibration(QUICK, standard_calibration(QUICK, "1-2", settings))
    there, density = checked(c), 0.87
    there.others["solid_fraction_start"] = density
    for corner in itertools.product((0, 1), repeat=len(there)):
        point = there.settings(np.array(corner), c.targets[0].name)
        keys = read_target(c.targets[0], [*law_of(solid_fraction_start=density), *c.fixed, *point]).dict()["continuum"]
    assert (keys["hardening"], keys["cohesion"], keys["softening_strain"]) == (hardening, 0.02, 0.1)


def test_a_dilatancy_ratio_above_the_least_gives_a_dilatancy_below_the_friction():
    """t/s of 0.26 + 5.5 0.82 ln(0.86/0.82) = 0.4748 is possible: the ratio is at least 1 - 0.26/0.4748 = 0.4524."""
    c = read_calibration(QUICK, standard_calibration(QUICK, "1-2", law_of(hardening="critical_state")))
    there = checked(c)
    there.others["solid_fraction_start"] = 0.86
    values = dict(zip([p.key for p in c.parameters], there.values(there.start)))
    assert values["dilatancy_ratio"] == pytest.approx(0.4524 + 0.25, abs=1e-4)


def test_laws_without_standard_parameters_are_refused_and_libraries_give_their_own(tmp_path):
    table = law_of(hardening="table", table_strain="0, 1", table_friction_angle="20, 20",
                   table_dilatancy_angle="5, 0", table_cohesion="0, 0")
    with pytest.raises(diptych.SceneError, match="table has no standard parameters"):
        standard_calibration(QUICK, "1-2", table)
    examples = os.path.join(os.environ["DIPTYCH_SOURCE"], "benchmarks", "own_law", "von_mises.c")
    header = os.path.join(os.environ["DIPTYCH_SOURCE"], "continuum", "laws")
    library = str(tmp_path / "von_mises.so")
    subprocess.run(["cc", "-shared", "-fPIC", "-I" + header, "-o", library, examples, "-lm"], check=True)
    contents = standard_calibration(QUICK, "1-2", law_of(law="library", law_library=library))
    found = {p.key: (p.start, p.low, p.high) for p in read_calibration(QUICK, contents).parameters}
    assert found["law.strength"][0] == pytest.approx(10 * found["law.strength"][1])


def test_a_file_of_set_is_found_from_the_working_directory(tmp_path, monkeypatch):
    (tmp_path / "mine.csv").write_text("eyy,sxx,exy\n0,1,0\n0.02,1,0\n0.01,1,0\n")
    monkeypatch.chdir(tmp_path)
    keys = {"mode": "path", "path": "mine.csv", "axial_strain": "2", "stage_strain": "1"}
    path = [Setting("loading", key, value, "") for key, value in keys.items()]
    more = [Setting("discrete", "lateral", "cell", ""), Setting("comparison", "window_edges", "0, 1, 2", "")]
    contents = standard_calibration(QUICK, "1-2", [*path, *more])
    assert contents["targets"][0]["set"]["loading/path"] == str(tmp_path / "mine.csv")
    assert "internal_length" not in [p["key"] for p in contents["parameters"]]  # a point has no band


def test_a_curve_without_deviations_gets_the_usual_scatter(tmp_path):
    (tmp_path / "lab.csv").write_text(CURVE)
    text = ('{"targets": [{"name": "lab", "scene": "%s", "curve": "lab.csv"}], "quantities": ["stress_ratio", '
            '"volumetric_strain"], "bins": [0, 0.02], %s"parameters": [{"key": "friction_angle_peak", "start": 25, '
            '"low": 12, "high": 40}]}')
    for given, start, growth in (("", 2e-4, 0.02), ('"noise": {"volume_growth": 0.1}, ', 2e-4, 0.1)):
        (tmp_path / "c.json").write_text(text % (QUICK, given))
        c = read_calibration(str(tmp_path / "c.json"))
        assert (c.noise.volume_start, c.noise.volume_growth, c.noise.stress_level) == (start, growth, None)
        assert len(c.remarks) == 1 and "no volumetric_strain_deviation" in c.remarks[0]


@pytest.mark.parametrize("changes, converged, failed, why", [
    ({}, True, 9, ""),
    ({"is_outside": True}, True, 0, "the best point lies outside its own posterior in cohesion"),
    ({"share_known": 1.5}, True, 0, "the posterior is wider than the prior in cohesion"),
    ({}, True, 10, "10 of 18 runs at draws of the posterior failed"),
    ({}, False, 0, "the search has not converged")])
def test_intervals_that_are_none_are_replaced_by_a_sentence(changes, converged, failed, why):
    p = {"key": "cohesion", "targets": [], "is_outside": False, "share_known": 1.0, **changes}
    assert doubts([p], converged, {"failed": failed, "more_runs": 18}) == (why and f"No intervals: {why}.")


@pytest.mark.parametrize("widths, keeps", [([np.nan, np.nan], True), ([1.1, np.nan], True), ([1.1, 1.3], False)])
def test_a_length_without_a_width_of_a_band_is_not_fitted(widths, keeps):
    """Nor does its prediction count as fitted."""
    both = [Parameter(key=key, coordinate="logarithm", start=3, low=1, high=8)
            for key in ("internal_length", "youngs_modulus")]
    data = Data(observables=[Observable(kind="ln_width", low=0, high=0.03)], values=[[one] for one in widths])
    path = Path(target=Target(name="a", scene="", settings=[]), scene=diptych.scenes.read({}), data=data,
                samples=[Observation(values=values) for values in data.values], left_out=[""])
    record = empty_record("c")
    fitted = with_data(Coordinates(both, {"internal_length": 2.0}), [path], record)
    assert [p.key for p in fitted.parameters] == ["internal_length", "youngs_modulus"][keeps:]
    assert ["keeps the scene's value 2 d" in one for one in record["findings"]] == [True] * keeps
    assert predictions(path, path.samples[:1] * 2, np.zeros(1))[0]["use"] == ("not fitted" if keeps else "fitted")
    if keeps:
        with pytest.raises(diptych.NotConverged, match="no parameter is left"):
            with_data(Coordinates(both[:1], {"internal_length": 2.0}), [path], record)
