#!/usr/bin/env python3
# diptych: prepares the samples of this folder again
# SPDX-License-Identifier: LGPL-2.1-or-later
"""samples.py PROGRAM FOLDER [SEED ...]: writes the prepared samples of ../dense_biaxial (default: seeds 11 to 22) to
FOLDER/seed_N.h5, which `sample/file` reads. Another revision of the program prepares other samples; the stored results
of LAMMPS do not belong to them. Needs h5py and numpy."""
import argparse
import os
import sys
import tempfile

import h5py

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
import claims  # noqa: E402

SCENE = os.path.join(HERE, "../dense_biaxial/scene.prm")
GRAINS = ("position", "velocity", "rotation", "spin", "radius", "mass")
ATTRIBUTES = ("left_x", "right_x", "lower_y", "upper_y", "step", "time", "mean_diameter")


def keep(result, path):
    """Writes grains, box and acting contacts of the first stage to `path`."""
    packed = {"compression": 9, "shuffle": True}
    with h5py.File(os.path.join(result.folder, "discrete.h5"), "r") as source, h5py.File(path, "w") as file:
        old, new = source["stage_0000"], file.create_group("stage_0000")
        for name in GRAINS:
            new.create_dataset("grains/" + name, data=old["grains/" + name][()], **packed)
        acting = old["contacts/impulse"][:, 0] > 0
        new.create_dataset("contacts/body", data=old["contacts/body"][()][acting].astype("int32"), **packed)
        new.create_dataset("contacts/impulse", data=old["contacts/impulse"][()][acting], **packed)
        for name in ATTRIBUTES:
            new.attrs[name] = old.attrs[name]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("folder")
    parser.add_argument("seeds", type=int, nargs="*")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        for seed in options.seeds or range(11, 23):
            runs = claims.Runs(argparse.Namespace(program=options.program, reuse=False, set=[]), seed, scratch)
            short = ("loading/axial_strain=1e-4", "loading/stage_strain=1e-4", "comparison/window_edges=0,1e-4")
            keep(runs.run(f"seed_{seed}", "discrete", SCENE, *short), os.path.join(options.folder, f"seed_{seed}.h5"))


if __name__ == "__main__":
    main()
