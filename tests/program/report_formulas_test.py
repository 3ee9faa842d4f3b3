#!/usr/bin/python3
# diptych: formulas and units of the report, without a page
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import sys
import unittest

import numpy as np

from report_folder import REPORT, panel

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(REPORT))


class Formulas(unittest.TestCase):
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

    def test_stresses_and_lengths_are_shown_in_P_and_d(self):
        # d = 2 and P = 10: a stress of 20 is 2 P, a corner at 6 is at 3 d, a force of 40 is 2 P d, a moment of 80 is 2 P d^2
        from increments import _scale_panel, unit_of
        value = {"probes": [{"polygon": [[6.0, 2.0]], "s1": {"value": 20.0, "low": 10.0, "high": None}, "s2": None}],
                 "circular_probe": {"centre": [4.0, 2.0], "radius": 6.0, "normal": [20.0]},
                 "band_traction": {"normal": [None, 30.0]}}
        _scale_panel(value, 2.0, 10.0)
        probe = {"polygon": [[3.0, 1.0]], "s1": {"value": 2.0, "low": 1.0, "high": None}, "s2": None}
        self.assertEqual(value, {"probes": [probe],
                                 "circular_probe": {"centre": [2.0, 1.0], "radius": 3.0, "normal": [2.0]},
                                 "band_traction": {"normal": [None, 3.0]}})
        units = {"discrete/position": 2, "cells/discrete_stress": 10, "cells/discrete_couple_stress": 20, "contacts/force": 20,
                 "discrete/internal_moment": 40, "cells/continuum_dissipation": 10, "cells/discrete_standard_error": 10,
                 "grid/discrete_displacement_increment": 2, "cells/discrete_shear_strain_increment": 1}
        self.assertEqual({name: unit_of(name, 2.0, 10.0) for name in units}, units)

    def test_an_echoed_scene_gives_key_value_and_meaning(self):
        from load import scene_section
        text = "# tiny\nsubsection other\n  set a = 1\nend\nsubsection continuum\n  # stiffness [pressure]; > 0\n" \
               "  set youngs_modulus = 500\nend\n"
        self.assertEqual(scene_section(text, "continuum"), [("youngs_modulus", "500", "stiffness [pressure]; > 0")])

    def test_a_band_at_minus_45_degrees_goes_right_and_down_with_its_normal_up_and_right(self):
        from still import band_axes
        along, normal = band_axes(-45.0)
        np.testing.assert_allclose(along, [np.sqrt(0.5), -np.sqrt(0.5)], atol=1e-15)
        np.testing.assert_allclose(normal, [np.sqrt(0.5), np.sqrt(0.5)], atol=1e-15)

    def test_fabric_and_stress_directions_have_no_sense(self):
        # 90 and -88 degrees are 2 degrees apart, not 178
        import stage_tables
        from increments import Increment
        table = stage_tables.probes(Increment("stage-0", "stage", 0.0, 0.01, {"discrete": panel([])}))
        self.assertEqual(dict(zip(table["head"], table["rows"][0]))["fabric − stress"], "2.0°")

    def test_solver_noise_counts_in_grain_diameters_and_the_pressures_speed(self):
        # residual 1e-5, step 4 in units of 1/s with d = 2, P = 16, rho = 4: h sqrt(P/rho)/d = 4, over I = 1e-4: 0.4
        import types

        import accuracy
        result = types.SimpleNamespace(pressure=16.0, diameter=2.0, scene={"sample": {"density": "4"}})
        noise = accuracy._noise(result, {"residual": 1e-5, "step_length": 4.0, "mean_inertial_number": 1e-4})
        self.assertAlmostEqual(noise, 0.4, places=12)

    def test_an_interval_of_the_inclination_turns_with_it(self):
        # band at -45 [-50, -42], minor stress at 0: 45 degrees, between 42 and 50
        from increments import Increment
        from trends import to_minor_stress
        band = {"angle_deg": {"value": -45.0, "low": -50.0, "high": -42.0}, "jump": 1.0}
        record = {"discrete": {"bands": [band], "probes": [{"name": "zone", "direction_deg": 90.0}]}}
        stage = Increment("stage-0", "stage", 0.0, 0.01, record, end_record=record)
        self.assertEqual(to_minor_stress(stage, "discrete"), {"value": 45.0, "low": 42.0, "high": 50.0})


if __name__ == "__main__":
    unittest.main()
