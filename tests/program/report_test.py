# diptych: tests of the report of a tiny result folder
# SPDX-License-Identifier: LGPL-2.1-or-later
import base64
import glob
import json
import os
import re
import tempfile
import types
import unittest
from unittest import mock

import h5py
import matplotlib
import numpy as np

import diptych.report
import report_folder
from diptych.report import calibration, ensemble, studies
from diptych.report.charts import by_matplotlib, colour_maps, trends
from diptych.report.charts.drawing import Axis, Figure
from diptych.report.charts.strips import _turn
from diptych.report.charts.style import thin
from diptych.report.data.numbers import Descriptions, LOADING_VARIABLES, Units
from diptych.report.data.result import Increment
from diptych.report.page.result_page import end_of, opens_at
from diptych.report.tables import stage as tables
from report_folder import read, run, write_folder, write_json


HALF_A_CODE = 0.5 / 65534 * 1.01  # in units of the range of an array


def stored(maps, index):
    """Values of an array of the page, as the browser decodes them."""
    entry = maps["arrays"][index]
    codes = np.frombuffer(base64.b64decode(entry["data"]), dtype="<u2")
    return np.where(codes == 65535, np.nan, entry["low"] + codes * (entry["high"] - entry["low"]) / 65534)


def maps_of(text):
    """The data of the maps in a page."""
    return json.loads(re.search(r'id="map-data">(.*?)</script>', text)[1])


def page_of(folder, **changes):
    """Text of the page of the tiny folder, with changes of its comparison; drawn without a message."""
    write_folder(folder)
    write_json(folder, "comparison.json", {**report_folder.comparison_of_two_stages(), **changes})
    outcome = run(folder)
    if (outcome.returncode, outcome.stderr) != (0, ""):
        raise RuntimeError(outcome.stderr)
    return read(folder)


class CompleteFolder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        cls.text = page_of(cls.folder)
        cls.words = cls.text.replace("\u00a0", " ")  # where no line may be broken
        cls.maps = maps_of(cls.text)

    def increment(self, key):
        return next(i for i in self.maps["increments"] if i["key"] == key)

    def test_drawing_again_gives_the_same_page_and_leaves_no_temporary_file(self):
        self.assertEqual(page_of(self.folder), self.text)
        self.assertFalse([name for name in os.listdir(self.folder) if name.endswith(".part")])

    def test_every_figure_has_an_alternative_text(self):
        images = re.findall(r'<img [^>]*alt="([^"]{20,})"', self.text)
        canvases = re.findall(r'<canvas [^>]*aria-label="[^"]+"', self.text)
        self.assertEqual((len(images), len(canvases)), report_folder.number_of_figures())

    def test_profiles_of_a_classical_continuum_are_those_that_it_has(self):
        pictures = dict(re.findall(
            r'src="data:image/svg\+xml;base64,([^"]*)" alt="(Grains|Continuum): rotation minus spin', self.text))
        drawn = {panel: base64.b64decode(picture).decode() for picture, panel in pictures.items()}
        self.assertEqual(drawn["Continuum"].count("a classical continuum has none"), 2)  # rotation and couple stress
        self.assertIn("a continuum has no fluctuations", drawn["Continuum"])
        self.assertNotIn("a classical continuum has none", drawn["Grains"])
        self.assertIn("solid fraction", drawn["Continuum"])

    def test_both_panels_share_their_colour_limits(self):
        # The 98th percentiles are 0.98 * 2 % (grains) and 0.98 * 8 % (continuum); the grains count. Over axial strain
        # this is 1.96/0.5 in both stages and 1.96/1 in the window. The median 3.92 gives 1.96 % over 0.5 % and 3.92 %
        # over 1 %, rounded to two digits.
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
        # A grain at y moves by (y, -y) per unit of progress and the platen by 0.5, so the ratio is 2 y. The velocities
        # give 0.001 / (0.5 * 0.005 / 10) = 4.
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
            np.testing.assert_allclose(stored(self.maps, values[quantity]["discs"][panel]), expected,
                                       atol=0.6 * HALF_A_CODE)

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

    def test_the_page_states_what_was_found(self):
        # The major stress is vertical, so the minor stress is horizontal, at 45 degrees to a band at -45 degrees.
        for words in ("diffuse: no band", "a later key", "set by the mesh (local law)",
                      "In 2 % of the bootstrap samples", "0.900 [0.800, 1.000]", "−45.0° [−46.5, −43.5]",
                      "in the band: grains 45.0°", "Coulomb 45° + φ/2 = 55.0°"):
            self.assertIn(words, self.words)

    def test_dissipation_is_shown_in_per_cent_and_its_density_as_a_ratio(self):
        # 75 % of it on half of the area: (0.75/0.5)/(0.25/0.5) = 3
        row = re.search(r"<th scope=\"row\">Grains</th><td>75.0 %</td><td>50.0 %</td><td>(.*?)</td>", self.words)
        self.assertEqual(row.group(1), "3.00")

    def test_a_summary_has_the_meanings_and_units_of_the_program(self):
        # the initial height of 8 is shown in d
        self.assertRegex(self.words, r'initial height</th><td>8 d</td>')
        self.assertRegex(self.words, r'platen unbalance</th><td>3\.0 × 10⁻⁴</td><td></td>')

    def test_broken_checks_are_counted_on_top_and_marked(self):
        top = self.words[:self.words.index("</header>")]
        self.assertRegex(top, r'class="warning"><strong>1 of 2 checks fail</strong>: spin \(')
        self.assertRegex(self.words, r'spin</th><td>0.002</td><td>0.001</td><td class="broken">broken<')
        self.assertRegex(self.words, r'noise</th><td>0.012</td><td>0.03</td><td class="kept">kept<')
        self.assertEqual(self.words.count("0.012"), 1, "a checked number stands in the table of the checks only")

    def test_every_heading_is_in_the_contents(self):
        links = re.findall(r'<a href="#(part-\d+)">(.*?)</a>', self.text)
        self.assertEqual(links, re.findall(r'<h2[^>]* id="(part-\d+)">(.*?)</h2>', self.text))
        self.assertGreater(len(links), 15)

    def test_a_diffuse_zone_has_neither_an_inclination_nor_a_line(self):
        self.assertRegex(self.words, r'angle_deg</th><td>−45.0° \[[^<]*</td><td>−45.0°</td><td>diffuse zone</td>')
        self.assertIn("Continuum, diffuse zone", self.words)
        window = next(one for one in self.maps["increments"] if one["kind"] == "window")
        self.assertEqual([band[0] for band in window["bands"]["continuum"]], [-45, None])

    def test_the_page_needs_no_other_file(self):
        self.assertIsNone(re.search(r' (?:src|href)="(?!data:|#)', self.text))
        self.assertIsNone(re.search(r"url\(|@import", self.text))


class OtherFolders(unittest.TestCase):
    def setUp(self):
        self.folder = self.enterContext(tempfile.TemporaryDirectory())

    def test_an_internal_length_sets_the_band_width_of_a_scene_named_like_markup(self):
        stages = report_folder.comparison_of_two_stages()["stages"]
        stages[1]["discrete"]["probes"][0]["name"] = "</script><b>x"
        text = page_of(self.folder, scene="</script><b>x", stages=stages, continuum_summary={
            "law": "a_law", "internal_length_d": 1.5, "localisation_strain": None}).replace("\u00a0", " ")
        self.assertIn("band in the continuum: internal length 1.5 d", text)
        self.assertNotIn("set by the mesh (local law)", text)
        self.assertIn("never", text)  # no localisation
        self.assertNotIn("</script><b>", text)

    def test_a_measurement_of_an_earlier_comparison_is_not_shown(self):
        write_folder(self.folder)
        report_folder.write_levelled(self.folder)
        run(self.folder)
        self.assertIn("Beside the measurement", read(self.folder))
        self.assertNotIn("Beside the measurement", page_of(self.folder))  # comparison.json is new

    def test_axes_name_the_loading_variable(self):
        for variable, label, averaging in (("shear_strain", "shear strain (%)",
                                            "mean over the last 0.5 % of shear strain"),
                                           ("time", ">time<", "mean over the last 0.005 of time")):
            text = page_of(self.folder, walk=variable)
            self.assertIn(averaging, text)
            pictures = [base64.b64decode(data).decode()
                        for data in re.findall(r"data:image/svg\+xml;base64,([^\"]+)", text)]
            self.assertTrue(any(label in picture for picture in pictures))

    def test_lengths_and_stresses_are_shown_in_d_and_P(self):
        """With d = 2 and P = 10, the corner of a probe at 1 is at 0.5 d, and a major stress of 2 is 0.2 P."""
        maps = maps_of(page_of(self.folder, mean_diameter=2.0, pressure=10.0))
        stage = next(i for i in maps["increments"] if i["key"] == "stage-1")
        self.assertEqual(stage["probes"]["continuum"]["rectangles"][0]["polygon"][0], [0.5, 2.75])
        self.assertEqual(stage["probes"]["continuum"]["rectangles"][0]["s1"], 0.2)
        np.testing.assert_allclose(stored(maps, stage["crosses"]["discrete"]["s1"]), 0.2)
        np.testing.assert_allclose(stored(maps, stage["discs"]["r"]), 0.25)
        np.testing.assert_allclose(stored(maps, stage["forces"]["f"]), 3 / 20)

    def refused(self, damage, message, word="page"):
        write_folder(self.folder)
        damage(lambda name: os.path.join(self.folder, name))
        outcome = run(self.folder, word)
        self.assertEqual(outcome.returncode, 2)
        self.assertRegex(outcome.stderr, "^report: " + message)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "report.html")))

    def test_wrong_input_is_named(self):
        def edit(name, value):
            def damage(path):
                with h5py.File(path("comparison.h5"), "r+") as file:
                    file["stage_0001"].attrs[name] = value
            return damage

        def other_arrays(path):
            with h5py.File(path("comparison.h5"), "w") as file:
                file["mine"] = [1.0]

        self.refused(lambda path: None, r"usage: python3 -m diptych\.report page\|movie\|ensemble\|study", "figure")
        self.refused(lambda path: os.remove(path("continuum.csv")), r"missing: .*continuum\.csv")
        self.refused(lambda path: write_json(path(""), "comparison.json", {"format": 1}),
                     r".*comparison\.json: format 1, .* 2;")
        self.refused(lambda path: write_json(path(""), "provenance.json", {"a": [1, 2]}), r".*provenance\.json")
        self.refused(lambda path: os.truncate(path("provenance.json"), 9), r".*provenance\.json")
        self.refused(lambda path: os.truncate(path("comparison.h5"), 999), r".*comparison\.h5")
        self.refused(other_arrays, r".*comparison\.h5: has no group")
        self.refused(edit("to", 0.5), r".*comparison\.h5: stage_0001 does not end")
        self.refused(edit("centre", "mine"), r".*comparison\.h5.* has contents that this version does not write")


class Formulas(unittest.TestCase):
    def test_maps_have_the_colours_of_matplotlib(self):
        for name in colour_maps.STOPS:
            found = np.array([list(bytes.fromhex(one[1:])) for one in colour_maps.table(name)])
            wanted = np.rint(255 * matplotlib.colormaps[name](np.arange(256))[:, :3])
            self.assertLessEqual(np.abs(found - wanted).max(), 4, name)

    def test_a_thinned_history_keeps_its_spike(self):
        values = np.zeros(10000)
        values[4321] = 7.0
        x, y = thin(np.arange(10000.0), values, 100)
        self.assertLessEqual(len(x), 100)
        self.assertEqual(y[x == 4321.0], 7.0)

    def test_a_unit_is_its_product_of_pressures_and_lengths(self):
        # d = 2 and P = 10: a force of 40 is 2 P d, a moment of 80 is 2 P d^2; times stay as they are
        expected = {"length": 2, "pressure": 10, "pressure length": 20, "pressure length^2": 40, "length/time": 2,
                    "length^2/time^2": 4, "mean diameters": 1, "degrees": 1, "rad": 1, "-": 1, "strain or time": 1,
                    "s": 1, "": 1}
        self.assertEqual({unit: Units(2.0, 10.0).size(unit) for unit in expected}, expected)

    def test_a_standard_error_stands_where_there_is_no_interval(self):
        increment = Increment(key="stage-0", kind="stage", start=0.0, end=0.01,
                              record={"discrete": report_folder.panel([])},
                              loading_variable=LOADING_VARIABLES["axial_strain"])
        increment.record["discrete"]["probes"][0]["fabric_to_stress_deg"] = report_folder.within(2.0, -3.0, 7.0)
        table = tables.probes(types.SimpleNamespace(numbers=Descriptions(report_folder.numbers())), increment)
        row = dict(zip(table["head"], table["rows"][0]))
        self.assertEqual(row["fabric to stress"], "2.0° [−3.0,\u00a07.0]")
        self.assertEqual(row["fabric_direction_deg"], "−88.0° ± 4.0°")

    def test_lines_that_differ_by_half_a_turn_are_one(self):
        self.assertAlmostEqual(_turn({"angle_deg": -89.0}, 89.0), 2.0)  # not 178

    def test_an_ensembles_places_keep_their_ends_apart(self):
        places = ensemble._places({"windows": [{"from": 1e-5, "to": 0.02}]}, LOADING_VARIABLES["axial_strain"])
        self.assertEqual(places, {"window 1e-05-0.02": ("window", "0.001–2\u00a0%")})

    def test_a_calibration_writes_numbers_without_exponents(self):
        self.assertEqual([calibration.text(x, 2) for x in (-2.9, -110.4, 1e5)], ["−2.9", "−110", "100000"])

    def test_the_curves_of_a_study_open_on_the_grains(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "study.h5")
            with h5py.File(path, "w") as file:
                for panel in ("continuum", "discrete"):
                    for name in ("progress", *studies.CURVES):
                        file[f"{panel}/{name}"] = [0.0, 1.0]
            self.assertEqual(list(studies._curves(path)), ["discrete", "continuum"])

    def test_no_label_and_no_legend_leaves_its_place(self):
        verdict = {"quantity": "peak", "margin": 0.03, "verdict": "equivalent", "discrete": [0.3], "continuum": [0.4],
                   **dict.fromkeys(("difference", "difference_90"), {"value": 0.1, "low": None, "high": None})}
        long = "strength T/S from 0.3 % strain to the end of the loading"
        stage = types.SimpleNamespace(end=0.01, shown_end=1.0, bands=lambda panel: [{"to_minor_stress_deg": 40.0}])
        result = types.SimpleNamespace(stages=[stage], loading_variable=LOADING_VARIABLES["axial_strain"],
                                       part=lambda name: dict(coulomb_deg=58.8, arthur_deg=55.1, roscoe_deg=51.5))
        with mock.patch.object(by_matplotlib, "svg", lambda figure, alt: figure), by_matplotlib.styled():
            for figure in (ensemble.dots(verdict, dict.fromkeys(("discrete", "continuum")), long),
                           ensemble.differences([(long, verdict)])):
                box = figure.get_tightbbox()
                self.assertTrue(box.x0 >= 0 and box.y0 >= 0 and (box.max <= figure.get_size_inches()).all(), box)
        picture = trends._inclination(result)[0]
        svg = base64.b64decode(picture.uri.partition(",")[2]).decode()
        width, height = 0.75 * picture.width, 0.75 * picture.height
        frame_top = float(re.search(r'<rect x="[^"]*" y="([^"]*)"', svg).group(1))
        for x, y, size, anchor, words in re.findall(
                r'<text x="([^"]*)" y="([^"]*)" font-size="([^"]*)" text-anchor="([^"]*)">([^<]*)<', svg):
            ends = [float(x) + side * 0.5 * float(size) * len(words)
                    for side in {"start": (0, 1), "middle": (-0.5, 0.5), "end": (-1, 0)}[anchor]]
            self.assertTrue(0 <= ends[0] and ends[1] <= width and float(size) <= float(y) <= height, words)
            if words.startswith(("Coulomb", "Arthur", "Roscoe", "Grains")):
                self.assertLess(float(y), frame_top)  # the legend lies on no data

    def test_a_chart_puts_values_where_its_axes_say(self):
        figure = Figure((1, 1), [[0.25, 0.25, 0.5, 0.5]])  # 72 points; axes from 18 to 54
        axes, = figure.axes
        axes.set(xlim=(0, 4), ylim=(1, 100))
        axes.y.is_log = True
        axes.plot([0, 4, np.nan, 1, 2], [1, 10, 10, 100, 0], color="red")
        axes.axhline(10, color="blue")
        axes.fill_between([0, 1, 2, 3, 4], [1, 1, np.nan, 1, 1], [10] * 5, color="green")
        text, *size = figure.svg()
        paths = {colour: path for path, colour in
                 re.findall(r'<path d="([^"]*)" (?:fill="none" stroke|fill)="(\w+)"', text)}
        self.assertEqual(size, [72, 72])
        # 0 lies below a logarithmic axis; the frame cuts it off
        self.assertEqual(paths["red"], f"M18.0 54.0 54.0 36.0M27.0 18.0 36.0 {18 + 36 * 10:.1f}")
        self.assertEqual(paths["blue"], "M-306.0 36.0 378.0 36.0")
        self.assertEqual(paths["green"], "M18.0 54.0 27.0 54.0 27.0 36.0 18.0 36.0Z"
                                         "M45.0 54.0 54.0 54.0 54.0 36.0 45.0 36.0Z")
        self.assertEqual(re.findall(">([^<]+)</text>", text), ["0", "1", "100"])

    def test_numbers_of_an_axis_are_round_and_within_its_limits(self):
        for ends, most, words in (((0, 1), 4, "0.00 0.25 0.50 0.75 1.00"), ((-0.31, 0.3), 4, "−0.2 0.0 0.2"),
                                  ((0, 36000), 4, "0 10000 20000 30000"), ((0, 0.0011), 3, "0.0000 0.0005 0.0010")):
            axis = Axis()
            axis.given = ends
            self.assertEqual(" ".join(text for _, text in axis.numbers(most)), words)

    def test_the_page_opens_on_the_last_window_or_stage(self):
        windows, stages = ([types.SimpleNamespace(kind=kind, end=end) for end in ends]
                           for kind, ends in (("window", (0.01, 0.02)), ("stage", (0.005, 0.01, 0.02, 0.03))))
        self.assertEqual((end_of(windows + stages), end_of(stages)), (0.02, 0.03))
        self.assertIs(opens_at(windows + stages, 0.02), windows[1])
        self.assertIs(opens_at(stages, 0.02), stages[2])  # the same instant in a part without windows

    def test_no_module_reaches_against_the_arrows(self):
        # page -> charts, tables -> data; a chart uses the modules of the charts that draw
        allowed = {"data": {"data"}, "charts": {"data", "charts.style", "charts.drawing"}, "tables": {"data", "tables"},
                   "page": {"data", "charts", "tables", "page"}}
        for folder, targets in allowed.items():
            for path in glob.glob(os.path.join(os.path.dirname(diptych.report.__file__), folder, "*.py")):
                with open(path, encoding="utf-8") as stream:
                    lines = re.findall(r"^from \.(\.?)(\w[\w.]*) import (.+)", stream.read(), re.M)
                for above, module, names in lines:
                    module = module if above else f"{folder}.{module}"
                    for one in [module] if "." in module else [f"{module}.{name}" for name in names.split(", ")]:
                        self.assertTrue(any(one == t or one.startswith(t + ".") for t in targets), f"{path}: {one}")
