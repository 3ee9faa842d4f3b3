# diptych: figure of a study of the time step
# SPDX-License-Identifier: LGPL-2.1-or-later

import os

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from .style import GRAINS, INK, THIRD, decades, ruled, set_up
from ..data.files import read_csv, read_json, require

LOOKS = ((THIRD, (0, (5, 1.5))), (GRAINS, (0, (1.5, 1))), (INK, "-"))
# (column of study_step.csv, title, line width)
PANELS = (("stress_ratio_mean", "stress ratio t/s, running mean", 1.5),
          ("external_work", "work of platens, pressure [pressure length$^2$]", 1.5),
          ("friction_dissipation", "dissipated by friction [pressure length$^2$]", 1.5),
          ("impact_dissipation", "dissipated by impacts [pressure length$^2$]", 1.5),
          ("kinetic_energy", "kinetic energy [pressure length$^2$]", 0.7),
          ("max_penetration", "largest penetration [d]", 0.7))
LOGARITHMIC = ("kinetic_energy", "max_penetration")


def draw(folder):
    """Writes study_step.png, in the units of the scene. Raises InputError if a file is missing or broken."""
    paths = [os.path.join(folder, name) for name in ("study_step.json", "study_step.csv")]
    require(paths)
    record, table = read_json(paths[0]), read_csv(paths[1])
    runs = [(step, {name: column[table["step"] == step] for name, column in table.items()}) for step in record["steps"]]
    set_up()
    figure = Figure(figsize=(10.5, 6.4))
    for k, panel in enumerate(PANELS):
        axes = ruled(figure.add_axes([0.05 + 0.325 * (k % 3), 0.525 - 0.46 * (k // 3), 0.285, 0.35]))
        _panel(axes, runs, *panel)
        axes.tick_params(labelbottom=k >= 3)
        axes.set_xlabel("time" if k >= 3 else "")
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=len(labels) or 1, bbox_to_anchor=(0.5, 0.965))
    figure.suptitle(record["verdict"], fontsize=9.5, y=0.99)
    path = os.path.join(folder, "study_step.png")
    FigureCanvasAgg(figure)
    figure.savefig(path + ".part", format="png", dpi=120)
    os.replace(path + ".part", path)


def _panel(axes, runs, name, label, width):
    """runs: [(step, {column: array})], the longest step first."""
    known = [(step, run["time"], run[name]) for step, run in runs if name in run]
    for (step, time, values), (colour, dashes) in zip(known, LOOKS * len(known)):
        axes.plot(time, values, color=colour, linestyle=dashes, linewidth=width, label=f"step {step:g}")
    axes.set_title(label, loc="left", fontsize=9.5)
    if not known:
        axes.text(0.5, 0.5, "not computed", transform=axes.transAxes, ha="center")
    every = [value for _, _, values in known for value in values if value > 0]
    if name in LOGARITHMIC and known and len(every) == sum(len(values) for _, _, values in known):
        axes.set(yscale="log", ylim=decades(np.array(every)))
        axes.yaxis.set_minor_formatter(NullFormatter())
