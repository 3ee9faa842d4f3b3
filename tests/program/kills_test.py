#!/usr/bin/env python3
# diptych: thirty kills at random moments of each panel and of an ensemble, and the bits of a run left alone
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: kills_test.py PROGRAM SOURCE_DIR [unittest arguments]. Takes minutes: label slow."""

import csv
import json
import os
import random
import shutil
import signal
import tempfile
import time
import unittest

from running import bits, diptych, listing, main, QUICK, setting, SMALL, start

KILLS = 30
SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
GRAINS = SMALL + setting(sample_grains=200, loading_axial_strain=0.04, loading_stage_strain=0.005, output_report="false",
                         comparison_window_edges="0,0.04", discrete_checkpoint_minutes=0.0005)
NODES = GRAINS + setting(continuum_mesh="rectangle", continuum_rectangle_width=40, continuum_rectangle_height=60,
                         continuum_initial_step=1e-3, continuum_max_step=1e-3, comparison_coarse_element_size=0)
SEEDS = SMALL + setting(sample_grains=150, continuum_element_size=2.5, comparison_coarse_element_size=3, output_report="false",
                        discrete_checkpoint_minutes=0.0005)


def table(path):
    """Rows of a .csv without what a clock measured."""
    with open(path) as file:
        return [{name: value for name, value in row.items() if not name.endswith("cpu_s")} for row in csv.DictReader(file)]


class Kills(unittest.TestCase):
    def setUp(self):
        keep = tempfile.TemporaryDirectory()
        self.addCleanup(keep.cleanup)
        self.alone, self.folder = os.path.join(keep.name, "alone"), os.path.join(keep.name, "out")

    def kill_again_and_again(self, words, seed, same):
        """`same`: whether the folder holds what the one left alone does. A run that ends before its signal is judged and begun anew."""
        began = time.monotonic()
        result = diptych(*words, "--output", self.alone, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        length, dice, kills, ends, checkpoints = time.monotonic() - began, random.Random(seed), 0, 0, 0
        while kills < KILLS or ends == 0:
            process = start(*words, "--output", self.folder, "--resume", "--quiet")
            if kills < KILLS:
                time.sleep(dice.uniform(0, length))
                process.send_signal(dice.choice(SIGNALS))
            _, errors = process.communicate()
            if process.returncode == 0:
                same()
                shutil.rmtree(self.folder)
                ends += 1
            else:
                self.assertIn(process.returncode, (3, -signal.SIGKILL, -signal.SIGTERM, -signal.SIGINT), errors)
                kills += 1
                checkpoints += any("checkpoint" in name for name in (listing(self.folder) if os.path.isdir(self.folder) else []))
        self.assertGreater(checkpoints, KILLS // 5, "hardly anything was taken up")
        print(f"{words[0]}: {kills} kills, {ends} runs to their end, all the same")

    def test_the_grains(self):
        def same():
            one, other = (bits(os.path.join(folder, "discrete.h5")) for folder in (self.alone, self.folder))
            self.assertEqual(one, other)
            self.assertEqual(*(table(os.path.join(folder, "discrete.csv")) for folder in (self.alone, self.folder)))
        self.kill_again_and_again(["discrete", QUICK, *GRAINS], 1, same)

    def test_the_continuum(self):
        def same():
            one, other = (bits(os.path.join(folder, "continuum.h5")) for folder in (self.alone, self.folder))
            self.assertEqual(one, other)
            self.assertEqual(*(table(os.path.join(folder, "continuum.csv")) for folder in (self.alone, self.folder)))
        self.kill_again_and_again(["continuum", QUICK, *NODES], 2, same)

    def test_an_ensemble(self):
        def same():
            records = []
            for folder in (self.alone, self.folder):
                with open(os.path.join(folder, "ensemble.json"), encoding="utf-8") as file:
                    records.append(json.load(file))
            self.assertEqual(*records)
        self.kill_again_and_again(["run", QUICK, *SEEDS, "--seeds", "1-3", "--jobs", "2"], 3, same)


if __name__ == "__main__":
    main()
