#!/usr/bin/env python3
# diptych: build the manual as HTML pages
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: build.py SOURCE PROGRAM OUTPUT

Writes all pages as Markdown into a temporary folder and runs mkdocs on it. The site replaces the folder OUTPUT. The
pages come from pages/*.md, from the READMEs, from the comments of the headers and from what PROGRAM prints. Exit code
1: a file or a link that a page names does not exist."""
import glob
import importlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

import headers
import module_docs
import readmes
import reference
from readmes import text_of, write

HERE = os.path.dirname(os.path.abspath(__file__))
UNUSED = ("404.html", "sitemap.xml", "sitemap.xml.gz", "assets/javascripts/lunr", "assets/javascripts/workers")
PAGES = [("index", "Start"), ("install", "Install"), ("cluster", "Clusters, no root"),
         ("first_comparison", "First comparison"), ("gallery", "Gallery"),
         ("own_scene", "Your own scene"), ("own_data", "Your own data"),
         ("dic_data", "My DIC data in ten minutes"), ("result_folders", "Result folders"),
         ("ensembles", "Ensembles"), ("studies", "Studies and plans"),
         ("calibration", "Calibration"), ("python", "Python"),
         ("conventions", "Conventions"), ("platens", "Platens and sides"),
         ("equations", "Equations"), ("limits", "Limits"), ("faq", "Questions"), ("glossary", "Glossary")]


class Directives:
    """Fills in the lines `<!-- WORD: ARGUMENT -->` of the pages in pages/."""

    def __init__(self, source, program, docs, tree):
        self.source, self.program, self.docs, self.tree = source, program, docs, tree

    def filled(self, text):
        return re.sub(r"^<!-- (\w+): (.+?) -->$", lambda match: getattr(self, "do_" + match[1])(match[2]), text,
                      flags=re.MULTILINE)

    def path(self, name):
        path = os.path.join(self.source, name)
        if not os.path.exists(path):
            raise ValueError(f"coupling/manual/pages name {name}, which does not exist")
        return path

    def do_file(self, name):
        """A file of the source tree as a code block."""
        return "```\n" + text_of(self.path(name)).rstrip() + "\n```"

    def do_packages(self, name):
        """The Debian packages that a shell script of the source tree installs."""
        block = re.search(r"packages=\((.*?)\)", text_of(self.path(name)), re.DOTALL)
        command = "apt-get install " + " ".join(block[1].split())
        return "```\n" + " \\\n".join(textwrap.wrap(command, 80, subsequent_indent="    ",
                                                    break_on_hyphens=False)) + "\n```"

    def do_versions(self, names):
        """The least versions that the find_package lines of CMake files demand."""
        text = "".join(text_of(self.path(name)) for name in names.split())
        found = re.findall(r"(cmake)_minimum_required\(VERSION ([\d.]+)|find_package\((\S+) (\d[\d.]*)", text)
        return ", ".join(f"{one or other} {first or second}" for one, first, other, second in found) + "."

    def do_equations(self, name):
        """The comments of a source file that hold a formula, below a link to the page of the file."""
        page = self.tree.page_of(name)
        found = [f'<div class="equation">{headers.flowing(comment)}</div>'
                 for comment in headers.formulas(text_of(self.path(name)))]
        return "\n\n".join([f"[`{name}`]({page})" if page else f"`{name}`", *found])

    def do_figure(self, argument):
        """A figure of the source tree with its caption: FILE, CAPTION."""
        name, caption = argument.split(", ", 1)
        readmes.copy(self.path(name), os.path.join(self.docs, "source", name))
        return f"![{caption}](source/{name})\n\n*{caption}*"

    def do_docstrings(self, package):
        """Signatures and docstrings of the Python package beside the program; empty if the package was not built."""
        built = os.path.join(os.path.dirname(self.program), "python")
        if not glob.glob(os.path.join(built, package, "*.so")):
            return ""
        sys.path.insert(0, built)
        return module_docs.page(importlib.import_module(package))


def find_page(entries):
    """The page that searches keys, numbers, commands and headers."""
    rows = [[name, kind, link, meaning[:160]] for name, kind, link, meaning in entries]
    data = json.dumps(rows, ensure_ascii=False).replace("</", "<\\/")
    return ("# Find\n\nSearches keys, columns, datasets, commands and headers. All words must occur.\n\n"
            '<input id="words" type="search" placeholder="internal length" aria-label="words to find">\n'
            '<p id="found-count"></p>\n<div id="found"></div>\n'
            f'<script id="find-data" type="application/json">{data}</script>\n')


def navigation(keys, results, rooms, tree):
    def under(*folders):
        paths = [path for folder in folders for path in tree.paths if path.startswith(folder)]
        return [{readmes.title(tree.texts[path], path): "source/" + path} for path in paths]

    def listed(pages):
        return [{title: page} for page, title, _ in pages]

    project = [{readmes.title(tree.texts[path], path): "source/" + path} for path in tree.paths if "/" not in path]
    return [*({title: name + ".md"} for name, title in PAGES), {"Find": "find.md"},
            {"Commands": "reference/commands.md"},
            {"Keys of a scene": listed(keys)}, {"Results": listed(results)}, {"Benchmarks": under("benchmarks/")},
            {"Modules": under("discrete/", "continuum/", "coupling/", "meshes/")}, {"Headers": listed(rooms)},
            {"Project": project}]


def settings(docs, site, nav):
    """Text of mkdocs.yml (JSON is YAML). The pages load nothing from the network."""
    return json.dumps({
        "site_name": "Diptych", "docs_dir": docs, "site_dir": site, "use_directory_urls": False, "plugins": [],
        "nav": nav,
        "theme": {"name": "material", "font": False, "palette": {"primary": "blue grey", "accent": "deep orange"}},
        "extra": {"generator": False}, "extra_css": ["theme/manual.css"], "extra_javascript": ["theme/manual.js"],
        "markdown_extensions": ["tables", "sane_lists", "fenced_code", {"toc": {"permalink": False, "toc_depth": 3}}]})


def assemble(source, program, docs):
    """Writes all pages as Markdown into docs; returns their navigation."""
    schema = json.loads(reference.output_of(program, "explain", "--json"))
    keys, results, commands = reference.Keys(schema), reference.Results(schema), reference.Commands(program)
    tree = readmes.Tree(source, headers.links(source), keys)
    key_pages, result_pages = list(keys.pages()), list(results.pages())
    rooms = list(headers.pages(source, tree.page_of))
    for path, _, text in key_pages + result_pages + rooms:
        write(os.path.join(docs, path), text)
    write(os.path.join(docs, "reference", "commands.md"), commands.page())
    tree.write(docs)
    directives = Directives(source, program, docs, tree)
    for name, _ in PAGES:
        text = readmes.spaced(directives.filled(text_of(os.path.join(HERE, "pages", name + ".md"))))
        write(os.path.join(docs, name + ".md"), tree.with_links(text, name + ".html", ""))
    titles = [(path, "header", link, headers.title(text_of(os.path.join(source, path))))
              for path, link in tree.headers.items() if path.endswith(".h")]
    write(os.path.join(docs, "find.md"), find_page([*commands.index(), *keys.index(), *results.index(), *titles]))
    shutil.copytree(os.path.join(HERE, "theme"), os.path.join(docs, "theme"))
    return navigation(key_pages, result_pages, rooms, tree)


def remove(path):
    if os.path.isdir(path):
        shutil.rmtree(path)
    elif os.path.exists(path):
        os.remove(path)


def build(source, program, output):
    with tempfile.TemporaryDirectory() as work:
        docs, site, config = os.path.join(work, "docs"), output + ".part", os.path.join(work, "mkdocs.yml")
        remove(site)
        write(config, settings(docs, site, assemble(source, program, docs)))
        done = subprocess.run(["mkdocs", "build", "-q", "-f", config], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError("mkdocs: " + done.stderr)
    for path in [*(os.path.join(site, name) for name in UNUSED), *glob.glob(site + "/**/*.map", recursive=True)]:
        remove(path)
    remove(output)
    os.rename(site, output)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    if not shutil.which("mkdocs"):
        sys.exit("manual: mkdocs is missing: apt-get install mkdocs mkdocs-material")
    try:
        build(*(os.path.abspath(word) for word in sys.argv[1:]))
    except ValueError as error:
        sys.exit(f"manual: {error}")
