#!/usr/bin/python3
# diptych: formulas and units of the report, without a page
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import re
import sys
import types
import unittest

import numpy as np

from report_folder import REPORT, numbers, panel, within

sys.dont_write_bytecode = True
sys.path.insert(0, REPORT)

from diptych_report.charts import style  # noqa: E402
from diptych_report.data.increments import Increment  # noqa: E402
from diptych_report.data.numbers import Descriptions, Units  # noqa: E402
from diptych_report.data.walk import WALKS  # noqa: E402
from diptych_report.tables import stage as tables  # noqa: E402
from diptych_report.tables import wording  # noqa: E402


class Formulas(unittest.TestCase):
    def test_a_thinned_history_keeps_its_spike(self):
        values = np.zeros(10000)
        values[4321] = 7.0
        x, y = style.thin(np.arange(10000.0), values, 100)
        self.assertLessEqual(len(x), 100)
        self.assertEqual(y[x == 4321.0], 7.0)

    def test_a_unit_is_its_product_of_pressures_and_lengths(self):
        # d = 2 and P = 10: a force of 40 is 2 P d, a moment of 80 is 2 P d^2; times stay as they are
        expected = {"length": 2, "pressure": 10, "pressure length": 20, "pressure length^2": 40, "length/time": 2,
                    "length^2/time^2": 4, "mean diameters": 1, "degrees": 1, "rad": 1, "-": 1, "strain or time": 1, "s": 1, "": 1}
        self.assertEqual({unit: Units(2.0, 10.0).size(unit) for unit in expected}, expected)

    def test_stresses_and_lengths_are_shown_in_P_and_d(self):
        # d = 2 and P = 10: a stress of 20 is 2 P, a corner at 6 is at 3 d; what is not known stays so
        value = {"stages": [{"discrete": {
            "probes": [{"polygon": [[6.0, 2.0]], "s1": within(20.0, 10.0, None), "s2": None, "contacts": 7}],
            "circular_probe": {"centre": [4.0, 2.0], "radius": 6.0, "normal": [20.0]},
            "band_traction": {"normal": [None, 30.0]}, "bands": [{"offset_d": 3.0}]}}]}
        self.assertEqual(Descriptions(numbers()).shown_in(value, Units(2.0, 10.0)), {"stages": [{"discrete": {
            "probes": [{"polygon": [[3.0, 1.0]], "s1": within(2.0, 1.0, None), "s2": None, "contacts": 7}],
            "circular_probe": {"centre": [2.0, 1.0], "radius": 3.0, "normal": [2.0]},
            "band_traction": {"normal": [None, 3.0]}, "bands": [{"offset_d": 3.0}]}}]})

    def test_units_are_written_as_the_page_says_them(self):
        expected = {"pressure length^2": " P d²", "mean diameters": " d", "degrees": "°", "-": "", "length/time": " d/time"}
        self.assertEqual({unit: wording.suffix(unit) for unit in expected}, expected)

    def test_an_echoed_scene_gives_key_value_and_meaning(self):
        from diptych_report.data.scene import scene_section
        text = "# tiny\nsubsection other\n  set a = 1\nend\nsubsection continuum\n  # stiffness [pressure]; > 0\n" \
               "  set youngs_modulus = 500\nend\n"
        self.assertEqual(scene_section(text, "continuum"), [("youngs_modulus", "500", "stiffness [pressure]; > 0")])

    def test_a_band_at_minus_45_degrees_goes_right_and_down_with_its_normal_up_and_right(self):
        along, normal = style.band_axes(-45.0)
        np.testing.assert_allclose(along, [np.sqrt(0.5), -np.sqrt(0.5)], atol=1e-15)
        np.testing.assert_allclose(normal, [np.sqrt(0.5), np.sqrt(0.5)], atol=1e-15)

    def test_a_standard_error_stands_where_there_is_no_interval(self):
        increment = Increment("stage-0", "stage", 0.0, 0.01, {"discrete": panel([])}, WALKS["axial_strain"])
        increment.record["discrete"]["probes"][0]["fabric_to_stress_deg"] = within(2.0, -3.0, 7.0)
        table = tables.probes(types.SimpleNamespace(numbers=Descriptions(numbers())), increment)
        row = dict(zip(table["head"], table["rows"][0]))
        self.assertEqual(row["fabric to stress"], "2.0° [−3.0,\u00a07.0]")
        self.assertEqual(row["fabric_direction_deg"], "−88.0° ± 4.0°")

    def test_lines_that_differ_by_half_a_turn_are_one(self):
        # strips at 89 degrees, a band at -89: 2 degrees apart, not 178
        from diptych_report.charts.strips import _turn
        self.assertAlmostEqual(_turn({"angle_deg": -89.0}, 89.0), 2.0)

    def test_an_ensembles_places_keep_their_ends_apart(self):
        from diptych_report.data.ensemble import Ensemble
        results = Ensemble("", {}, {}, None, WALKS["axial_strain"], None, {}, None, "", {})
        self.assertEqual(results.place("window 0.01-0.02"), ("window", "1–2\u00a0%"))
        self.assertEqual(results.place("window 1e-05-0.02"), ("window", "0.001–2\u00a0%"))

    def test_no_module_reaches_against_the_arrows(self):
        # page -> charts, tables -> data; charts.style is the one module of the charts that others share
        allowed = {"data": {"data"}, "charts": {"data", "charts.style"}, "tables": {"data", "tables"},
                   "page": {"data", "charts", "tables", "page"}}
        package = os.path.join(REPORT, "diptych_report")
        for folder, targets in allowed.items():
            for name in sorted(os.listdir(os.path.join(package, folder))):
                if not name.endswith(".py"):
                    continue
                with open(os.path.join(package, folder, name), encoding="utf-8") as stream:
                    text = stream.read()
                self.assertLess(text.count("\n"), 300, name)
                for module, names in re.findall(r"^\s*from diptych_report\.(\S+) import (.+)", text, re.M):
                    reached = {module} if "." in module else {f"{module}.{n.strip().split(' ')[0]}" for n in names.split(",")}
                    for one in reached:
                        self.assertTrue(any(one == t or one.startswith(t + ".") for t in targets), f"{folder}/{name}: {one}")


if __name__ == "__main__":
    unittest.main()
