#!/usr/bin/python3
# diptych: the files for ParaView, read back by a reader that is not ours
# SPDX-License-Identifier: LGPL-2.1-or-later
"""python3 tests/program/paraview_test.py PROGRAM SOURCE_DIR; the reader is meshio (python3-meshio), which test.sh installs."""

import os
import re
import unittest
import xml.etree.ElementTree as tree

import h5py
import meshio
import numpy as np

from running import QUICK, SMALL, finished, main, setting, temporary

# A law without couple stresses: its stress is symmetric, and so is everything that a tensor of it may be checked against.
SYMMETRIC = SMALL + setting(sample_seed=2, continuum_law="mohr_coulomb", output_report="false")  # 2: a smooth outline


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary(cls)
        finished("run", QUICK, "--output", cls.folder, "--quiet", *SYMMETRIC)
        cls.stages = sorted(os.listdir(os.path.join(cls.folder, "continuum")))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def last_stage(self):
        with h5py.File(self.path("comparison.h5")) as file:
            group = file[max(name for name in file if name.startswith("stage"))]
            return {name: item[()] for name, item in group["cells"].items()}

    def tensors(self, mesh, name):
        """Cell data as (cells, 3, 3): nine components, row after row."""
        values = mesh.cell_data[name][0]
        self.assertEqual(values.shape[1:], (9,), name)
        return values.reshape(-1, 3, 3)

    def test_fields_are_plane_tensors_with_the_values_of_the_comparison(self):
        mesh, stored = meshio.read(self.path("fields.vtu")), self.last_stage()
        self.assertEqual([block.type for block in mesh.cells], ["quad"])
        np.testing.assert_allclose(mesh.points[mesh.cells[0].data][:, :, :2], stored["node_position"][stored["nodes"]], atol=1e-6)
        for name in ("discrete_stress", "continuum_stress"):
            found = self.tensors(mesh, name)
            # ten digits are written; row and column keep their order: the grains' stress is not symmetric on a cell
            np.testing.assert_allclose(found[:, :2, :2], stored[name], rtol=1e-9, atol=1e-9)
            np.testing.assert_array_equal(found[:, 2, :], 0)
            np.testing.assert_array_equal(found[:, :, 2], 0)
        difference = self.tensors(mesh, "continuum_stress") - self.tensors(mesh, "discrete_stress")
        np.testing.assert_allclose(self.tensors(mesh, "stress_difference"), difference, atol=2e-8)

    def test_scalars_of_the_fields_keep_their_digits(self):
        mesh, stored = meshio.read(self.path("fields.vtu")), self.last_stage()
        scalars = [name for name, values in stored.items() if values.ndim == 1]
        self.assertIn("solid_fraction", scalars)
        for name in scalars:  # one name in both files
            np.testing.assert_allclose(np.ravel(mesh.cell_data[name][0]), stored[name], rtol=1e-6, atol=1e-300, err_msg=name)

    def test_stress_of_the_continuum_starts_isotropic_and_stays_symmetric(self):
        # initial_stress = isotropic, P = 1, positive in compression; the first stage is the state before loading
        for stage in self.stages:
            mesh = meshio.read(self.path("continuum", stage))
            for name in ("stress", "strain", "plastic_strain"):
                found = self.tensors(mesh, name)
                np.testing.assert_allclose(found, found.transpose(0, 2, 1), atol=1e-12, err_msg=name)
                np.testing.assert_array_equal(found[:, 2, :2], 0)
            if stage == self.stages[0]:
                np.testing.assert_allclose(self.tensors(mesh, "stress").mean(axis=0), np.eye(3), atol=0.02)

    def test_the_series_of_the_continuum_is_that_of_its_single_files(self):
        with meshio.xdmf.TimeSeriesReader(self.path("continuum.xdmf")) as series:
            points, cells = series.read_points_cells()
            self.assertEqual(series.num_steps, len(self.stages))
            times = []
            for k, stage in enumerate(self.stages):
                time, _, data = series.read_data(k)
                times.append(time)
                self.assertEqual(data["stress"][0].shape[1:], (3, 3))
                single = meshio.read(self.path("continuum", stage))
                np.testing.assert_allclose(data["stress"][0], self.tensors(single, "stress"), rtol=1e-12, atol=1e-12)
        self.assertEqual(len(cells[0].data), len(data["stress"][0]))
        self.assertEqual(len(points), cells[0].data.max() + 1)
        self.assertEqual(times, sorted(set(times)))

    def test_every_item_of_the_grains_series_is_what_it_says_and_moments_are_symmetric(self):
        """meshio reads no vertices without connectivity, which XDMF allows: followed here by its rules, item by item."""
        root = tree.parse(self.path("discrete.xdmf")).getroot()
        series = root.findall(".//Grid[@GridType='Collection']")
        self.assertLessEqual({"grains", "contacts"}, {s.get("Name") for s in series})
        expected = {"grains": {"internal_moment": "Tensor", "velocity": "Vector", "radius": "Scalar"},
                    "contacts": {"normal": "Vector", "force": "Vector", "gap": "Scalar"}}
        for grid in [grid for s in series for grid in s.findall("Grid")]:
            points = int(grid.find("Topology").get("NumberOfElements"))
            self.assertEqual(self.item(grid.find("Geometry/DataItem")).shape, (points, 3))
            kinds = {}
            for attribute in grid.findall("Attribute"):
                values = self.item(attribute.find("DataItem"))
                kinds[attribute.get("Name")] = attribute.get("AttributeType")
                shape = {"Scalar": (), "Vector": (3,), "Tensor": (3, 3)}[attribute.get("AttributeType")]
                self.assertEqual(values.shape, (points,) + shape, attribute.get("Name"))
                if shape == (3, 3):
                    np.testing.assert_array_equal(values, values.transpose(0, 2, 1))
                    np.testing.assert_array_equal(values[:, 2, :], 0)
                    self.assertGreater(np.trace(values.sum(axis=0)), 0)  # positive in compression
            self.assertLessEqual(expected.get(grid.get("Name").split("/")[1], {}).items(), kinds.items())
        for s in series:
            times = [float(grid.find("Time").get("Value")) for grid in s.findall("Grid")]
            self.assertEqual(times, sorted(set(times)))
            self.assertEqual(len(times), len(self.stages))

    def item(self, element):
        """Array that a DataItem points to, with the extents and the kind of number that it states."""
        name, path = re.fullmatch(r"\s*(\S+?):(/\S+)\s*", element.text).groups()
        with h5py.File(self.path(name)) as file:
            values = file[path][()]
        self.assertEqual(values.shape, tuple(map(int, element.get("Dimensions").split())))
        self.assertEqual(values.dtype.kind, {"Float": "f", "Int": "i", "UInt": "u"}[element.get("NumberType")])
        self.assertEqual(values.dtype.itemsize, int(element.get("Precision", 4)))
        return values


if __name__ == "__main__":
    main()
