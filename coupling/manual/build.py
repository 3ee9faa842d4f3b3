#!/usr/bin/env python3
# diptych: the manual as pages
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: build.py SOURCE PROGRAM OUTPUT

Made of what the program, the READMEs and the headers say; pages/*.md are the only words of its own, and their keys, commands and
options are held against the program. OUTPUT is replaced as a whole. Exit code 1 naming what is stale: an equation that its source does
not state, an unknown key or option, a link that leads nowhere."""
import glob
import html
import json
import os
import posixpath
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

import equations
import headers
import links
import readmes
import reference

HERE = os.path.dirname(os.path.abspath(__file__))
KATEX = "/usr/share/javascript/katex"
UNUSED = ("404.html", "sitemap.xml", "sitemap.xml.gz", os.path.join("assets", "javascripts", "lunr"), os.path.join("assets", "javascripts", "workers"))
PAGES = [("index", "Start"), ("install", "Install"), ("first_comparison", "First comparison"), ("own_scene", "A scene of your own"),
         ("own_data", "Data of your own"), ("studies", "Studies and plans"), ("calibration", "Calibration"), ("python", "From Python")]


class Stale(Exception):
    """What the manual says is not so any more."""


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Directives:
    """Lines of a hand-written page that are filled in: `<!-- WORD: ARGUMENT -->`."""

    def __init__(self, source, commands, tree):
        self.source, self.commands, self.tree, self.shown = source, commands, tree, set()

    def path(self, name, optional=False):
        path = os.path.join(self.source, name)
        if not optional and not os.path.exists(path):
            raise Stale(f"coupling/manual/pages name {name}, which is not there")
        return path

    def filled(self, text):
        return re.sub(r"^<!-- (\w+): (.+?) -->$", lambda match: getattr(self, "do_" + match[1])(match[2]), text, flags=re.MULTILINE)

    def do_file(self, name):
        """A file of the tree as code."""
        return "```\n" + text_of(self.path(name)).rstrip() + "\n```"

    def do_help(self, name):
        return "```\n" + self.commands.helps[name].split("\n\nExit codes:")[0].rstrip() + "\n```"

    def do_packages(self, name):
        """The packages that a script of the tree installs."""
        block = re.search(r"packages=\((.*?)\)", text_of(self.path(name)), re.DOTALL)
        words = "apt-get install " + " ".join(block[1].split())
        return "```\n" + " \\\n".join(textwrap.wrap(words, 80, subsequent_indent="    ", break_on_hyphens=False)) + "\n```"

    def do_section(self, argument):
        """A section of a README, by its heading: FILE, HEADING."""
        name, heading = argument.split(", ", 1)
        match = re.search(rf"^## {re.escape(heading)}\n(.*?)(?=^## |\Z)", text_of(self.path(name)), re.DOTALL | re.MULTILINE)
        if not match:
            raise Stale(f"{name} has no section '{heading}' any more, which coupling/manual/pages show")
        return self.moved(match[1], posixpath.dirname(name))

    def moved(self, text, folder):
        """Words of a README of a folder as a page at the top of the manual shows them."""
        text = readmes.LINK.sub(lambda m: m[0] if re.match(r"\w+:|#", m[2]) else f"{m[1]}({posixpath.join('source', folder, m[2])})", text)
        return self.tree.with_links(readmes.spaced(text.strip()), "index.html", folder)

    def do_readme(self, argument):
        """A README where there is one, below a heading in the place of its title: FILE, HEADING."""
        name, heading = argument.split(", ", 1)
        if not os.path.exists(self.path(name, optional=True)):
            return ""
        text = self.moved(re.sub(r"\A#.*\n", "", text_of(self.path(name))), posixpath.dirname(name)).split("```")
        deeper = [part if k % 2 else re.sub(r"^#(?=#* )", "##", part, flags=re.MULTILINE) for k, part in enumerate(text)]
        return f"## {heading}\n\n" + "```".join(deeper)

    def do_docstrings(self, folder):
        """Docstrings of the Python package that was built beside the program; else of the modules of a folder; else nothing."""
        built = os.path.join(os.path.dirname(self.commands.program), "python")
        if glob.glob(os.path.join(built, "diptych", "*.so")):
            done = subprocess.run([sys.executable, "-B", os.path.join(HERE, "module_docs.py"), "diptych"], capture_output=True, text=True,
                                  check=False, env={**os.environ, "PYTHONPATH": built})
            if done.returncode != 0:
                raise RuntimeError("the Python package does not load: " + done.stderr)
            return "## What it has\n\n" + done.stdout
        found = []
        for root, folders, names in os.walk(self.path(folder, optional=True)):
            folders.sort()
            for name in sorted(names):
                said = headers.docstrings(os.path.join(root, name)) if name.endswith(".py") else ""
                if said.strip():
                    found.append(f"## `{os.path.relpath(os.path.join(root, name), self.source)}`\n\n" + said)
        return "\n".join(found)

    def do_figure(self, argument):
        """A figure of the tree with its words: FILE, WORDS."""
        name, words = argument.split(", ", 1)
        self.path(name)
        self.shown.add("source/" + name)
        return f"![{words}](source/{name})\n\n*{words}*"


def own_pages(docs, directives, keys, commands):
    for name, _ in PAGES:
        text = text_of(os.path.join(HERE, "pages", name + ".md"))
        unknown = reference.unknown_words(text, keys, commands)
        if unknown:
            raise Stale(f"coupling/manual/pages/{name}.md: the program does not know {', '.join(unknown)}")
        filled = directives.filled(text)
        write(os.path.join(docs, name + ".md"), directives.tree.with_links(readmes.spaced(filled), name + ".html", ""))
    for figure in directives.shown:
        target = os.path.join(docs, figure)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        shutil.copyfile(os.path.join(directives.source, figure[len("source/"):]), target)


def find_page(entries):
    """The page that finds keys, numbers, commands and equations by a word."""
    rows = [[name, kind, link, meaning[:160]] for name, kind, link, meaning in entries]
    data = json.dumps(rows, ensure_ascii=False).replace("</", "<\\/")
    return ("# Find\n\nKeys of scenes, columns and datasets of results, commands, equations, headers: all of them, by any words in them.\n\n"
            '<input id="words" type="search" placeholder="internal length" aria-label="words to find">\n<p id="found-count"></p>\n'
            f'<div id="found"></div>\n<script id="find-data" type="application/json">{data}</script>\n')


def navigation(key_pages, result_pages, header_pages, tree):
    """The tree of pages, as mkdocs takes it."""
    def under(prefix):
        return [{readmes.title(tree.texts[path], path): "source/" + path} for path in tree.paths if path.startswith(prefix)]
    project = [{readmes.title(tree.texts[path], path): "source/" + path} for path in tree.paths if "/" not in path]
    return [*({title: name + ".md"} for name, title in PAGES), {"Find": "find.md"},
            {"Commands": "reference/commands.md"}, {"Keys of a scene": [{title: page} for page, title, _ in key_pages]},
            {"Results": [{title: page} for page, title, _ in result_pages]}, {"Equations": "reference/equations.md"},
            {"Benchmarks": under("benchmarks/")},
            {"How it is made": under("discrete/") + under("continuum/") + under("coupling/") + under("meshes/")},
            {"Headers": [{title: page} for page, title, _ in header_pages]}, {"Project": project}]


def settings(docs, site, nav):
    """mkdocs.yml; JSON is YAML. Everything stands in the folder: no fonts, scripts or search from elsewhere."""
    return json.dumps({
        "site_name": "Diptych", "docs_dir": docs, "site_dir": site, "use_directory_urls": False, "plugins": [], "nav": nav,
        "theme": {"name": "material", "font": False, "palette": {"primary": "blue grey", "accent": "deep orange"}},
        "extra": {"generator": False},
        "extra_css": ["theme/katex/katex.min.css", "theme/manual.css"],
        "extra_javascript": ["theme/katex/katex.min.js", "theme/manual.js"],
        "markdown_extensions": ["tables", "sane_lists", "fenced_code", {"toc": {"permalink": False, "toc_depth": 3}}]})


def add_theme(docs):
    """Style, script and KaTeX, which sets formulas without any network."""
    shutil.copytree(os.path.join(HERE, "theme"), os.path.join(docs, "theme"))
    katex = os.path.join(docs, "theme", "katex")
    os.makedirs(os.path.join(katex, "fonts"))
    for name in ("katex.min.css", "katex.min.js"):
        shutil.copyfile(os.path.join(KATEX, name), os.path.join(katex, name))
    for name in os.listdir(os.path.join(KATEX, "fonts")):
        if name.endswith(".woff2"):
            shutil.copyfile(os.path.join(KATEX, "fonts", name), os.path.join(katex, "fonts", name))


def assemble(source, program, docs):
    """All pages as Markdown in docs; their navigation."""
    missing = equations.missing(source)
    if missing:
        raise Stale("\n".join(f"equation '{name}': {path} does not say '{words}' any more" for name, path, words in missing))
    keys, results, commands = reference.Keys(program), reference.Results(program), reference.Commands(program)
    tree = readmes.Tree(source, headers.pages_of(source), keys)
    from_reference = lambda path: (lambda page: posixpath.relpath(page, "reference") if page else None)(tree.page_of(path))
    key_pages, result_pages, header_pages = list(keys.pages()), list(results.pages()), list(headers.pages(source, tree.page_of))
    for path, _, text in key_pages + result_pages + header_pages:
        write(os.path.join(docs, path), text)
    write(os.path.join(docs, "reference", "commands.md"), commands.page())
    write(os.path.join(docs, "reference", "equations.md"), equations.page(from_reference))
    tree.write(docs)
    own_pages(docs, Directives(source, commands, tree), keys, commands)
    stated = [(name, "equation", "reference/equations.html#" + equations.anchor(name), path)
              for _, listed in equations.SECTIONS for name, _, path, _ in listed]
    in_headers = [(path, "header", link, headers.comments(text_of(os.path.join(source, path)))[0]) for path, link in tree.headers.items()
                  if path.endswith(".h")]
    write(os.path.join(docs, "find.md"), find_page([*commands.index(), *keys.index(), *stated, *results.index(), *in_headers]))
    add_theme(docs)
    return navigation(key_pages, result_pages, header_pages, tree)


def build(source, program, output):
    """The site at `output`. Stale where something is not so any more."""
    with tempfile.TemporaryDirectory() as work:
        docs, site = os.path.join(work, "docs"), output + ".part"
        shutil.rmtree(site, ignore_errors=True)
        write(os.path.join(work, "mkdocs.yml"), settings(docs, site, assemble(source, program, docs)))
        done = subprocess.run(["mkdocs", "build", "-q", "-f", os.path.join(work, "mkdocs.yml")], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError("mkdocs: " + done.stderr)
    for name in UNUSED:
        path = os.path.join(site, name)
        shutil.rmtree(path) if os.path.isdir(path) else os.path.exists(path) and os.remove(path)
    for root, _, names in os.walk(site):
        for name in names:
            if name.endswith(".map"):
                os.remove(os.path.join(root, name))
    broken, external = links.check(site)
    if broken:
        raise Stale("\n".join(f"{page}: {link} leads nowhere" for page, link in broken))
    write(os.path.join(site, "external_links.txt"), "\n".join(external) + "\n")
    shutil.rmtree(output, ignore_errors=True)
    os.rename(site, output)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    if not shutil.which("mkdocs") or not os.path.isdir(KATEX):
        sys.exit("manual: it is made by mkdocs and KaTeX: apt-get install mkdocs mkdocs-material libjs-katex")
    try:
        build(*(os.path.abspath(word) for word in sys.argv[1:]))
    except (Stale, ValueError) as error:
        print("manual: " + str(error), file=sys.stderr)
        sys.exit(1)
