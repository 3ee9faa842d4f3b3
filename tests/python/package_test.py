# diptych: tests of the package as installed: docstrings, places of files
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import subprocess
import sys

import diptych


def test_every_public_name_has_a_docstring():
    for name in diptych.__all__:
        if not name.startswith("__"):
            assert (getattr(diptych, name).__doc__ or "").strip(), name
    for name, member in vars(diptych.DiscreteSnapshot).items():
        if isinstance(member, property):
            assert "[" in member.__doc__ or name in ("contacts", "window"), name
    for word in ("(k, 2, 2)", "[length]", "Raises", "Returns"):
        assert word in diptych.map_stress.__doc__


def test_dir_and_the_docstring_name_what_there_is():
    assert set(dir(diptych)) == set(diptych.__all__)
    for name in ("run", "ensemble", "study", "plan", "calibrate", "homogenise", "load", "compare", "find_bands"):
        assert name in dir(diptych) and name in diptych.__doc__, name


def test_importing_the_package_does_not_load_deal_ii():
    script = "import diptych, sys; diptych.scene({}); print(open('/proc/self/maps').read().count('libdeal_II'))"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                          check=True).stdout.strip() == "0"


def test_shipped_scenes_and_notebooks_are_found_in_the_source_tree():
    assert os.path.isfile(os.path.join(diptych.benchmarks_dir(), "moreau_quick", "scene.prm"))
    assert os.path.isfile(os.path.join(diptych.notebooks_dir(), "data", "frames.csv"))
