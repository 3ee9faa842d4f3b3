# diptych: tests of the package as installed: stubs, docstrings, places of files, missing requirements
# SPDX-License-Identifier: LGPL-2.1-or-later
import ast
import importlib
import inspect
import os
import subprocess
import sys

import pytest

import diptych
from conftest import PROGRAM, SOURCE

PACKAGE = os.path.join(SOURCE, "coupling", "python", "diptych")


def names_in_stub(module):
    """Name of a function or class -> names of its members."""
    with open(os.path.join(PACKAGE, module + ".pyi")) as file:
        tree = ast.parse(file.read())
    return {node.name: {part.name for part in getattr(node, "body", []) if isinstance(part, ast.FunctionDef)}
            for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


@pytest.mark.parametrize("module", ["_diptych", "_continuum"])
def test_stubs_list_the_names_of_the_compiled_module(module):
    compiled, stub = importlib.import_module("diptych." + module), names_in_stub(module)
    public = {name for name, value in vars(compiled).items() if not name.startswith("_") and callable(value)}
    assert public == set(stub)
    for name in public:
        if inspect.isclass(getattr(compiled, name)):
            members = {member for member in vars(getattr(compiled, name)) if not member.startswith("_")}
            assert members == {member for member in stub[name] if not member.startswith("_")}, name


def test_every_public_name_has_a_docstring():
    for name in diptych.__all__:
        if not name.startswith("__"):
            assert (getattr(diptych, name).__doc__ or "").strip(), name
    for name, member in vars(diptych.DiscreteSnapshot).items():
        if isinstance(member, property):
            assert "[" in member.__doc__ or name in ("contacts", "window"), name
    for word in ("(k, 2, 2)", "[length]", "Raises", "Returns"):
        assert word in diptych.map_stress.__doc__


def test_importing_the_package_does_not_load_deal_ii():
    script = "import diptych, sys; diptych.scene({}); print(open('/proc/self/maps').read().count('libdeal_II'))"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.strip() == "0"


def test_an_installed_package_runs_from_its_place(tmp_path):
    build = os.path.dirname(PROGRAM)
    subprocess.run(["cmake", "--install", build, "--prefix", tmp_path], check=True, capture_output=True)
    place = tmp_path / "lib" / "python3" / "dist-packages"
    assert (place / "diptych" / "py.typed").exists() and (place / "diptych" / "_diptych.pyi").exists()
    script = ("import diptych; print(diptych.__file__, diptych.biaxial({})['stress_ratio'].max() > 0.2, diptych.notebooks_dir(), "
              "diptych.scene(diptych.benchmarks_dir() + '/moreau_quick/scene.prm')['sample']['grains'])")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=tmp_path,
                          env={**os.environ, "PYTHONPATH": str(place)})
    notebooks = tmp_path / "share" / "diptych" / "notebooks"
    assert done.stdout.split() == [str(place / "diptych" / "__init__.py"), "True", str(notebooks), "2000"]
    assert len(list(notebooks.glob("*.ipynb"))) == 7 and (notebooks / "data" / "frames.csv").exists()


def test_shipped_scenes_and_notebooks_are_found_in_the_source_tree():
    assert os.path.isfile(os.path.join(diptych.benchmarks_dir(), "moreau_quick", "scene.prm"))
    assert os.path.isfile(os.path.join(diptych.notebooks_dir(), "data", "frames.csv"))


def message_without(module):
    """The message of `import diptych` if Python does not find a module."""
    script = f"""
import sys
class Hide:
    def find_spec(self, name, path=None, target=None):
        if name == "{module}":
            raise ImportError("hidden by the test")
sys.meta_path.insert(0, Hide())
try:
    import diptych
except ImportError as error:
    print(error)
"""
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout


def test_a_failed_import_says_what_to_install():
    assert "python3-numpy" in message_without("numpy") and sys.executable in message_without("numpy")
    assert "hidden by the test" in message_without("diptych._diptych") and "/usr/bin/python3" in message_without("diptych._diptych")
    assert message_without("h5py") == ""  # only readers of the raw files need it
