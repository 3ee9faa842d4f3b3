# diptych: lower and upper bounds of a collapse load as second-order cone programs
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Limit analysis of a Mohr-Coulomb continuum in plane strain with associated flow, friction angle phi > 0 and cohesion
c.

Both bounds are one problem: the largest l.sigma + constant over the stresses sigma at the corners of all triangles,
with A sigma = b and every corner inside the yield surface. `lower_problem` states strict equilibrium of stresses that
are linear in a triangle and jump between triangles (Sloan 1988; Makrodimopoulos and Martin 2006). `upper_problem`
states the power balance for every velocity field that is quadratic in a triangle and continuous. The multipliers of its
equations are such a field, and the cone is its flow rule at the corners, which suffices because the strain rate is
linear (Makrodimopoulos and Martin 2007).

Inside this file stress is positive in tension. A stress is (s_xx, s_yy, s_xy), number 9 triangle + 3 corner +
component. Results are positive in compression."""
from dataclasses import dataclass

import numpy
import scipy.sparse
import scipy.sparse.linalg

from cones import largest

# makes the flow rule of the upper bound hold in spite of the solver's tolerance; raises the bound by about 1e-5
MARGIN = 1e-8


@dataclass
class Soil:
    """Friction angle [degrees] and cohesion."""
    friction_angle: float
    cohesion: float

    @property
    def sine(self):
        return numpy.sin(numpy.radians(self.friction_angle))

    @property
    def apex(self):
        """Isotropic tension that the cohesion carries, c cot(phi)."""
        return self.cohesion / numpy.tan(numpy.radians(self.friction_angle))

    def margin(self, stress):
        """2 c cos(phi) - (s_xx + s_yy) sin(phi) - sqrt((s_xx - s_yy)^2 + 4 s_xy^2) of stresses (..., 3): not negative
        if admissible. The out-of-plane stress may have any value and is taken between the other two principal
        stresses."""
        sxx, syy, sxy = numpy.moveaxis(stress, -1, 0)
        return (2 * self.apex - sxx - syy) * self.sine - numpy.hypot(sxx - syy, 2 * sxy)


@dataclass
class Bound:
    """Bound of the mean vertical stress under the platen. `error` is the largest unbalanced traction (lower bound) or
    the largest violation of the flow rule relative to the largest shear rate (upper bound). velocity: (n, 2) at `nodes`
    (m, 6); strain_rate: (m, 3, 3)."""
    value: float
    error: float
    n_triangles: int
    iterations: int
    nodes: numpy.ndarray = None
    velocity: numpy.ndarray = None
    strain_rate: numpy.ndarray = None


class Equations:
    """Rows of A sigma = b, collected block by block."""

    def __init__(self):
        self.entries, self.right, self.n = [], [], 0

    def add(self, columns, values, right):
        """Equations (k,): columns and values (k, terms), right sides (k,)."""
        rows = numpy.broadcast_to(self.n + numpy.arange(len(columns))[:, None], columns.shape)
        self.entries.append(numpy.stack((rows, columns, values)).reshape(3, -1))
        self.right.append(right)
        self.n += len(columns)

    def system(self, n_columns):
        rows, columns, values = numpy.concatenate(self.entries, axis=1)
        return scipy.sparse.csr_matrix((values, (rows, columns)),
                                       shape=(self.n, n_columns)), numpy.concatenate(self.right)


def dependent(body, pairs, inside):
    """Ends of edges (k, 2) at which one continuity equation follows from others: one for each point inside where
    exactly two straight lines of edges cross. There both lines' shear tractions are one number."""
    direction = body.points[pairs[:, 1]] - body.points[pairs[:, 0]]
    direction /= numpy.linalg.norm(direction, axis=1)[:, None]
    total, count = numpy.zeros_like(body.points), numpy.bincount(pairs.ravel(), minlength=len(body.points))
    numpy.add.at(total, pairs[:, 0], direction)
    numpy.add.at(total, pairs[:, 1], -direction)
    count[pairs[~inside]] = 0
    crossing = (count == 4) & (numpy.linalg.norm(total, axis=1) < 1e-9)
    spare = numpy.zeros(pairs.shape, bool)
    points, first = numpy.unique(pairs, return_index=True)
    spare.ravel()[first[crossing[points]]] = True
    return spare


def traction_terms(plane, direction):
    """Coefficients (k, 3) of a stress in its traction on planes with normals (k, 2), as component along directions (k,
    2)."""
    (n_x, n_y), (d_x, d_y) = plane.T, direction.T
    return numpy.column_stack((n_x * d_x, n_y * d_y, n_x * d_y + n_y * d_x))


def lower_problem(body):
    """A, b and l of the lower bound, and the number of contacts of a platen with friction, whose cones come last."""
    gradients, area = body.gradients()
    three, corners = numpy.arange(3), 9 * numpy.arange(len(area))[:, None] + 3 * numpy.arange(3)
    equations, objective = Equations(), numpy.zeros(9 * len(area))
    scaled = gradients * numpy.sqrt(area)[:, None, None]
    for along_x, along_y in ((0, 2), (2, 1)):  # equilibrium in the triangle
        equations.add(numpy.hstack((corners + along_x, corners + along_y)),
                      numpy.hstack((scaled[..., 0], scaled[..., 1])), 0 * area)
    pairs, one, other, _ = body.sides()
    ends = body.points[pairs]
    along, inside = ends[:, 1] - ends[:, 0], other >= 0
    length = numpy.linalg.norm(along, axis=1)
    normal = numpy.column_stack((along[:, 1], -along[:, 0])) / length[:, None]
    outward = numpy.einsum("ij,ij->i", normal, ends[:, 0] - body.points[body.triangles[one]].mean(axis=1))
    normal *= numpy.sign(outward)[:, None]
    tangent = numpy.column_stack((-normal[:, 1], normal[:, 0]))
    held, traction, platen = body.edges(ends.mean(axis=1))
    spare, contacts = dependent(body, pairs, inside), []
    for end in range(2):
        here, there = (9 * triangle + 3 * numpy.argmax(body.triangles[triangle] == pairs[:, [end]], axis=1)
                       for triangle in (one, other))
        for direction, kept in ((normal, inside), (tangent, inside & ~spare[:, end])):  # continuity between triangles
            terms = traction_terms(normal, direction)[kept]
            equations.add(numpy.hstack((here[kept, None] + three, there[kept, None] + three)),
                          numpy.hstack((terms, -terms)), numpy.zeros(len(terms)))
        for axis in range(2):  # given tractions
            kept = ~inside & ~held[:, axis] & ~(platen & (body.friction > 0))
            terms = traction_terms(normal, numpy.broadcast_to(numpy.eye(2)[axis], normal.shape))
            equations.add(here[kept, None] + three, terms[kept], traction[kept, axis])
        under = ~inside & platen
        objective[here[under] + 1] -= length[under] / 2 / body.platen_width
        contacts.append(here[under] if body.friction > 0 else here[:0])
    at = numpy.concatenate(contacts)[:, None]
    cones = len(objective) + 3 * numpy.arange(len(at))[:, None]
    for stress, cone, scale in ((1, 0, -body.friction), (2, 1, 1)):  # w = (mu N, T, 0), T positive along x
        equations.add(numpy.hstack((at + stress, cones + cone)), numpy.tile((scale, -1.0), (len(at), 1)),
                      0 * at.ravel())
    objective = numpy.concatenate((objective, numpy.zeros(3 * len(at))))
    return *equations.system(len(objective)), objective, len(at)


def lower_bound(body, soil, pressure):
    """Bound of a stress that is admissible to rounding: the solver's stress is first corrected to equilibrium, then
    moved towards the isotropic state of the lateral pressure until no corner violates the yield condition."""
    A, b, objective, n_contacts = lower_problem(body)
    stress, _, iterations = largest(objective, A, b, soil, n_contacts=n_contacts)
    solve = scipy.sparse.linalg.splu((A @ A.T).tocsc()).solve
    for _ in range(2):
        stress += A.T @ solve(b - A @ stress)
    n_soil = len(stress) // 3 - n_contacts

    def margins(state):
        of_soil, of_contacts = numpy.split(state.reshape(-1, 3), [n_soil])
        return numpy.concatenate((soil.margin(of_soil), of_contacts[:, 0] - numpy.hypot(*of_contacts[:, 1:].T)))
    start = numpy.concatenate((numpy.tile((-pressure, -pressure, 0.0), n_soil),
                               numpy.tile((body.friction * pressure, 0, 0), n_contacts)))
    before, after = margins(start), margins(stress)
    share = numpy.where(after < 0, before / (before - numpy.minimum(after, 0)), 1).min() * (1 - 1e-12)
    stress = start + share * (stress - start)
    assert margins(stress).min() >= 0
    return Bound(objective @ stress, numpy.abs(A @ stress - b).max(), len(body.triangles), iterations)


def quadratic_nodes(body):
    """Nodes (m, 6) of the 6-node triangles, corners first, then the middles of the edges opposite to them; whether a
    component is held (n, 2); its velocity (n, 2); nodal forces (n, 2) of the given tractions; the ends and the middle
    (k, 3) of the edges of a platen with friction, on which no component is held."""
    pairs, _, other, number = body.sides()
    n_points = len(body.points)
    shape = (n_points + len(pairs), 2)
    held, velocity, force = numpy.zeros(shape, bool), numpy.zeros(shape), numpy.zeros(shape)
    edge = numpy.flatnonzero(other < 0)
    ends = body.points[pairs[edge]]
    edge_held, traction, platen = body.edges(ends.mean(axis=1))
    length = numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    slides = platen & (body.friction > 0)
    edge_held = edge_held & ~slides[:, None]
    # Simpson's rule is exact
    for nodes, share in ((pairs[edge, 0], 1 / 6), (pairs[edge, 1], 1 / 6), (n_points + edge, 2 / 3)):
        numpy.logical_or.at(held, nodes, edge_held)
        numpy.add.at(force, nodes, share * length[:, None] * numpy.where(edge_held, 0, traction))
        velocity[nodes[platen & ~slides], 1] = -1
    rubbing = numpy.column_stack((pairs[edge], n_points + edge))[slides]
    return numpy.hstack((body.triangles, n_points + number)), held, velocity, force, rubbing


def contact_columns(rubbing, n_nodes, friction):
    """Nodal forces (2 n, 3 k) of the cones (mu N, T, 0) at the k control points of the velocity along edges of a
    platen, power of the platen's velocity -1 (3 k), and k. If a quadratic's control points are in a convex set, so is
    it: v_middle = (v_a + 2 v_c + v_b) / 4."""
    points = numpy.unique(rubbing)
    columns = scipy.sparse.lil_matrix((n_nodes, len(points)))
    middles = dict(zip(rubbing[:, 2], rubbing))
    for k, point in enumerate(points):
        if point in middles:
            first, last, middle = middles[point]
            columns[middle, k], columns[first, k], columns[last, k] = 2.0, -0.5, -0.5
        else:
            columns[point, k] = 1.0
    forces = scipy.sparse.kron(columns, [[0, 1, 0], [1 / friction, 0, 0]])
    return forces.tocsr(), numpy.tile((1 / friction, 0, 0), len(points)), len(points)


def strain_rates(body, nodes):
    """Matrix (9 m, 2 n) from velocities to strain rates at the corners times a third of the area: rows as stresses,
    with the shear rate gamma_xy; columns 2 node + component. Linear strain rates are integrated exactly by their
    corners."""
    gradients, area = body.gradients()
    entries = []
    for corner, after, before in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        # (m, 6, 2), of the shape functions at this corner
        slopes = numpy.concatenate((-gradients, 0 * gradients), axis=1)
        slopes[:, corner] = 3 * gradients[:, corner]
        slopes[:, 3 + before], slopes[:, 3 + after] = 4 * gradients[:, after], 4 * gradients[:, before]
        slopes *= area[:, None, None] / 3
        for component, direction, axis in ((0, 0, 0), (1, 1, 1), (2, 0, 1), (2, 1, 0)):
            rows = numpy.repeat(9 * numpy.arange(len(area)) + 3 * corner + component, 6)
            entries.append((rows, (2 * nodes + direction).ravel(), slopes[:, :, axis].ravel()))
    rows, columns, values = numpy.concatenate(entries, axis=1)
    return scipy.sparse.csr_matrix((values, (rows, columns)), shape=(9 * len(area), 2 * (nodes.max() + 1)))


def upper_bound(body, soil):
    """Bound from the solver's velocities alone: dissipation less the power of the tractions, for a platen that moves by
    1. The dissipation of associated flow is c cot(phi) x the rate of volume."""
    nodes, held, velocity, force, rubbing = quadratic_nodes(body)
    strain, free = strain_rates(body, nodes), ~held.ravel()
    power, internal, n_contacts = strain @ velocity.ravel() / body.platen_width, strain.T.tocsr(), 0
    if len(rubbing):
        on_nodes, of_platen, n_contacts = contact_columns(rubbing, len(velocity), body.friction)
        internal = scipy.sparse.hstack((internal, on_nodes)).tocsr()
        power = numpy.append(power, of_platen / body.platen_width)
    _, multipliers, iterations = largest(power, internal[free], force.ravel()[free], soil, MARGIN,
                                         n_contacts=n_contacts)
    velocity.ravel()[free] = body.platen_width * multipliers
    integral = strain @ velocity.ravel()
    rate = integral.reshape(-1, 3, 3) / (body.gradients()[1] / 3)[:, None, None]
    volume, shear = rate[..., 0] + rate[..., 1], numpy.hypot(rate[..., 0] - rate[..., 1], rate[..., 2])
    value = (soil.apex * (integral[0::3] + integral[1::3]).sum() - force.ravel() @ velocity.ravel()) / body.platen_width
    error = (soil.sine * shear - volume).max() / shear.max()
    return Bound(value, max(error, 0.0), len(body.triangles), iterations, nodes, velocity, rate)
