# diptych: thickness and angle of a shear band in a result of the continuum panel
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The full width at half maximum of the plastic shear increment between two stages, across the band, in current
coordinates.

1. The result holds the increment of the hardening variable as means over cells. On the rectangle's grid the cubic
spline through
   its cumulative sums, direction by direction, turns them into point values. This keeps the cells' means, so that the
   width of a cell does not widen the band. Each cell has N_POINTS^2 points; the biquadratic displacement moves them to
   their current places.
2. A frame (centre, angle) on the band's middle part is cut into N_STRIPS strips across the band. The profile of a strip
is the
   mean over bins of a fifth of an element. Its half-maximum points are the first on both sides of its peak,
   interpolated linearly. The base is zero, not the smallest value.
3. The frame is moved and turned onto the straight line through the strips' middles until it no longer changes.
Thickness is the
   mean over the strips, scatter their standard deviation. The angle is that of the frame."""
import dataclasses
import os

import h5py
import numpy

N_POINTS, N_STRIPS, BINS_PER_ELEMENT = 10, 9, 5


@dataclasses.dataclass
class Arm:
    """First guess of the measured part of a band, in the initial sample."""
    x: float  # Middle of the part [initial widths].
    y: float  # Middle of the part [initial heights].
    angle: float  # From the horizontal, anticlockwise [degrees].
    half_length: float  # [initial widths].


@dataclasses.dataclass
class Band:
    thickness: float
    scatter: float
    angle: float  # From the horizontal, in (-90, 90] [degrees].
    centre: numpy.ndarray
    half_length: float
    across: numpy.ndarray  # Abscissae of the mean profile.
    profile: numpy.ndarray


def point_values(n_cells):
    """Matrix from the means c over a row of equal cells to N_POINTS values in each, through the natural cubic spline of
    the sums. Its slopes m at the nodes satisfy m[i-1] + 4 m[i] + m[i+1] = 3 (c[i-1] + c[i])."""
    left, right = numpy.zeros((n_cells + 1, n_cells)), numpy.zeros((n_cells + 1, n_cells + 1))
    for i in range(n_cells + 1):
        for neighbour, cell in ((i - 1, i - 1), (i + 1, i)):
            if 0 <= neighbour <= n_cells:
                right[i, neighbour] = 1
                right[i, i] += 2
                left[i, cell] = 3
    slopes = numpy.linalg.solve(right, left)
    t = (numpy.arange(N_POINTS) + 0.5) / N_POINTS
    cells = numpy.eye(n_cells)
    values = ((1 - 4 * t + 3 * t**2)[None, :, None] * slopes[:-1, None, :] + (3 * t**2 - 2 * t)[None, :, None]
              * slopes[1:, None, :]
              + 6 * (t - t**2)[None, :, None] * cells[:, None, :])
    return values.reshape(-1, n_cells)


class Increment:
    """Plastic shear increment between two stages of a run on a uniform rectangle: points, values and areas."""

    def __init__(self, folder, last, strain=0.01):
        """`last`: axial strain at the end of the increment."""
        with h5py.File(os.path.join(folder, "continuum.h5"), "r") as file:
            reached = {round(float(file[name].attrs["axial_strain"]), 6): name for name in sorted(file)}
            before, after = file[reached[round(last - strain, 6)]], file[reached[round(last, 6)]]
            means = (after["cells/equivalent_plastic_strain"][()]
                     - before["cells/equivalent_plastic_strain"][()]).ravel()
            cells = after["cells/nodes"][()]
            position = after["nodes/position"][()][:, :2]
            initial = position - after["nodes/displacement"][()][:, :2]
        self.corners, self.means = position[cells[:, :4]], means
        corner = initial[cells].min(axis=1)
        self.h = numpy.ptp(initial[cells[0], 0])
        self.width, self.height = numpy.ptp(initial, axis=0)
        column, row = numpy.rint((corner - initial.min(axis=0)) / self.h).astype(int).T
        shape = (row.max() + 1, column.max() + 1)
        grid = numpy.zeros(shape)
        grid[row, column] = means
        place = numpy.rint((initial[cells] - corner[:, None]) / (self.h / 2)).astype(int)  # 0, 1, 2 in x and y
        nodes = numpy.zeros(shape + (3, 3, 2))
        nodes[row[:, None], column[:, None], place[..., 1], place[..., 0]] = position[cells]
        t = (numpy.arange(N_POINTS) + 0.5) / N_POINTS
        quadratic = numpy.stack(((1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)))
        self.points = numpy.einsum("ai,bj,rcabk->ricjk", quadratic, quadratic, nodes).reshape(-1, 2)
        self.values = (point_values(shape[0]) @ grid @ point_values(shape[1]).T).ravel()
        self.shape = tuple(N_POINTS * n for n in shape)

    def material_point(self, x, y):
        """Current position of the point that was initially at (x widths, y heights)."""
        row, column = (min(int(share * n), n - 1) for share, n in zip((y, x), self.shape))
        return self.points.reshape(self.shape + (2,))[row, column]


def half_maximum(across, profile):
    """(first, last) abscissa of half the peak; NaN if the profile does not fall that far."""
    peak = int(numpy.nanargmax(profile))
    half = 0.5 * profile[peak]
    ends = []
    for step in (-1, 1):
        k = peak
        while 0 <= k + step < len(profile) and not profile[k + step] < half:
            k += step
        if not 0 <= k + step < len(profile):
            return numpy.nan, numpy.nan
        inner, outer = profile[k], profile[k + step]
        ends.append(across[k] + step * (across[1] - across[0]) * (inner - half) / (inner - outer))
    return tuple(ends)


def strip_profiles(increment, centre, angle, half_length, reach):
    """(across, profiles[N_STRIPS, n]) in the frame. A profile holds the mean value of each bin."""
    tangent = numpy.array((numpy.cos(angle), numpy.sin(angle)))
    relative = increment.points - centre
    along, across = relative @ tangent, relative @ (-tangent[1], tangent[0])
    n_bins = 2 * int(reach / increment.h * BINS_PER_ELEMENT) + 1
    size = 2 * reach / n_bins
    inside = (abs(along) < half_length) & (abs(across) < reach)
    strip = ((along[inside] / half_length + 1) / 2 * N_STRIPS).astype(int)
    bin_of = ((across[inside] + reach) / size).astype(int)
    key = strip * n_bins + bin_of
    count = numpy.bincount(key, minlength=N_STRIPS * n_bins)
    total = numpy.bincount(key, weights=increment.values[inside], minlength=N_STRIPS * n_bins)
    with numpy.errstate(invalid="ignore"):
        profiles = (total / count).reshape(N_STRIPS, n_bins)
    return (numpy.arange(n_bins) + 0.5) * size - reach, profiles


def measure(increment, arm):
    centre, angle = increment.material_point(arm.x, arm.y), numpy.radians(arm.angle)
    half_length, reach = arm.half_length * increment.width, 0.3 * increment.width
    along = half_length * ((numpy.arange(N_STRIPS) + 0.5) / N_STRIPS * 2 - 1)
    for _ in range(40):
        across, profiles = strip_profiles(increment, centre, angle, half_length, reach)
        ends = numpy.array([half_maximum(across, profile) for profile in profiles])
        if numpy.isnan(ends).any():  # There is no band, or it leaves the frame.
            break
        slope, offset = numpy.polyfit(along, ends.mean(axis=1), 1)
        centre = centre + offset * numpy.array((-numpy.sin(angle), numpy.cos(angle)))
        angle += numpy.arctan(slope)
        if abs(offset) < 1e-3 * increment.h and abs(slope) < 1e-4:
            break
    thickness = ends[:, 1] - ends[:, 0]
    return Band(thickness.mean(), thickness.std(), (numpy.degrees(angle) + 90) % 180 - 90, centre, half_length, across,
                profiles.mean(axis=0))
