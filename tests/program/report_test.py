#!/usr/bin/python3
# diptych: the report of a tiny result folder
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run with the python3 that the program uses for its reports: python3 tests/program/report_test.py"""

import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser

import h5py
import numpy as np

REPORT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "coupling", "report", "report.py")
BAND = {"angle_deg": -45.0, "half_width_d": 1.0, "width_10_90_d": 2.197, "offset_d": 0.0, "jump": 0.9,
        "dilation_deg": 3.0, "r_squared": 0.98}
STRIPS = {"angle_deg": -45.0, "edges_d": list(np.linspace(-4, 4, 17)), "mean": [None] + list(np.linspace(0, 1, 15)),
          "deviation": [None] + [0.1] * 15, "count": [0] + [2] * 15}


def probe(name, y):
    return {"name": name, "polygon": [[1, y], [4, y], [4, y + 1.5], [1, y + 1.5]], "stress": [[1, 0], [0, 2]],
            "s1": 2.0, "s2": 1.0, "direction_deg": 90.0, "t_over_s": 1 / 3, "fabric_direction_deg": -88.0,
            "fabric_direction_error_deg": 4.0, "anisotropy": 0.3, "anisotropy_error": 0.05, "normals_24": [3] * 24,
            "contacts": 36}


def panel(bands):
    return {"stress_ratio": 0.3, "volumetric_strain": -0.001, "bands": bands, "strips": STRIPS,
            "probes": [probe(name, y) for name, y in (("upper", 5.5), ("zone", 3.0), ("lower", 0.5))]}


def write_group(file, name, start, end, stress):
    """5 x 8 d: a lattice of 40 grains, 2 x 3 cells; continuum strains four times the grains'."""
    group = file.create_group(name)
    group.attrs.update({"from": start, "axial_strain": end})
    x, y = (v.ravel() + 0.5 for v in np.meshgrid(np.arange(5.0), np.arange(8.0)))
    group["discrete/position"] = np.column_stack([x, y])
    group["discrete/radius"] = np.full(40, 0.5)
    group["discrete/displacement_increment"] = np.column_stack([y, -y]) * (end - start)
    group["discrete/shear_strain_increment"] = np.linspace(0, 0.02, 40)
    corners = np.array([[[2.5 * (i + a), 8 / 3 * (j + b)] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                        for j in range(3) for i in range(2)])
    nodes = np.unique(corners.reshape(-1, 2), axis=0)
    group["nodes/position"] = nodes
    group["nodes/displacement_increment"] = np.column_stack([nodes[:, 1], -nodes[:, 1]]) * (end - start)
    group["cells/corners"] = corners
    group["cells/continuum_shear_strain_increment"] = np.linspace(0, 0.08, 6)
    group["cells/discrete_shear_strain_increment"] = np.array([0.01, np.nan, 0.01, 0.02, 0.01, 0.0])
    if stress:
        tensor = np.tile(np.diag([1.0, 2.0]), (6, 1, 1))
        group["cells/continuum_stress"] = tensor
        group["cells/discrete_stress"] = tensor * np.array([0.5, np.nan, 1.0, 2.0, 1.0, 0.8])[:, None, None]


def write_folder(folder, complete=True):
    """Two stages (the first one diffuse in both panels) and one window; without optional keys if not complete."""
    comparison = {"format": 1, "scene": "tiny", "seed": 3}
    if complete:
        comparison["stages"] = [
            {"axial_strain": end, "discrete": panel(bands), "continuum": panel(bands),
             "difference": {"stress_ratio": 0.0, "angle_deg": None}, "mapping": {"method": "segments"}}
            for end, bands in ((0.005, []), (0.01, [BAND]))]
        comparison["windows"] = [{"from": 0.0, "to": 0.01, "discrete": panel([dict(BAND, angle_deg={
            "value": -45.0, "low": -46.5, "high": -43.5})]), "continuum": panel([BAND, dict(BAND, angle_deg=44.0)])}]
        comparison["windows"][0]["discrete"]["bands"][0]["jump"] = {"value": 0.9, "low": 0.8, "high": 1.0}
        comparison["continuum_coarse"] = {"element_size_d": 4.0, "windows": [{"from": 0.0, "to": 0.01, "bands": [BAND]}]}
        comparison["continuum_summary"] = {"element_size_d": 2.0, "law": {"friction_angle_peak": 20.5}}
        comparison["discrete_summary"] = {"grains": 40, "residual_factor": None, "a_later_key": 1.5}
        comparison["cost"] = {"discrete_cpu_s": 1.0}
    with h5py.File(os.path.join(folder, "comparison.h5"), "w") as file:
        if complete:
            file.attrs.update(mean_diameter=1.0, pressure=1.0, height0=8.0, width0=5.0)
            write_group(file, "stage_0001", 0.0, 0.005, True)
            write_group(file, "stage_0002", 0.005, 0.01, True)
            write_group(file, "window_0", 0.0, 0.01, False)
    write_json(folder, "comparison.json", comparison)
    write_json(folder, "provenance.json", {"phases": [{"name": "discrete", "cpu_s": 1.0}]} if complete else {})
    columns = "axial_strain,stress_ratio,volumetric_strain,lower_fy,upper_fy" + (
        ",sweeps,residual,kinetic_energy_ratio" if complete else "")
    for name in ("discrete.csv", "continuum.csv"):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
            stream.write(columns + "\n")
            for k in range(1, 21):
                row = [0.0005 * k, 0.3, -0.001 * k, 10, -10.05] + ([20, 1e-5, 1.2] if complete else [])
                stream.write(",".join(map(str, row)) + "\n")


def write_json(folder, name, value):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
        json.dump(value, stream)


def run(folder):
    return subprocess.run([sys.executable, REPORT, folder], capture_output=True, text=True, check=False)


def read(folder):
    with open(os.path.join(folder, "report.html"), encoding="utf-8") as stream:
        return stream.read()


class Page(HTMLParser):
    """Images, links to anything, and the colour limits of each pair of panels."""

    def __init__(self, text):
        super().__init__()
        self.images, self.links, self.pairs = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        if tag == "img":
            self.images.append(attributes)
        if attributes.get("class") == "pair":
            self.pairs.append([])
        if "data-vmin" in attributes:
            self.pairs[-1].append((attributes["data-panel"], attributes["data-vmin"], attributes["data-vmax"]))


class CompleteFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        write_folder(cls.folder.name)
        cls.outcome = run(cls.folder.name)
        cls.text = read(cls.folder.name) if cls.outcome.returncode == 0 else ""
        cls.page = Page(cls.text)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_succeeds_and_leaves_no_temporary_file(self):
        self.assertEqual(self.outcome.returncode, 0, self.outcome.stderr)
        self.assertEqual(self.outcome.stderr, "")
        self.assertFalse([name for name in os.listdir(self.folder.name) if name.endswith(".part")])

    def test_every_figure_is_there_with_words_for_those_who_cannot_see_it(self):
        # strain 3 increments x 2; stress 2 stages x 2 quantities x 2; cells, arrows, strips 1 window x 2 each;
        # probes 2 stages x (2 maps + roses); 6 histories.
        self.assertEqual(len(self.page.images), 6 + 8 + 2 + 2 + 2 + 6 + 6)
        self.assertTrue(all(len(image.get("alt", "")) > 20 for image in self.page.images))

    def test_both_panels_have_the_same_colour_limits(self):
        coloured = [pair for pair in self.page.pairs if pair]
        self.assertEqual(len(coloured), 3 + 4 + 1)
        for left, right in coloured:
            self.assertEqual((left[0], right[0]), ("discrete", "continuum"))
            self.assertEqual(left[1:], right[1:])
            self.assertLess(float(left[1]), float(left[2]))

    def test_what_is_fitted_and_what_the_mesh_sets_is_said(self):
        self.assertIn("fitted, not predicted", self.text)
        # of both bands of the continuum and of the coarse mesh, with its element size
        row = re.search(r"10–90 % width</th>(.*?)</tr>", self.text).group(1)
        self.assertEqual(row.count("set by the mesh (local law)"), 3)
        self.assertIn("elements of 4 d", self.text)

    def test_no_band_is_called_diffuse(self):
        self.assertIn("diffuse: no band", self.text)

    def test_an_interval_stands_beside_its_number(self):
        self.assertIn("0.900 [0.800, 1.000]", self.text)

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
        text = read(self.folder.name)
        return text, re.search(r"10–90 % width</th>(.*?)</tr>", text).group(1)

    def test_a_law_with_an_internal_length_is_not_said_to_be_set_by_the_mesh(self):
        text, row = self.write_with_law(1.5)
        self.assertEqual(row.count("internal length 1.5 d"), 3)
        self.assertNotIn("set by the mesh (local law)", text)
        self.assertIn("never", text)  # it did not localise

    def test_a_law_without_one_is(self):
        text, row = self.write_with_law(None)
        self.assertEqual(row.count("set by the mesh (local law)"), 3)
        self.assertNotIn("internal length 1.5 d", text)

    def test_stages_of_shear_are_drawn_against_the_travel(self):
        """In the mode shear the grains' axial strain stays 0: their histories are drawn against shear_strain."""
        write_folder(self.folder.name)
        with open(os.path.join(self.folder.name, "scene.prm"), "w", encoding="utf-8") as stream:
            stream.write("subsection loading\n  set mode = shear\nend\n")
        with open(os.path.join(self.folder.name, "discrete.csv"), "w", encoding="utf-8") as stream:
            stream.write("axial_strain,shear_strain,stress_ratio\n0,0.005,0.3\n0,0.01,0.3\n")
        sys.path.insert(0, os.path.dirname(REPORT))
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


class Formulas(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        sys.dont_write_bytecode = True
        sys.path.insert(0, os.path.dirname(REPORT))

    def test_trailing_mean_of_a_straight_line_lags_by_half_the_window(self):
        # mean of x over [x - w, x] is x - w/2, for uneven steps too; before a full window there is no value
        from curves import trailing_mean
        strain = np.concatenate([np.linspace(0, 0.004, 5), np.linspace(0.0045, 0.02, 40)])
        mean = trailing_mean(strain, strain, 0.005)
        full = strain >= 0.005
        np.testing.assert_allclose(mean[full], strain[full] - 0.0025, rtol=1e-12, atol=1e-15)
        self.assertTrue(np.isnan(mean[~full]).all())

    def test_a_thinned_history_keeps_its_spike(self):
        from curves import thin
        values = np.zeros(10000)
        values[4321] = 7.0
        x, y = thin(np.arange(10000.0), values, 100)
        self.assertLessEqual(len(x), 100)
        self.assertEqual(y[x == 4321.0], 7.0)

    def test_stresses_and_lengths_of_probes_are_shown_in_P_and_d(self):
        # d = 2 and P = 10: a stress of 20 is 2 P, a corner at 6 is at 3 d
        from load import _scale_probes
        value = {"probes": [{"polygon": [[6.0, 2.0]], "s1": 20.0, "s2": None}]}
        _scale_probes(value, 2.0, 10.0)
        self.assertEqual(value["probes"], [{"polygon": [[3.0, 1.0]], "s1": 2.0, "s2": None}])

    def test_an_echoed_scene_gives_key_value_and_meaning(self):
        from load import scene_section
        text = "# tiny\nsubsection other\n  set a = 1\nend\nsubsection continuum\n  # stiffness [pressure]; > 0\n" \
               "  set youngs_modulus = 500\nend\n"
        self.assertEqual(scene_section(text, "continuum"), [("youngs_modulus", "500", "stiffness [pressure]; > 0")])

    def test_a_band_at_minus_45_degrees_goes_right_and_down_with_its_normal_up_and_right(self):
        from maps import band_axes
        along, normal = band_axes({"angle_deg": -45.0})
        np.testing.assert_allclose(along, [np.sqrt(0.5), -np.sqrt(0.5)], atol=1e-15)
        np.testing.assert_allclose(normal, [np.sqrt(0.5), np.sqrt(0.5)], atol=1e-15)

    def test_fabric_and_stress_directions_have_no_sense(self):
        # 90 and -88 degrees are 2 degrees apart, not 178
        import tables
        from load import Increment
        table = tables.probes(Increment("stage-0", "stage", 0.0, 0.01, {"discrete": panel([])}))
        self.assertEqual(dict(zip(table["head"], table["rows"][0]))["fabric − stress"], "2.0°")


if __name__ == "__main__":
    unittest.main()
