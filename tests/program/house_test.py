#!/usr/bin/env python3
# diptych: how the sources look: formatted as .clang-format says, no file above what CONTRIBUTING.md allows
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: house_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

from running import SOURCE, content, main, write

FOLDERS = ("discrete", "continuum", "coupling", "tests", "benchmarks")


def sources(*endings):
    return sorted(os.path.join(folder, name) for top in FOLDERS for folder, _, names in os.walk(os.path.join(SOURCE, top))
                  for name in names if name.endswith(endings))


def allowed_lines():
    """The number that CONTRIBUTING.md states."""
    text = content(os.path.join(SOURCE, "CONTRIBUTING.md")).decode()
    return int(re.search(r"One idea a file \(about \d+ lines, (\d+) at most\)", text).group(1))


class House(unittest.TestCase):
    def test_no_file_is_longer_than_allowed(self):
        most = allowed_lines()
        files = sources(".h", ".cc", ".py", ".js")
        self.assertGreater(len(files), 300)
        long = {os.path.relpath(path, SOURCE): content(path).count(b"\n") for path in files}
        self.assertEqual({path: lines for path, lines in long.items() if lines > most}, {})

    def misformatted(self, files):
        words = ["clang-format", "--style=file:" + os.path.join(SOURCE, ".clang-format"), "--dry-run", *files]
        told = subprocess.run(words, capture_output=True, text=True, check=True).stderr
        return sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning", told, re.MULTILINE)))

    def test_every_source_is_formatted(self):
        if shutil.which("clang-format") is None:
            self.skipTest("clang-format is not installed (test.sh installs it)")
        files = sources(".h", ".cc")
        self.assertGreater(len(files), 300)
        self.assertEqual(self.misformatted(files), [])
        with tempfile.TemporaryDirectory() as work:  # it can fail
            ugly = write(os.path.join(work, "ugly.cc"), "int  main( ){return 0;}\n")
            self.assertEqual(self.misformatted([ugly]), [ugly])


if __name__ == "__main__":
    main()
