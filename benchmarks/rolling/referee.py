#!/usr/bin/env python3
# diptych: rolling resistance in LAMMPS, on a slope and on the same samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""referee.py [PROGRAM --output DIR] [--seeds 11,12,...]

Prints the results stored in referee.csv: dense biaxial tests (../rigid_limit/samples, 1000 discs) with rolling friction
0.1 by LAMMPS, by springs of the same stiffness and by contact dynamics. With PROGRAM it first lets a disc roll down a
slope in LAMMPS, then makes the runs (those in DIR are kept) and stores them again. Needs lmp (Debian package lammps),
h5py, numpy, pandas."""
import argparse
import os
import re
import subprocess
import sys

import numpy
import pandas

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../rigid_limit"))
import lammps  # noqa: E402
import rigid_limit  # noqa: E402
from rigid_limit import claims  # noqa: E402

STORED = os.path.join(HERE, "referee.csv")
INERTIAL, ROLLING = 1.13e-3, 0.1
METHODS = {"LAMMPS, kn/P = 1e4": 1e4, "penalty, 1e4": ("discrete/method=penalty", "discrete/penalty_stiffness=1e4"),
           "NSCD, accuracy 0.01": ("discrete/accuracy=0.01",)}
REFERENCE = "LAMMPS, kn/P = 1e4"
# Slope [rad], friction, rolling friction.
SLOPE_CASES = ((0.3, 0.5, 0.1), (0.3, 0.5, 0.4), (0.3, 0.1, 0.1), (0.05, 0.5, 0.1))
# A disc of radius 1/2 and mass pi/4, whose weight is pi/4 at a slope of 0, on a plane; springs of 1e6.
SLOPE = """units lj
dimension 2
boundary f f p
newton off
comm_modify vel yes
atom_style sphere
atom_modify map yes
region box block -3 60 -3 3 -0.5 0.5
create_box 1 box
create_atoms 1 single 0 0.499999 0
set atom 1 diameter 1.0
set group all density/disc 1.0
timestep 1e-4
pair_style gran/hooke/history 1e6 5e5 0 0 0 0
pair_coeff * *
region floor plane 0 0 0 0 1 0 side in
fix w all wall/gran/region granular hooke 1e6 200.0 damping mass_velocity tangential linear_history 5e5 0.0 {mu} &
  rolling sds 1e6 0.0 {mu_r} region floor
fix g all gravity 1.0 vector {along} -{across} 0
fix m all nve/sphere disc
compute v all property/atom vx
variable v equal c_v[1]
fix out all print 100000 "velocity ${{v}}"
run 100000
"""


def slope_acceleration(slope, mu, mu_r):
    """Acceleration of a disc from rest on a plane [g]. It sticks, rolls or slides. Rolling: m a = m g sin - T and
    (m r^2/2) a/r = r T - mu_r r N."""
    along, across = numpy.sin(slope), numpy.cos(slope)
    if along < min(mu, mu_r) * across:
        return 0.
    rolls = 2 / 3 * (along - mu_r * across)
    return rolls if rolls / 2 + mu_r * across <= mu * across else along - mu * across


def slopes():
    for slope, mu, mu_r in SLOPE_CASES:
        script = SLOPE.format(mu=mu, mu_r=mu_r, along=numpy.sin(slope), across=numpy.cos(slope))
        log = subprocess.run(["lmp", "-log", "none"], input=script, check=True, capture_output=True, text=True).stdout
        velocity = float(re.findall(r"^velocity (\S+)", log, re.MULTILINE)[-1])
        print(f"slope {slope} rad, friction {mu}, rolling {mu_r}: acceleration {velocity / 10:.5f} g, "
              f"closed form {slope_acceleration(slope, mu, mu_r):.5f} g")


def load(options, seed, method):
    """(binned columns, CPU seconds of the loading) of one run."""
    settings, folder = METHODS[method], f"{options.output}/{re.sub('[ ,/=]+', '_', method)}"
    sample, strain = rigid_limit.sample_file(seed), rigid_limit.STRAIN
    if isinstance(settings, float):
        done = f"{folder}/seed_{seed}/binned.npz"
        if not os.path.exists(done):
            columns, seconds = lammps.run(sample, os.path.dirname(done), settings, INERTIAL, strain,
                                          rolling_friction=ROLLING)
            numpy.savez(done, cpu_s=seconds, **rigid_limit.binned(columns))
        columns = dict(numpy.load(done))
        return columns, float(columns.pop("cpu_s"))
    runs = claims.Runs(argparse.Namespace(program=options.program, reuse=True, set=[]), seed, folder)
    return rigid_limit.of_panel(runs.run(f"seed_{seed}", "discrete", rigid_limit.SCENE,
                                         f"loading/axial_strain={strain}",
                                         "loading/stage_strain=0.01", f"sample/file={sample}",
                                         f"discrete/rolling_friction={ROLLING}", *settings))


def measured(options):
    rows = []
    for seed in options.seeds:
        for method in METHODS:
            columns, seconds = load(options, seed, method)
            rows.append({"method": method, "seed": seed, "strength": rigid_limit.strength(columns, *rigid_limit.JUDGED),
                         "dilation": -100 * columns["volumetric_strain"][-1], "cpu_s": seconds})
            print(rows[-1], flush=True)
    return pandas.DataFrame(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath, nargs="?")
    parser.add_argument("--output", type=os.path.abspath)
    parser.add_argument("--seeds", type=lambda text: [int(word) for word in text.split(",")], default=range(11, 23))
    options = parser.parse_args()
    if options.program:
        slopes()
        measured(options).to_csv(STORED, index=False, float_format="%.6g")
    table = pandas.read_csv(STORED)
    for column in ("strength", "dilation"):
        wide = table.pivot(index="seed", columns="method", values=column)
        print(f"\n{column}: mean, standard error; difference from {REFERENCE} sample by sample [%]")
        for method in METHODS:
            mean, error = claims.mean_and_error(wide[method])
            change, change_error = claims.mean_and_error(100 * (wide[method] - wide[REFERENCE])
                                                         / wide[REFERENCE].mean())
            seconds = table[table.method == method].cpu_s.mean()
            print(f"{method:22} {mean:.4f} +- {error:.4f}   {change:+.2f} +- {change_error:.2f} %   "
                  f"{seconds:.2f} CPU s")


if __name__ == "__main__":
    main()
