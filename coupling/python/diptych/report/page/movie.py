# diptych: movie.gif, the shear strain of both panels stage by stage
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from PIL import Image

from ...files import part_of
from ..charts.by_matplotlib import styled
from ..data.panels import PANEL_NAMES
from ..data.result import load
from .quantities import QUANTITIES, box, limits

MOST_FRAMES = 40  # about 5 MB
SECONDS, LAST_SECONDS = 0.5, 2.0
SHEAR = QUANTITIES[0]


@styled()
def draw(folder):
    """Writes movie.gif: one frame per stage, or 40 evenly spaced stages of more."""
    result = load(folder, folder)
    stages = result.stages
    limit = limits(SHEAR, SHEAR.home, stages, result)
    scale = Normalize(0, max(limit(stage)[1] for stage in stages))
    shown = np.unique(np.linspace(0, len(stages) - 1, MOST_FRAMES).round().astype(int))
    frames = [_frame(result, stages[k], box(stages), scale) for k in shown]
    seconds = [SECONDS] * (len(frames) - 1) + [LAST_SECONDS]
    with part_of(os.path.join(folder, "movie.gif")) as part:
        frames[0].save(part, format="GIF", save_all=True, append_images=frames[1:], loop=0,
                       duration=[int(1000 * s) for s in seconds])


def _frame(result, stage, limits_of_axes, scale):
    """Grains as discs on the left, the continuum on the right. The colour is the shear strain that the stage adds."""
    x0, x1, y0, y1 = limits_of_axes
    width = 4.0
    height = width * (y1 - y0) / (x1 - x0)
    figure = Figure(figsize=(2 * width + 1.0, height + 0.75), dpi=100)
    of = figure.get_size_inches()
    for k, (panel, name) in enumerate(PANEL_NAMES.items()):
        axes = figure.add_axes([k * width / of[0], 0.08 / of[1], width / of[0], height / of[1]])
        axes.set(xlim=(x0, x1), ylim=(y0, y1))
        axes.axis("off")
        axes.set_title(name, fontweight="bold")
        values = SHEAR.values(stage, result, SHEAR.home, panel)
        (_discs if panel == "discrete" else _smooth)(axes, stage, values, norm=scale, cmap=SHEAR.colour_map)
    bar = figure.add_axes([2 * width / of[0], 0.15, 0.18 / of[0], 0.6])
    figure.colorbar(ScalarMappable(scale, SHEAR.colour_map), cax=bar, extend="max", label=SHEAR.label(result))
    across = stage.loading_variable
    figure.suptitle(f"{across.word} {across.text(stage.end)}; shear strain added since {across.text(stage.start)}",
                    fontsize=12)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB").quantize(128)


def _discs(axes, stage, values, **look):
    size = 2 * stage.arrays["discrete/radius"]
    shapes = axes.add_collection(EllipseCollection(
        size, size, 0 * size, units="xy", offsets=stage.arrays["discrete/position"], offset_transform=axes.transData,
        linewidths=0, **look))
    shapes.set_array(np.ma.masked_invalid(values))


def _smooth(axes, stage, values, **look):
    """Colours between nodes; the value of a node is the mean over its cells."""
    nodes, cells = np.unique(stage.arrays["cells/corners"].reshape(-1, 2), axis=0, return_inverse=True)
    of_node = np.bincount(cells, np.repeat(values, 4)) / np.bincount(cells)
    corners = cells.reshape(-1, 4)
    triangles = np.concatenate([corners[:, :3], corners[:, [0, 2, 3]]])
    axes.tripcolor(*nodes.T, triangles, of_node, shading="gouraud", **look)
