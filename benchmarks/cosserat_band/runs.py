# diptych: runs of the continuum panel with several lengths, sizes and laws, and their numbers
# SPDX-License-Identifier: LGPL-2.1-or-later
import csv
import json
import os
import subprocess
import sys

import numpy

from width import Arm, Increment, measure

HERE = os.path.dirname(os.path.abspath(__file__))
STRAINS = (0.02, 0.04, 0.08)
# First guess of the measured arm. In the X it is the lower left arm, half way between crossing and corner.
ARMS = {"oblique": Arm(0.5, 0.5, -45, 0.3), "vertical": Arm(0.25, 0.25, 43, 0.11), "smooth": Arm(0.5, 0.27, 47, 0.25)}
LENGTHS, SIZES, LOCAL_ELEMENTS = (1, 2, 4), (40, 60, 90, 120), (4, 2, 1)


class Runs:
    def __init__(self, options, folder, scenes=HERE):
        self.program, self.reuse, self.folder, self.scenes = options.program, options.reuse, folder, scenes

    def __call__(self, scene, **keys):
        """Result folder of `scene` with the given keys of its section continuum. axial_strain is a key of the section
        loading."""
        keys = {key: value if isinstance(value, str) else f"{value:g}" for key, value in keys.items()}
        name = "_".join([scene] + [f"{key}={value}" for key, value in keys.items()])
        folder = os.path.join(self.folder, name)
        if self.reuse and os.path.exists(os.path.join(folder, "provenance.json")) and facts(folder)["finished"]:
            return folder
        words = ["--set", "comparison/coarse_element_size=100"]  # Larger than the sample: no second mesh.
        for key, value in keys.items():
            words += ["--set", f"{'loading' if key == 'axial_strain' else 'continuum'}/{key}={value}"]
        done = subprocess.run([self.program, "continuum", os.path.join(self.scenes, scene + ".prm"), "--output", folder,
                               "--overwrite", "--quiet", *words], capture_output=True, text=True)
        if done.returncode not in (0, 3):
            sys.stderr.write(f"band.py: {name} ended with exit code {done.returncode}: {done.stderr.strip()}\n")
            sys.exit(2)
        return folder


def facts(folder):
    with open(os.path.join(folder, "provenance.json")) as file:
        record = json.load(file)
    seconds = sum(phase["cpu_s"] for phase in record["phases"] if phase["name"] == "continuum")
    return dict(record["continuum"], seconds=seconds)


def history(folder):
    with open(os.path.join(folder, "continuum.csv")) as file:
        return [{key: float(value) for key, value in row.items() if key != "walk"} for row in csv.DictReader(file)]


def bands(folder, scene, strains=STRAINS):
    """Bands of the increments of 1 % that end at these strains; None beyond the strain that the run reached."""
    reached = facts(folder)["reached_axial_strain"]
    return [measure(Increment(folder, e), ARMS[scene]) if e < reached + 1e-9 else None for e in strains]


def thicknesses(folder, scene, strains=STRAINS):
    return numpy.array([numpy.nan if band is None else band.thickness for band in bands(folder, scene, strains)])


def size_runs(runs):
    return {size: runs("oblique", internal_length=2, element_size=1) if size == 60 else
            runs("oblique", internal_length=2, element_size=1, rectangle_width=size, rectangle_height=size)
            for size in SIZES}


def length_runs(runs):
    return {length: runs("oblique", internal_length=length, element_size=length / 2) for length in LENGTHS}


def power(x, y):
    """(factor, exponent, largest relative misfit) of y = factor x^exponent."""
    exponent, offset = numpy.polyfit(numpy.log(x), numpy.log(y), 1)
    return numpy.exp(offset), exponent, numpy.max(abs(numpy.exp(offset) * numpy.power(x, exponent) / y - 1))
