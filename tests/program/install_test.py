# diptych: the Debian package runs without the tree that it was built from
# SPDX-License-Identifier: LGPL-2.1-or-later
"""PROGRAM in its build folder."""

import gzip
import os
import re
import shutil
import subprocess
import sys
import unittest

from running import content, ENVIRONMENT, member_of, PROGRAM, setting, SMALL, SOURCE, temporary

BUILD = os.path.dirname(PROGRAM)


class Package(unittest.TestCase):
    """The .deb is unpacked into a folder of its own, and the program started from there in an empty environment."""

    @classmethod
    def setUpClass(cls):
        cls.work = temporary(cls)
        cls.root = os.path.join(cls.work, "root")
        cls.share = os.path.join(cls.root, "usr", "share")
        subprocess.run(["cpack", "--config", os.path.join(BUILD, "CPackConfig.cmake"), "-G", "DEB", "-B", cls.work],
                       check=True, capture_output=True, cwd=cls.work)
        cls.package = next(os.path.join(cls.work, name) for name in os.listdir(cls.work) if name.endswith(".deb"))
        subprocess.run(["dpkg-deb", "-x", cls.package, cls.root], check=True)
        cls.program = os.path.join(cls.root, "usr", "bin", "diptych")

    def run_program(self, *words):
        environment = {name: ENVIRONMENT[name] for name in ENVIRONMENT if name.startswith("OMPI_")}
        return subprocess.run([self.program, *words], capture_output=True, text=True, check=False, cwd=self.work,
                              env={"PATH": "/usr/bin:/bin", "HOME": self.work, **environment})

    def test_it_names_what_it_needs(self):
        fields = subprocess.run(["dpkg-deb", "-f", self.package, "Depends"], check=True, capture_output=True,
                                text=True).stdout
        for package in ("python3-h5py", "python3-matplotlib", "python3-jinja2", "python3-numpy", "python3-scipy",
                        "python3-pandas",
                        "python3-mpi4py", "python3-meshio", "python3-emcee", "libdeal.ii", "libhdf5-openmpi", "libc6"):
            self.assertIn(package, fields)

    def test_no_file_of_it_knows_where_it_was_built(self):
        """So that it cannot lean on the source tree or the build folder, moved away or not."""
        names = [os.path.join(folder, name) for folder, _, files in os.walk(self.root) for name in files]
        self.assertGreater(len(names), 30)
        for name in names:
            for tree in (SOURCE, BUILD):
                self.assertNotIn(tree.encode(), content(name), name)

    def test_the_version_names_what_it_was_built_with(self):
        told = self.run_program("--version").stdout
        self.assertRegex(told, r"^diptych \d+\.\d+\.\d+ \(\S+\)\n")
        for name in ("GNU", "Eigen", "HDF5", "CLI11", "deal.II", "Trilinos", "p4est", "gmsh API"):
            self.assertRegex(told, rf"\b{re.escape(name)} \d+\.\d+")

    def test_the_manual_page_has_every_command_and_option(self):
        page = os.path.join(self.share, "man", "man1", "diptych.1.gz")
        with gzip.open(page, "rt") as file:
            text = file.read().replace("\\-", "-")
        commands = re.findall(r"^  ([a-z][a-z-]*) ", self.run_program("--help").stdout, re.MULTILINE)
        self.assertGreater(len(commands), 10)
        for command in commands:
            section = text.split(f'.SS "diptych {command}"')[1].split(".SS")[0]
            for option in re.findall(r"^  (?:-h,)?(--[a-z-]+)", self.run_program(command, "--help").stdout,
                                     re.MULTILINE):
                self.assertRegex(section, rf"(?m)^\.B (?:-h, )?{option}\b")
        if shutil.which("man"):
            told = subprocess.run(["man", "--warnings", "-l", page], capture_output=True, text=True, check=True,
                                  env={"PATH": "/usr/bin:/bin", "MANWIDTH": "100", "LC_ALL": "C.UTF-8"})
            self.assertEqual(told.stderr, "")
            self.assertIn("material-point", told.stdout)

    def test_shells_complete_keys(self):
        for script in (("bash-completion", "completions", "diptych"), ("zsh", "vendor-completions", "_diptych")):
            path = os.path.join(self.share, *script)
            self.assertTrue(content(path).startswith(b"#compdef diptych\n"))
            line = f"source {path}; COMP_WORDS=({self.program} run --set discrete/fric); COMP_CWORD=3; _diptych; "
            told = subprocess.run(["bash", "-c", line + "echo ${COMPREPLY[@]}"], capture_output=True, text=True,
                                  check=True).stdout
            self.assertEqual(told, "discrete/friction=\n")

    def test_another_project_links_the_library(self):
        build = os.path.join(self.work, "external")
        source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "external_project")
        environment = {"PATH": "/usr/bin:/bin", "HOME": self.work}
        for words in (["cmake", "-S", source, "-B", build, "-DCMAKE_PREFIX_PATH=" + os.path.join(self.root, "usr")],
                      ["cmake", "--build", build]):
            done = subprocess.run(words, capture_output=True, text=True, check=False, env=environment)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        cache = content(os.path.join(build, "CMakeCache.txt")).decode()
        self.assertIn("diptych_DIR:PATH=" + self.root, cache)
        self.assertNotIn(BUILD, cache)
        told = subprocess.run([os.path.join(build, "three_discs"), os.path.join(self.work, "discs.h5")],
                              capture_output=True, text=True, check=True, env=environment).stdout
        ratio, height = (float(number) for number in re.findall(r"\d+\.\d+", told))
        self.assertAlmostEqual(ratio, 1, delta=1e-8)  # at rest the floor carries the weight of all three
        # radius 0.5 on two diameters, less penetrations of at most 1e-4 d
        self.assertAlmostEqual(height, 2.5, delta=3e-4)

    def test_a_law_of_the_user(self):
        """Built from the installed examples against the installed header, as README of continuum/ says."""
        folder = shutil.copytree(os.path.join(self.share, "diptych", "benchmarks", "own_law"),
                                 os.path.join(self.work, "own_law"))
        subprocess.run(["make", "-s", "-C", folder, "INCLUDE=" + os.path.join(self.root, "usr", "include", "diptych")],
                       check=True)
        for library in ("mohr_coulomb.so", "von_mises.so"):
            done = self.run_program("check-law", os.path.join(folder, library), "--quiet")
            self.assertEqual((done.returncode, done.stdout.count(": holds")), (0, 5), done.stdout + done.stderr)

    def test_an_ensemble_with_its_page_and_that_of_a_run(self):
        scene = os.path.join(self.share, "diptych", "benchmarks", "moreau_quick", "scene.prm")
        folder, few = os.path.join(self.work, "two"), SMALL + setting(sample_grains=150)
        done = self.run_program("run", scene, *few, "--seeds", "1-2", "--output", folder, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.run_program("report", member_of(folder, 1), "--quiet").returncode, 0)
        self.assertIn("biaxial: ", self.run_program("new").stdout)
        for page in (folder, member_of(folder, 1)):
            self.assertGreater(os.path.getsize(os.path.join(page, "report.html")), 100000)

    def test_the_python_package(self):
        place = os.path.join(self.root, "usr", "lib", "python3", "dist-packages")
        script = ("import diptych; p = diptych.ContinuumPanel({'continuum': {'mesh': 'rectangle', 'rectangle_width': "
                  "8, 'rectangle_height': 8}}); print(p.prepare(), diptych.__file__, diptych.notebooks_dir(), "
                  "diptych.scene(diptych.benchmarks_dir() + '/moreau_quick/scene.prm')['sample']['grains'])")
        done = subprocess.run([sys.executable, "-B", "-c", script], capture_output=True, text=True, check=False,
                              cwd=self.work, env={"PATH": "/usr/bin:/bin", "HOME": self.work, "PYTHONPATH": place})
        notebooks = os.path.join(self.share, "diptych", "notebooks")
        package = os.path.join(place, "diptych", "__init__.py")
        self.assertEqual(done.stdout.split(), ["finished", package, notebooks, "2000"], done.stderr)
        self.assertEqual(len([name for name in os.listdir(notebooks) if name.endswith(".ipynb")]), 7)
        self.assertTrue(os.path.exists(os.path.join(notebooks, "data", "frames.csv")))

    def test_a_broken_installation_is_named_with_exit_code_4(self):
        templates = os.path.join(self.share, "diptych", "templates")
        os.rename(templates, templates + "_away")
        self.addCleanup(os.rename, templates + "_away", templates)
        done = self.run_program("new")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("installation is broken", done.stderr)
