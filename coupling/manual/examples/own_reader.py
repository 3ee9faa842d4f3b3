"""Reads lines: walls LEFT RIGHT LOWER UPPER, grain ID X Y R, touch I J FX FY, left I FX FY (or another side)."""
import numpy as np

from diptych import importers


@importers.register("pack")
def read(options):
    return [frame_of(path) for path in options.files]  # one file an instant, in the order of the command line


def frame_of(path):
    rows, sides = {}, ["left", "right", "lower", "upper"]
    for number, line in enumerate(importers.read_lines(path), 1):
        kind, *numbers = line.split()
        if kind not in ("walls", "grain", "touch", *sides):
            raise importers.refused(path, f"unknown word '{kind}'", number)
        rows.setdefault(kind, []).append([float(word) for word in numbers])
    grain = np.array(rows["grain"])
    contacts = []  # first grain, second grain, force on the first, index of the wall or -1
    for i, j, fx, fy in rows.get("touch", []):
        contacts.append([i, j, fx, fy, -1])
    for k, side in enumerate(sides):
        contacts += [[i, -1, fx, fy, k] for i, fx, fy in rows.get(side, [])]
    c = np.array(contacts)
    grains = {"id": grain[:, 0].astype(int), "position": grain[:, 1:3], "radius": grain[:, 3]}
    contacts = importers.contacts_of(c[:, 0], c[:, 1], c[:, 2:4], c[:, 4])
    walls = [importers.Wall(side, side, place) for side, place in zip(sides, rows["walls"][0])]
    return importers.Frame(path, grains, contacts, walls=walls, grain_file=path)
