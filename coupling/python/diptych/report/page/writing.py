# diptych: writes a page from its template
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
import re

import jinja2

from ... import _diptych
from ...files import part_of

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "templates")


def with_contents(text):
    """The page with a list of links to its headings."""
    links = []

    def numbered(found):
        links.append(f'<a href="#part-{len(links)}">{found[2]}</a>')
        return f'<h2{found[1]} id="part-{len(links) - 1}">{found[2]}</h2>'

    text = re.sub("<h2([^>]*)>(.*?)</h2>", numbered, text)
    return text.replace("</header>", f'<nav aria-label="Contents">{" ".join(links)}</nav>\n</header>', 1)


def write(folder, template, **values):
    """Fills in a template of templates/ and writes it to report.html of the folder."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    environment.globals |= {name: getattr(_diptych, name) for name in ("origin_of_law", "count_of_checks")}
    text = with_contents(environment.get_template(template).render(values))
    with part_of(os.path.join(folder, "report.html")) as part, open(part, "w", encoding="utf-8") as stream:
        stream.write(text)
