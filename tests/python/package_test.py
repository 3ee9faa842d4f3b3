# diptych: the package as it is installed: stubs, docstrings, its place
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
    """name of a function or class -> names of its members."""
    with open(os.path.join(PACKAGE, module + ".pyi")) as file:
        tree = ast.parse(file.read())
    return {node.name: {part.name for part in getattr(node, "body", []) if isinstance(part, ast.FunctionDef)}
            for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


@pytest.mark.parametrize("module", ["_diptych", "_continuum"])
def test_stubs_name_what_the_compiled_module_has(module):
    compiled, stub = importlib.import_module("diptych." + module), names_in_stub(module)
    public = {name for name, value in vars(compiled).items() if not name.startswith("_") and callable(value)}
    assert public == set(stub)
    for name in public:
        if inspect.isclass(getattr(compiled, name)):
            members = {member for member in vars(getattr(compiled, name)) if not member.startswith("_")}
            assert members == {member for member in stub[name] if not member.startswith("_")}, name


def test_everything_public_says_what_it_is():
    for name in diptych.__all__:
        if not name.startswith("__"):
            assert (getattr(diptych, name).__doc__ or "").strip(), name
    for name, member in vars(diptych.DiscreteSnapshot).items():
        if isinstance(member, property):
            assert "[" in member.__doc__ or name in ("contacts", "window"), name
    for word in ("(k, 2, 2)", "[length]", "Raises", "Returns"):
        assert word in diptych.map_stress.__doc__


def test_the_grains_are_there_without_the_libraries_of_the_continuum():
    script = "import diptych, sys; diptych.scene({}); print(open('/proc/self/maps').read().count('libdeal_II'))"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.strip() == "0"


def test_an_installed_package_runs_from_its_place(tmp_path):
    build = os.path.dirname(PROGRAM)
    subprocess.run(["cmake", "--install", build, "--prefix", tmp_path], check=True, capture_output=True)
    place = tmp_path / "lib" / "python3" / "dist-packages"
    assert (place / "diptych" / "py.typed").exists() and (place / "diptych" / "_diptych.pyi").exists()
    script = "import diptych; print(diptych.__file__, diptych.biaxial({})['stress_ratio'].max() > 0.2)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=tmp_path,
                          env={**os.environ, "PYTHONPATH": str(place)})
    assert done.stdout.split() == [str(place / "diptych" / "__init__.py"), "True"]
