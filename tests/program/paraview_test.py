# diptych: the files for ParaView and OVITO, read back by readers that are not ours
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The readers are meshio and VTK, which test.sh installs."""

import os
import unittest
import xml.etree.ElementTree as tree

import h5py
import meshio
import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTubeFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from running import finished, QUICK, setting, SMALL, temporary

SERIES = ("discrete", "discrete_contacts", "continuum", "fields")
DIGITS = dict(rtol=1e-6, atol=1e-6)  # single precision; coordinates and stresses are of the order 1 to 20

# A law without couple stresses: its stress is symmetric, and so is everything that a tensor of it may be checked
# against.
SYMMETRIC = SMALL + setting(sample_seed=2, continuum_law="mohr_coulomb", output_report="false")  # 2: a smooth outline


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary(cls)
        finished("run", QUICK, "--output", cls.folder, "--quiet", *SYMMETRIC)
        cls.stages = sorted(os.listdir(os.path.join(cls.folder, "continuum")))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def stored(self, name, stage):
        """{dataset: array} of a stage of an HDF5 file."""
        found = {}
        with h5py.File(self.path(name)) as file:
            file[f"stage_{stage:04d}"].visititems(
                lambda path, item: found.update({path: item[()]}) if isinstance(item, h5py.Dataset) else None)
        return found

    def tensors(self, mesh, name):
        """Cell data as (cells, 3, 3): nine components, row after row."""
        values = mesh.cell_data[name][0]
        self.assertEqual(values.shape[1:], (9,), name)
        return values.reshape(-1, 3, 3)

    def test_every_series_lists_its_stages_by_strain(self):
        strains = {}
        for name in SERIES:
            entries = tree.parse(self.path(name + ".pvd")).getroot().findall(".//DataSet")
            self.assertEqual([e.get("file") for e in entries],
                             [f"{name}/{file}" for file in sorted(os.listdir(self.path(name)))])
            strains[name] = [float(e.get("timestep")) for e in entries]
            self.assertEqual(strains[name], sorted(set(strains[name])))
        self.assertEqual(strains["fields"], strains["discrete"][1:])
        for name in SERIES[:3]:
            np.testing.assert_allclose(strains[name], strains["discrete"], rtol=1e-9)
        self.assertEqual(strains["discrete"][0], 0)
        with h5py.File(self.path("discrete.h5")) as file:
            self.assertEqual(strains["discrete"], [round(group.attrs["progress"], 10) for group in file.values()])

    def test_grains_are_vertices_with_the_values_of_the_file_of_results(self):
        stored, mesh = self.stored("discrete.h5", 2), meshio.read(self.path("discrete", "stage_0002.vtu"))
        self.assertEqual([(block.type, len(block.data)) for block in mesh.cells], [("vertex", 300)])
        np.testing.assert_allclose(mesh.points, stored["grains/position"], **DIGITS)
        for name in ("displacement", "velocity", "rotation", "spin", "radius", "mass", "rattler", "fixed"):
            np.testing.assert_allclose(np.squeeze(mesh.point_data[name]), stored["grains/" + name], **DIGITS,
                                       err_msg=name)
        trace = stored["grains/internal_moment"][:, 0, 0] + stored["grains/internal_moment"][:, 1, 1]
        np.testing.assert_allclose(np.ravel(mesh.point_data["mean_stress"]),
                                   trace / 2 / (np.pi * stored["grains/radius"] ** 2), **DIGITS)

    def test_the_force_network_of_vtk_is_that_of_the_file_of_results(self):
        stored = self.stored("discrete.h5", 2)
        force, normal = stored["contacts/force"][:, :2], stored["contacts/normal"][:, :2]
        loaded = force.any(axis=1)
        grid, points = self.in_vtk("discrete_contacts", 2)
        self.assertEqual((grid.GetNumberOfCells(), len(points)), (loaded.sum(), 2 * loaded.sum()))
        values = {name: vtk_to_numpy(grid.GetPointData().GetArray(name))
                  for name in ("normal_force", "tangential_force", "status")}
        along, across = (force * normal).sum(axis=1), force[:, 1] * normal[:, 0] - force[:, 0] * normal[:, 1]
        np.testing.assert_allclose(values["normal_force"][::2], along[loaded], **DIGITS)
        np.testing.assert_allclose(values["tangential_force"][::2], across[loaded], **DIGITS)
        np.testing.assert_array_equal(values["status"][1::2], stored["contacts/status"][loaded])
        body, radius = stored["contacts/body"][loaded], stored["grains/radius"]
        self.assertTrue((body >= 300).any(), "contacts with platens")
        lengths = np.linalg.norm(points[::2] - points[1::2], axis=1)
        # a line to a wall ends at the contact point
        reach = radius[body[:, 0]] + np.append(radius, np.zeros(4))[body[:, 1]]
        np.testing.assert_allclose(lengths, reach, atol=0.01)

    def test_vtk_makes_tubes_of_the_force_network(self):
        grid, _ = self.in_vtk("discrete_contacts", 2)
        grid.GetPointData().SetActiveScalars("normal_force")
        lines, tubes = vtkGeometryFilter(), vtkTubeFilter()
        lines.SetInputData(grid)
        tubes.SetInputConnection(lines.GetOutputPort())
        tubes.SetVaryRadiusToVaryRadiusByScalar()
        tubes.Update()
        self.assertGreater(tubes.GetOutput().GetNumberOfPoints(), grid.GetNumberOfCells())

    def in_vtk(self, series, stage):
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(self.path(series, f"stage_{stage:04d}.vtu"))
        reader.Update()
        return reader.GetOutput(), vtk_to_numpy(reader.GetOutput().GetPoints().GetData())

    def test_fields_are_plane_tensors_and_scalars_with_the_values_of_the_comparison(self):
        for stage in range(1, len(self.stages)):
            mesh = meshio.read(self.path("fields", f"stage_{stage:04d}.vtu"))
            stored = {path[6:]: values for path, values in self.stored("comparison.h5", stage).items()
                      if path.startswith("cells/")}
            self.assertEqual([block.type for block in mesh.cells], ["quad"])
            np.testing.assert_allclose(mesh.points[mesh.cells[0].data][:, :, :2],
                                       stored["node_position"][stored["nodes"]], **DIGITS)
            for name in ("discrete_stress", "continuum_stress", "stress_difference"):
                # row and column keep their order: the grains' stress is not symmetric on a cell
                found = self.tensors(mesh, name)
                np.testing.assert_allclose(found[:, :2, :2], stored[name], **DIGITS)
                np.testing.assert_array_equal(found[:, 2, :], 0)
                np.testing.assert_array_equal(found[:, :, 2], 0)
            scalars = [name for name, values in stored.items() if values.ndim == 1]
            self.assertIn("solid_fraction", scalars)
            for name in scalars:  # one name in both files
                np.testing.assert_allclose(np.ravel(mesh.cell_data[name][0]), stored[name], rtol=1e-6, atol=1e-30,
                                           err_msg=name)

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

    def test_the_dump_for_ovito_comes_back_by_the_import(self):
        finished("export", self.folder, "--format", "dump", "--output", self.path("dump"), "--quiet")
        finished("import", "lammps", self.path("dump", "grains.dump"), self.path("dump", "contacts.dump"),
                 "--walls-touch", "--output", self.path("back"), "--quiet")
        for stage in range(len(self.stages)):
            ours, back = self.stored("discrete.h5", stage), self.stored("back/discrete.h5", stage)
            for name in ("position", "velocity", "spin", "radius", "mass"):
                np.testing.assert_allclose(back["grains/" + name], ours["grains/" + name], rtol=1e-15, err_msg=name)

    def test_the_movie_has_a_frame_for_each_stage(self):
        finished("report", self.folder, "--movie", "--quiet")
        with Image.open(self.path("movie.gif")) as movie:
            self.assertEqual(movie.n_frames, len(self.stages) - 1)
            movie.seek(movie.n_frames - 1)
            self.assertGreater(len(movie.convert("RGB").getcolors(10 ** 6)), 50, "both panels are coloured")
        finished("compare", self.folder, "--quiet")
        self.assertFalse(os.path.exists(self.path("movie.gif")), "it would show the earlier comparison")
