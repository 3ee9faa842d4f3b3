#!/usr/bin/python3
# diptych: tests of the report of a tiny result folder
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run with the python3 that the program uses for its reports: python3 tests/program/report_test.py"""

import base64
import json
import os
import re
import sys
import tempfile
import types
import unittest
from html.parser import HTMLParser

import h5py
import numpy as np

import report_folder
from report_folder import REPORT, read, run, write_folder, write_json

sys.dont_write_bytecode = True
sys.path.insert(0, REPORT)


class Page(HTMLParser):
    """Images (those for readers without JavaScript separately), canvases, links, and the data of the maps."""

    def __init__(self, text):
        super().__init__()
        self.images, self.still, self.canvases, self.links, self.maps = [], [], [], [], ""
        self._without_scripts = self._data = False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        self._without_scripts |= tag == "noscript"
        self._data = attributes.get("id") == "map-data"
        if tag == "img":
            (self.still if self._without_scripts else self.images).append(attributes)
        if tag == "canvas":
            self.canvases.append(attributes)

    def handle_endtag(self, tag):
        self._without_scripts &= tag != "noscript"
        self._data &= tag != "script"

    def handle_data(self, text):
        if self._data:
            self.maps += text


HALF_A_CODE = 0.5 / 4094 * 1.001  # in units of the range of an array


def stored(maps, index):
    """Values of an array of the page, as the browser decodes them."""
    entry = maps["arrays"][index]
    first, middle, last = np.frombuffer(base64.b64decode(entry["data"]), dtype=np.uint8).astype(int).reshape(-1, 3).T
    codes = np.stack([first + 256 * (middle % 16), middle // 16 + 16 * last], axis=1).ravel()[:entry["size"]]
    return np.where(codes == 4095, np.nan, entry["low"] + codes * (entry["high"] - entry["low"]) / 4094)


class CompleteFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        write_folder(cls.folder.name)
        cls.outcome = run(cls.folder.name)
        cls.text = read(cls.folder.name) if cls.outcome.returncode == 0 else ""
        cls.words = cls.text.replace("\u00a0", " ")  # where no line may be broken
        cls.page = Page(cls.text)
        cls.maps = json.loads(cls.page.maps)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def increment(self, key):
        return next(i for i in self.maps["increments"] if i["key"] == key)

    def test_drawing_succeeds_without_temporary_files(self):
        self.assertEqual(self.outcome.returncode, 0, self.outcome.stderr)
        self.assertEqual(self.outcome.stderr, "")
        self.assertFalse([name for name in os.listdir(self.folder.name) if name.endswith(".part")])

    def test_every_figure_has_an_alternative_text(self):
        self.assertEqual((len(self.page.images), len(self.page.canvases)), report_folder.number_of_figures())
        self.assertEqual(len(self.page.still), 2)
        self.assertTrue(all(len(image.get("alt", "")) > 20 for image in self.page.images + self.page.still))
        self.assertTrue(all(canvas.get("aria-label") for canvas in self.page.canvases))

    def test_both_panels_share_their_colour_limits(self):
        # The 98th percentiles are 0.98 * 2 % (grains) and 0.98 * 8 % (continuum); the lower counts. Over axial strain this is 1.96/0.5
        # in both stages and 1.96/1 in the window. The median 3.92 gives 1.96 % over 0.5 % and 3.92 % over 1 %, rounded to two digits.
        self.assertEqual(self.increment("stage-1")["values"]["shear"]["discs"]["limits"], [0.0, 2.0])
        self.assertEqual(self.increment("window-0")["values"]["shear"]["discs"]["limits"], [0.0, 3.9])
        for increment in self.maps["increments"]:
            for quantity, places in increment["values"].items():
                for place, values in places.items():
                    self.assertLess(*values["limits"], f"{quantity} {place}")

    def test_the_page_holds_the_numbers_of_the_files(self):
        # 12 bits over the range: the error is at most half a code
        values = stored(self.maps, self.increment("stage-1")["values"]["shear"]["discs"]["discrete"])
        np.testing.assert_allclose(values, np.linspace(0, 2, 40), atol=2 * HALF_A_CODE)
        cells = stored(self.maps, self.increment("stage-1")["values"]["shear"]["cells"]["discrete"])
        np.testing.assert_array_equal(np.isnan(cells), [False, True, False, False, False, False])

    def test_a_window_shows_the_stress_of_the_stage_that_ends_with_it(self):
        window, stage = (self.increment(key)["values"]["s"]["cells"] for key in ("window-0", "stage-1"))
        self.assertEqual(window["continuum"], stage["continuum"])  # the same array, stored once
        np.testing.assert_allclose(stored(self.maps, stage["continuum"]), 1.5)

    def test_crosses_are_the_stored_principal_stresses(self):
        # 2 P along the vertical and 1 P across
        crosses = self.increment("stage-0")["crosses"]["discrete"]
        for key, value in (("s1", 2.0), ("s2", 1.0)):
            np.testing.assert_allclose(stored(self.maps, crosses[key]), value, rtol=1e-12)
        np.testing.assert_allclose(np.abs(stored(self.maps, crosses["a"])), np.pi / 2, rtol=1e-12)

    def test_arrows_are_relative_to_the_motion_of_the_platen(self):
        # A grain at y moves by (y, -y) per unit of progress and the platen by 0.5, so the ratio is 2 y. The velocities give
        # 0.001 / (0.5 * 0.005 / 10) = 4.
        arrows = self.increment("stage-1")["arrows"]["discrete"]
        y, u, v = (stored(self.maps, arrows["increment"][key]) for key in "yuv")
        np.testing.assert_allclose(u, 2 * y, rtol=1e-4)
        np.testing.assert_allclose(v, -2 * y, rtol=1e-4)
        np.testing.assert_allclose(stored(self.maps, arrows["velocity"]["u"]), 4, rtol=1e-9)

    def test_relative_speeds_and_displacements_are_those_stored(self):
        # the continuum is quasi-static: its relative velocity is its relative displacement
        values = self.increment("stage-1")["values"]
        for quantity, panel, expected in (("velocity", "discrete", np.full(40, 0.4)),
                                          ("velocity", "continuum", np.linspace(0.1, 0.6, 6)),
                                          ("displacement", "continuum", np.linspace(0.1, 0.6, 6))):
            np.testing.assert_allclose(stored(self.maps, values[quantity]["discs"][panel]), expected, atol=0.6 * HALF_A_CODE)

    def test_cells_are_their_four_nodes_anticlockwise(self):
        # the second cell, to the right of the first: 2.5 x 8/3 d
        corners = stored(self.maps, self.increment("window-0")["cells"]).reshape(-1, 4, 2)[1]
        np.testing.assert_allclose(corners, [[2.5, 0], [5, 0], [5, 8 / 3], [2.5, 8 / 3]], atol=8 * HALF_A_CODE)

    def test_colour_bars_have_the_titles_and_units_of_the_datasets(self):
        quantities = {quantity["key"]: quantity for quantity in self.maps["quantities"]}
        self.assertEqual(quantities["s"]["label"], "mean stress s (P)")
        self.assertEqual(quantities["rotation"]["label"], "rotation increment (degrees)")
        self.assertEqual(quantities["couple"]["label"], "couple stress (P d)")
        self.assertEqual(quantities["t_over_s"]["label"], "stress ratio t/s")
        self.assertIn("around each grain", quantities["shear"]["meaning"]["discs"])

    def test_a_contact_without_force_is_not_drawn(self):
        forces = self.increment("stage-1")["forces"]
        np.testing.assert_allclose(stored(self.maps, forces["f"]), [3.0])

    def test_every_quantity_can_be_chosen(self):
        offered = {quantity["key"]: quantity["places"] for quantity in self.maps["quantities"]}
        for key in ("shear", "displacement", "velocity", "rotation", "s", "t_over_s", "xx", "yy", "xy", "yx"):
            self.assertIn("discs", offered[key])
        for key in ("spin", "turn", "couple", "dissipation"):
            self.assertEqual(offered[key], ["cells", "grid"])

    def test_the_page_states_the_origin_of_parameters_and_of_the_band_width(self):
        self.assertIn("origin not stated in the scene", self.text)
        self.assertIn("Width of the band in the continuum: set by the mesh (local law); elements of 2 d. "
                      "On the coarse mesh with elements of 4 d: 2.2 d at −45.0°.", self.words)

    def test_a_stage_without_band_is_diffuse(self):
        self.assertIn("diffuse: no band", self.text)

    def test_lost_bands_reduce_the_basis_of_the_interval(self):
        self.assertIn("In 2 % of the bootstrap samples no band was found; the interval is based on the other 98 %.", self.words)

    def test_an_interval_follows_its_number(self):
        self.assertIn("0.900 [0.800, 1.000]", self.words)
        self.assertIn("−45.0° [−46.5, −43.5]", self.words)

    def test_the_angle_to_the_minor_stress_is_shown_with_theory_lines(self):
        # the major stress is vertical, so the minor stress is horizontal, at 45 degrees to a band at -45 degrees
        self.assertIn("Angle to the minor principal stress in the band: grains 45.0°", self.text)
        self.assertIn("Coulomb 45° + φ/2 = 55.0°", self.text)

    def test_dissipation_is_shown_in_per_cent_and_its_density_as_a_ratio(self):
        # 75 % of it on half of the area: (0.75/0.5)/(0.25/0.5) = 3
        row = re.search(r"<th scope=\"row\">Grains</th><td>75.0 %</td><td>50.0 %</td><td>(.*?)</td>", self.words)
        self.assertEqual(row.group(1), "3.00")

    def test_null_is_not_computed_and_unknown_keys_are_shown(self):
        self.assertIn("not computed", self.text)
        self.assertIn("a later key", self.text)

    def test_a_summary_has_the_meanings_and_units_of_the_program(self):
        # the initial height of 8 is shown in d; noise and unbalance have an expected value
        self.assertRegex(self.words, r'initial height</th><td>8 d</td>')
        self.assertRegex(self.words, r'grains: noise</th><td>0\.012</td><td>reliable below 0\.03</td>')
        self.assertRegex(self.words, r'platen unbalance</th><td>3\.0 × 10⁻⁴</td><td>equilibrium: 0</td>')
        self.assertNotIn("prototype", self.text)

    def test_counts_are_whole_numbers(self):
        self.assertIn("<td>12</td>", self.text)
        self.assertNotIn("12.000", self.text)

    def test_the_page_needs_no_other_file(self):
        outside = [link for link in self.page.links if not link.startswith("data:")]
        self.assertEqual(outside, [])
        self.assertIsNone(re.search(r"url\(|@import", self.text))


class OtherFolders(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def test_optional_keys_may_be_missing_and_the_page_is_reproducible(self):
        write_folder(self.folder.name, complete=False)
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        first = read(self.folder.name)
        self.assertIn("not computed", first)
        run(self.folder.name)
        self.assertEqual(read(self.folder.name), first)

    def write_with_law(self, length):
        write_folder(self.folder.name)
        path = os.path.join(self.folder.name, "comparison.json")
        with open(path, encoding="utf-8") as stream:
            comparison = json.load(stream)
        comparison["continuum_summary"] = {"law": "a_law", "internal_length_d": length, "localisation_strain": None}
        write_json(self.folder.name, "comparison.json", comparison)
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return read(self.folder.name).replace("\u00a0", " ")

    def test_an_internal_length_sets_the_band_width(self):
        text = self.write_with_law(1.5)
        self.assertIn("band in the continuum: internal length 1.5 d", text)
        self.assertNotIn("set by the mesh (local law)", text)
        self.assertIn("never", text)  # no localisation

    def test_the_mesh_sets_the_band_width_of_a_local_law(self):
        text = self.write_with_law(None)
        self.assertIn("band in the continuum: set by the mesh (local law)", text)
        self.assertNotIn("internal length 1.5 d", text)

    def test_a_scene_named_like_markup_is_shown_as_it_is(self):
        write_folder(self.folder.name)
        record = report_folder.comparison_of_two_stages()
        record["scene"] = record["stages"][1]["discrete"]["probes"][0]["name"] = "</script><b>x"
        write_json(self.folder.name, "comparison.json", record)
        self.assertEqual(run(self.folder.name).returncode, 0)
        self.assertNotIn("</script><b>", read(self.folder.name))

    def axes_of(self, walk):
        """Labels of the axes in the charts of histories."""
        write_folder(self.folder.name)
        record = dict(report_folder.comparison_of_two_stages(), walk=walk)
        write_json(self.folder.name, "comparison.json", record)
        outcome = run(self.folder.name)
        self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
        text = read(self.folder.name)
        pictures = [base64.b64decode(data).decode() for data in re.findall(r"data:image/svg\+xml;base64,([^\"]+)", text)]
        return text, [word for word in ("axial strain (%)", "shear strain (%)", ">time<") if any(word in p for p in pictures)]

    def test_axes_name_the_loading_variable(self):
        text, labels = self.axes_of("shear_strain")
        self.assertEqual(labels, ["shear strain (%)"])
        self.assertIn("mean over the last 0.5 % of shear strain", text)
        text, labels = self.axes_of("time")
        self.assertEqual(labels, [">time<"])
        self.assertIn("mean over the last 0.005 of time", text)

    def test_lengths_and_stresses_are_shown_in_d_and_P(self):
        """With d = 2 and P = 10, the corner of a probe at 1 is at 0.5 d, and a major stress of 2 is 0.2 P."""
        write_folder(self.folder.name)
        write_json(self.folder.name, "comparison.json",
                   dict(report_folder.comparison_of_two_stages(), mean_diameter=2.0, pressure=10.0))
        self.assertEqual(run(self.folder.name).returncode, 0)
        maps = json.loads(Page(read(self.folder.name)).maps)
        stage = next(i for i in maps["increments"] if i["key"] == "stage-1")
        self.assertEqual(stage["probes"]["continuum"]["rectangles"][0]["polygon"][0], [0.5, 2.75])
        self.assertEqual(stage["probes"]["continuum"]["rectangles"][0]["s1"], 0.2)
        np.testing.assert_allclose(stored(maps, stage["crosses"]["discrete"]["s1"]), 0.2)
        np.testing.assert_allclose(stored(maps, stage["discs"]["r"]), 0.25)
        np.testing.assert_allclose(stored(maps, stage["forces"]["f"]), 3 / 20)

    def test_another_format_is_an_input_error(self):
        write_folder(self.folder.name, complete=False)
        write_json(self.folder.name, "comparison.json", {"format": 1, "stages": []})
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertRegex(outcome.stderr, r"^report: .*comparison\.json: format 1, .*format 2")

    def test_wrong_arguments_are_an_input_error(self):
        outcome = run(self.folder.name, "figure")
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("page|ensemble|study|calibration|step-study", outcome.stderr)

    def test_a_missing_file_is_an_input_error(self):
        write_folder(self.folder.name, complete=False)
        os.remove(os.path.join(self.folder.name, "continuum.csv"))
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("continuum.csv", outcome.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder.name, "report.html")))

    def test_arrays_of_another_comparison_are_an_input_error(self):
        write_folder(self.folder.name)
        path = os.path.join(self.folder.name, "comparison.h5")
        with h5py.File(path, "w") as file:
            file["mine"] = [1.0]
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertRegex(outcome.stderr, r"^report: .*comparison\.h5: has no group")
        write_folder(self.folder.name)
        with h5py.File(path, "r+") as file:
            file["stage_0001"].attrs["to"] = 0.5
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertRegex(outcome.stderr, r"^report: .*comparison\.h5: stage_0001 does not end")

    def test_unknown_contents_are_an_input_error_that_names_the_files(self):
        write_folder(self.folder.name)
        with h5py.File(os.path.join(self.folder.name, "comparison.h5"), "r+") as file:
            file["stage_0001"].attrs["centre"] = "mine"
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("comparison.h5", outcome.stderr)

    def test_a_wrong_provenance_is_an_input_error(self):
        write_folder(self.folder.name, complete=False)
        for text in ('{"program": ', '{"a": [1, 2]}'):
            with open(os.path.join(self.folder.name, "provenance.json"), "w", encoding="utf-8") as stream:
                stream.write(text)
            outcome = run(self.folder.name)
            self.assertEqual(outcome.returncode, 2, text)
            self.assertIn("provenance.json", outcome.stderr)


class Opening(unittest.TestCase):
    def test_the_page_opens_on_the_last_window_or_stage(self):
        from diptych_report.page import opening
        windows, stages = ([types.SimpleNamespace(kind=kind, end=end) for end in ends]
                           for kind, ends in (("window", (0.01, 0.02)), ("stage", (0.005, 0.01, 0.02, 0.03))))
        self.assertEqual((opening.end_of(windows + stages), opening.end_of(stages), opening.end_of([])), (0.02, 0.03, 0.0))
        self.assertIs(opening.opens_at(windows + stages, 0.02), windows[1])
        self.assertIs(opening.opens_at(stages, 0.02), stages[2])  # the same instant in a part without windows
        self.assertIs(opening.opens_at([], 0.0), None)


class StepStudy(unittest.TestCase):
    def test_a_step_study_is_drawn_and_a_missing_file_is_an_input_error(self):
        with tempfile.TemporaryDirectory() as folder:
            outcome = run(folder, "step-study")
            self.assertEqual(outcome.returncode, 2)
            self.assertIn("study_step.csv", outcome.stderr)
            write_json(folder, "study_step.json", {"verdict": "the step does not matter", "steps": [0.1, 0.05]})
            with open(os.path.join(folder, "study_step.csv"), "w", encoding="utf-8") as stream:
                stream.write("step,time,progress,stress_ratio,stress_ratio_mean,external_work\n")
                stream.writelines(f"{step},{k},{0.001 * k},0.3,0.3,{k}\n" for step in (0.1, 0.05) for k in range(5))
            outcome = run(folder, "step-study")
            self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
            with open(os.path.join(folder, "study_step.png"), "rb") as stream:
                self.assertEqual(stream.read(8), b"\x89PNG\r\n\x1a\n")


class Ensemble(unittest.TestCase):
    def test_curves_are_those_stored_or_not_computed(self):
        interval = {"value": 0.1, "low": 0.0, "high": 0.2}
        verdict = {"quantity": "peak_stress_ratio", "unit": "-", "margin": 0.1, "relative": False, "difference": interval,
                   "difference_90": interval, "n": 2, "verdict": "cannot tell", "discrete": [0.3, 0.4], "continuum": [0.4, 0.5]}
        record = {"format": 1, "scene": "tiny", "seeds": [1, 2], "done": [1, 2], "failed": [], "interrupted": [], "bands": [],
                  "quantities": [], "verdicts": [verdict], "folded": False, "walk": "shear_strain"}
        with tempfile.TemporaryDirectory() as folder:
            write_json(folder, "ensemble.json", record)
            self.assertEqual(run(folder, "ensemble").returncode, 0)
            self.assertEqual(read(folder).count("not computed"), 2)
            with h5py.File(os.path.join(folder, "ensemble.h5"), "w") as file:
                file["progress"] = np.linspace(0, 0.01, 5)
                file.attrs["averaging_width"] = 0.005
                for name in ("discrete/stress_ratio", "continuum/stress_ratio"):
                    file[name + "/members"] = np.full((2, 5), 0.3)
                    for key in ("mean", "low", "high"):
                        file[f"{name}/{key}"] = np.full(5, 0.3)
            outcome = run(folder, "ensemble")
            self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
            text = read(folder).replace("\u00a0", " ")
            self.assertEqual(text.count("not computed"), 1)  # the volumetric strain
            self.assertIn("mean over the last 0.5 % of shear strain", text)


if __name__ == "__main__":
    unittest.main()
