# diptych: what headers and Python modules say of themselves, as pages
# SPDX-License-Identifier: LGPL-2.1-or-later
import ast
import html
import os
import posixpath
import re

PANELS = ("discrete", "continuum", "coupling")


def find(source):
    """{room: [paths]} of the headers of a tree, a room being a folder below a panel, or the panel for those beside its README."""
    rooms = {}
    for panel in PANELS:
        for root, folders, names in os.walk(os.path.join(source, panel)):
            folders.sort()
            room = posixpath.normpath(os.path.relpath(root, source))
            rooms.setdefault(room, []).extend(posixpath.join(room, name) for name in sorted(names) if name.endswith(".h"))
    return {room: paths for room, paths in rooms.items() if paths}


def anchor(path):
    """Of a header on its room's page, as the Markdown package makes it of the heading."""
    return re.sub(r"[^\w-]", "", posixpath.basename(path).lower())


def page_name(room):
    return "reference/headers_" + room.replace("/", "_")


def pages_of(source):
    """{path of a header: page#anchor}, and of a room: page."""
    rooms = find(source)
    return {**{room: page_name(room) + ".html" for room in rooms},
            **{path: page_name(room) + ".html#" + anchor(path) for room, paths in rooms.items() for path in paths}}


def declaration(lines, k):
    """What a comment that ends before line k stands above: up to its semicolon or brace, at most twelve lines."""
    found = []
    for line in lines[k:k + 12]:
        if not line.strip():
            break
        found.append(line)
        if re.search(r"[;{]\s*(//.*)?$", line):
            break
    text = "\n".join(found)
    return re.sub(r"\s*\{\s*$", "", re.sub(r"\n\s*\{\s*$", "", text)).rstrip(";")


def undented(text):
    lines = text.split("\n")
    depth = min((len(line) - len(line.lstrip()) for line in lines if line.strip()), default=0)
    return "\n".join(line[depth:] for line in lines)


def comments(text):
    """(title, [(comment, declaration)]) of a header: comments in the namespace's own depth and those of members of structs and
    classes, each with what it stands above."""
    lines, found, k = text.split("\n"), [], 0
    title = re.sub(r"^// diptych: ", "", lines[0])
    while k < len(lines):
        if k < 2 or not re.match(r" {2,4}//( |$)", lines[k]):
            k += 1
            continue
        first = k
        while k < len(lines) and re.match(r" {2,4}//", lines[k]):
            k += 1
        said = "\n".join(re.sub(r"^ *// ?", "", line) for line in lines[first:k])
        if k < len(lines) and lines[k].strip() and not lines[k].strip().startswith(("}", "#")) and "clang-format" not in said:
            found.append((said, undented(declaration(lines, k))))
    return title, found


def with_code(text):
    """Escaped for HTML, words between backquotes as code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", html.escape(text))


def flowing(text):
    """HTML of a comment: lines flow, those set in (formulas, lists) stay lines."""
    parts = []
    for line in text.split("\n"):
        is_set_in = line.startswith("  ")
        if not line.strip():
            parts.append((None, ""))
        elif parts and parts[-1][0] is False and not is_set_in:
            parts[-1] = (False, parts[-1][1] + " " + line.strip())
        else:
            parts.append((is_set_in, line.strip()))
    return "".join(f'<p{" class=set-in" if is_set_in else ""}>{with_code(line)}</p>' for is_set_in, line in parts if line)


def room_page(source, room, paths, link_of):
    """Markdown of the headers of a room."""
    up = link_of(room)
    up = None if up is None or up.startswith("reference/") else up
    lines = [f"# Headers of `{room}/`", "", "What their comments say: shapes, units, signs, errors, sources."
             + (f" The room: [{room}/]({posixpath.relpath(up, 'reference')})." if up else ""), ""]
    for path in paths:
        with open(os.path.join(source, path), encoding="utf-8") as file:
            title, found = comments(file.read())
        lines += [f"## `{posixpath.basename(path)}`", "", html.escape(title[:1].upper() + title[1:]) + ".", ""]
        for said, code in found:
            lines += ['<div class="declared">' + flowing(said) + "<pre><code>" + html.escape(code).replace("\n", "&#10;")
                      + "</code></pre></div>", ""]
    return "\n".join(lines)


def pages(source, link_of):
    """(path of the page, title, Markdown)"""
    for room, paths in find(source).items():
        yield page_name(room) + ".md", room + "/", room_page(source, room, paths, link_of)


def docstrings(path):
    """Markdown of what a Python module says of itself, its classes and its functions; names that begin with _ left out."""
    with open(path, encoding="utf-8") as file:
        tree = ast.parse(file.read())
    lines = [ast.get_docstring(tree) or "", ""]

    def add(node, level, prefix=""):
        text = ast.get_docstring(node)
        if node.name.startswith("_") or not text:
            return
        head = prefix + node.name + ("(" + ast.unparse(node.args) + ")" if isinstance(node, ast.FunctionDef) else "")
        lines.extend(["#" * level + f" `{head}`", "", "    " + text.replace("\n", "\n    "), ""])
        for child in node.body if isinstance(node, ast.ClassDef) else ():
            if isinstance(child, (ast.FunctionDef, ast.ClassDef)):
                add(child, level + 1, node.name + ".")

    for node in tree.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            add(node, 3)
    return "\n".join(lines)
