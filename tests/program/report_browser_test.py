# diptych: tests of the report of a tiny result folder in headless Chromium
# SPDX-License-Identifier: LGPL-2.1-or-later
"""test.sh installs Chromium. Without it these tests are skipped."""

import os
import tempfile
import unittest

import browser
from report_folder import STAGES, WINDOWS, number_of_figures, run, write_folder, write_levelled

DESK, PHONE, A4 = (1400, 900), (390, 844), (688, 1016)  # CSS pixels; A4 without margins of 14 mm, at 96 dpi
PAIR = '.pair[data-draw="quantity"] canvas.map'


@unittest.skipUnless(browser.program(), "no chromium on the PATH: test.sh installs it")
class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = cls.enterClassContext(tempfile.TemporaryDirectory())
        write_folder(cls.folder)
        outcome = run(cls.folder)
        if outcome.returncode:
            raise RuntimeError(outcome.stderr)
        cls.page = cls.enterClassContext(browser.Page(*DESK))

    def setUp(self):
        self.page.messages.clear()
        self.page.command("Emulation.setEmulatedMedia", media="screen")
        self.page.size(*DESK)
        self.page.open(os.path.join(self.folder, "report.html"))

    def pixels(self):
        """The pictures of both canvases of the first pair, as data URLs."""
        return self.page.run(f"[...document.querySelectorAll('{PAIR}')].map((c) => c.toDataURL())")

    def keys(self):
        """Increment of each canvas, by the name of its drawing."""
        return self.page.run("Object.fromEntries([...document.querySelectorAll('.pair[data-draw]')].map((p) => "
                             "[p.dataset.draw, [...p.querySelectorAll('canvas.map')].map((c) => c.dataset.key)]))")

    def limits(self):
        """Colour limits of both panels of the first pair."""
        return self.page.run(f"[...document.querySelectorAll('{PAIR}')].map((c) => c.dataset.low + ' ' + "
                             "c.dataset.high)")

    def choose(self, selector, value):
        self.page.run(f"(() => {{ const s = document.querySelector('{selector}'); s.value = '{value}';"
                      "s.dispatchEvent(new Event('change', {bubbles: true})); })()")

    def colour_at(self, panel, x, y):
        """Colour [red, green, blue] at a place in d, in the first map of a panel."""
        return self.page.run(f"""(() => {{
          const c = document.querySelector('.pair[data-draw="quantity"] canvas[data-panel="{panel}"]'), b = data.box;
          const scale = (c.width / pixels - 44) / (b[1] - b[0]);
          const px = pixels * (38 + scale * ({x} - b[0])), py = pixels * (6 + scale * (b[3] - {y}));
          return [...c.getContext('2d').getImageData(Math.round(px), Math.round(py), 1, 1).data].slice(0, 3); }})()""")

    def test_the_page_opens_without_errors_and_shows_every_figure(self):
        self.assertEqual(self.page.run("document.documentElement.dataset.ready"), "yes")
        self.assertEqual(self.page.messages, [])
        self.assertEqual((self.page.run("document.querySelectorAll('figure.panel img').length"),
                          self.page.run("document.querySelectorAll('canvas').length")), number_of_figures())
        bad = ("[...document.querySelectorAll('canvas.map')]"
               ".filter((c) => c.dataset.drawn !== 'yes' || c.width < 100).length")
        self.assertEqual(self.page.run(bad), 0)
        self.assertTrue(self.page.run("[...document.images].every((i) => i.complete && i.naturalWidth > 0)"))

    def test_a_phone_cuts_no_title_of_a_colour_bar(self):
        # A title that is too wide for its canvas leaves ink in the first or the last column.
        self.page.size(*PHONE)
        self.page.open(os.path.join(self.folder, "report.html"))
        cut = self.page.run("""[...document.querySelectorAll('canvas.bar')].filter((c) => [0, c.width - 1].some((x) =>
          c.getContext('2d').getImageData(x, 30 * pixels, 1, c.height - 30 * pixels).data
            .some((v) => v < 250))).length""")
        self.assertEqual((self.page.run("document.querySelectorAll('canvas.bar').length > 2"), cut), (True, 0))

    def test_a_map_has_the_right_colour_at_a_place(self):
        # The limits of the window are 0 and 3.9 %. Continuum, third cell: its nodes have the means of their cells, 1.6,
        # 2.4, 5.6 and 4.8 %. Its third part of six along both sides has its middle at 5/12: 3.267 %, so colour
        # floor(256 * 3.267/3.9) = 214. Grains: grain 20 (fifth row, first column) at (0.5, 4.5): 2 * 20/39 = 1.0256 %,
        # so floor(256 * 1.0256/3.9) = 67.
        table = self.page.run("data.maps.viridis")
        for panel, at, number in (("continuum", (1.0, 3.75), 214), ("discrete", (0.5, 4.65), 67)):
            expected = [int(table[number][k:k + 2], 16) for k in (1, 3, 5)]
            self.assertEqual(self.colour_at(panel, *at), expected, panel)

    def test_the_centre_line_of_a_band_passes_through_the_centre(self):
        # with offset 0 and -45 degrees the line passes through (2.5, 4), the centre, and (3.5, 3); it is white
        for at in ((2.5, 4.0), (3.5, 3.0)):
            self.assertGreater(min(self.colour_at("discrete", *at)), 200)

    def test_the_slider_and_the_buttons_work_by_the_keyboard(self):
        before = self.pixels()
        self.page.run("document.querySelector('input[type=range]').focus()")
        # the window ends with the second stage, so one step to the left is the first stage
        self.page.press("ArrowLeft")
        after = self.pixels()
        self.assertEqual(self.keys()["quantity"], ["stage-0", "stage-0"])
        self.assertNotEqual(before[0], after[0])
        self.assertNotEqual(before[1], after[1])
        self.assertEqual(self.limits(), ["0 2", "0 2"])
        self.page.run("document.querySelector('#maps-section .stepper input:checked').focus()")
        self.page.press("ArrowRight")
        self.assertNotEqual(self.keys()["quantity"], ["stage-0", "stage-0"])
        self.assertEqual(self.page.messages, [])

    def test_all_parts_step_together_unless_switched_off(self):
        self.page.run("document.getElementById('maps-stage-0').click()")
        self.assertEqual({key for shown in self.keys().values() for key in shown}, {"stage-0"})
        self.assertEqual(self.page.run("document.querySelector('#strips-section .pane.open').dataset.key"), "stage-0")
        self.page.run("document.getElementById('together').click(); document.getElementById('forces-stage-1').click()")
        self.assertEqual(self.keys()["forces"], ["stage-1", "stage-1"])
        self.assertEqual(self.keys()["quantity"], ["stage-0", "stage-0"])

    def test_every_quantity_draws_in_both_panels_on_one_scale(self):
        self.page.run("document.getElementById('maps-stage-1').click()")
        for quantity in self.page.run("data.quantities"):
            for place in quantity["places"]:
                self.choose("#quantity", quantity["key"])
                self.choose("#place", place)
                drawn = self.page.run(f"[...document.querySelectorAll('{PAIR}')].map((c) => c.dataset.drawn)")
                both = quantity["group"] != "Grains only"
                self.assertEqual(drawn, ["yes", "yes" if both else "no"], f"{quantity['key']} {place}")
                if both:
                    self.assertEqual(*self.limits())
        self.assertEqual(self.page.messages, [])

    def test_the_pointer_reads_the_value_of_both_panels(self):
        # grain 20 has 1.03 %, the third cell 3.2 %
        self.page.run("""(() => {
          const c = document.querySelector('.pair[data-draw="quantity"] canvas'), r = c.getBoundingClientRect();
          const scale = (r.width - 44) / (data.box[1] - data.box[0]);
          c.dispatchEvent(new PointerEvent('pointermove', {bubbles: true,
            clientX: r.left + 38 + scale * (0.5 - data.box[0]),
            clientY: r.top + 6 + scale * (data.box[3] - 4.5)})); })()""")
        self.assertEqual(self.page.run("document.querySelector('output.readout').textContent"),
                         "x 0.5 d, y 4.5 d: grains 1.03, continuum 3.20")

    def test_a_phone_does_not_scroll_sideways(self):
        for size in (PHONE, DESK):
            self.page.size(*size)
            self.page.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
            self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), size[0])
        self.page.size(*PHONE)
        tops = self.page.run(f"[...document.querySelectorAll('{PAIR}')].map((c) => c.getBoundingClientRect().top)")
        self.assertEqual(tops[0], tops[1])  # still side by side

    def test_a_print_shows_every_increment_and_cuts_no_figure(self):
        self.page.size(*A4)
        self.page.command("Emulation.setEmulatedMedia", media="print")
        self.page.run("window.dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.page.run("document.querySelectorAll('#sheet canvas').length"), 2 * (STAGES + WINDOWS))
        shown = self.page.run("[...document.querySelectorAll('#strips-section .pane.window')].map((p) => "
                              "p.offsetHeight > 0)")
        self.assertEqual(shown, [True] * WINDOWS)
        cut = self.page.run("""[...document.querySelectorAll('figure, canvas, img')].filter((f) => f.offsetHeight > 0)
          .map((f) => f.getBoundingClientRect())
          .filter((r) => r.left < -0.5 || r.right > innerWidth + 0.5 || r.height > innerHeight).length""")
        self.assertEqual(cut, 0)
        self.page.run("window.dispatchEvent(new Event('afterprint'))")
        self.page.command("Emulation.setEmulatedMedia", media="screen")
        self.assertEqual(self.page.run("document.querySelectorAll('#sheet canvas').length"), 0)
        self.assertTrue(self.page.pdf().startswith(b"%PDF"))
        self.assertEqual(self.page.messages, [])

    def test_a_measurement_is_a_third_map_on_the_same_scale(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        write_folder(folder)
        write_levelled(folder)
        outcome = run(folder)
        self.assertEqual((outcome.returncode, outcome.stderr), (0, ""))
        self.page.open(os.path.join(folder, "report.html"))
        self.assertEqual(self.page.run(f"[...document.querySelectorAll('{PAIR}')].map((c) => c.dataset.drawn)"),
                         ["yes"] * 3)
        self.choose("#place", "points")  # all panes have the 28 points, so their limits agree
        self.assertEqual(len(set(self.limits())), 1)
        self.assertIn("28 points; band at −45 degrees", self.page.run(
            "document.querySelector('canvas[data-panel=measured]').getAttribute('aria-label')"))
        words = self.page.run("document.getElementById('measured-section').textContent")
        for told in ("not resolved", "diffuse: no band", "Grains: too narrow.", "Continuum − measurement"):
            self.assertIn(told, words)
        self.page.run("document.getElementById('maps-stage-0').click()")
        self.assertIn("not measured", self.page.run(
            "document.querySelector('canvas[data-panel=measured]').getAttribute('aria-label')"))
        for size in (PHONE, DESK):
            self.page.size(*size)
            self.page.run("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
            self.assertLessEqual(self.page.run("document.documentElement.scrollWidth"), size[0])
        self.assertEqual(self.page.messages, [])
