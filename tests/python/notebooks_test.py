# diptych: tests that the notebooks run, also as copies in another folder
# SPDX-License-Identifier: LGPL-2.1-or-later
import glob
import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from conftest import SOURCE

NOTEBOOKS = sorted(glob.glob(os.path.join(SOURCE, "coupling", "python", "notebooks", "*.ipynb")))


def test_notebooks_hold_their_outputs_without_paths_of_a_machine():
    for path in NOTEBOOKS:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        assert "image/png" in text, path
        assert not re.search(r"/(home|root|tmp|work)/", text), path


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[os.path.basename(path) for path in NOTEBOOKS])
def test_a_copied_notebook_runs(path, tmp_path):
    copy, out = shutil.copy(path, tmp_path), tmp_path / "done.ipynb"
    done = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", copy, "--output",
                           str(out)],
                          capture_output=True, text=True, check=False, env={**os.environ, "IPYTHONDIR": str(tmp_path)})
    assert done.returncode == 0, done.stderr[-3000:]
    outputs = [output for cell in json.loads(out.read_text())["cells"] for output in cell.get("outputs", [])]
    assert any("image/png" in output.get("data", {}) for output in outputs)
    assert not [output for output in outputs if output.get("name") == "stderr"]
