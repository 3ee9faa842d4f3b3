# diptych: the common part of the benchmarks
# SPDX-License-Identifier: LGPL-2.1-or-later
import argparse
import os
import runpy

from diptych import benchmarks_dir


def test_an_interrupted_run_is_made_again(tmp_path):
    """A stand-in for the program finishes the run. The finished run is then read, and nothing is run."""
    program, folder = tmp_path / "program", tmp_path / "seed_1" / "a"
    program.write_text("""#!/bin/sh\necho '{"discrete": {"finished": true}, "phases": []}' > "$4/provenance.json"\n""")
    program.chmod(0o755)
    folder.mkdir(parents=True)
    (folder / "provenance.json").write_text('{"discrete": {"finished": false}, "phases": []}')
    runs = runpy.run_path(os.path.join(benchmarks_dir(), "claims.py"))["Runs"](
        argparse.Namespace(program=program, reuse=True, set=[]), 1, folder.parent)
    assert runs.run("a", "discrete", "scene.prm").provenance["discrete"]["finished"]
    program.write_text("#!/bin/sh\nexit 1\n")
    assert runs.run("a", "discrete", "scene.prm").seconds() == 0
