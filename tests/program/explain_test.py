# diptych: whatever stands in a file of results is explained, with the unit that the file itself tells
# SPDX-License-Identifier: LGPL-2.1-or-later
import json
import os
import re
import unittest

import h5py

from running import diptych, finished, history, member_of, QUICK, read_json, setting, SMALL, temporary

TINY = SMALL + setting(sample_grains=150, continuum_element_size=2.5, comparison_coarse_element_size=3,
                       output_report="false")
INTERVAL = {"value", "low", "high"}


def explained():
    """Heading -> name -> (unit, shape) of `diptych explain --json`."""
    found = {}
    for one in json.loads(diptych("explain", "--json").stdout)["results"]:
        entries, name = found.setdefault(one["file"], {}), one["entry"]
        for name in [p + name[14:] for p in ("cells/", "grid/")] if name.startswith("cells/, grid/ ") else [name]:
            assert name not in entries, f"{one['file']}: {name} twice"
            entries[name] = one["unit"], one["shape"]
    return found


def places(value, place=""):
    """Keys on the way to every value of a JSON file; a list's entries stand under the list's key."""
    if isinstance(value, dict) and not INTERVAL <= set(value):
        for key, part in value.items():
            inner = place + "/" + key if place else key
            yield inner
            yield from places(part, inner)
    elif isinstance(value, list):
        for part in value:
            if isinstance(part, dict):
                yield from places(part, place)


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        work = temporary(cls)
        cls.ensemble, cls.point = (os.path.join(work, name) for name in ("ensemble", "point"))
        for words in (["run", "--seeds", "1-2", "--output", cls.ensemble], ["material-point", "--output", cls.point]):
            finished(words[0], QUICK, *TINY, *words[1:], "--quiet")
        cls.run_ = member_of(cls.ensemble, 1)
        cls.explained = explained()

    def entries(self, file, group=None):
        """Those of every heading that names the file and, if any, the group."""
        found = {}
        for heading, entries in self.explained.items():
            parts = [part.strip() for part in re.split("[,;]", heading)]
            if file in (part.split(" ")[0] for part in parts) and (group is None
                                                                   or any(part.endswith(group) for part in parts)):
                found.update(entries)
        self.assertTrue(found, f"nothing is said of {file} {group or ''}")
        return found

    def test_columns_of_tables(self):
        for folder, name in ((self.run_, "discrete.csv"), (self.run_, "continuum.csv"),
                             (self.point, "material_point.csv"),
                             (self.run_, "comparison.csv"), (self.run_, "summary.csv"),
                             (self.ensemble, "ensemble.csv")):
            columns = [column for column in history(folder, name) if not re.fullmatch("seed_[0-9]+", column)]
            self.assertGreater(len(columns), 5)
            self.assertEqual([column for column in columns if column not in self.entries(name)], [], name)

    def test_keys_of_json_files(self):
        for folder, name in ((self.run_, "comparison.json"), (self.run_, "provenance.json"),
                             (self.ensemble, "ensemble.json"), (self.ensemble, "provenance.json")):
            record = read_json(folder, name)
            record.pop("numbers", None)  # what explains the file itself
            found = set(places(record))
            self.assertGreater(len(found), 5)
            self.assertEqual(sorted(found - set(self.entries(name))), [], name)

    def test_arrays_and_attributes_of_hdf5_files(self):
        groups = {"discrete.h5": {"stage_0001": "stage_NNNN"}, "continuum.h5": {"stage_0001": "stage_NNNN"},
                  "comparison.h5": {"stage_0001": "stage_NNNN", "window_0": "window_N",
                                    "histories/discrete": "histories/discrete "
                                    "and histories/continuum"},
                  "ensemble.h5": {"discrete/stress_ratio": "PANEL/stress_ratio and PANEL/volumetric_strain"}}
        for name, of_file in groups.items():
            with h5py.File(os.path.join(self.ensemble if name == "ensemble.h5" else self.run_, name)) as file:
                self.assertEqual([key for key in file.attrs if key not in self.entries(name)], [], name)
                for group, heading in of_file.items():
                    said, n_arrays = self.entries(name, heading), 0
                    wrong = [key for key in file[group].attrs if key not in said]

                    def look(path, item):
                        nonlocal n_arrays
                        if isinstance(item, h5py.Dataset):
                            n_arrays += 1
                            unit = item.attrs.get("unit", "none")
                            if said.get(path, ("nothing", ))[0] != (unit.decode() if isinstance(unit, bytes) else unit):
                                wrong.append(f"{path} [{unit}], explained {said.get(path)}")
                    file[group].visititems(look)
                    self.assertGreater(n_arrays, 3)
                    self.assertEqual(wrong, [], f"{name} {group}")

    def test_arrays_of_paraview_files(self):
        for name, heading in (("fields/stage_0001.vtu", "comparison.h5"), ("continuum/stage_0001.vtu", "continuum.h5"),
                              ("discrete/stage_0001.vtu", "discrete.h5"),
                              ("discrete_contacts/stage_0001.vtu", "discrete.h5")):
            with open(os.path.join(self.run_, name), "rb") as file:
                text = file.read().decode(errors="ignore")
            arrays = set(re.findall('Name="([^"]+)"', text)) - {"connectivity", "offsets", "types", "Points"}
            self.assertGreater(len(arrays), 3)
            known = {path.rsplit("/", 1)[-1] for path in self.entries(heading, "stage_NNNN")}
            if heading == "discrete.h5":
                known |= set(self.entries(name.replace("0001", "NNNN")))
            self.assertEqual(sorted(arrays - known), [], name)
