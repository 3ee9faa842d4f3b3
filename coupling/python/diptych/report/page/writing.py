# diptych: templates of the pages, and writing of a page
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

import jinja2

from ...files import part_of

TEMPLATES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "templates")


def template(name):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(TEMPLATES), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True)
    return environment.get_template(name)


def write(folder, text):
    with part_of(os.path.join(folder, "report.html")) as part, open(part, "w", encoding="utf-8") as stream:
        stream.write(text)
