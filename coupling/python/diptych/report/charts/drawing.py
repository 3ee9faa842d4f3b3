# diptych: charts as SVG: lines, marks, bars and fills in axes with numbers and a legend
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Methods and options have matplotlib's names. A page has a hundred charts; matplotlib would take seconds for them.

Lengths are points (1/72 inch). A coordinate of ±inf means the edge of the axes, NaN interrupts a line.
"""

from html import escape

import numpy as np

from ...plotting import INK

GRID = "#e4e4e4"
NUMBER, LABEL, TITLE = 8.5, 9.5, 10  # sizes of text
LETTER = 0.58                        # mean width of a letter over its size
ROW, HANDLE = 13.7, 20               # height of a row of the legend, length of the line in it
APART_X, APART_Y = 42, 24            # least distance of numbers
DASHES = {"-": (), "--": (3.7, 1.6), ":": (1, 1.65), "-.": (6.4, 1.6, 1, 1.6)}  # over the width of the line
CORNERS = {"s": [(-1, -1), (1, -1), (1, 1), (-1, 1)], "D": [(0, -1.3), (1.3, 0), (0, 1.3), (-1.3, 0)],
           "^": [(-1, 1), (0, -1), (1, 1)]}


class Axis:
    """One direction: label, limits, numbers, and the place of a value."""

    def __init__(self):
        self.label, self.is_log, self.has_numbers = "", False, True
        self.given, self.data, self.ticks = (None, None), (np.inf, -np.inf), None

    def include(self, values):
        known = values[np.isfinite(values) & ((values > 0) | (not self.is_log))]
        self.data = min(known.min(initial=np.inf), self.data[0]), max(known.max(initial=-np.inf), self.data[1])

    def limits(self):
        """The given limits, or those of the data with a margin of 5 %."""
        low, high = self.data if self.data[0] <= self.data[1] else (0.1, 1)
        if self.is_log:
            room = (high / low) ** 0.05
            found = low / room, high * room
        else:
            room = 0.05 * (high - low or abs(high) or 1)
            found = low - room, high + room
        return tuple(end if given is None else given for given, end in zip(self.given, found))

    def place(self, values):
        """Values as shares of the axis from its low to its high limit."""
        low, high = self.limits()
        if self.is_log:
            with np.errstate(divide="ignore", invalid="ignore"):
                values, low, high = np.log(np.maximum(values, 0)), np.log(low), np.log(high)
        return np.clip((values - low) / (high - low), -9, 10)

    def numbers(self, most):
        """[(value, text)] within the limits, about `most` at most."""
        low, high = self.limits()
        if self.ticks is not None:
            return [(value, text) for value, text in self.ticks if min(low, high) <= value <= max(low, high)]
        if self.is_log:
            powers = np.arange(np.ceil(np.log10(low) - 1e-9), np.log10(high) + 1e-9)
            return [(10.0 ** k, f"{10.0 ** k:g}") for k in powers[::int(np.ceil(len(powers) / most)) or 1]]
        power = 10 ** np.floor(np.log10((high - low) / most))
        step = next(k for k in (1, 2, 2.5, 5, 10, 20) if k * power * most >= high - low) * power
        values = step * np.arange(np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9) + 1)
        digits = max(0, int(np.ceil(-np.log10(step) - 1e-9))) + (f"{step:.0e}" != f"{step:.1e}".replace(".0", ""))
        return [(value, f"{value:.{digits if step < 10 else 0}f}".replace("-", "−")) for value in values + 0.0]


class Axes:
    """box: left, bottom, width, height from the lower left corner of the figure."""

    def __init__(self, box):
        self.left, self.bottom, self.width, self.height = box
        self.x, self.y = Axis(), Axis()
        self.is_empty, self.has_frame, self.columns = True, True, 0
        self.fills, self.strokes, self.entries, self.titles, self.texts = [], [], [], {}, []

    def _add(self, shapes, x, y, draw):
        """draw(px, py): SVG from points of the figure."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        self.x.include(x)
        self.y.include(y)
        self.is_empty &= not len(x)
        shapes.append((x, y, draw))

    def _name(self, label, handle):
        """handle(x, y): SVG of a sample in the legend, from x to x + HANDLE about the height y."""
        if label:
            self.entries.append((label, handle))

    def plot(self, x, y, fmt="", *, label=None, linestyle=None, marker="", **look):
        """A line and marks at its points. fmt: a mark, "-", or both like "o-"; default: a line."""
        dashes = linestyle if linestyle is not None else "-" if not fmt or "-" in fmt else ""
        mark = marker or fmt.strip("-")
        self._add(self.strokes, x, y, lambda px, py: _line(px, py, dashes, **look) + _marks(px, py, mark, **look))
        self._name(label, lambda x, y: _line(np.array([x, x + HANDLE]), np.array([y, y]), dashes, **look) +
                   _marks([x + HANDLE / 2], [y], mark, **look))

    def errorbar(self, x, y, bars, fmt="", *, label=None, color=INK, ecolor=None, elinewidth=1, capsize=0, **look):
        """Points with bars down and up, of lengths (n) or (2, n). fmt "none": bars alone."""
        x, y, bars = np.asarray(x, float), np.asarray(y, float), np.asarray(bars, float)
        down, up = bars if bars.ndim == 2 else (bars, bars)

        def draw(px, py):
            cap = f"m{-capsize} 0h{2 * capsize}"
            return _path("".join(f"M{at:.1f} {a:.1f}V{b:.1f}{cap}M{at:.1f} {a:.1f}{cap}"
                                 for at, a, b in zip(px, *py.reshape(2, -1)) if np.isfinite(at + a + b)),
                         ecolor or color, elinewidth)

        self._add(self.strokes, np.tile(x, 2), np.concatenate([y - down, y + up]), draw)
        if fmt == "none":
            self._name(label, lambda x, y: draw(np.full(1, x + HANDLE / 2), np.array([y + 4, y - 4])))
        else:
            self.plot(x, y, fmt, label=label, color=color, **look)

    def fill(self, x, y, *, color=INK, alpha=1.0, edge="none", label=None):
        """Polygons, apart at NaN."""
        def draw(px, py):
            return (f'<path d="{_through(px, py, "Z")}" fill="{color}" fill-opacity="{alpha}" stroke="{edge}" '
                    'stroke-width=".5"/>')

        self._add(self.fills, x, y, draw)
        self._name(label, lambda x, y: draw(x + np.array([0, HANDLE, HANDLE, 0]), y + np.array([4, 4, -4, -4])))

    def fill_between(self, x, low, high, **look):
        x, low, high = (np.asarray(one, float) for one in (x, low, high))
        across, along = [], []
        for part in np.split(np.arange(len(x)), np.flatnonzero(~np.isfinite(low + high))):
            part = part[np.isfinite(low[part] + high[part])]
            across += [*x[part], *x[part][::-1], np.nan]
            along += [*low[part], *high[part][::-1], np.nan]
        self.fill(across, along, **look)

    def stairs(self, values, edges, *, fill=False, **look):
        x, y = np.repeat(edges, 2), np.repeat(values, 2)
        if fill:
            self.fill(x, [0, *y, 0], **look)
        else:
            self.plot(x[1:-1], y, **look)

    def axvspan(self, low, high, **look):
        self.fill([low, high, high, low], np.array([-1, -1, 1, 1]) * np.inf, **look)

    def axhline(self, y, *, color=INK, linewidth=1, **look):
        self.plot([-np.inf, np.inf], [y, y], color=color, linewidth=linewidth, **look)

    def axvline(self, x, *, color=INK, linewidth=1, **look):
        self.plot([x, x], [-np.inf, np.inf], color=color, linewidth=linewidth, **look)

    def text(self, x, y, words):
        """x, y: shares of the axes."""
        self.texts.append((x, y, words))

    def set(self, *, xlabel=None, ylabel=None, xlim=None, ylim=None, xticks=None, yticks=None):
        for axis, label, ends, ticks in ((self.x, xlabel, xlim, xticks), (self.y, ylabel, ylim, yticks)):
            axis.label = axis.label if label is None else label
            axis.given = axis.given if ends is None else tuple(ends)
            axis.ticks = axis.ticks if ticks is None else [
                one if isinstance(one, tuple) else (one, f"{one:g}".replace("-", "−")) for one in ticks]

    def title(self, words, loc="left"):
        self.titles[loc] = words

    def legend(self, columns=2):
        """Above the axes, where it lies on no data; fewer columns if the labels are long."""
        self.columns = columns

    # From here on: drawing.

    def rows(self):
        """[[(label, handle)]] of the legend, and the widths of its columns."""
        for n in range(min(self.columns, len(self.entries)), 0, -1):
            rows = [self.entries[k:k + n] for k in range(0, len(self.entries), n)]
            widths = [max(HANDLE + 12 + LETTER * NUMBER * len(row[k][0]) for row in rows if k < len(row))
                      for k in range(n)]
            if n == 1 or sum(widths) < self.left + self.width - 6:
                return rows, widths
        return [], []

    def above(self):
        """Height of legend and titles."""
        return ROW * len(self.rows()[0]) + (16 if self.titles else 0)

    def svg(self, name, top):
        """name: of the clip path. top: height of the figure."""
        left, up = self.left, top - self.bottom - self.height
        shown = "".join(draw(left + self.width * self.x.place(x), up + self.height * (1 - self.y.place(y)))
                        for x, y, draw in self.fills + self.strokes)
        box = f'x="{left:.1f}" y="{up:.1f}" width="{self.width:.1f}" height="{self.height:.1f}"'
        grid, numbers = self._grid(left, up) if self.has_frame else ("", "")
        frame = f'<rect {box} fill="none" stroke="{INK}" stroke-width=".7"/>' if self.has_frame else ""
        texts = "".join(_text(left + self.width * x, up + self.height * (1 - y), words)
                        for x, y, words in self.texts)
        return (f'<clipPath id="{name}"><rect {box}/></clipPath>{grid}<g clip-path="url(#{name})">{shown}</g>'
                f'{frame}{numbers}{texts}{self._heads(left, up)}')

    def _grid(self, left, up):
        down, words, path, ticks, longest = up + self.height, [], "", "", 0
        for value, text in self.x.numbers(self.width / APART_X):
            at = left + self.width * float(self.x.place(value))
            path += f"M{at:.1f} {up:.1f}v{self.height:.1f}"
            ticks += f"M{at:.1f} {down:.1f}v3.5"
            words += [_text(at, down + 13, text)] if self.x.has_numbers else []
        for value, text in self.y.numbers(self.height / APART_Y):
            at = down - self.height * float(self.y.place(value))
            path += f"M{left:.1f} {at:.1f}h{self.width:.1f}"
            ticks += f"M{left:.1f} {at:.1f}h-3.5"
            words.append(_text(left - 6, at + 3, text, anchor="end"))
            longest = max(longest, LETTER * NUMBER * len(text))
        words.append(_text(left + self.width / 2, down + 28, self.x.label, LABEL))
        x, y = max(9, left - 12 - longest), up + self.height / 2
        words.append(_text(x, y, self.y.label, LABEL, more=f' transform="rotate(-90 {x:.1f} {y:.1f})"'))
        return _path(path, GRID, 0.6), _path(ticks, INK, 0.7) + "".join(words)

    def _heads(self, left, up):
        found, (rows, widths) = "", self.rows()
        for k, row in enumerate(rows):
            y = up - 6 - ROW * (len(rows) - 1 - k)
            for n, (label, handle) in enumerate(row):
                x = max(2, left + min(0, self.width - sum(widths))) + sum(widths[:n])
                found += handle(x, y) + _text(x + HANDLE + 5, y + 3, label, anchor="start")
        places = {"left": (left, "start"), "center": (left + self.width / 2, "middle"),
                  "right": (left + self.width, "end")}
        for loc, words in self.titles.items():
            x, anchor = places[loc]
            found += _text(x, up - 6 - ROW * len(rows), words, TITLE if loc == "left" else NUMBER, anchor=anchor,
                           more=' font-weight="bold"' if loc == "left" else "")
        return found


class Figure:
    """Axes in boxes (left, bottom, width, height), shares of the size [inch]. It grows by what stands above the top."""

    def __init__(self, size, boxes):
        self.width, self.height = 72 * size[0], 72 * size[1]
        self.axes = [Axes((a * self.width, b * self.height, w * self.width, h * self.height)) for a, b, w, h in boxes]

    def svg(self):
        """(text, width, height)"""
        top = max(self.height, *(one.bottom + one.height + one.above() + 4 for one in self.axes), 0)
        shown = "".join(one.svg(f"c{k}", top) for k, one in enumerate(self.axes))
        text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width:.1f} {top:.1f}" '
                f'font-family="DejaVu Sans, Verdana, Arial, sans-serif" fill="{INK}">{shown}</svg>')
        return text, self.width, top


def _through(px, py, end=""):
    """Path through points, apart at NaN; end "Z" closes the parts."""
    points, found = np.column_stack([px, py]), ""
    for part in np.split(points, np.flatnonzero(~np.isfinite(px + py))):
        part = part[np.isfinite(part).all(1)]
        if len(part) > 1:
            found += "M" + " ".join(map("{:.1f} {:.1f}".format, *part.T.tolist())) + end
    return found


def _path(d, color, linewidth, more=""):
    return f'<path d="{d}" fill="none" stroke="{color}" stroke-width="{linewidth}"{more}/>' if d else ""


def _line(px, py, dashes, *, color=INK, linewidth=1.6, alpha=1, **_):
    if not dashes:
        return ""
    pattern = DASHES[dashes] if isinstance(dashes, str) else dashes[1]
    drawn = " ".join(f"{linewidth * length:.2f}" for length in pattern)
    return _path(_through(px, py), color, linewidth, (f' stroke-dasharray="{drawn}"' if drawn else "") +
                 (f' stroke-opacity="{alpha}"' if alpha < 1 else ""))


def _marks(px, py, shape, *, color=INK, alpha=1, markersize=6, markerfacecolor=None, markeredgewidth=1, **_):
    if not shape:
        return ""
    r = markersize / (4 if shape == "." else 2)
    if shape in CORNERS:
        outline = "".join(f"{'ml'[k > 0]}{r * (x - a):.2f} {r * (y - b):.2f}" for k, ((x, y), (a, b)) in enumerate(
            zip(CORNERS[shape], [(0, 0), *CORNERS[shape]]))) + "z"
    else:
        outline = f"m{-r} 0a{r} {r} 0 1 0 {2 * r} 0a{r} {r} 0 1 0 {-2 * r} 0z"
    path = "".join(f"M{x:.1f} {y:.1f}{outline}" for x, y in zip(px, py) if np.isfinite(x) and np.isfinite(y))
    return (f'<path d="{path}" fill="{markerfacecolor or color}" stroke="{color}" stroke-width="{markeredgewidth}" '
            f'opacity="{alpha}"/>')


def _text(x, y, words, size=NUMBER, *, anchor="middle", more=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}"{more}>{escape(words)}</text>'
            if words else "")
