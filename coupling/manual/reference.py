# diptych: pages of keys, numbers of results and commands
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what `diptych explain --json` and `diptych COMMAND --help` print."""
import html
import re
import subprocess

from headers import with_code


def output_of(program, *words):
    """Standard output of the program. Raises RuntimeError if its exit code is not 0."""
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{program} {' '.join(words)}: {done.stderr}")
    return done.stdout


def grouped(entries, heading):
    """[(heading, entries)] of a list of `diptych explain --json`; the heading is an entry of each."""
    found = {}
    for one in entries:
        found.setdefault(one[heading], []).append(one)
    return list(found.items())


def anchor(*words):
    return re.sub(r"[^A-Za-z0-9_]+", "-", "-".join(words)).strip("-")


def entry(identity, head, facts, meaning):
    """HTML of one key or number: its name, its facts in small print, its meaning."""
    small = "".join(f'<span class="fact">{html.escape(fact)}</span>' for fact in facts if fact)
    return (f'<div class="entry" id="{identity}"><p class="head"><a '
            f'href="#{identity}"><code>{html.escape(head)}</code></a>{small}</p>'
            f'<p class="meaning">{with_code(meaning)}</p></div>')


def unit_of(one):
    return "" if one["unit"] == "-" else f"[{one['unit']}]"


class Keys:
    """The keys of a scene, one page per section. names: meaning of every key by "section/key"."""

    def __init__(self, schema):
        self.sections = grouped(schema["keys"], "section")
        self.names = {f"{one['section']}/{one['key']}": one["meaning"] for one in schema["keys"]}

    def link(self, name):
        section, key = name.split("/", 1)
        return f"reference/keys_{section}.html#{anchor(section, key)}"

    def pages(self):
        for section, entries in self.sections:
            heads = [f"{one['key']} = {one['default'] or '(empty)'}" for one in entries]
            lines = [f"# Section `{section}`", "", f"{len(entries)} keys; `diptych explain {section}` prints the same "
                     "list. In a scene:", "", f"    subsection {section}", f"      set {heads[0]}", "    end", "",
                     f"or on the command line `--set {section}/KEY=VALUE`.", ""]
            for one, head in zip(entries, heads):
                lines += [entry(anchor(section, one["key"]), head, (unit_of(one), one["allowed"]), one["meaning"]), ""]
            yield f"reference/keys_{section}.md", f"Section {section}", "\n".join(lines)

    def index(self):
        return [(name, "key", self.link(name), meaning) for name, meaning in self.names.items()]


class Results:
    """The columns, numbers and datasets of result files, one page per family of files: the first word of the
    heading."""

    def __init__(self, schema):
        self.families = {}
        for heading, entries in grouped(schema["results"], "file"):
            self.families.setdefault(re.match(r"[a-z]+", heading)[0], []).extend(entries)

    def pages(self):
        for family, found in self.families.items():
            lines = [f"# Results: {family}", "", "`diptych explain results` prints the same list. Stress and strain "
                     "are positive in compression.", ""]
            for heading, entries in grouped(found, "file"):
                lines += ["## " + heading, ""]
                for one in entries:
                    facts = (unit_of(one), one["shape"])
                    lines += [entry(anchor(heading, one["entry"]), one["entry"], facts, one["meaning"]), ""]
            yield f"reference/results_{family}.md", f"Results: {family}", "\n".join(lines)

    def index(self):
        for family, found in self.families.items():
            for one in found:
                page = f"reference/results_{family}.html#{anchor(one['file'], one['entry'])}"
                yield one["entry"], f"{one['file']}, {one['shape']}", page, one["meaning"]


def options(text):
    """[(head, meaning)] of the arguments and options that CLI11 prints. The meaning of a long head is on the next
    line."""
    found = []
    for block in re.findall(r"^(?:Positionals|Options):\n(.*?)(?=^\S|\Z)", text, re.DOTALL | re.MULTILINE):
        for line in block.split("\n"):
            head = re.match(r"  (\S.*?)(?: {2,}(\S.*))?$", line)
            if head:
                found.append([head[1].replace("-h,", "-h, "), head[2] or ""])
            elif found and line.strip():
                found[-1][1] = (found[-1][1] + " " + line.strip()).strip()
    return found


class Commands:
    """The commands with their options."""

    def __init__(self, program):
        self.overview = output_of(program, "--help")
        self.names = re.findall(r"^  ([a-z][a-z-]*) ", self.overview, re.MULTILINE)
        self.helps = {name: output_of(program, name, "--help") for name in self.names}

    def page(self):
        lines = ["# Commands", "", "`diptych --help` and `diptych COMMAND --help` print the same.", ""]
        for name in self.names:
            first, rest = self.helps[name].split("\n", 1)
            lines += [f"## diptych {name}", "", html.escape(first[:1].upper() + first[1:]) + ".", "",
                      "    " + re.search(r"^Usage: (.*)$", rest, re.MULTILINE)[1], ""]
            for head, meaning in options(rest):
                lines += [entry(anchor(name, head.split()[-1] if head.startswith("-h") else head.split()[0]), head, (),
                                meaning), ""]
        codes = self.overview[self.overview.index("Exit codes: "):].split(": ", 1)[1]
        lines += ["## Exit codes", "", html.escape(" ".join(codes.split())) + "."]
        return "\n".join(lines)

    def index(self):
        for name in self.names:
            first, _ = self.helps[name].split("\n", 1)
            yield "diptych " + name, "command", "reference/commands.html#diptych-" + name, first

