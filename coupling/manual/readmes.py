# diptych: pages from the READMEs of the source tree
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages keep the folders of the tree below source/. So links between READMEs and to their figures stay valid."""
import os
import posixpath
import re
import shutil

SKIPPED = {"build", "results", ".git", "__pycache__"}
LINK = re.compile(r"(!?\[[^\]]*\])\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")
ITEM = re.compile(r"(?:[-*+]|\d+\.) ")


def text_of(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def copy(path, target):
    os.makedirs(os.path.dirname(target), exist_ok=True)
    shutil.copyfile(path, target)


def find(source):
    """Sorted paths of all .md files of the tree, without the manual's own pages."""
    found = []
    for root, folders, names in os.walk(source):
        folders[:] = sorted(name for name in folders if name not in SKIPPED and not name.startswith("."))
        path = os.path.relpath(root, source)
        if not path.startswith(os.path.join("coupling", "manual", "")):
            found += [posixpath.normpath(posixpath.join(path, name)) for name in sorted(names) if name.endswith(".md")]
    return found


def title(text, path):
    """The first heading, or else the folder."""
    match = re.search(r"^# (.+)$", text, re.MULTILINE)
    return match[1].replace("`", "") if match else posixpath.dirname(path)


def spaced(text):
    """The text with a blank line before and after each list, table and code block. GitHub's Markdown does not need it,
    Python's does."""
    out, fenced, in_list = [], False, False
    for line in text.split("\n"):
        before = out[-1] if out else ""
        is_fence = line.startswith("```")
        is_text = not fenced and before.strip() and not before.startswith(("```", "    "))
        if is_text and (is_fence or line.startswith("|") != before.startswith("|")
                        or (ITEM.match(line) and not in_list)) and line.strip():
            out.append("")
        fenced ^= is_fence
        in_list = not fenced and bool(line.strip()) and (in_list or bool(ITEM.match(line)))
        out.append(line)
    return "\n".join(out)


class Tree:
    """The READMEs of a source tree, and the pages that show its files and folders."""

    def __init__(self, source, headers, keys):
        self.source, self.headers, self.keys = source, headers, keys
        self.paths = find(source)
        self.texts = {path: text_of(os.path.join(source, path)) for path in self.paths}

    def page_of(self, path):
        """The page (.html, from the top of the site) that shows a file or folder of the tree, or None."""
        path = posixpath.normpath(path)
        for candidate in (path, posixpath.join(path, "README.md")):
            if candidate in self.texts:
                folder, name = posixpath.split("source/" + candidate)
                return posixpath.join(folder, "index.html" if name == "README.md" else name[:-3] + ".html")
        return self.headers.get(path)

    def meant(self, word, folder):
        """The page for a word in code within a text of `folder`: a key, or a path of the tree with or without its
        ending; or None."""
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

    def with_links(self, text, path, folder):
        """The text, shown on the page `path`, with links at the words in code that have a page of their own."""
        def linked(match):
            page, _, place = (self.meant(match[1], folder) or "").partition("#")
            if page in ("", path):
                return match[0]
            link = posixpath.relpath(page, posixpath.dirname(path) or ".")
            return f'[{match[0]}]({link}{"#" + place if place else ""})'

        out, fenced = [], False
        for line in text.split("\n"):
            fenced ^= line.startswith("```")
            if not (fenced or line.startswith(("    ", "#"))):  # neither code nor a heading
                parts = re.split(r"(!?\[[^\]]*\]\([^)]*\))", line)  # existing links stay
                line = "".join(part if k % 2 else CODE.sub(linked, part) for k, part in enumerate(parts))
            out.append(line)
        return "\n".join(out)

    def write(self, docs):
        """Writes the pages and the files that they link to below docs/source. Raises ValueError if a linked file does
        not exist."""
        for path in self.paths:
            folder = posixpath.dirname(path)
            write(os.path.join(docs, "source", path),
                  self.with_links(spaced(self.texts[path]), self.page_of(path), folder))
            for _, link in LINK.findall(self.texts[path]):
                target = posixpath.normpath(posixpath.join(folder, link.partition("#")[0]))
                if "://" in link or link.startswith("#") or target in self.texts:
                    continue
                if not os.path.isfile(os.path.join(self.source, target)):
                    raise ValueError(f"{path}: the link to {link} leads to no file")
                copy(os.path.join(self.source, target), os.path.join(docs, "source", target))
