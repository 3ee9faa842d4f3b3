#!/usr/bin/python3
# diptych: the report of a tiny result folder
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run with the python3 that the program uses for its reports: python3 tests/program/report_test.py"""

import base64
import json
import os
import re
import sys
import tempfile
import unittest
from html.parser import HTMLParser

import numpy as np

import report_folder
from report_folder import REPORT, read, run, write_folder, write_json

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(REPORT))


class Page(HTMLParser):
    """Images (those for readers without scripts apart), canvases, links to anything, and the data of the maps."""

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


def stored(maps, index):
    """Values of an array of the page, as the browser decodes them."""
    entry = maps["arrays"][index]
    codes = np.frombuffer(base64.b64decode(entry["data"]), dtype="<u2").astype(float)
    return np.where(codes == 65535, np.nan, entry["low"] + codes * (entry["high"] - entry["low"]) / 65534)


class CompleteFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        write_folder(cls.folder.name)
        cls.outcome = run(cls.folder.name)
        cls.text = read(cls.folder.name) if cls.outcome.returncode == 0 else ""
        cls.page = Page(cls.text)
        cls.maps = json.loads(cls.page.maps)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def increment(self, key):
        return next(i for i in self.maps["increments"] if i["key"] == key)

    def test_succeeds_and_leaves_no_temporary_file(self):
        self.assertEqual(self.outcome.returncode, 0, self.outcome.stderr)
        self.assertEqual(self.outcome.stderr, "")
        self.assertFalse([name for name in os.listdir(self.folder.name) if name.endswith(".part")])

    def test_every_figure_is_there_with_words_for_those_who_cannot_see_it(self):
        self.assertEqual((len(self.page.images), len(self.page.canvases)), report_folder.number_of_figures())
        self.assertEqual(len(self.page.still), 2)
        self.assertTrue(all(len(image.get("alt", "")) > 20 for image in self.page.images + self.page.still))
        self.assertTrue(all(canvas.get("aria-label") for canvas in self.page.canvases))

    def test_both_panels_share_their_colour_limits(self):
        # 98th percentiles: grains 0.98 * 2 %, continuum 0.98 * 8 %, the lower counts: 1.96 %. Per axial strain 1.96/0.5 in both
        # stages, 1.96/1 in the window; their median, 3.92, gives 1.96 % over 0.5 % and 3.92 % over 1 %, two digits each.
        self.assertEqual(self.increment("stage-1")["values"]["shear"]["discs"]["limits"], [0.0, 2.0])
        self.assertEqual(self.increment("window-0")["values"]["shear"]["discs"]["limits"], [0.0, 3.9])
        for increment in self.maps["increments"]:
            for quantity, places in increment["values"].items():
                for place, values in places.items():
                    self.assertLess(*values["limits"], f"{quantity} {place}")

    def test_the_page_holds_the_numbers_of_the_files(self):
        # 16 bits over the range: at most half a code off, range/65534/2
        values = stored(self.maps, self.increment("stage-1")["values"]["shear"]["discs"]["discrete"])
        np.testing.assert_allclose(values, np.linspace(0, 2, 40), atol=2 / 65534 / 2 * 1.001)
        cells = stored(self.maps, self.increment("stage-1")["values"]["shear"]["cells"]["discrete"])
        np.testing.assert_array_equal(np.isnan(cells), [False, True, False, False, False, False])

    def test_a_window_shows_the_stress_of_the_stage_that_ends_with_it(self):
        window, stage = (self.increment(key)["values"]["s"]["cells"] for key in ("window-0", "stage-1"))
        self.assertEqual(window["continuum"], stage["continuum"])  # one array, stored once
        np.testing.assert_allclose(stored(self.maps, stage["continuum"]), 1.5)

    def test_stress_of_a_single_grain_is_its_moment_over_its_share_of_the_area(self):
        # moment = diag(1, 2) pi/4 on discs of area pi/4, no solid fraction stored (1): stresses 2 and 1, major vertical
        crosses = self.increment("stage-0")["crosses"]["discrete"]
        for key, value in (("s1", 2.0), ("s2", 1.0)):
            np.testing.assert_allclose(stored(self.maps, crosses[key]), value, rtol=1e-12)
        np.testing.assert_allclose(np.abs(stored(self.maps, crosses["a"])), np.pi / 2, rtol=1e-12)

    def test_velocities_count_in_the_platens_speed(self):
        # platen: 8 d sqrt(2) * 0.005 in 10 steps of time 1; grains: 0.001 sqrt(2)
        speed = stored(self.maps, self.increment("stage-1")["values"]["velocity"]["discs"]["discrete"])
        np.testing.assert_allclose(speed, 0.001 / (8 * 0.005 / 10), rtol=1e-9)

    def test_displacement_of_a_cell_is_the_mean_of_its_corners(self):
        # nodes move by (y, -y) per strain and the platen at y = 8 by 8 sqrt(2): a cell counts the height of its centre over 8
        for key in ("window-0", "stage-1"):
            moved = stored(self.maps, self.increment(key)["values"]["displacement"]["discs"]["continuum"])
            np.testing.assert_allclose(moved, np.repeat([1 / 6, 1 / 2, 5 / 6], 2), rtol=1e-4)

    def test_a_contact_without_force_is_not_drawn(self):
        forces = self.increment("stage-1")["forces"]
        np.testing.assert_allclose(stored(self.maps, forces["f"]), [3.0])

    def test_every_quantity_asked_for_can_be_chosen(self):
        offered = {quantity["key"]: quantity["places"] for quantity in self.maps["quantities"]}
        for key in ("shear", "displacement", "velocity", "rotation", "s", "t_over_s", "xx", "yy", "xy"):
            self.assertIn("discs", offered[key])
        for key in ("spin", "turn", "couple", "dissipation"):
            self.assertEqual(offered[key], ["cells", "grid"])

    def test_what_is_fitted_and_what_the_mesh_sets_is_said(self):
        self.assertIn("the scene does not say whether its parameters are fitted or predicted", self.text)
        self.assertIn("Thickness of the continuum&#39;s band: set by the mesh (local law); elements of 2 d. "
                      "On the coarse mesh, elements of 4 d: 2.2 d at −45.0°.", self.text)

    def test_no_band_is_called_diffuse(self):
        self.assertIn("diffuse: no band", self.text)

    def test_an_interval_stands_beside_its_number(self):
        self.assertIn("0.900 [0.800,\u00a01.000]", self.text)
        self.assertIn("−45.0° [−46.5,\u00a0−43.5]", self.text)

    def test_the_angle_to_the_minor_stress_stands_beside_the_theory_lines(self):
        # major stress at 90 degrees, so the minor one lies along the horizontal: a band at -45 degrees is 45 degrees from it
        self.assertIn("To the minor principal stress of the zone: grains 45.0°", self.text)
        self.assertIn("Coulomb 45° + φ/2 = 55.0°", self.text)

    def test_density_of_dissipation_in_the_band(self):
        # three quarters of it on half of the area: (0.75/0.5)/(0.25/0.5) = 3
        row = re.search(r"<th scope=\"row\">Grains</th><td>75.0 %</td><td>50.0 %</td><td>(.*?)</td>", self.text)
        self.assertEqual(row.group(1), "3.00")

    def test_a_value_that_is_null_is_not_computed_and_an_unknown_one_is_shown(self):
        self.assertIn("not computed", self.text)
        self.assertIn("a later key", self.text)

    def test_nothing_outside_the_file_is_needed(self):
        outside = [link for link in self.page.links if not link.startswith("data:")]
        self.assertEqual(outside, [])
        self.assertIsNone(re.search(r"url\(|@import", self.text))


class OtherFolders(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def test_optional_keys_may_be_absent_and_the_page_is_the_same_each_time(self):
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
        comparison["continuum_summary"] = {"law": "a law", "internal_length_d": length, "localisation_strain": None}
        write_json(self.folder.name, "comparison.json", comparison)
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)
        return read(self.folder.name)

    def test_a_law_with_an_internal_length_is_not_said_to_be_set_by_the_mesh(self):
        text = self.write_with_law(1.5)
        self.assertIn("band: internal length 1.5 d", text)
        self.assertNotIn("set by the mesh (local law)", text)
        self.assertIn("never", text)  # it did not localise

    def test_a_law_without_one_is(self):
        text = self.write_with_law(None)
        self.assertIn("band: set by the mesh (local law)", text)
        self.assertNotIn("internal length 1.5 d", text)

    def test_a_scene_named_like_markup_is_shown_as_it_is(self):
        write_folder(self.folder.name)
        record = report_folder.comparison_of_two_stages()
        record["scene"] = record["stages"][1]["discrete"]["probes"][0]["name"] = "</script><b>x"
        write_json(self.folder.name, "comparison.json", record)
        self.assertEqual(run(self.folder.name).returncode, 0)
        self.assertNotIn("</script><b>", read(self.folder.name))

    def test_stages_of_shear_are_drawn_against_the_travel(self):
        """In the mode shear the grains' axial strain stays 0: their histories are drawn against shear_strain."""
        write_folder(self.folder.name)
        with open(os.path.join(self.folder.name, "scene.prm"), "w", encoding="utf-8") as stream:
            stream.write("subsection loading\n  set mode = shear\nend\n")
        with open(os.path.join(self.folder.name, "discrete.csv"), "w", encoding="utf-8") as stream:
            stream.write("axial_strain,shear_strain,stress_ratio\n0,0.005,0.3\n0,0.01,0.3\n")
        from load import load
        np.testing.assert_array_equal(load(self.folder.name).histories["discrete"]["axial_strain"], [0.005, 0.01])

    def test_a_missing_file_is_named_and_ends_with_code_2(self):
        write_folder(self.folder.name, complete=False)
        os.remove(os.path.join(self.folder.name, "continuum.csv"))
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("continuum.csv", outcome.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder.name, "report.html")))

    def test_broken_json_is_named_and_ends_with_code_2(self):
        write_folder(self.folder.name, complete=False)
        with open(os.path.join(self.folder.name, "provenance.json"), "w", encoding="utf-8") as stream:
            stream.write('{"program": ')
        outcome = run(self.folder.name)
        self.assertEqual(outcome.returncode, 2)
        self.assertIn("provenance.json", outcome.stderr)


if __name__ == "__main__":
    unittest.main()
