# diptych: rectangles between platens and strip footings for limit analysis, with their meshes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A body is a triangle mesh with conditions on its edges. Symmetry leaves one quarter of a rectangle and one half of a
footing.

Lower bounds use meshes of rays from the singular corner, upper bounds crossed diagonals in a grid that is graded
towards it. Any mesh gives a strict bound; these meshes make both bounds close."""
from dataclasses import dataclass

import numpy

EDGE = 1e-9


@dataclass
class Body:
    """Triangles (m, 3), counter-clockwise, between points (n, 2), and what acts on the edges of the boundary.

    `edges(middles)` gives for points (k, 2) in the middle of boundary edges: held (k, 2), where a velocity component is
    given; traction (k, 2) on the other components, positive along the axes; platen (k,), where the given vertical
    velocity is -1. Elsewhere a given velocity is 0. `platen_width` is the part of the platen's width that the mesh
    holds. With a friction of the platen both velocity components on it are free, but for the law of the interface."""
    points: numpy.ndarray
    triangles: numpy.ndarray
    edges: callable
    platen_width: float
    friction: float = 0.0

    def sides(self):
        """Edges as pairs of points (k, 2) in ascending order; first and second triangle (k,), the second is -1 on the
        boundary; number of the edge opposite to each corner (m, 3)."""
        pairs = numpy.sort(self.triangles[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2), axis=1)
        pairs, first, number = numpy.unique(pairs, axis=0, return_index=True, return_inverse=True)
        number = number.ravel()
        later = numpy.flatnonzero(numpy.arange(len(number)) != first[number])
        second = numpy.full(len(pairs), -1)
        second[number[later]] = later // 3
        return pairs, first // 3, second, number.reshape(-1, 3)

    def gradients(self):
        """Gradients (m, 3, 2) of the linear shape functions of the corners, and areas (m,)."""
        x = self.points[self.triangles]
        along = numpy.roll(x, 1, axis=1) - numpy.roll(x, -1, axis=1)  # the edge opposite to each corner
        twice = along[:, 0, 0] * along[:, 1, 1] - along[:, 0, 1] * along[:, 1, 0]
        return numpy.stack((-along[..., 1], along[..., 0]), axis=-1) / twice[:, None, None], twice / 2


@dataclass
class Rectangle:
    """Between platens, width 1, under the lateral pressure P = 1 on its free sides."""
    width_over_height: float
    rough: bool = True
    friction: float = 0.0  # of platens that are not rough
    pressure = 1.0
    platen_width = 0.5

    @property
    def corner(self):
        """Where platen and free side meet: the singular point of the quarter x > 0, y > 0."""
        return numpy.array((0.5, 0.5 / self.width_over_height))

    @property
    def outline(self):
        """The sides of the quarter that do not contain the corner."""
        return numpy.array(((0, self.corner[1]), (0, 0), (0.5, 0)))

    def edges(self, middles):
        (x, y), (right, top) = middles.T, self.corner
        platen = y > top - EDGE
        held = numpy.column_stack(((x < EDGE) | (platen & self.rough), (y < EDGE) | platen))
        return held, numpy.column_stack((numpy.where(x > right - EDGE, -self.pressure, 0), 0 * y)), platen

    def grid(self, n):
        """Coordinates of the grid lines of the quarter, finest at the corner: n rows, a multiple of 4, and columns of
        about equal size, so many that twice n gives twice the columns."""
        columns = n // 4 * round(4 * self.width_over_height)
        return tuple(end * (1 - numpy.linspace(1, 0, k + 1)**2) for end, k in zip(self.corner, (columns, n)))

    def area(self):
        return self.corner.prod()


@dataclass
class Footing:
    """A rough strip of width 2 on the upper edge y = 0 of a box of weightless ground: half width and depth in half
    strips. The base is rough, the side walls are smooth, the surface beside the strip is free."""
    half_width: float
    depth: float
    friction = 0.0
    pressure = 0.0
    platen_width = 1.0
    corner = numpy.array((1.0, 0.0))

    @property
    def outline(self):
        return numpy.array(((0, 0), (0, -self.depth), (self.half_width, -self.depth), (self.half_width, 0)))

    def edges(self, middles):
        x, y = middles.T
        platen, base = (y > -EDGE) & (x < 1), y < -self.depth + EDGE
        held = numpy.column_stack(((x < EDGE) | (x > self.half_width - EDGE) | base | platen, base | platen))
        return held, numpy.zeros(middles.shape), platen

    def grid(self, n):
        """Coordinates of the grid lines: n rows, n columns beside the strip and 0.4 n under it, finest at its edge."""
        under, beside = 1 - numpy.linspace(1, 0, round(0.4 * n) + 1)**2, numpy.linspace(0, 1, n + 1)[1:]**2
        return numpy.concatenate((under, 1 + (self.half_width - 1) * beside)), -self.depth * numpy.linspace(1, 0,
                                                                                                            n + 1)**2

    def area(self):
        return self.half_width * self.depth


def crossed(points, quads):
    """Triangles between the points and the crossing points of the diagonals of quadrilaterals (m, 4): all points,
    triangles (4 m, 3)."""
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    p, q, r = c - a, d - b, b - a
    share = (r[:, 0] * q[:, 1] - r[:, 1] * q[:, 0]) / (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0])
    middle = len(points) + numpy.arange(len(quads))
    triangles = [numpy.column_stack((quads[:, k], quads[:, (k + 1) % 4], middle)) for k in range(4)]
    return numpy.concatenate((points, a + share[:, None] * p)), numpy.concatenate(triangles)


def quads_of(n_columns, n_rows):
    """Counter-clockwise corners of the cells of a grid, whose points are numbered along y first: (n_columns n_rows,
    4)."""
    first = (numpy.arange(n_columns)[:, None] * (n_rows + 1) + numpy.arange(n_rows)).ravel()
    return numpy.column_stack((first, first + n_rows + 1, first + n_rows + 2, first + 1))


def grid_body(shape, n):
    """Grid of n rows with crossed diagonals."""
    x, y = shape.grid(n)
    points = numpy.stack(numpy.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
    return Body(*crossed(points, quads_of(len(x) - 1, len(y) - 1)), shape.edges, shape.platen_width, shape.friction)


def ray_ends(shape, n):
    """Points (k, 2) of the outline that n rays from the corner meet at about equal angles, with the corners of the
    outline."""
    ends = [shape.outline[:1]]
    direction = numpy.unwrap([numpy.arctan2(*(point - shape.corner)[::-1]) for point in shape.outline])
    for first, last, start, end in zip(shape.outline, shape.outline[1:], direction, direction[1:]):
        angles = numpy.linspace(start, end, max(1, round(n * (end - start) / (direction[-1] - direction[0]))) + 1)[1:-1]
        ray, normal = numpy.column_stack((numpy.cos(angles), numpy.sin(angles))), (last - first)[::-1] * (1, -1)
        ends += [shape.corner + ray * ((first - shape.corner) @ normal / (ray @ normal))[:, None], last[None]]
    return numpy.concatenate(ends)


def ray_body(shape, n):
    """n rays from the singular corner, 2 n / 3 rings that are finer towards it, crossed diagonals; triangles at the
    corner."""
    ends, rings = ray_ends(shape, n), round(2 * n / 3)
    k = len(ends)
    share = (numpy.arange(1, rings + 1) / rings)**1.5
    points = (shape.corner + share[:, None, None] * (ends - shape.corner)).reshape(-1, 2)
    points, triangles = crossed(points, quads_of(rings - 1, k - 1))
    tips = numpy.column_stack((numpy.full(k - 1, len(points)), numpy.arange(k - 1), numpy.arange(1, k)))
    points, triangles = numpy.concatenate((points, shape.corner[None])), numpy.concatenate((triangles, tips))
    return Body(points, triangles, shape.edges, shape.platen_width, shape.friction)
