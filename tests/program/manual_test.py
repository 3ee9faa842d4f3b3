#!/usr/bin/env python3
# diptych: the manual is built, says what the program says, leads nowhere in vain, and fits a screen and a telephone
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: manual_test.py PROGRAM SOURCE_DIR [unittest arguments]."""

import html
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import browser
from running import PROGRAM, QUICK, SMALL, SOURCE, content, diptych, main, setting, write

MANUAL = os.path.join(SOURCE, "coupling", "manual")
sys.path.insert(0, MANUAL)
import equations  # noqa: E402
import links  # noqa: E402
import reference  # noqa: E402

DESK, PHONE = (1400, 1000), (390, 844)  # CSS pixels


def build(source, site):
    return subprocess.run([sys.executable, "-B", os.path.join(source, "coupling", "manual", "build.py"), source, PROGRAM, site],
                          capture_output=True, text=True, check=False)


def setUpModule():
    """One manual for all tests, in a folder of its own."""
    if not shutil.which("mkdocs"):
        raise unittest.SkipTest("no mkdocs on the PATH: test.sh installs it")
    work = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(work.cleanup)
    Built.site = os.path.join(work.name, "manual")
    built = build(SOURCE, Built.site)
    if built.returncode:
        raise RuntimeError(built.stderr)
    Built.pages = sorted(os.path.relpath(os.path.join(folder, name), Built.site) for folder, _, names in os.walk(Built.site)
                         for name in names if name.endswith(".html"))


class Built(unittest.TestCase):
    site, pages = None, []


class Manual(Built):
    def page(self, name):
        return content(os.path.join(self.site, name)).decode()

    def words(self, name):
        """What a page shows, without its tags."""
        return html.unescape(re.sub(r"<[^>]*>", "", self.page(name)))

    def test_every_key_of_a_scene_stands_on_its_page(self):
        section, count = None, 0
        for line in diptych("explain", check=True).stdout.split("\n"):
            if line and not line.startswith(" "):
                section = line
            elif re.match(r"  \S", line):
                count += 1
                self.assertIn(line.split("  [")[0].strip(), self.words(f"reference/keys_{section}.html"))
        self.assertGreater(count, 100)

    def test_every_column_and_dataset_stands_on_its_page(self):
        heading, count = None, 0
        for line in diptych("explain", "results", check=True).stdout.split("\n"):
            if line and not line.startswith(" "):
                heading = line
            elif re.match(r"  \S", line):
                count += 1
                self.assertIn(line.split("  [")[0].strip(), self.words(f"reference/results_{re.match('[a-z]+', heading)[0]}.html"))
            elif line.strip():
                self.assertIn(line.strip().replace("`", ""), self.words(f"reference/results_{re.match('[a-z]+', heading)[0]}.html"))
        self.assertGreater(count, 900)

    def test_every_option_of_every_command_stands_on_its_page(self):
        listed = re.findall(r"^  ([a-z-]+) ", diptych("--help", check=True).stdout.split("Subcommands:")[1], re.MULTILINE)
        shown = self.words("reference/commands.html")
        self.assertGreater(len(listed), 10)
        for name in listed:
            self.assertIn("diptych " + name, shown)
            for option in re.findall(r"--[a-z-]+", diptych(name, "--help", check=True).stdout):
                self.assertIn(option, shown)

    def test_every_readme_is_a_page(self):
        readmes = [os.path.relpath(os.path.join(folder, "README.md"), SOURCE) for top in ("discrete", "continuum", "coupling", "benchmarks")
                   for folder, _, names in os.walk(os.path.join(SOURCE, top)) if "README.md" in names]
        self.assertGreater(len(readmes), 30)
        for path in readmes:
            self.assertIn(os.path.join("source", os.path.dirname(path), "index.html"), self.pages)

    def test_every_equation_is_stated_by_its_source(self):
        self.assertEqual(equations.missing(SOURCE), [])
        self.assertGreater(sum(len(listed) for _, listed in equations.SECTIONS), 60)
        false = [("", [("sign turned", "", "discrete/contacts/internal_moment.h", "M_i = sym sum_c (x_c - x_i) (x) f_c"),
                       ("gone", "", "discrete/contacts/no_such.h", "M_i")])]
        self.assertEqual([name for name, *_ in equations.missing(SOURCE, false)], ["sign turned", "gone"])

    def test_a_formula_that_its_source_does_not_state_ends_the_build(self):
        with tempfile.TemporaryDirectory() as work:
            tree = os.path.join(work, "tree")
            shutil.copytree(SOURCE, tree, symlinks=True, ignore=shutil.ignore_patterns("build", "results", ".git", "*.csv", "*.h5"))
            path = os.path.join(tree, "continuum", "laws", "mohr_coulomb.h")
            write(path, content(path).decode().replace("F = t - s sin(phi)", "F = t + s sin(phi)"))
            built = build(tree, os.path.join(work, "site"))
            self.assertEqual(built.returncode, 1)
            self.assertIn("continuum/laws/mohr_coulomb.h does not say", built.stderr)
            self.assertFalse(os.path.exists(os.path.join(work, "site")))

    def test_words_that_the_program_does_not_know_are_found(self):
        keys, commands = reference.Keys(PROGRAM), reference.Commands(PROGRAM)
        self.assertEqual(reference.unknown_words("`discrete/friction` and\n    diptych run SCENE --seeds 1-8\n", keys, commands), [])
        wrong = "`discrete/frictoin` and\n    diptych run SCENE --seed 1-8\n    diptych walk SCENE\n"
        self.assertEqual(reference.unknown_words(wrong, keys, commands), ["discrete/frictoin", "diptych run --seed", "diptych walk"])

    def test_a_python_package_is_shown_by_its_docstrings(self):
        with tempfile.TemporaryDirectory() as work:
            os.mkdir(os.path.join(work, "grains"))
            write(os.path.join(work, "grains", "__init__.py"), '"""Discs."""\n__all__ = ["Panel", "radii"]\n'
                  'class Panel:\n    """One sample."""\n    def step(self, h=1):\n        """Goes on by h."""\n    def _own(self):\n'
                  '        """Not shown."""\ndef radii(n):\n    """n numbers."""\ndef hidden():\n    """Not shown."""\n')
            told = subprocess.run([sys.executable, "-B", os.path.join(MANUAL, "module_docs.py"), "grains"], capture_output=True,
                                  text=True, check=True, env={**os.environ, "PYTHONPATH": work}).stdout
        self.assertEqual(re.findall(r"^#+ .*$", told, re.MULTILINE), ["### `Panel`", "#### `step(self, h=1)`", "### `radii(n)`"])
        for words in ("Discs.", "    One sample.", "    Goes on by h.", "    n numbers."):
            self.assertIn(words, told)
        self.assertNotIn("Not shown", told)

    def test_no_link_leads_nowhere(self):
        self.assertEqual(links.check(self.site)[0], [])
        with tempfile.TemporaryDirectory() as work:  # it can fail
            write(os.path.join(work, "a.html"), '<a href="b.html#here">b</a><a href="b.html#there">b</a><a href="#up">a</a>'
                  '<img src="../out.png"><a href="https://example.org/">x</a>')
            write(os.path.join(work, "b.html"), '<p id="here"></p><a href="c.html">c</a>')
            broken, external = links.check(work)
            self.assertEqual(sorted(broken), [("a.html", "#up"), ("a.html", "../out.png"), ("a.html", "b.html#there"), ("b.html", "c.html")])
            self.assertEqual(external, ["https://example.org/"])

    def test_pages_need_no_network(self):
        for name in self.pages:
            for tag in re.findall(r"<(?:script|img|link)\b[^>]*>", self.page(name)):
                if 'rel="canonical"' not in tag:
                    self.assertNotRegex(tag, r'(?:src|href)="(?:https?:)?//', name)
        styles = [os.path.join(folder, name) for folder, _, names in os.walk(self.site) for name in names if name.endswith(".css")]
        self.assertGreater(len(styles), 2)
        for path in styles:
            self.assertNotRegex(content(path).decode(), r"url\(['\"]?https?:", path)

    def test_its_scenes_run(self):
        for name in os.listdir(os.path.join(MANUAL, "examples")):
            with tempfile.TemporaryDirectory() as work:
                done = diptych("run", os.path.join(MANUAL, "examples", name), *SMALL, *setting(sample_grains=200, output_report="false"),
                               "--output", work, "--quiet")
                self.assertEqual((done.returncode, "warning" in done.stderr), (0, False), done.stderr)
        self.assertTrue(os.path.exists(QUICK))  # which the first comparison runs


@unittest.skipUnless(browser.program(), "no chromium on the PATH: test.sh installs it")
class Look(Built):
    """Its pages in a browser."""

    @classmethod
    def setUpClass(cls):
        cls.window = browser.Page(*DESK)

    @classmethod
    def tearDownClass(cls):
        cls.window.close()

    def setUp(self):
        self.window.messages.clear()

    def open(self, name):
        self.window.open(os.path.join(self.site, name))

    def width(self):
        """Of all that the page could scroll to [CSS pixels]; a telephone would widen innerWidth to it."""
        return self.window.run("document.documentElement.scrollWidth")

    def test_no_page_is_wider_than_its_window(self):
        for size, names in ((DESK, [name for name in self.pages if "/" not in name]), (PHONE, self.pages)):
            self.window.size(*size)
            for name in names:
                self.open(name)
                self.assertLessEqual(self.width(), size[0], name)
        self.window.run("document.querySelector('article').innerHTML = '<p style=\"width: 900px\">x</p>'")  # it can fail
        self.assertGreater(self.width(), PHONE[0])
        self.assertEqual(self.window.messages, [])

    def test_every_formula_is_set(self):
        self.window.size(*DESK)
        self.open("reference/equations.html")
        count = sum(len(listed) for _, listed in equations.SECTIONS)
        self.assertEqual(self.window.run("document.querySelectorAll('.formula .katex-display').length"), count)
        self.assertEqual(self.window.run("[...document.querySelectorAll('.katex-error')].map((e) => e.title)"), [])
        self.assertTrue(self.window.run("document.fonts.check('16px KaTeX_Main')"))

    def test_a_key_is_found_by_its_meaning(self):
        self.window.size(*PHONE)
        self.open("find.html")
        self.window.run("(() => { const f = document.getElementById('words'); f.value = 'internal Cosserat KEY'; f.dispatchEvent(new Event('input')); })()")
        found = self.window.run("[...document.querySelectorAll('#found a')].map((a) => a.getAttribute('href'))")
        self.assertIn("reference/keys_continuum.html#continuum-internal_length", found)
        self.assertEqual(self.window.messages, [])


if __name__ == "__main__":
    main()
