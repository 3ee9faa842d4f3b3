# diptych: reads keys of a resolved scene
# SPDX-License-Identifier: LGPL-2.1-or-later

import re


def scene_section(text, section):
    """[(key, value, meaning)] of one section. The meaning is the comment above the key; nested sections give keys with
    slashes."""
    rows, path, comment = [], [], ""
    for line in text.splitlines():
        line = line.strip()
        entry = re.match(r"set\s+(.+?)\s*=\s*(.*?)\s*(#.*)?$", line)
        if line.startswith("#"):
            comment = line.lstrip("# ")
            continue
        if line.startswith("subsection "):
            path.append(line[len("subsection "):].strip())
        elif line == "end" and path:
            path.pop()
        elif entry and path[:1] == [section]:
            rows.append(("/".join(path[1:] + [entry[1]]), entry[2], comment))
        comment = ""
    return rows


def scene_value(text, section, key):
    """Value of one key as text, or ""."""
    return next((value for name, value, _ in scene_section(text, section) if name == key), "")
