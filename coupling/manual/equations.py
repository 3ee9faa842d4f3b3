# diptych: the page of equations, each held against the source that states it
# SPDX-License-Identifier: LGPL-2.1-or-later
import html
import os
import re

import equation_list
import equation_list_continuum

SECTIONS = [
    ("One step of the grains", equation_list.GRAINS), ("Length of a step, and what it costs", equation_list.STEP_LENGTH),
    ("Springs", equation_list.PENALTY), ("Stress of the grains", equation_list.MOMENTS),
    ("The continuum", equation_list_continuum.CONTINUUM), ("From grains to cells", equation_list.AVERAGING),
    ("Bands", equation_list.BANDS), ("Intervals and verdicts", equation_list_continuum.INTERVALS),
    ("Calibration, studies, plans", equation_list_continuum.SEARCHES)]


def words_of(text):
    """A source as its words: comment signs and line breaks taken out."""
    return " ".join(re.sub(r"^\s*(//+|#+)? ?", "", line) for line in text.split("\n")).split()


def stated(path):
    """What a source says, in one line; nothing where it is not there."""
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as file:
        return " ".join(words_of(file.read()))


def missing(source, sections=tuple(SECTIONS)):
    """(name, file, words) of every equation whose source does not state it, or is not there."""
    texts, lacking = {}, []
    for _, equations in sections:
        for name, _, path, words in equations:
            if path not in texts:
                texts[path] = stated(os.path.join(source, path))
            if " ".join(words.split()) not in texts[path]:
                lacking.append((name, path, words))
    return lacking


def anchor(name):
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")


def formula(latex):
    """For theme/manual.js, which sets it with KaTeX; without scripts the LaTeX is shown."""
    return f'<div class="formula" data-latex="{html.escape(latex, quote=True)}">{html.escape(latex)}</div>'


def page(link_of):
    """Markdown of the page; link_of(path): where the manual shows a source, or None."""
    count = sum(len(equations) for _, equations in SECTIONS)
    lines = ["# Equations", "", f"The {count} equations that results rest on, each with the file that carries it out and the words there. A manual whose "
             "words are not found in the file any more is not built.", ""]
    for title, equations in SECTIONS:
        lines += ["## " + title, ""]
        for name, latex, path, words in equations:
            link = link_of(path)
            shown = f'<a href="{link}"><code>{path}</code></a>' if link else f"<code>{path}</code>"
            lines += [f'<div class="equation" id="{anchor(name)}"><p class="name">{html.escape(name)}</p>{formula(latex)}'
                      f'<p class="stated">{shown}: <q>{html.escape(" ".join(words.split()))}</q></p></div>', ""]
    return "\n".join(lines)
