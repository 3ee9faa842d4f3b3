# diptych: studies that are stopped, killed, changed and gone on with end as one that is left alone
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import shutil
import signal
import time

import study_test
from running import bits, content, finished, listing, start, temporary, write
from study_test import LONG


def running_on(folder):
    """Whether some process has a file of the folder open: all have its lock."""
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            for name in os.listdir(f"/proc/{number}/fd"):
                if os.readlink(f"/proc/{number}/fd/{name}").startswith(folder):
                    return True
        except OSError:
            pass
    return False


class Interruption(study_test.Study):
    @classmethod
    def setUpClass(cls):
        work = temporary(cls)
        cls.alone, file = os.path.join(work, "alone"), write(os.path.join(work, "steps.json"), json.dumps(LONG))
        finished("study", file, "--output", cls.alone, "--quiet")

    def stop(self, signal_number):
        """Sends a signal when the first run has its prepared sample."""
        return self.signalled(signal_number, lambda: any(name.endswith("discrete.h5") for name in listing(self.work)),
                              "study", self.study_file(LONG), "--output", self.folder, "--jobs", "2")

    def expect_the_rest(self):
        self.run_study(LONG, "--resume")
        self.expect_same_files(self.alone, "study.json")
        self.assertEqual(bits(self.path("study.h5")), bits(os.path.join(self.alone, "study.h5")))
        self.assertEqual([name for name in listing(self.folder) if "checkpoint" in name and ".1/" not in name], [])

    def test_ctrl_c_keeps_what_is_done(self):
        code, errors = self.stop(signal.SIGINT)
        self.assertEqual(code, 3, errors)
        for text in ("stopped on request", "runs are left", "--resume", self.folder):
            self.assertIn(text, errors)
        self.assertTrue(any(name.endswith("checkpoint.h5") for name in listing(self.folder)))
        self.assertIn("not run", self.classes())
        self.expect_the_rest()

    def test_ctrl_c_while_the_report_is_drawn_tells_how_to_draw_it(self):
        process = start("study", self.study_file(LONG), "--output", self.folder, "--jobs", "2")
        while process.poll() is None and not os.path.exists(self.path("study.h5")):
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        self.assertIn(f"diptych report {self.folder}", process.communicate()[1])
        self.assertEqual(process.returncode, 3)

    def test_a_run_whose_table_was_changed_since_is_run_again(self):
        shutil.copytree(self.alone, self.folder)
        table = next(self.path(name) for name in listing(self.folder) if name.endswith("discrete.csv"))
        rows = content(table).splitlines(keepends=True)
        fields = rows[len(rows) // 2].split(b",")
        fields[rows[0].split(b",").index(b"stress_ratio")] = b"0.99"
        write(table, b"".join([*rows[:len(rows) // 2], b",".join(fields), *rows[len(rows) // 2 + 1:]]).decode())
        self.expect_the_rest()
        self.assertNotIn(b",0.99,", content(table))

    def test_a_kill(self):
        code, _ = self.stop(signal.SIGKILL)
        self.assertEqual(code, -signal.SIGKILL)
        self.assertNotIn("study.json", listing(self.folder))
        patience = time.monotonic() + 60  # workers notice, and write their checkpoints
        while running_on(self.folder) and time.monotonic() < patience:
            time.sleep(0.01)
        self.assertFalse(running_on(self.folder), "workers outlive their study")
        self.assertTrue(any(name.endswith("checkpoint.h5") for name in listing(self.folder)))
        self.expect_the_rest()

    def test_a_run_whose_checkpoint_is_damaged_begins_anew(self):
        self.stop(signal.SIGINT)
        for name in listing(self.folder):
            if name.endswith("checkpoint.h5"):
                write(self.path(name), "no checkpoint")
        self.assertIn("begin anew", self.run_study(LONG, "--resume").stderr)
        self.expect_the_rest()
