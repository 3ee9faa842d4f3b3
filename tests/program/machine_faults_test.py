#!/usr/bin/env python3
# diptych: faults of the machine that were once found, each by itself: no room, no memory, nobody who reads
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: machine_faults_test.py PROGRAM SOURCE_DIR [unittest arguments]. Random relatives of these: tests/robustness."""

import os
import resource
import shutil
import subprocess
import unittest

from faults_test import BOTH, FEW, Folder
from running import ENVIRONMENT, PROBLEMS, PROGRAM, QUICK, bits, diptych, listing, main, setting, write


class Machine(Folder):
    def test_results_do_not_care_who_reads_what_is_said(self):
        """As in `diptych run ... 2>&1 | true`: whoever reads is gone before a word was said."""
        for words, name in ((["run", QUICK, *BOTH], "comparison.json"), (["continuum", QUICK, *BOTH], "continuum.csv"),
                            (["run", QUICK, *BOTH, "--seeds", "1-2", "--jobs", "1"], "ensemble.json"), (["material-point", QUICK, *BOTH], "material_point.csv"),
                            (["discrete", QUICK, *BOTH], "discrete.csv")):
            with self.subTest(words=words[0]):
                shutil.rmtree(self.folder, ignore_errors=True)
                reader, writer = os.pipe()
                os.close(reader)
                code = subprocess.run([PROGRAM, *words, "--output", self.folder], env=ENVIRONMENT, stdout=writer, stderr=writer, check=False).returncode
                os.close(writer)
                self.assertEqual(code, 0)
                self.assertIn(name, listing(self.folder))

    def test_what_is_said_and_nowhere_else_is_not_lost_in_silence(self):
        for words in (["explain"], ["explain", "results"], ["--version"], ["--help"], ["solve", os.path.join(PROBLEMS, "small.h5")]):
            with open("/dev/full", "wb") as full:
                result = subprocess.run([PROGRAM, *words], env=ENVIRONMENT, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual(result.returncode, 4, words)
            self.assertIn("standard output cannot be written", result.stderr)

    def test_threads_that_the_system_does_not_start(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20))
        self.expect(4, ["discrete", QUICK, *FEW, "--threads", "512", "--output", self.folder, "--quiet"], "--threads", preexec_fn=limit)

    def test_a_small_stack(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_STACK, (128 << 10, 128 << 10))
        self.expect(4, ["run", QUICK, *BOTH, "--output", self.folder, "--quiet"], "ulimit -s", "nothing was written", preexec_fn=limit)

    def test_no_room_for_the_report(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))
        shutil.copytree(self.whole, self.folder)
        self.expect(4, ["report", self.folder, "--quiet"], "report.html", "kept", preexec_fn=limit)

    def test_little_room_on_the_disk(self):
        """The library's exit handler once ended every one of these in SIGSEGV."""
        for room in (0, 64000, 120000, 250000, 500000):
            def limit(room=room):
                resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
            with self.subTest(room=room):
                shutil.rmtree(self.folder, ignore_errors=True)
                result = diptych("discrete", QUICK, *FEW, "--output", self.folder, "--quiet", preexec_fn=limit)
                self.assertIn(result.returncode, (0, 4) if room == 500000 else (4,), result.stderr)
                if result.returncode == 4:
                    self.assertTrue(self.folder in result.stderr or "nothing was written" in result.stderr, result.stderr)

    def test_grains_run_where_the_continuum_would_not(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (400 << 20, 400 << 20))
        self.expect(0, ["discrete", QUICK, *FEW, "--output", self.folder, "--quiet"], preexec_fn=limit)

    def test_little_memory_is_no_wrong_input(self):
        table = write(os.path.join(self.work, "grains.csv"), "x,y,r\n" + "".join(f"{k % 700},{k // 700},0.5\n" for k in range(490000)))

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (120 << 20, 120 << 20))
        for words in (["discrete", QUICK, *FEW, *setting(sample_file=table), "--output", self.folder, "--quiet"],
                      ["import", "csv", table, "--output", self.folder, "--quiet"]):
            result = self.expect(4, words, "not enough memory", "nothing was written", table, preexec_fn=limit)
            self.assertNotIn("bad_alloc", result.stderr)

    def test_without_h5py_what_was_computed_is_kept(self):
        os.mkdir(os.path.join(self.work, "modules"))
        write(os.path.join(self.work, "modules", "h5py.py"), "raise ModuleNotFoundError(\"No module named 'h5py'\", name='h5py')\n")
        environment = dict(ENVIRONMENT, PYTHONPATH=os.path.join(self.work, "modules"))
        result = subprocess.run([PROGRAM, "run", QUICK, *BOTH, *setting(output_report="true"), "--output", self.folder, "--quiet"],
                                env=environment, capture_output=True, text=True)
        self.assertEqual(result.returncode, 4, result.stderr)
        for text in ("h5py", "kept in"):
            self.assertIn(text, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        self.assertEqual(bits(os.path.join(self.folder, "comparison.h5")), bits(os.path.join(self.whole, "comparison.h5")))


if __name__ == "__main__":
    main()
