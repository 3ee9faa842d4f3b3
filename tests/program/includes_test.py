# diptych: the arrows of the house, read from the #include lines
# SPDX-License-Identifier: LGPL-2.1-or-later

import collections
import glob
import graphlib
import os
import re
import tempfile
import unittest

from running import content, SOURCE, write

# The folders of the project that each folder may include, and the libraries that it must not know.
ALLOWED = {"discrete": ("discrete",), "continuum": ("continuum",), "coupling": ("discrete", "continuum", "coupling")}
FORBIDDEN = {"discrete": ("deal.II", "gmsh", "Trilinos", "Epetra")}

# The rooms of each folder from the ground up: a room may include itself and those before it. Headers beside the rooms
# are the folder's public ones: any room may include them, but may not reach a room above its own through them.
ROOMS = {"discrete": ("files", "bodies", "contacts", "solvers", "stepping", "problem_files", "samples", "panel"),
         "continuum": ("laws", "mesh", "elements", "equilibrium", "panel"),
         "coupling": ("cells", "statistics", "numbers", "processes", "averaging", "fields", "bands", "probes", "scene",
                      "store", "comparison", "grains", "panels", "program", "python")}
# Only store/ knows where a result folder has which file.
PATH_IN_A_FOLDER = r'"/[a-z_]+\.(h5|csv|json|prm|vtu|pvd|html|msh|png)"'
WHOLE_SCENE = r"const\s+(coupling::)?Scene\s*&"


def text_of(*names):
    return content(os.path.join(*names)).decode()


def sources(root, folder):
    """Path below the root -> what it includes, of every source of a folder."""
    paths = [path for path in glob.glob(os.path.join(root, folder, "**"), recursive=True)
             if path.endswith((".h", ".cc"))]
    return {os.path.relpath(path, root): re.findall(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', text_of(path), re.MULTILINE)
            for path in sorted(paths)}


def folder_of(path):
    return path.split("/")[0]


def room_of(path):
    """contacts of discrete/contacts/law.h; "" of discrete/snapshot.h."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else ""


def violations(root):
    for folder, may_include in ALLOWED.items():
        for file, includes in sources(root, folder).items():
            for include in includes:
                target = folder_of(include) if "/" in include else ""
                if ((target in ALLOWED and target not in may_include)
                        or include.startswith(FORBIDDEN.get(folder, ()))):
                    yield f"{file} includes {include}"


def reached(every, file, followed):
    """Headers of rooms that `file` includes, directly or through headers beside the rooms."""
    for include in every.get(file, ()):
        if folder_of(include) == folder_of(file) and room_of(include):
            yield include
        elif folder_of(include) == folder_of(file) and include not in followed:
            followed.add(include)
            yield from reached(every, include, followed)


def upward_arrows(root):
    """Arrows between rooms that run upward, and rooms that have no place in the order."""
    for folder, order in ROOMS.items():
        floor = {room: k for k, room in enumerate(order)}
        every = sources(root, folder)
        for file in filter(room_of, every):
            here = floor.get(room_of(file), len(order))
            if here == len(order):
                yield f"{file} is in a room that has no place in the order"
            for include in sorted(set(reached(every, file, set()))):
                if floor.get(room_of(include), len(order)) > here:
                    yield f"{file} includes {include} of a room above its own"


def circle(root, folder):
    """A header and its source are one unit. The units of one circle; empty where there is none."""
    arrows = collections.defaultdict(set)
    for file, includes in sources(root, folder).items():
        unit = os.path.splitext(file)[0]
        arrows[unit] |= {os.path.splitext(one)[0] for one in includes if folder_of(one) == folder} - {unit}
    try:
        graphlib.TopologicalSorter(arrows).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return []


def public_headers(root, panel):
    """Headers that the section "Public headers" of a panel's README lists."""
    section = text_of(root, panel, "README.md").partition("\n## Public headers\n")[2].partition("\n## ")[0]
    return {f"{panel}/{name}" for name in re.findall(r"`([a-z0-9_/]+\.h)`", section)}


def lines_outside(root, may, pattern):
    """Lines of coupling/ that match `pattern`, outside the rooms that may hold them."""
    return [f"{file}: {line}" for file in sources(root, "coupling") if room_of(file) not in may
            for line in text_of(root, file).splitlines() if re.search(pattern, line)]


def divided_rooms(root, folder):
    """Rooms whose sources are in more than one library or program of CMake, and sources that are in none."""
    targets = collections.defaultdict(set)
    for target, listed in re.findall(r"(?:add_library|add_executable|target_sources)\((\S+)([^)]*)\)",
                                     text_of(root, folder, "CMakeLists.txt")):
        for file in re.findall(r"\S+\.cc", listed):
            targets[f"{folder}/{file}"].add(target)
    files = [file for file in sources(root, folder) if file.endswith(".cc") and room_of(file) != "python"]
    of_room = collections.defaultdict(set)
    for file in filter(room_of, files):
        of_room[room_of(file)] |= targets[file]
    return ([f"{file} is in no target" for file in files if not targets[file]]
            + [room for room, of in of_room.items() if len(of) > 1])


class House(unittest.TestCase):
    def test_arrows_run_from_coupling_to_the_panels_and_no_other_way(self):
        self.assertGreater(sum(len(sources(SOURCE, folder)) for folder in ALLOWED), 200)
        self.assertEqual(list(violations(SOURCE)), [])

    def test_arrows_between_rooms_run_downward(self):
        self.assertEqual(list(upward_arrows(SOURCE)), [])

    def test_no_units_include_each_other_in_a_circle(self):
        for folder in ROOMS:
            self.assertEqual(circle(SOURCE, folder), [])

    def test_only_public_headers_of_a_panel_are_included_from_outside(self):
        """coupling/ includes of a panel the headers that its README calls public, and all of those are there."""
        used = {include for includes in sources(SOURCE, "coupling").values() for include in includes}
        for panel in ("discrete", "continuum"):
            listed = public_headers(SOURCE, panel)
            self.assertGreater(len(listed), 5)
            self.assertEqual([header for header in listed if not os.path.exists(os.path.join(SOURCE, header))], [])
            self.assertLessEqual({include for include in used if folder_of(include) == panel}, listed)

    def test_only_the_store_names_files_of_a_result_folder(self):
        self.assertEqual(lines_outside(SOURCE, ("store",), PATH_IN_A_FOLDER), [])

    def test_the_whole_scene_is_passed_to_few_functions(self):
        """A function takes the options that it uses. The reader of scenes, the commands and the binding know all."""
        self.assertLessEqual(len(lines_outside(SOURCE, ("scene", "program", "python"), WHOLE_SCENE)), 40)
        self.assertGreater(len(lines_outside(SOURCE, (), WHOLE_SCENE)), 40)

    def test_libraries_consist_of_whole_rooms(self):
        """Sources of program/ go with the programs that need them. A program without deal.II reads options of laws."""
        for folder, divided in (("discrete", []), ("continuum", ["laws"]), ("coupling", ["program"])):
            self.assertEqual(divided_rooms(SOURCE, folder), divided)

    def test_a_wrong_arrow_is_seen(self):
        """The tests themselves can fail: a house with one wrong arrow of each kind and one wrong library."""
        root = self.enterContext(tempfile.TemporaryDirectory())

        def put(path, text):
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            write(os.path.join(root, path), text)

        put("continuum/a.cc", '#include "discrete/state.h"\n#include "continuum/mesh.h"\n')
        put("discrete/b.h", "#include <deal.II/base/tensor.h>\n#include <vector>\n")
        put("discrete/panel/c.h", '#include "discrete/files/d.h"\n')
        put("discrete/files/d.h", "#include <vector>\n")
        self.assertEqual(len(list(violations(root))), 2)
        self.assertEqual((list(upward_arrows(root)), circle(root, "discrete")), ([], []))
        put("discrete/files/d.cc", '#include "discrete/panel/c.h"\n')
        self.assertEqual(len(list(upward_arrows(root))), 1)
        self.assertEqual(set(circle(root, "discrete")), {"discrete/files/d", "discrete/panel/c"})
        put("discrete/files/d.cc", '#include "discrete/public.h"\n')
        put("discrete/public.h", '#include "discrete/panel/c.h"\n')
        self.assertEqual(len(list(upward_arrows(root))), 1, "through a header beside the rooms")
        put("discrete/README.md", "`x.h`\n## Public headers\n`panel/c.h`, `files/d.h`\n## More\n`y.h`\n")
        self.assertEqual(public_headers(root, "discrete"), {"discrete/files/d.h", "discrete/panel/c.h"})
        put("coupling/panels/e.cc", 'read(folder + "/scene.prm");\nread(folder + "/a/b");\n')
        self.assertEqual(len(lines_outside(root, ("store",), PATH_IN_A_FOLDER)), 1)
        self.assertEqual(len(lines_outside(root, ("panels",), PATH_IN_A_FOLDER)), 0)
        libraries = "add_library(a STATIC\n  b.cc\n  files/d.cc\n  panel/e.cc)\n"
        put("discrete/CMakeLists.txt", libraries)
        self.assertEqual(divided_rooms(root, "discrete"), [])
        put("discrete/panel/e.cc", "")
        put("discrete/panel/f.cc", "")
        self.assertEqual(divided_rooms(root, "discrete"), ["discrete/panel/f.cc is in no target"])
        put("discrete/CMakeLists.txt", libraries + "add_executable(g panel/f.cc)\n")
        self.assertEqual(divided_rooms(root, "discrete"), ["panel"])
