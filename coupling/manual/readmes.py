# diptych: the READMEs of the source tree as pages
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages keep the folders of the tree below source/, so that links between READMEs and to their figures hold as they are."""
import os
import posixpath
import re
import shutil

SKIPPED = {"build", "results", ".git", "__pycache__"}
LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")


def find(source):
    """Paths of all .md files of a tree from its top, the manual's own pages left out, sorted."""
    found = []
    for root, folders, names in os.walk(source):
        folders[:] = sorted(name for name in folders if name not in SKIPPED and not name.startswith("."))
        path = os.path.relpath(root, source)
        if path.startswith(os.path.join("coupling", "manual", "")):
            continue
        found += [posixpath.normpath(posixpath.join(path, name)) for name in sorted(names) if name.endswith(".md")]
    return found


def title(text, path):
    """First heading, or the folder."""
    match = re.search(r"^# (.+)$", text, re.MULTILINE)
    return match[1].replace("`", "") if match else posixpath.dirname(path)


def spaced(text):
    """What GitHub's Markdown takes and Python's does not: lists and tables that begin right below a paragraph, and words in
    angle brackets."""
    lines, out, fenced = text.split("\n"), [], False
    item, row = re.compile(r"(?:[-*+]|\d+\.) "), re.compile(r"\|")
    for line in lines:
        if line.startswith("```"):
            fenced = not fenced
            if fenced and out and out[-1].strip():
                out.append("")
        before = out[-1] if out else ""
        if not fenced and before.strip() and not before.startswith(("```", "    ")):
            begins_list = item.match(line) and not item.match(before) and not (before.startswith(" ") and in_list(out, item))
            begins_list = begins_list and not in_list(out, item)
            begins_table = row.match(line) and not row.match(before)
            ends_table = row.match(before) and not row.match(line) and line.strip()
            if begins_list or begins_table or ends_table:
                out.append("")
        out.append(line)
    return "\n".join(out)


def in_list(lines, item):
    """Whether the last paragraph is an item of a list."""
    for line in reversed(lines):
        if not line.strip():
            return False
        if item.match(line):
            return True
    return False


class Tree:
    """The READMEs of a source tree, and where a path of the tree is shown in the manual."""

    def __init__(self, source, headers, keys):
        self.source, self.headers, self.keys = source, headers, keys
        self.paths = find(source)
        self.texts = {}
        for path in self.paths:
            with open(os.path.join(source, path), encoding="utf-8") as file:
                self.texts[path] = file.read()

    def page_of(self, path):
        """Page (.html, from the top of the site) that shows a file or folder of the tree; None where none does."""
        path = posixpath.normpath(path)
        for candidate in (path, posixpath.join(path, "README.md")):
            if candidate in self.texts:
                folder, name = posixpath.split("source/" + candidate)
                return posixpath.join(folder, "index.html" if name == "README.md" else name[:-3] + ".html")
        return self.headers.get(path)

    def meant(self, word, folder):
        """Page that a word in code means as seen from a folder: a path of the tree, of a unit, or a key."""
        if word in self.keys.names:
            return self.keys.link(word)
        if not re.fullmatch(r"[\w./*-]+", word) or not re.search(r"[/.]", word):
            return None
        stem = re.sub(r"\.\*$|/\*$", "", word.rstrip("/"))
        for base in (folder, ""):
            path = posixpath.normpath(posixpath.join(base, stem))
            for candidate in (path, path + ".h" if word.endswith(".*") else path, re.sub(r"\.cc$", ".h", path)):
                page = None if candidate in (".", folder) or candidate.startswith("..") else self.page_of(candidate)
                if page:
                    return page
        return None

    def with_links(self, text, path, to_page):
        """Words in code that the manual has a page for become links. path: page (.html) that shows the text, to_page: None or
        the folder of the tree that words are relative to."""
        def linked(match):
            page = self.meant(match[1], to_page)
            if not page or page.partition("#")[0] == path:
                return match[0]
            return f'[{match[0]}]({posixpath.relpath(page.partition("#")[0], posixpath.dirname(path) or ".")}' + \
                   ("#" + page.partition("#")[2] if "#" in page else "") + ")"
        out, fenced = [], False
        for line in text.split("\n"):
            fenced ^= line.startswith("```")
            is_code = fenced or line.startswith("    ")
            spans = [line] if is_code or line.startswith("#") else re.split(r"(!?\[[^\]]*\]\([^)]*\))", line)
            out.append(spans[0] if len(spans) == 1 and (is_code or line.startswith("#"))
                       else "".join(s if k % 2 else CODE.sub(linked, s) for k, s in enumerate(spans)))
        return "\n".join(out)

    def write(self, docs):
        """Pages and the files that they show below docs/source. ValueError naming README and link where one leads nowhere."""
        for path in self.paths:
            folder = posixpath.dirname(path)
            for _, link in LINK.findall(self.texts[path]):
                target = posixpath.normpath(posixpath.join(folder, link.partition("#")[0]))
                full = os.path.join(self.source, target)
                if "://" in link or link.startswith("#") or target in self.texts:
                    continue
                if not os.path.isfile(full):
                    raise ValueError(f"{path}: the link to {link} leads to no file")
                os.makedirs(os.path.dirname(os.path.join(docs, "source", target)), exist_ok=True)
                shutil.copyfile(full, os.path.join(docs, "source", target))
            out = os.path.join(docs, "source", path)
            os.makedirs(os.path.dirname(out), exist_ok=True)
            with open(out, "w", encoding="utf-8") as file:
                file.write(self.with_links(spaced(self.texts[path]), self.page_of(path), folder))
