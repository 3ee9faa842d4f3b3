# diptych: writes a page from its template
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

import jinja2

from ...files import part_of

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "templates")


def write(folder, template, **values):
    """Fills in a template of templates/ and writes it to report.html of the folder."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    text = environment.get_template(template).render(values)
    with part_of(os.path.join(folder, "report.html")) as part, open(part, "w", encoding="utf-8") as stream:
        stream.write(text)
