# diptych: pages of keys, numbers of results and commands
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads what `diptych explain` and `diptych COMMAND --help` print."""
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


def groups(text):
    """[(heading, [(name, unit, facts, meaning)])] of the output of `explain`. Headings are not indented, entries such
    as "step = auto  [time]  auto or a number" by two, meanings by six."""
    found = []
    for line in filter(str.strip, text.split("\n")):
        depth = len(line) - len(line.lstrip())
        if depth == 0:
            found.append((line.strip(), []))
        elif depth == 2:
            match = re.fullmatch(r"(.*?)  \[(.*?)\](?:  (.*))?", line.strip())
            if not match:
                raise RuntimeError("the manual cannot parse this line of `diptych explain`: " + line)
            found[-1][1].append([match[1], "" if match[2] == "-" else f"[{match[2]}]", match[3] or "", ""])
        else:
            found[-1][1][-1][3] = (found[-1][1][-1][3] + " " + line.strip()).strip()
    return found


def anchor(*words):
    return re.sub(r"[^A-Za-z0-9_]+", "-", "-".join(words)).strip("-")


def entry(identity, head, facts, meaning):
    """HTML of one key or number: its name, its facts in small print, its meaning."""
    small = "".join(f'<span class="fact">{html.escape(fact)}</span>' for fact in facts if fact)
    return (f'<div class="entry" id="{identity}"><p class="head"><a '
            f'href="#{identity}"><code>{html.escape(head)}</code></a>{small}</p>'
            f'<p class="meaning">{with_code(meaning)}</p></div>')


class Keys:
    """The keys of a scene, one page per section."""

    def __init__(self, program):
        self.sections = groups(output_of(program, "explain"))
        self.names = {section + "/" + name.split(" = ")[0] for section, entries in self.sections for name,
                      *_ in entries}

    def link(self, name):
        section, key = name.split("/", 1)
        return f"reference/keys_{section}.html#{anchor(section, key)}"

    def pages(self):
        for section, entries in self.sections:
            lines = [f"# Section `{section}`", "", f"{len(entries)} keys; `diptych explain {section}` prints the same "
                     "list. In a scene:", "", f"    subsection {section}", f"      set {entries[0][0]}", "    end", "",
                     f"or on the command line `--set {section}/KEY=VALUE`.", ""]
            for name, unit, bounds, meaning in entries:
                lines += [entry(anchor(section, name.split(" = ")[0]), name, (unit, bounds), meaning), ""]
            yield f"reference/keys_{section}.md", f"Section {section}", "\n".join(lines)

    def index(self):
        for section, entries in self.sections:
            for name, _, _, meaning in entries:
                key = section + "/" + name.split(" = ")[0]
                yield key, "key", self.link(key), meaning


class Results:
    """The columns, numbers and datasets of result files, one page per family of files: the first word of the
    heading."""

    def __init__(self, program):
        self.families = {}
        for heading, entries in groups(output_of(program, "explain", "results")):
            self.families.setdefault(re.match(r"[a-z]+", heading)[0], []).append((heading, entries))

    def pages(self):
        for family, files in self.families.items():
            lines = [f"# Results: {family}", "", "`diptych explain results` prints the same list. Stress and strain "
                     "are positive in compression.", ""]
            for heading, entries in files:
                lines += ["## " + heading, ""]
                for name, unit, kind, meaning in entries:
                    lines += [entry(anchor(heading, name), name, (unit, kind), meaning), ""]
            yield f"reference/results_{family}.md", f"Results: {family}", "\n".join(lines)

    def index(self):
        for family, files in self.families.items():
            for heading, entries in files:
                for name, _, kind, meaning in entries:
                    page = f"reference/results_{family}.html#{anchor(heading, name)}"
                    yield name, heading + (", " + kind if kind else ""), page, meaning


def options(text):
    """[(head, meaning)] of the arguments and options that CLI11 prints. The meaning of a long head is on the next
    line."""
    found = []
    for block in re.findall(r"^(?:Positionals|Options|Subcommands):\n(.*?)(?=^\S|\Z)", text, re.DOTALL | re.MULTILINE):
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
        block = self.overview.split("Subcommands:\n")[1].split("\n\n")[0]
        self.names = re.findall(r"^  (\S+)", block, re.MULTILINE)
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
            yield "diptych " + name, "command", "reference/commands.html#diptych-" + name, self.helps[name].split("\n",
                                                                                                                  1)[0]

