# diptych: look of the report's pictures and their encoding into the page
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours, type sizes, and the one way a figure becomes an embedded picture."""

import base64
import io
from dataclasses import dataclass
from typing import Optional, Tuple

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from PIL import Image

# Okabe and Ito's palette: told apart by colour-blind readers; line styles differ as well, for prints in grey.
GRAINS = "#0072B2"
CONTINUUM = "#D55E00"
INK = "#222222"
FAINT = "#9a9a9a"
NO_VALUE = "#c4c4c4"
DIFFUSE = "diffuse: no band"
PANEL_NAMES = {"discrete": "Grains", "continuum": "Continuum"}
PANEL_COLOURS = {"discrete": GRAINS, "continuum": CONTINUUM}
PANEL_LINES = {"discrete": "-", "continuum": (0, (5, 1.5))}
MAP_DPI = 150


@dataclass(frozen=True)
class Picture:
    """One embedded image. limits: the colour limits read back from what was drawn, None without a colour scale."""

    uri: str
    alt: str
    width: int
    height: int
    limits: Optional[Tuple[float, float]] = None


def set_up():
    """Start from matplotlib's own defaults, so that a user's matplotlibrc cannot change a report."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update({
        "font.size": 9, "axes.titlesize": 10, "axes.labelsize": 9.5, "legend.fontsize": 8.5,
        "xtick.labelsize": 8.5, "ytick.labelsize": 8.5, "axes.edgecolor": INK, "axes.linewidth": 0.7,
        "axes.unicode_minus": True, "legend.frameon": False, "lines.linewidth": 1.6,
        # A stated title height spares matplotlib a search that costs a tenth of the page's time.
        "axes.titley": 1.0, "svg.fonttype": "path", "svg.hashsalt": "diptych", "path.simplify_threshold": 0.3,
    })


def png(figure, alt, limits=None, dpi=MAP_DPI):
    """Raster picture for maps of thousands of shapes, with a palette of 255 colours: a third of the bytes."""
    canvas = FigureCanvasAgg(figure)
    figure.set_dpi(dpi)
    canvas.draw()
    image = Image.frombuffer("RGBA", canvas.get_width_height(), canvas.buffer_rgba(), "raw", "RGBA", 0, 1)
    image = image.convert("RGB").quantize(255, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    stream = io.BytesIO()
    image.save(stream, "png", compress_level=7)
    return _picture(figure, "image/png", stream, alt, limits)


def svg(figure, alt, limits=None):
    """Vector picture for curves. No date is written, so that the same results give the same bytes."""
    stream = io.BytesIO()
    figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return _picture(figure, "image/svg+xml", stream, alt, limits)


def _picture(figure, kind, stream, alt, limits):
    width, height = figure.get_size_inches()
    uri = f"data:{kind};base64," + base64.b64encode(stream.getvalue()).decode("ascii")
    return Picture(uri, alt, round(96 * width), round(96 * height), limits)
