# diptych: whether all links of a folder of pages lead somewhere
# SPDX-License-Identifier: LGPL-2.1-or-later
import html.parser
import os
import urllib.parse


class Page(html.parser.HTMLParser):
    """What a page refers to and the anchors that it has."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        for name, value in attrs:
            if name in ("href", "src") and value is not None:
                self.links.append(value)
            elif name == "id" or (name == "name" and tag == "a"):
                self.anchors.add(value)


def is_external(link):
    return bool(urllib.parse.urlsplit(link).scheme) or link.startswith("//")


def check(folder):
    """(broken, external): broken as (page, link) where file or anchor is missing or lies outside the folder; external ones
    are not asked for. Folder: of the site."""
    pages = {}
    for root, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html"):
                path = os.path.join(root, name)
                with open(path, encoding="utf-8") as file:
                    pages[os.path.realpath(path)] = Page(file.read())
    top, broken, external = os.path.realpath(folder), [], set()
    for path, page in pages.items():
        for link in page.links:
            if is_external(link):
                external.add(link)
                continue
            target, _, fragment = link.partition("#")
            target = urllib.parse.unquote(target.partition("?")[0])
            full = os.path.realpath(os.path.join(os.path.dirname(path), target)) if target else path
            found = os.path.isfile(full) and full.startswith(top + os.sep)
            if not found or (fragment and urllib.parse.unquote(fragment) not in (pages[full].anchors if full in pages else ())):
                broken.append((os.path.relpath(path, top), link))
    return broken, sorted(external)
