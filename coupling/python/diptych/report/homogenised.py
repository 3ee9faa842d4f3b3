# diptych: report.html of homogenised grains
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from types import SimpleNamespace

import meshio
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from ..files import read_json, read_provenance
from .charts import by_matplotlib, resolution
from .charts.style import GRAINS, INK, NO_VALUE, chart, limit_below, svg, with_intervals
from .data.files import require
from .data.numbers import loading_variable_of, plain, scaled
from .data.panels import DIFFUSE_ZONE
from .page.writing import write
from .tables.wording import number, rounded

WIDTH, TALLEST = 3.6, 4.6  # of a map, inches
CURVES = (("t_over_s", 1.0, "stress ratio t/s", "Stress ratio of the sample."),
          ("volumetric_strain", 100.0, "volumetric strain (%)",
           "Volumetric strain 1 − V/V₀ of the outline; dilation is negative."),
          ("coordination_number", 1.0, "contacts per grain",
           "Mean number of force-carrying contacts per grain, rattlers included."),
          ("anisotropy", 1.0, "anisotropy a of the fabric",
           "Anisotropy a of the contact normals, in the density 1 + a cos 2(θ − θ₀)."))
# key -> (head, unit of the form of numbers)
FRAME = {"s": ("s", "pressure of the files"), "t_over_s": ("t/s", "[95 %]"),
         "direction_deg": ("direction of σ₁", "degrees [95 %]"), "solid_fraction": ("solid fraction", ""),
         "coordination_number": ("contacts per grain", ""), "rattlers": ("rattlers", "grains"),
         "anisotropy": ("anisotropy", "[95 %]"), "fabric_direction_deg": ("direction of the fabric", "degrees [95 %]"),
         "volumetric_strain": ("volumetric strain", "%")}
DECIMALS = {"direction_deg": 1, "fabric_direction_deg": 1, "volumetric_strain": 2, "coordination_number": 2}
BAND = {"angle_deg": ("inclination", "degrees [95 %]"), "width_10_90_d": ("width 10–90", "d [95 %]"),
        "offset_d": ("offset", "d [95 %]"), "jump": ("jump", "of the platens’ travel [95 %]"),
        "dilation_deg": ("dilation", "degrees [95 %]")}
STRAIN = {"strain_xx": "ε xx", "strain_yy": "ε yy", "strain_xy": "ε xy"}


@by_matplotlib.styled()
def draw(folder):
    result = _load(folder)
    write(folder, "homogenised.html", record=result.record, name=os.path.basename(os.path.abspath(folder)),
          command=read_provenance(os.path.join(folder, "provenance.json"))["command"], walk=result.loading_variable,
          frames=_frames(result), increments=_increments(result), maps=_maps(result), curves=_curves(result),
          profiles=_profiles(result), scan=resolution.figures(_relative(result), "s / mean of the sample"))


def _load(folder):
    """record: homogenised.json, with its frames, the increments between successive frames, and `whole`, the one from
    the first to the last frame, if there are more than two. polygons (k, 4, 2) [d] and maps of the last frame; polygons
    have the origin of the files.
    """
    record = read_json(os.path.join(folder, "homogenised.json"), 1)
    frames, increments = record["frames"], record["increments"]
    fields = os.path.join(folder, f"fields_{len(frames) - 1:04d}.vtu")
    require([fields])
    mesh = meshio.vtu.read(fields)
    return SimpleNamespace(record=record, frames=frames, increments=increments[:len(frames) - 1],
                           whole=increments[-1] if len(frames) > 2 else None,
                           loading_variable=loading_variable_of(record["walk"]),
                           polygons=mesh.points[mesh.cells_dict["quad"], :2] / record["mean_diameter"],
                           maps={name: values[0] for name, values in mesh.cell_data.items()})


def _relative(result):
    """The study of the averaging width with s relative to the mean of the sample; {} without forces."""
    study = result.record["resolution_study"]
    if not study:
        return {}
    mean = result.frames[study["frame"]]["s"]
    kernel = [{**row, "points": [{**point, "s": point["s"] / mean} for point in row["points"]]}
              for row in study["kernel"]]
    return {**study, "kernel": kernel}


def _maps(result):
    """List of (Picture, caption) of the last frame; maps without values are left out."""
    shown, last, across = [], result.frames[-1], result.loading_variable
    at = f" at {across.word} {across.text(last['progress'])}" if len(result.frames) > 1 else ""
    if last.get("s"):
        shown += [_map(result, result.maps["s"] / last["s"], "cividis", "s / mean of the sample",
                       f"Mean stress s = (σ₁ + σ₂)/2{at}."),
                  _map(result, result.maps["t_over_s"], "cividis", "stress ratio t/s", f"Stress ratio t/s{at}.")]
    shown.append(_map(result, result.maps["solid_fraction"], "viridis", "solid fraction", f"Solid fraction{at}."))
    for increment, name in ((result.increments[-1:], "shear_strain_increment"),
                            ([result.whole], "shear_strain_since_start")):
        for one in filter(None, increment):
            when = f"from {across.number(one['from'])} to {across.text(one['to'])}"
            shown.append(_map(result, 100 * result.maps[name], "viridis", "shear strain ε₁ − ε₂ (%)",
                              f"Shear strain {when}: {_bands_text(one)}.", increment=one))
    return shown


def _profiles(result):
    """Displacement along the strongest band of the last increment and of the whole loading."""
    found, across = [], result.loading_variable
    for one in [*result.increments[-1:], result.whole]:
        for band in [band for band in (one["bands"][:1] if one else ()) if "profile" in band]:
            profile, half = band["profile"], 0.5 * band["width_10_90_d"]["value"]
            figure, axes = chart(result, "displacement along the band / travel")
            axes.axvspan(-half, half, color=GRAINS, alpha=0.15)
            axes.plot(profile["distance_d"], [np.nan if y is None else y for y in profile["displacement"]], "o-",
                      color=GRAINS, markersize=3.5)
            axes.set(xlabel="distance from the middle of the band / d")
            caption = f"Profile from {across.number(one['from'])} to {across.text(one['to'])}; shaded: 10–90 % width."
            found.append((svg(figure, caption), caption))
    return found


def _bands_text(increment):
    n = sum(not band.get("diffuse") for band in increment["bands"])
    return f"{n} band{'s' if n > 1 else ''} (solid: middle, dashed: 10–90 % width)" if n else increment["band_verdict"]


def _map(result, values, colours, label, caption, *, increment=None):
    low, high = result.polygons.reshape(-1, 2).min(0), result.polygons.reshape(-1, 2).max(0)
    size = high - low
    scale = min((WIDTH - 0.2) / size[0], TALLEST / size[1])
    height = scale * size[1] + 1.05
    figure = Figure(figsize=(WIDTH, height))
    axes = figure.add_axes([0.5 - scale * size[0] / WIDTH / 2, 1.0 / height, scale * size[0] / WIDTH,
                            scale * size[1] / height])
    known = values[np.isfinite(values)]
    limits = np.percentile(known, (2, 98)) if len(known) else (0, 1)
    cells = PolyCollection(result.polygons, array=np.ma.masked_invalid(values), cmap=colours, edgecolors="face",
                           linewidths=0.3)
    cells.get_cmap().set_bad(NO_VALUE)
    cells.set_clim(*limits)
    axes.add_collection(cells)
    for band in [band for band in increment["bands"] if not band.get("diffuse")] if increment else []:
        _draw_band(axes, band, result.record["mean_diameter"], 2 * np.hypot(*size))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.axis("off")
    _scale_bar(figure, scale, size[0], height)
    bar = figure.colorbar(cells, cax=figure.add_axes([0.42, 0.66 / height, 0.53, 0.12 / height]),
                          orientation="horizontal", extend="both")
    bar.set_label(label)
    bar.ax.locator_params(nbins=4)
    return by_matplotlib.svg(figure, f"Map: {caption}"), caption


def _draw_band(axes, band, diameter, length):
    middle = np.array(band["middle"]) / diameter
    angle = np.radians(band["angle_deg"]["value"])
    along, across = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    for side, look in ((0, "-"), (-0.5, (0, (4, 2))), (0.5, (0, (4, 2)))):
        at = middle + side * band["width_10_90_d"]["value"] * across
        ends = np.array([at - length * along, at + length * along])
        axes.plot(*ends.T, color="white", linewidth=2.2)
        axes.plot(*ends.T, color=INK, linewidth=1.2 if side == 0 else 0.8, linestyle=look)


def _scale_bar(figure, scale, width, height):
    """A bar of 1, 2 or 5 times a power of ten d, at most a third of the width."""
    power = 10.0 ** np.floor(np.log10(width / 3))
    length = max(k * power for k in (1, 2, 5) if k * power <= width / 3)
    axes = figure.add_axes([0.03, 0.5 / height, 0.37, 0.4 / height])
    axes.set(xlim=(0, 0.37 * WIDTH), ylim=(0, 0.4))
    axes.plot([0.05, 0.05 + scale * length], [0.22, 0.22], color=INK, linewidth=2, solid_capstyle="butt")
    axes.text(0.05, 0.02, f"{length:g} d", va="bottom", fontsize=8.5)
    axes.axis("off")


def _curves(result):
    """List of (Picture, caption) over the frames."""
    found, across = [], result.loading_variable.factor
    for key, factor, label, caption in CURVES:
        known = [frame for frame in result.frames if plain(frame.get(key)) is not None]
        if len(known) < 2:
            continue
        figure, axes = chart(result, label)
        numbers = [scaled(frame[key], factor) for frame in known]
        at = [across * frame["progress"] for frame in known]
        axes.plot(at, [plain(number) for number in numbers], color=GRAINS, linewidth=1)
        with_intervals(axes, at, numbers, fmt="o", markersize=4, color=GRAINS)
        limit_below(axes, key == "volumetric_strain")
        found.append((svg(figure, f"{label} over {result.loading_variable.word}."), caption))
    return found + [_band_curve(result, *look) for look in (("angle_deg", "inclination of the bands (degrees)"),
                                                       ("width_10_90_d", "10–90 % width of the bands (d)"))
                    if sum(len(one["bands"]) > 0 for one in result.increments) > 1]


def _band_curve(result, key, label):
    figure, axes = chart(result, label)
    across = result.loading_variable.factor
    for rank, fill in ((0, GRAINS), (1, "white")):
        rows = [one for one in result.increments if len(one["bands"]) > rank
                and not (key == "angle_deg" and one["bands"][rank].get("diffuse"))]
        at, numbers = [across * one["to"] for one in rows], [one["bands"][rank][key] for one in rows]
        with_intervals(axes, at, numbers, fmt="o", markersize=4.5, color=GRAINS, markerfacecolor=fill)
    if key == "angle_deg":
        axes.set(ylim=(-90, 90), yticks=range(-90, 91, 30))
    else:
        axes.set(ylim=(0, None))
    return (svg(figure, f"{label} over {result.loading_variable.word}."),
            f"{label[0].upper() + label[1:]}, at the end of each increment. Filled: the stronger band; "
            "open: the other one.")


def _frames(result):
    """One row per frame; "missing" where the files hold no forces."""
    across = result.loading_variable
    rows = [[across.number(frame["progress"])] + [_cell(frame, key) for key in FRAME] for frame in result.frames]
    return {"head": [(across.word, across.unit.strip()), *FRAME.values()], "rows": rows}


def _cell(frame, key):
    if frame.get(key) is None:
        return "missing"
    if key == "s":
        return number(frame[key])
    return rounded(scaled(frame[key], 100 if key == "volumetric_strain" else 1), "", DECIMALS.get(key))


def _increments(result):
    """One row per increment and band."""
    across, rows = result.loading_variable, []
    for one in result.record["increments"]:
        place = f"{across.number(one['from'])}–{across.number(one['to'])}"
        strain = ["missing" if one[key] is None else rounded(100 * one[key], "", 3) for key in STRAIN]
        for band in one["bands"] or [None]:
            values = [DIFFUSE_ZONE if key == "angle_deg" and band.get("diffuse") else
                      rounded(band[key], "", 2 if key == "jump" else 1) for key in BAND if band]
            values = values or [one["band_verdict"]]
            rows.append([place, *strain, *values, *[""] * (len(BAND) - len(values))])
            place, strain = "", [""] * len(strain)
    strains = [(name, "%") for name in STRAIN.values()]
    return {"head": [(across.word, across.unit.strip()), *strains, *BAND.values()], "rows": rows}
