# diptych: contradictions, doubts and damage in samples of other codes
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Messages name the file, its line and the reason."""

import re

import numpy as np
import pytest

import diptych
from foreign_sets import FORMATS, checked, copy, once, refusal, stresses  # noqa: F401  copy is a fixture


REFUSED = [  # set, file, change, words of the message: the file, its line, the reason
    ("lammps", "contacts.dump", once("ITEM: TIMESTEP\n240000", "ITEM: TIMESTEP\n240001"), "the frames do not match"),
    ("lammps", "contacts.dump", once("ENTRIES\n731", "ENTRIES\n732"), "row 732 of 732 has 2 entries instead of 10"),
    ("lmgc90", "DOF.OUT.1", lambda text: re.sub(r"\$bdyty[^$]*\$nodty[^$]*", "", text, count=1), "bodies, but"),
    ("lammps", "walls.dump", once("BOUNDS ff ff pp\n-1.0000000000000000e-02 4.1604799999999997e-02",
                                  "BOUNDS xy xz yz ff ff pp\n-0.01 0.04 0.001"),
                                  "walls.dump, line 6: the box is tilted by 0.001"),
    ("lammps", "grains.dump", lambda text: text[:5000], "grains.dump, line"),
    ("lmgc90", "Vloc_Rloc.OUT.1", once("$steps      220", "$steps      221"), "do not match"),
    ("lmgc90", "Vloc_Rloc.OUT.1", once("n(1)=-0.5", "n(1)=-0.9"), "not a unit normal"),
    ("lmgc90", "BODIES.DAT", None, "BODIES.DAT is missing"),
    ("mercurydpm", "Biaxial2D.fstat", once(" 0.7865765336 -0.617492799 ", " 0.1865765336 -0.617492799 "),
     "line 4: nx, ny are not a unit normal"),
    ("mercurydpm", "Biaxial2D.fstat", lambda text: text[:text.rstrip().rfind("\n") + 1], "Biaxial2D"),
    ("mercurydpm", "Biaxial2D.restart.4", once("particleDimensions 2", "particleDimensions 3"), "--thickness"),
    ("plain_csv", "contacts_1.csv", once("69,49,", "69,4,"), "contacts_1.csv, line 3: frame 1: a contact of body 4"),
    ("plain_csv", "contacts_1.csv", once("69,49,", "69,227,"),
     "contacts_1.csv, line 3: frame 1: the surfaces of the two bodies"),
    ("plain_csv", "contacts_1.csv", lambda text: text + "49,69,1,1\n", "twice with different forces"),
    ("plain_csv", "contacts_1.csv", lambda text: text + "1,NA,1,1\n", "column j = 'NA' is not a number"),
    ("plain_csv", "contacts_1.csv", lambda text: text + "1,2,,1\n", "column fx is empty"),
    ("plain_csv", "contacts_2.csv", lambda text: text.splitlines()[0], "every frame after the first needs them"),
    ("plain_csv", "particles_1.csv", once("\n2,", "\n1,"), "grain 1 occurs twice"),
    ("plain_csv", "particles_1.csv", once("\n49,0.0025810061,0.00344787159", "\n49,0.00128904658,0.00128048082"),
     "contacts_1.csv, line 3: frame 1: grains 69 and 49 have the same position"),
    ("plain_csv", "particles_1.csv", lambda text: text[:text.rstrip().rfind("\n") + 1], "lacks grain"),
    ("plain_csv", "particles_1.csv", once("id,x,y,r,vx", "id,x,y,r,d"), "contradict each other"),
    ("plain_csv", "walls.csv", lambda text: text + "1,0.03,0.05\n", "line 5: frame 1 has another width in line 3"),
    ("plain_csv", "particles_1.csv", lambda text: re.sub(r"(?m)^(\d+,[^,]+,[^,]+,)([^,]+)", lambda row: row[1] + str(
        1.2 * float(row[2])), text), "the discs cover 118 % of the area"),
    ("plain_csv", "walls.csv", once("0.04971981119", "0.02"), "walls.csv, line 3: frame 1: the centres of"),
    ("plain_csv", "walls.csv", once("1,0.0317409221,", "1,0.2317409221,"), "grain diameters apart"),
    ("plain_csv", "walls.csv", None, "--walls-touch"),
    ("liggghts", "contacts_100000.dump", once("ITEM: TIMESTEP\n100000", "ITEM: TIMESTEP\n100001"), "do not match")]


@pytest.mark.parametrize("name, file, change, reason", REFUSED)
def test_contradictions_are_refused_with_their_reason(name, file, change, reason, copy):
    assert reason in str(refusal(copy(name, {file: change})))


@pytest.mark.parametrize("name, option, reason", [
    ("yade", {"timestep": 1e-6}, "--timestep would have no effect"),
    ("lmgc90", {"columns": ["contacts=i,j"]}, "would have no effect"),
    ("lammps", {"density": 2600.0}, "--density would have no effect"),
    ("plain_csv", {"walls_touch": True}, "--walls-touch would have no"),
    ("lammps", {"columns": ["grains=id"]}, "is not KIND=NAME"), ("yade", {"thickness": None}, "--thickness"),
    ("lammps", {"columns": ["contacts=index,patom1"]}, "10 columns, not 2"),
    ("plain_csv", {"gravity": (0, -9.81)}, "give --density"),
    ("lammps", {"columns": ["contacts=index,patom1,patom2,dist,force,fx,p1,fy,p2,p4"]}, "contacts.dump, line 10"),
    ("liggghts", {"columns": ["contacts=force,pos,id,force_normal,force_tangential,contactArea,delta,contactPoint"]},
     "--columns contacts")])
def test_options_without_effect_or_sense_are_refused(name, option, reason, copy):
    assert reason in str(refusal(copy(name), **option))


def test_doubts_are_told(copy):
    def doubts(name, **changes):
        return " ".join(checked(copy(name, {file.replace("__", "."): change for file,
                                            change in changes.items()}))["doubtful"])
    assert "far from balance" in doubts("plain_csv", contacts_1__csv=once("161,154,-14.748704,-21.2551418",
                                                                          "161,154,0,0"))
    assert "too few contacts" in doubts("plain_csv", contacts_1__csv=lambda text: text[:text.index("434,15,")])
    assert "the radius of grain 1" in doubts("plain_csv", particles_1__csv=once("0.00077969925", "0.00077069925"))
    assert "off the place where the surfaces meet" in doubts("liggghts",
                                                             wallcontacts_100000__dump=once("\n0 0.0257691629 0",
                                                                                         "\n0 0.0457691629 0"))


@pytest.mark.parametrize("name", FORMATS)
def test_damaged_files_are_refused_or_doubtful_or_nearly_right(name, copy, tmp_path):
    """Truncated files and flipped bits: 20 of each. Another error than SceneError fails."""
    kind, files, options = copy(name)
    whole, dice = checked((kind, files, options)), np.random.default_rng(1)
    for draw in range(40):
        file = files[dice.integers(len(files))]
        good = file.read_bytes()
        data = bytearray(good if draw % 2 else good[:dice.integers(len(good))])
        if draw % 2:
            data[dice.integers(len(data))] ^= 1 << dice.integers(8)
        file.write_bytes(data)
        try:
            record = checked((kind, files, options))
            near = len(record["frames"]) == len(whole["frames"]) and all(
                one["grains"] == other["grains"] and one["solid_fraction"]
                == pytest.approx(other["solid_fraction"], rel=1e-3)
                for one, other in zip(record["frames"], whole["frames"])) and np.allclose(
                    stresses(record), stresses(whole), rtol=0, atol=0.03 * np.abs(stresses(whole)).max())
            assert near or record["doubtful"], (file, draw)
        except diptych.SceneError as error:
            assert str(error)
        file.write_bytes(good)
