# diptych: campaigns in a build without the continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

from running import finished, Folder, listing, QUICK, read_json, SMALL, SOURCE

CELL = os.path.join(SOURCE, "benchmarks", "element", "scene.prm")


class GrainsOnly(Folder):
    def test_grains_are_varied_and_homogenised(self):
        finished("study", QUICK, *SMALL, "--panels", "discrete", "--vary", "discrete/friction=0.2,0.5", "--seeds",
                 "1-2", "--output", self.folder, "--quiet")
        points = read_json(self.folder, "study.json")["points"]
        self.assertEqual([point["quantities"][0]["n"] for point in points], [2, 2])
        grains = os.path.join(self.folder, points[0]["folders"][0])
        finished("homogenise", grains, "--output", self.path("fields"), "--quiet")
        self.assertIn("homogenised.json", listing(self.path("fields")))

    def test_what_needs_the_continuum_is_refused_in_a_sentence(self):
        vary = ["--vary", "discrete/friction=0.2,0.5"]
        for words in (["run", QUICK], ["run", QUICK, "--seeds", "1-2"], ["continuum", QUICK], ["study", QUICK, *vary],
                      ["study", QUICK, *vary, "--panels", "continuum"], ["element", CELL],
                      ["calibrate", QUICK, "--seeds", "1-2"],
                      ["plan", QUICK, "--accuracy", "2", "%", "--for", "continuum.strength"]):
            with self.subTest(words=words):
                result = self.expect(2, [*words, "--output", self.folder], "was built without the continuum")
                self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
