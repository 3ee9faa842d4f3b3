#!/usr/bin/env python3
# diptych: imports real output of five codes, compares it with numpy, and runs two samples beside the continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Usage: imported.py PROGRAM. Imports every set of tests/foreign into results/imported/ and prints the numbers of the
README. Then runs scene.prm on the samples of LAMMPS (seed 1) and MercuryDPM (seed 2)."""

import glob
import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import maps  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
FOREIGN = os.path.join(HERE, "..", "..", "tests", "foreign")
RESULTS = os.path.join(HERE, "..", "..", "results", "imported")
SETS = {  # folder of results: format, truth, files, options
    "sample_1": ("lammps", "lammps", ["lammps/*.dump", "lammps/walls.txt"], []),
    "sample_2": ("mercurydpm", "mercurydpm", ["mercurydpm/*.data", "mercurydpm/*.fstat", "mercurydpm/*.ene",
                                              "mercurydpm/*.restart.4"], []),
    "liggghts": ("liggghts", "liggghts", ["liggghts/*.dump", "liggghts/*.stl"], ["--thickness", "1"]),
    "yade": ("yade", "yade", ["yade/spheres_*.txt", "yade/contacts_*.txt", "yade/walls_*.txt"], ["--thickness", "1"]),
    "lmgc90": ("lmgc90", "lmgc90", ["lmgc90/DATBOX/BODIES.DAT", "lmgc90/DATBOX/BULK_BEHAV.DAT", "lmgc90/OUTBOX/*"], []),
    "lmgc90_hdf5": ("lmgc90", "lmgc90_hdf5", ["lmgc90/DATBOX/BODIES.DAT", "lmgc90/DATBOX/BULK_BEHAV.DAT",
                                              "lmgc90_hdf5/lmgc90.h5"], []),
    "csv": ("csv", "plain_csv", ["plain_csv/*.csv"], []),
}


def imported(program, name):
    form, _, patterns, options = SETS[name]
    files = sorted(sum((glob.glob(os.path.join(FOREIGN, pattern)) for pattern in patterns), []))
    folder = os.path.join(RESULTS, name)
    subprocess.run([program, "import", form, *files, *options, "--output", folder, "--overwrite", "--quiet"],
                   check=True)
    with open(os.path.join(folder, "import.json")) as file:
        return json.load(file)


def row(name, record):
    """Numbers of the worst frame: contacts, mass and stress by the import and by numpy, difference of walls and
    contacts in both."""
    with open(os.path.join(FOREIGN, SETS[name][1], "truth.json")) as file:
        truth = json.load(file)["frames"]
    contacts, true_contacts, mass, stress, apart, true_apart = 0, 0, 0., 0., 0., 0.
    for frame in record["frames"]:
        true = next(value for key, value in truth.items() if frame["frame"] in (key, "step " + key, "_" + key,
                                                                                "time " + key))
        contacts += frame["contacts"]
        true_contacts += true["contacts_grain_grain"]
        if frame["mass"] is not None:
            mass = max(mass, abs(frame["mass"] / true["mass"] - 1))
        here, there = frame["contact_stress"], true["mean_stress_from_contacts"]
        scale = max(abs(there[a][b]) for a in (0, 1) for b in (0, 1))
        # tension positive there
        stress = max(stress, *(abs(here[a][b] + there[a][b]) / scale for a in (0, 1) for b in (0, 1)))
        apart = max(apart, 100 * frame["stress_difference"])
        true_apart = max(true_apart, true.get("difference_contacts_walls_percent", apart))
    masses = "not told" if record["frames"][0]["mass"] is None else f"{mass:.1e}"
    balance = max(frame["balance_rms"] for frame in record["frames"])
    against = "resultants" if record["frames"][-1]["balance_against_resultants"] else "rest"
    return (f"| {SETS[name][1]} | {len(record['frames'])} | {contacts} | {true_contacts} | {masses} | {stress:.1e} | "
            f"{apart:.3f} | {true_apart:.3f} | {balance:.1e} ({against}) |")


def main():
    program = os.path.abspath(sys.argv[1])
    print("| set | frames | contacts | truth | mass, relative error | stress, relative error | walls against contacts "
          "% | truth | balance, rms |")
    print("|---|---|---|---|---|---|---|---|---|")
    for name in SETS:
        print(row(name, imported(program, name)))
    for seed, code in ((1, "LAMMPS"), (2, "MercuryDPM")):
        folder = os.path.join(RESULTS, f"both_{seed}")
        subprocess.run([program, "run", os.path.join(HERE, "scene.prm"), "--set", f"sample/seed={seed}", "--output",
                        folder, "--overwrite", "--quiet"], check=True)
        print(f"{code}: {os.path.normpath(folder)}/report.html")
    maps.draw_window(os.path.join(RESULTS, "both_1"), 1, os.path.join(HERE, "figure.png"))


if __name__ == "__main__":
    main()
