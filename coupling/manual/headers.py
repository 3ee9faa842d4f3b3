# diptych: pages from the comments of the headers
# SPDX-License-Identifier: LGPL-2.1-or-later
import html
import os
import posixpath
import re

from readmes import text_of


def find(source):
    """{folder: [paths of its headers]} of the three panels' folders."""
    found = {}
    for panel in ("discrete", "continuum", "coupling"):
        for root, folders, names in os.walk(os.path.join(source, panel)):
            folders.sort()
            folder = posixpath.normpath(os.path.relpath(root, source))
            paths = [posixpath.join(folder, name) for name in sorted(names) if name.endswith(".h")]
            if paths:
                found[folder] = paths
    return found


def page_name(folder):
    return "reference/headers_" + folder.replace("/", "_")


def links(source):
    """{folder: its page} and {path of a header: page#anchor}; the Markdown package makes the anchors from the
    headings."""
    found = {}
    for folder, paths in find(source).items():
        found[folder] = page_name(folder) + ".html"
        for path in paths:
            found[path] = page_name(folder) + ".html#" + re.sub(r"[^\w-]", "", posixpath.basename(path).lower())
    return found


def title(text):
    """The subject of a file from its first line, "// diptych: SUBJECT"."""
    return re.sub(r"^// diptych: ", "", text.split("\n", 1)[0])


def declaration(lines):
    """The declaration at the start of lines, up to its semicolon or brace, at most twelve lines."""
    found = []
    for line in lines[:12]:
        if not line.strip():
            break
        found.append(line)
        if re.search(r"[;{]\s*(//.*)?$", line):
            break
    depth = min(len(line) - len(line.lstrip()) for line in found)
    text = "\n".join(line[depth:] for line in found)
    return re.sub(r"\s*\{\s*$", "", text).rstrip(";")


def comments(text):
    """[(comment, declaration below it)] of the functions, types and members of a header."""
    found = []
    for match in re.finditer(r"(?:^ {2,4}//(?: .*)?\n)+(?=( *)(\S))", text, re.MULTILINE):
        comment = re.sub(r"^ *// ?", "", match[0].rstrip("\n"), flags=re.MULTILINE)
        if match[2] not in "}#/" and "clang-format" not in comment:
            found.append((comment, declaration(text[match.end():].split("\n"))))
    return found


def formulas(text):
    """The comments of a source, verbatim, that hold a formula ("=", "<=" or ">=" between spaces), or all if none
    does."""
    blocks = re.findall(r"(?:^ *//.*\n)+", text.split("\n\n", 1)[-1], re.MULTILINE)
    plain = [re.sub(r"^ *// ?", "", block.rstrip("\n"), flags=re.MULTILINE) for block in blocks]
    return [block for block in plain if re.search(r" [<>]?= ", block)] or plain


def with_code(text):
    """HTML of a text; words between backquotes become code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))


def flowing(text):
    """HTML of a comment: indented lines (formulas, lists) keep their line breaks, the others flow."""
    parts = []
    for line in text.split("\n"):
        is_set_in = line.startswith("  ")
        if not line.strip():
            parts.append((None, ""))
        elif parts and parts[-1][0] is False and not is_set_in:
            parts[-1] = (False, parts[-1][1] + " " + line.strip())
        else:
            parts.append((is_set_in, line.strip()))
    return "".join(f'<p{" class=set-in" if is_set_in else ""}>{with_code(line)}</p>' for is_set_in, line in parts
                   if line)


def page(source, folder, paths, link_of):
    """Markdown with the comments of a folder's headers."""
    readme = link_of(folder)
    lines = [f"# Headers of `{folder}/`", ""]
    if readme and not readme.startswith("reference/"):
        lines += [f"About this folder: [{folder}/]({posixpath.relpath(readme, 'reference')}).", ""]
    for path in paths:
        text = text_of(os.path.join(source, path))
        subject = title(text)
        lines += [f"## `{posixpath.basename(path)}`", "", html.escape(subject[:1].upper() + subject[1:]) + ".", ""]
        for comment, code in comments(text):
            shown = html.escape(code).replace("\n", "&#10;")
            lines += [f'<div class="declared">{flowing(comment)}<pre><code>{shown}</code></pre></div>', ""]
    return "\n".join(lines)


def pages(source, link_of):
    """(path of the page, title, Markdown) of every folder."""
    for folder, paths in find(source).items():
        yield page_name(folder) + ".md", folder + "/", page(source, folder, paths, link_of)
