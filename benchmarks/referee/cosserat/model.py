# diptych: finite element model in dolfinx of a rectangle between platens, independent of the continuum panel
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Biquadratic displacements with 3x3 points, bilinear rotations, Newton's method, direct solver. Equations:
README.md."""
import basix
import dolfinx.fem.petsc as assembly
import numpy
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

from law import Law

DEGREE = 5  # Quadrature of 3x3 Gauss points.
TOLERANCE = 1e-9  # Largest unbalanced nodal force relative to the platen force.


def number(keys, name, default=None):
    return float(keys.get(name, default))


class Model:
    """Sample of `keys`, a dictionary of the sections loading and continuum of a scene."""

    def __init__(self, keys):
        self.keys, self.law = keys, Law(keys)
        self.width, self.height = number(keys, "rectangle_width"), number(keys, "rectangle_height")
        self.counts = [round(side / number(keys, "element_size")) for side in (self.width, self.height)]
        self.domain = mesh.create_rectangle(MPI.COMM_SELF, [(0, 0), (self.width, self.height)], self.counts,
                                            mesh.CellType.quadrilateral)
        cell = self.domain.ufl_cell()
        plane = ufl.VectorElement("Lagrange", cell, 2)
        self.cosserat = self.law.cosserat
        element = ufl.MixedElement(plane, ufl.FiniteElement("Lagrange", cell, 1)) if self.cosserat else plane
        self.space = fem.FunctionSpace(self.domain, element)
        self.solution = fem.Function(self.space)
        self.n_cells = self.domain.topology.index_map(2).size_local
        self.cells = numpy.arange(self.n_cells, dtype=numpy.int32)
        self.points, self.weights = basix.make_quadrature(basix.CellType.quadrilateral, DEGREE)
        self.place_points()
        self.write_forms(cell)
        self.set_platens()

    def place_points(self):
        """Positions of the quadrature points [cells, points, 2], and (row, column) of each cell."""
        x = ufl.SpatialCoordinate(self.domain)
        places = fem.Expression(x, self.points).eval(self.cells).reshape(self.n_cells, -1, 2)
        middle = places.mean(axis=1)
        self.column, self.row = numpy.floor(middle * self.counts / (self.width, self.height)).astype(int).T
        kappa = number(self.keys, "weak_spot_strain", 0) * numpy.exp(
            -((places - self.spot())**2).sum(axis=2) / (2 * number(self.keys, "weak_spot_radius", 2)**2))
        n_points = kappa.size
        q = numpy.zeros((n_points, len(self.law.to_q)))
        self.state = {"p": numpy.ones(n_points), "q": q, "kappa": kappa.ravel(), "skew": numpy.zeros(n_points)}

    def spot(self):
        x, y = (number(self.keys, f"weak_spot_{axis}", 0.5) for axis in "xy")
        return numpy.array((x * self.width, y * self.height))

    def strain(self, function):
        """Generalised strain of displacements and rotations."""
        u, rotation = ufl.split(function) if self.cosserat else (function, None)
        g = ufl.grad(u)
        plane = [g[0, 0], g[1, 1], g[0, 1] + g[1, 0]]
        if self.cosserat:
            k = ufl.grad(rotation)
            plane += [g[1, 0] - g[0, 1] - 2 * rotation, k[0], k[1]]
        return ufl.as_vector(plane)

    def write_forms(self, cell):
        n = self.law.n_strains
        points = {"family": "Quadrature", "cell": cell, "degree": DEGREE, "quad_scheme": "default"}
        vector = fem.FunctionSpace(self.domain, ufl.VectorElement(**points, dim=n))
        tensor = fem.FunctionSpace(self.domain, ufl.TensorElement(**points, shape=(n, n)))
        self.stress, self.tangent = fem.Function(vector), fem.Function(tensor)
        self.order = vector.dofmap.list.array.reshape(self.n_cells, -1).ravel()
        test, trial = ufl.TestFunction(self.space), ufl.TrialFunction(self.space)
        dx = ufl.Measure("dx", self.domain, metadata={"quadrature_degree": DEGREE, "quadrature_scheme": "default"})
        u, v = (ufl.split(f)[0] if self.cosserat else f for f in (self.solution, test))
        load = -ufl.FacetNormal(self.domain)[0] * v[0] * ufl.ds
        self.residual = fem.form(ufl.inner(self.stress, self.strain(test)) * dx - load)
        self.jacobian = fem.form(ufl.inner(ufl.dot(self.tangent, self.strain(trial)), self.strain(test)) * dx)
        self.dilation = fem.form(ufl.div(u) * dx)
        self.strains = fem.Expression(self.strain(self.solution), self.points)

    def set_platens(self):
        part = self.space.sub(0) if self.cosserat else self.space
        whole = self.space.sub(0).collapse()[0] if self.cosserat else self.space
        self.upper_value, lower_value = fem.Function(whole), fem.Function(whole)
        found = [fem.locate_dofs_geometrical((part, whole), lambda x, y=y: numpy.isclose(x[1], y))
                 for y in (self.height, 0)]
        self.conditions = [fem.dirichletbc(value, dofs, part) for value,
                           dofs in zip((self.upper_value, lower_value), found)]
        self.upper = [fem.locate_dofs_geometrical((part.sub(i), whole.sub(i).collapse()[0]),
                                                  lambda x: numpy.isclose(x[1], self.height))[0] for i in (0, 1)]
        self.free = numpy.ones(len(self.solution.x.array), dtype=bool)
        for condition in self.conditions:
            self.free[condition.dof_indices()[0]] = False
        self.solver = PETSc.KSP().create(MPI.COMM_SELF)
        self.solver.setType("preonly")
        self.solver.getPC().setType("lu")
        self.solver.getPC().setFactorSolverType("mumps")

    def evaluate(self):
        """Stress, tangent and the vector of unbalanced forces of the trial solution."""
        total = self.strains.eval(self.cells).reshape(-1, self.law.n_strains)
        self.trial, stress, tangent = self.law.step(self.state, total - self.strain_before, self.progress)
        self.total = total
        self.stress.x.array.reshape(-1, self.law.n_strains)[self.order] = stress
        self.tangent.x.array.reshape(-1, self.law.n_strains**2)[self.order] = tangent.reshape(len(stress), -1)
        return assembly.assemble_vector(self.residual)

    def unbalanced(self, forces):
        return abs(forces.array[self.free]).max() / max(abs(self.force(forces)).max(), 1)

    def force(self, forces):
        """Force of the upper platen on the sample, to the right and upwards."""
        return numpy.array([forces.array[dofs].sum() for dofs in self.upper])

    def correct(self, forces):
        """Newton's correction; platens get their prescribed displacement."""
        matrix = assembly.assemble_matrix(self.jacobian, self.conditions)
        matrix.assemble()
        right = forces.copy()
        assembly.apply_lifting(right, [self.jacobian], [self.conditions], [self.solution.vector], -1.0)
        assembly.set_bc(right, self.conditions, self.solution.vector, -1.0)
        right.scale(-1)
        self.solver.setOperators(matrix)
        change = right.duplicate()
        self.solver.solve(right, change)
        return change.array

    def step(self, target):
        """Equilibrium at the axial strain `target`. Throws ArithmeticError."""
        self.progress = target - self.reached
        descent = target * self.height
        values = self.upper_value.x.array.reshape(-1, 2)
        values[:] = descent * number(self.keys, "horizontal_over_vertical", 0), -descent
        forces = self.evaluate()
        for iteration in range(40):
            start = self.solution.x.array.copy()
            change, before = self.correct(forces), self.unbalanced(forces)
            for part in (1, 0.5, 0.25, 0.125):
                self.solution.x.array[:] = start + part * change
                forces = self.evaluate()
                if iteration == 0 or self.unbalanced(forces) < before:
                    break
            if self.unbalanced(forces) < TOLERANCE:
                break
        else:
            raise ArithmeticError(f"no equilibrium at {100 * target:g} % strain")
        self.state, self.strain_before, self.reached = self.trial, self.total, target
        return self.force(forces), iteration + 1

    def initialise(self):
        self.reached, self.progress = 0.0, 1.0
        self.strain_before = numpy.zeros((self.n_cells * len(self.weights), self.law.n_strains))
        return self.force(self.evaluate())

    def volumetric_strain(self):
        """Mean trace of the small strain, positive in compression."""
        return -fem.assemble_scalar(self.dilation) / (self.width * self.height)

    def means(self):
        """Cell means {name: [row, column]} of the hardening variable; Cosserat: also of rotation, skew and couple
        stresses."""
        def grid(values):
            result = numpy.zeros(self.counts[::-1])
            result[self.row, self.column] = values.reshape(self.n_cells, -1) @ self.weights
            return result
        fields = {"kappa": grid(self.state["kappa"])}
        if self.cosserat:
            rotation = fem.Expression(ufl.split(self.solution)[1], self.points).eval(self.cells)
            couple = self.state["q"][:, -2:] @ self.law.to_q[-2:, -2:] / self.law.shear
            fields |= {"rotation": grid(rotation), "skew": grid(self.state["skew"]),
                       "m_x": grid(couple[:, 0]), "m_y": grid(couple[:, 1])}
        return fields
