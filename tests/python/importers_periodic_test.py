# diptych: periodic samples of other codes, layers in the x-z plane, couples of contacts
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A square lattice of 36 discs of diameter 1 with the forces 2 along x and 3 along y: the stress is (2, 3, 0)."""

import json

import h5py
import numpy as np
import pytest

import diptych
from diptych import importers
from conftest import program
from foreign_sets import FOREIGN, PUBLIC

CELL = PUBLIC / "104"
N = 6
FORCES = {1: (2.0, 0.0), N: (0.0, 3.0)}
PAIRS = [(k, ((k % N + 1) % N + k // N * N if step == 1 else (k + N) % N**2), force)
         for k in range(N**2) for step, force in FORCES.items()]  # the second one pushes the first one back


def lattice(shear, shift=0.0):
    """Places of the lattice in a cell that `shear` has tilted, moved by `shift` and wrapped."""
    row, column = (part.ravel() for part in np.mgrid[:N, :N])
    share = np.column_stack([column + 0.5, row + 0.5]) / N
    return (share + shift) % 1 @ np.array([[N, 0], [shear * N, N]])


def dump(path, head, columns, rows):
    """A section; head: step and box; columns: their kind and names."""
    text = f"ITEM: TIMESTEP\n{head[0]}\nITEM: NUMBER OF {columns.split()[0]}\n{len(rows)}\n{head[1]}ITEM: {columns}\n"
    path.write_text(text + "".join(" ".join(map(repr, row)) + "\n" for row in rows))
    return path


def as_lammps(folder, step, shear, shift=0.0):
    tilt = N * (shear - round(shear))  # beyond half the width LAMMPS takes the other vector
    low, high = (repr(float(end)) for end in (min(0, tilt), N + max(0, tilt)))
    box = f"ITEM: BOX BOUNDS xy xz yz pp pp pp\n{low} {high} {tilt!r}\n0.0 {N}.0 0.0\n-0.5 0.5 0.0\n"
    grains = [(k, float(x), float(y), 0.5) for k, (x, y) in enumerate(lattice(shear, shift))]
    rows = [(k, i, j, 1.0, 0.0, -fx, -fy, 0.0, 0.0, 0.0) for k, (i, j, (fx, fy)) in enumerate(PAIRS)]
    return [dump(folder / f"g_{step}.dump", (step, box), "ATOMS id x y radius", grains),
            dump(folder / f"c_{step}.dump", (step, box), "ENTRIES i c[1] c[2] d e f g h k l", rows)]


def as_liggghts(folder, step):
    box = f"ITEM: BOX BOUNDS pp pp ff\n0 {N}\n0 {N}\n-0.5 0.5\n"
    places = lattice(0.0)
    grains = [(k, float(x), float(y), 0.0, 0.5) for k, (x, y) in enumerate(places)]
    rows = [(*map(float, places[i]), 0.0, *map(float, places[j]), 0.0, i, j, int(abs(places[i] - places[j]).max() > 1),
             -fx, -fy, 0.0) for i, j, (fx, fy) in PAIRS]
    return [dump(folder / "g_1.dump", (step, box), "ATOMS id x y z radius", grains),
            dump(folder / "c_1.dump", (step, box), "ENTRIES " + " ".join(f"c[{k}]" for k in range(1, 13)), rows)]


def as_yade(folder, _):
    (folder / "spheres_1.txt").write_text("#format x_y_z_r_attrs\n# x y z r id\n" + "".join(
        f"{x} {y} 0 0.5 {k}\n" for k, (x, y) in enumerate(lattice(0.0))))
    (folder / "contacts_1.txt").write_text("# id1 id2 normalForce_x y z\n" + "".join(
        f"{i} {j} {fx} {fy} 0\n" for i, j, (fx, fy) in PAIRS))
    (folder / "cell.txt").write_text(f"# frame cell_a1_x cell_a1_y cell_a2_x cell_a2_y\n1 {N} 0 0 {N}\n")
    return sorted(folder.glob("*.txt"))


def as_mercury(folder, _):
    grain = "orientation 1 0 0 0 velocity 0 0 0 angularVelocity 0 0 0 force 0 0 0 radius 0.5 invMass 1"
    lines = ["timeStep 1 time 1", "particleDimensions 2 gravity 0 0 0", "Species 1", "S id 0 density 1.2732", "Walls 0",
             "Boundaries 2", f"PeriodicBoundary id 0 normal 1 0 0 distanceLeft 0 distanceRight {N} shift {N} 0 0",
             f"PeriodicBoundary id 1 normal 0 1 0 distanceLeft 0 distanceRight {N} shift 0 {N} 0",
             f"Particles {N**2}",
             *(f"BaseParticle id {k} position {x} {y} 0 {grain}" for k, (x, y) in enumerate(lattice(0.0))),
             f"Interactions {len(PAIRS)}",
             *(f"I particleIds {i} {j} contactPoint {lattice(0.0)[i, 0] + fx / 4} {lattice(0.0)[i, 1] + fy / 6} 0 "
               f"force {-fx} {-fy} 0 torque 0 0 0.25" for i, j, (fx, fy) in PAIRS)]
    (folder / "a.restart").write_text("\n".join(lines) + "\n")
    return [folder / "a.restart"]


def check_lattice(record):
    frame = record["frames"][-1]
    assert frame["contacts"] == 72 and frame["balance_worst"] < 1e-12 and record["doubtful"] == []
    assert frame["solid_fraction"] == pytest.approx(np.pi / 4) and abs(frame["largest_overlap"]) < 1e-9
    assert np.allclose(frame["contact_stress"], [[2, 0], [0, 3]], atol=1e-12)


@pytest.mark.parametrize("kind, write", [("lammps", lambda folder, step: as_lammps(folder, step, 0.0)),
                                         ("liggghts", as_liggghts), ("yade", as_yade), ("mercurydpm", as_mercury)])
def test_a_cell_is_read_from_the_files_of_every_code(kind, write, tmp_path):
    options = {} if kind in ("lammps", "mercurydpm") else {"thickness": 1.0}
    check_lattice(importers.check(kind, write(tmp_path, 1), **options))


def test_a_table_needs_the_periods_and_says_so():
    files = sorted(CELL.glob("*.csv"))
    check_lattice(importers.check("csv", files, period_x=6.0, period_y=6.0))
    with pytest.raises(diptych.SceneError, match="periodic[?] Give its periods with --period-x and --period-y"):
        importers.check("csv", files)
    with pytest.raises(diptych.SceneError, match="--period-y needs --period-x"):
        importers.check("csv", files, period_y=6.0)


def test_grains_follow_a_cell_that_shear_tilts_and_the_code_flips(tmp_path):
    """Simple shear 0.3, 0.6 and 0.9, while the lattice drifts by a third of the cell. The strain is that of the path:
    2 exy = -0.9, since shear to the left is positive; no volume change."""
    files = [path for step, shear in enumerate((0.0, 0.3, 0.6, 0.9))
             for path in as_lammps(tmp_path, step, shear, 0.1 * step)]
    # in the tilted cell the pairs along the second vector are longer than a diameter: forces along x alone remain
    for path in tmp_path.glob("c_[123].dump"):
        path.write_text(path.read_text().replace("-3.0", "0.0").replace("-0.0", "0.0"))
    program("import", "lammps", *files, "--output", tmp_path / "out", "--quiet")
    grains = diptych.load(tmp_path / "out").discrete
    history, last = grains.history, grains.snapshots[-1]
    assert np.allclose(history["exy"], [0, -0.15, -0.3, -0.45], atol=1e-12)
    assert np.allclose(history["volumetric_strain"], 0)
    start = lattice(0.0)
    moved = last.displacement - np.column_stack([0.9 * start[:, 1], np.zeros(N**2)])
    assert np.allclose(moved, moved[0], atol=1e-9)
    assert history["sxx"][-1] == pytest.approx(2) and last.walk == "path"


def test_a_sample_that_is_periodic_along_x_has_walls_below_and_above(tmp_path):
    """The same lattice between two plates: its rows at the plates push them with 3."""
    folder = tmp_path / "in"
    folder.mkdir()
    for k, low in ((0, 0.0), (1, 0.06)):
        (folder / f"particles_{k}.csv").write_text((CELL / "particles_1.csv").read_text())
        (folder / f"walls_{k}.csv").write_text(f"frame,cell_width,lower_y,upper_y\n{k},6,{low},6\n")
        rows = (CELL / "contacts_1.csv").read_text().splitlines()
        kept = [row for row in rows if row not in [f"{column},{30 + column},0,3" for column in range(6)]]
        assert len(rows) - len(kept) == 6
        (folder / f"contacts_{k}.csv").write_text("\n".join(kept + [f"{column},-1,0,3" for column in range(6)] + [
            f"{30 + column},-2,0,-3" for column in range(6)]) + "\n")
    program("import", "csv", *sorted(folder.glob("*.csv")), "--output", tmp_path / "out", "--quiet", "--density", "1")
    record = json.loads((tmp_path / "out" / "import.json").read_text())["frames"]
    assert [frame["contacts"] for frame in record] == [66, 66] and record[1]["axial_strain"] == pytest.approx(0.01)
    assert np.allclose(record[0]["contact_stress"], [[2, 0], [0, 3]])
    program("continuum", tmp_path / "out" / "scene.prm", "--output", tmp_path / "run", "--quiet")


def test_couples_are_the_torques_less_the_moments_of_the_forces(tmp_path):
    """LIGGGHTS writes the torque about the centre. A couple of 0.3 is added to that of every contact, which makes it
    known; the other formats say that they do not hold couples, and discrete.h5 does not hold zeros."""
    words = {"thickness": 1.0, "columns": ["contacts=pos,id,force", "walls=pos,id,force"]}
    plain = importers.read("liggghts", sorted((PUBLIC / "29").glob("*")), **words)
    files = []
    for path in sorted((PUBLIC / "29").glob("*")):
        files.append(tmp_path / path.name)
        lines = path.read_text().splitlines()
        for k, line in enumerate(lines if path.name.startswith("c_") else []):
            row = line.split()
            if line.startswith("ITEM: ENTRIES"):
                lines[k] = line + " ".join(f"c[{n}]" for n in (13, 14, 15))
            elif k > 8:
                x, y, _, x2, y2, _, first, second, _, fx, fy, _ = map(float, row)
                radius = dict(zip(plain[0].grains["id"], plain[0].grains["radius"]))
                branch = np.array([x2 - x, y2 - y])
                size = np.hypot(*branch)
                lever = 0.5 * (size + radius[first] - radius[second]) / size * branch
                lines[k] = f"{line} 0 0 {lever[0] * fy - lever[1] * fx + 0.3:.12g}"
        files[-1].write_text("\n".join(lines) + "\n")
    words["columns"][0] += ",torque"
    program("import", "liggghts", *files, "--thickness", "1", *(part for text in words["columns"]
                                                              for part in ("--columns", text)),
            "--output", tmp_path / "out", "--quiet")
    couple = diptych.load(tmp_path / "out").discrete.snapshots[0].contacts.couple
    assert np.allclose(np.sort(abs(couple))[-21:], 0.3, atol=1e-8)
    [frame] = importers.read("mercurydpm", as_mercury(tmp_path, 1))
    assert np.all(frame.contacts["couple"] == 0.25)
    program("import", "csv", *sorted((FOREIGN / "plain_csv").glob("*.csv")), "--output", tmp_path / "csv", "--quiet")
    with h5py.File(tmp_path / "csv" / "discrete.h5") as file:
        assert "couple" not in file["stage_0001/contacts"]
        assert "contacts/couple" in file["stage_0001"].attrs["not_told"].decode()
    assert any("couples" in text for text in json.loads((tmp_path / "csv" / "import.json").read_text())["lacking"])


def test_a_layer_in_another_plane_is_named():
    files = sorted((PUBLIC / "107").glob("*"))
    words = {"thickness": 1.0, "columns": ["contacts=pos,id,force", "walls=pos,id,force"]}
    with pytest.raises(diptych.SceneError, match="the layer lies in the x-z plane; give --plane xz"):
        importers.check("liggghts", files, **words)
    upright, flat = (importers.read("liggghts", sorted((PUBLIC / case).glob("*")), plane=plane, **words)[0]
                     for case, plane in (("107", "xz"), ("29", "xy")))
    for name in ("position", "spin", "velocity"):
        sign = -1 if name == "spin" else 1  # the case has the same number as spin about y
        assert np.array_equal(upright.grains[name], sign * flat.grains[name])
    with pytest.raises(diptych.SceneError, match="--plane xz would have no effect"):
        importers.check("lammps", sorted((FOREIGN / "lammps").glob("*.dump")), plane="xz")


def test_tables_name_the_axes_of_an_upright_layer(tmp_path):
    texts = {"particles_1.csv": "id,x,z,r\n0,0,0,0.5\n1,0,1,0.5\n", "contacts_1.csv": "i,j,fx,fz\n0,1,0.1,-1\n"}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    [frame] = importers.read("csv", [tmp_path / name for name in texts], plane="xz")
    assert np.array_equal(frame.grains["position"], [[0, 0], [0, 1]])
    assert np.array_equal(frame.contacts["force"], [[0.1, -1]])


def test_the_words_of_the_user_come_before_a_guess(tmp_path):
    """Tables of four numbers without names: the file's name tells which of the user's words counts."""
    for name in ("particles", "contacts"):
        text = (CELL / f"{name}_1.csv").read_text().splitlines()[1:]
        (tmp_path / f"{name}_1.csv").write_text("\n".join(text) + "\n")
    words = {"columns": ["particles=id,x,y,r", "contacts=i,j,fx,fy"], "period_x": 6.0, "period_y": 6.0}
    check_lattice(importers.check("csv", sorted(tmp_path.glob("*.csv")), **words))
