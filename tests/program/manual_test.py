# diptych: tests of the manual: content, links, and width on a screen and a phone
# SPDX-License-Identifier: LGPL-2.1-or-later
import html
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

import browser
from running import content, diptych, PROGRAM, QUICK, setting, SMALL, SOURCE

MANUAL = os.path.join(SOURCE, "coupling", "manual")
sys.path.insert(0, MANUAL)
import headers  # noqa: E402

DESK, PHONE = (1400, 1000), (390, 844)  # CSS pixels


def setUpModule():
    """Builds one manual for all tests."""
    if not shutil.which("mkdocs"):
        raise unittest.SkipTest("no mkdocs on the PATH: test.sh installs it")
    work = tempfile.TemporaryDirectory()
    unittest.addModuleCleanup(work.cleanup)
    Built.site = os.path.join(work.name, "manual")
    built = subprocess.run([sys.executable, "-B", os.path.join(MANUAL, "build.py"), SOURCE, PROGRAM, Built.site],
                           capture_output=True, text=True, check=False)
    if built.returncode:
        raise RuntimeError(built.stderr)
    Built.pages = sorted(os.path.relpath(os.path.join(folder, name), Built.site) for folder, _,
                         names in os.walk(Built.site)
                         for name in names if name.endswith(".html"))


def explained(part):
    """The entries keys or results of `diptych explain --json`."""
    return json.loads(diptych("explain", "--json", check=True).stdout)[part]


class Built(unittest.TestCase):
    site, pages = None, []


class Links(html.parser.HTMLParser):
    """The links of a page and its anchors."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(content(path).decode())

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and value is not None:
                self.links.append(value)
            elif name == "id":
                self.anchors.add(value)


def broken_links(folder):
    """Sorted (page, link) of the links within a folder of pages whose file or anchor does not exist."""
    pages = {os.path.join(root, name): Links(os.path.join(root, name)) for root, _,
             names in os.walk(os.path.realpath(folder))
             for name in names if name.endswith(".html")}
    broken, top = [], os.path.realpath(folder)
    for path, page in pages.items():
        for link in page.links:
            target, _, anchor = urllib.parse.unquote(link).partition("#")
            if urllib.parse.urlsplit(link).scheme:
                continue
            full = os.path.normpath(os.path.join(os.path.dirname(path), target)) if target else path
            is_there = os.path.isfile(full) and full.startswith(top + os.sep)
            if not is_there or (anchor and anchor not in pages[full].anchors):
                broken.append((os.path.relpath(path, top), link))
    return sorted(broken)


class Manual(Built):
    def page(self, name):
        return content(os.path.join(self.site, name)).decode()

    def shown(self, name):
        """The text of a page without its tags."""
        return html.unescape(re.sub(r"<[^>]*>", "", self.page(name)))

    def test_every_key_column_and_dataset_is_listed_with_its_meaning(self):
        self.assertGreater(len(explained("keys")), 100)
        for one in explained("keys"):
            page = self.shown(f"reference/keys_{one['section']}.html")
            for text in (f"{one['key']} = {one['default'] or '(empty)'}", one["allowed"],
                         one["meaning"].replace("`", "")):
                self.assertIn(text, page)
        self.assertGreater(len(explained("results")), 900)
        for one in explained("results"):
            page = self.shown(f"reference/results_{re.match('[a-z]+', one['file'])[0]}.html")
            for text in (one["entry"], one["shape"], one["meaning"].replace("`", "")):
                self.assertIn(text, page)

    def test_every_command_and_option_is_listed(self):
        names = re.findall(r"^  ([a-z][a-z-]*) ", diptych("--help", check=True).stdout, re.MULTILINE)
        shown = self.shown("reference/commands.html")
        self.assertGreater(len(names), 10)
        for name in names:
            self.assertIn("diptych " + name, shown)
            for option in re.findall(r"--[a-z-]+", diptych(name, "--help", check=True).stdout):
                self.assertIn(option, shown)

    def test_every_readme_is_a_page(self):
        found = [os.path.relpath(os.path.join(folder, "README.md"), SOURCE)
                 for top in ("discrete", "continuum", "coupling", "benchmarks")
                 for folder, _, names in os.walk(os.path.join(SOURCE, top)) if "README.md" in names]
        self.assertGreater(len(found), 30)
        for path in found:
            if not path.startswith(os.path.join("coupling", "manual")):
                self.assertIn(os.path.join("source", os.path.dirname(path), "index.html"), self.pages)

    def test_the_pages_name_existing_keys_commands_and_options(self):
        keys = {f"{one['section']}/{one['key']}" for one in explained("keys")}
        sections = "|".join({key.split("/")[0] for key in keys})
        for name in os.listdir(os.path.join(MANUAL, "pages")):
            text = content(os.path.join(MANUAL, "pages", name)).decode()
            for key in re.findall(rf"`((?:{sections})/[a-z_]+)(?: = \w+)?`", text):
                self.assertIn(key, keys, name)
            for command, rest in re.findall(r"^    (?:\$ )?diptych ([a-z][a-z-]*)(.*)$", text, re.MULTILINE):
                known = diptych(command, "--help", check=True).stdout
                for option in re.findall(r" (--[a-z-]+)", rest):
                    self.assertIn(option, known, f"{name}: diptych {command}")

    def test_the_recipe_for_apptainer_has_the_steps_of_the_container_file(self):
        folder = os.path.join(SOURCE, ".container")
        recipe = subprocess.run([os.path.join(folder, "apptainer")], capture_output=True, text=True, check=True).stdout
        steps = re.findall(r"^(?:RUN|COPY|ENV) (.*)$", content(folder, "Containerfile").decode(), re.MULTILINE)
        self.assertEqual(len(steps), 4)
        for step in [*steps, "From: debian:12", "exec /opt/diptych/build/release/diptych "]:
            self.assertIn(step, recipe)

    def test_equations_are_the_comments_of_the_sources(self):
        # without blanks: list items are lines of their own
        shown, count = "".join(self.shown("equations.html").split()), 0
        for path in re.findall(r"<!-- equations: (.+) -->",
                               content(os.path.join(MANUAL, "pages", "equations.md")).decode()):
            for comment in headers.formulas(content(os.path.join(SOURCE, path)).decode()):
                self.assertIn("".join(comment.replace("`", "").split()[:9]), shown, path)
                count += 1
        self.assertGreater(count, 40)

    def test_the_gallery_shows_a_picture_of_each_test(self):
        page, templates = self.page("gallery.html"), os.path.join(SOURCE, "coupling", "templates")
        names = re.findall(r"diptych new (\w+) >", self.shown("gallery.html"))
        self.assertGreater(len(set(names)), 7)
        self.assertEqual(set(names), {name[:-4] for name in os.listdir(os.path.join(MANUAL, "gallery"))})
        for name in names:
            self.assertIn(f"coupling/manual/gallery/{name}.png", page)
            self.assertTrue(os.path.exists(os.path.join(templates, name + ".prm")), name)

    def test_every_link_works(self):
        self.assertEqual(broken_links(self.site), [])

    def test_pages_need_no_network(self):
        for name in self.pages:
            for tag in re.findall(r"<(?:script|img|link)\b[^>]*>", self.page(name)):
                if 'rel="canonical"' not in tag:
                    self.assertNotRegex(tag, r'(?:src|href)="(?:https?:)?//', name)
        styles = [os.path.join(folder, name) for folder, _, names in os.walk(self.site) for name in names
                  if name.endswith(".css")]
        self.assertGreater(len(styles), 2)
        for path in styles:
            self.assertNotRegex(content(path).decode(), r"url\(['\"]?https?:", path)

    def test_the_example_scenes_run(self):
        for name in (name for name in os.listdir(os.path.join(MANUAL, "examples")) if name.endswith(".prm")):
            with tempfile.TemporaryDirectory() as work:
                done = diptych("run", os.path.join(MANUAL, "examples", name), *SMALL,
                               *setting(sample_grains=200, output_report="false"), "--output", work, "--quiet")
                self.assertEqual((done.returncode, "warning" in done.stderr), (0, False), done.stderr)
        self.assertTrue(os.path.exists(QUICK))  # the scene of the page first_comparison


@unittest.skipUnless(browser.program(), "no chromium on the PATH: test.sh installs it")
class Look(Built):
    """The pages in a browser."""

    @classmethod
    def setUpClass(cls):
        cls.window = cls.enterClassContext(browser.Page(*DESK))

    def setUp(self):
        self.window.messages.clear()

    def open(self, name):
        self.window.open(os.path.join(self.site, name))

    def width(self):
        """Width that the page can scroll to [CSS pixels]; innerWidth would grow with it on a phone."""
        return self.window.run("document.documentElement.scrollWidth")

    def test_no_page_is_wider_than_its_window(self):
        for size, names in ((DESK, ["index.html"]), (PHONE, self.pages)):
            self.window.size(*size)
            for name in names:
                self.open(name)
                self.assertLessEqual(self.width(), size[0], name)
        # it can fail
        self.window.run("document.querySelector('article').innerHTML = '<p style=\"width: 900px\">x</p>'")
        self.assertGreater(self.width(), PHONE[0])
        self.assertEqual(self.window.messages, [])

    def test_a_key_is_found_by_its_meaning(self):
        self.window.size(*PHONE)
        self.open("find.html")
        links = "[...document.querySelectorAll('#found a')].map((a) => a.getAttribute('href'))"
        self.assertGreater(len(self.window.run(links)), 10)  # before anything is typed
        self.window.run("(() => { const f = document.getElementById('words'); f.value = 'internal Cosserat KEY'; "
                        "f.dispatchEvent(new Event('input')); })()")
        self.assertIn("reference/keys_continuum.html#continuum-internal_length", self.window.run(links))
        self.assertEqual(self.window.messages, [])
