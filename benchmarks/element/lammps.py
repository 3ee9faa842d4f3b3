# diptych: a periodic cell of discs on a path, in LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grains of a snapshot in LAMMPS' triclinic box (gran/hooke/history, fix deform, fix nph/sphere) under P = 1, d =
rho = 1.

The springs are those of the method `penalty`: kt = kn/2, normal damping that never makes a contact attract, none along
the tangent, step 0.2 sqrt(m_min/kn). They are pressed without friction for PRELOAD first. LAMMPS keeps the first
lattice vector along x, so that its box turns with the shear; the cell of Diptych does not turn."""
import os
import subprocess

import numpy

PRELOAD = 30.
DAMPING = 0.2  # Share of the critical damping of a pair of mean mass.
ROW_STRAIN = 4e-5  # Strain between two rows of the history.
# Path -> (motion of the box, component under P): the height falls and sxx = P, or 2 exy grows and syy = P, exx = 0.
PATHS = {"drained": ("y erate -{rate}", "x"), "simple_shear": ("xy erate -{rate}", "y")}

SCRIPT = """units lj
dimension 2
boundary p p p
newton off
comm_modify vel yes
atom_style sphere
box tilt large
read_data start.data
set group all density/disc 1.0
timestep {step}
pair_style gran/hooke/history {kn} {kt} {gn} 0.0 0.0 0 limit_damping
pair_coeff * *
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
fix box all nph/sphere x 1 1 1.0 y 1 1 1.0 couple none disc ptemp 1 drag 1 fixedpoint 0 0 0
fix flat all enforce2d
compute stress all pressure NULL pair
variable width equal lx
variable height equal ly
variable tilt equal xy
thermo 100000
run {preload_steps}
unfix box
unfix flat
reset_timestep 0
pair_style gran/hooke/history {kn} {kt} {gn} 0.0 {friction} 0 limit_damping
pair_coeff * *
velocity all set 0.0 0.0 0.0
set group all omega 0.0 0.0 0.0
fix deform all deform 1 {motion} remap v
fix box all nph/sphere {free} 1 1 1.0 disc ptemp 1 drag 1 scalexy no fixedpoint 0 0 0
fix flat all enforce2d
fix out all ave/time {every} 1 {every} v_width v_height v_tilt c_stress[1] c_stress[2] c_stress[4] &
  file history.txt format " %.9g"
run {steps}
"""


def write_start(path, position, radius, vectors):
    """vectors (2, 2): the lattice vectors as columns, the first along x."""
    n = len(radius)
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"cell\n\n{n} atoms\n1 atom types\n0 {vectors[0, 0]:.16g} xlo xhi\n0 {vectors[1, 1]:.16g} ylo yhi\n"
                   f"-0.5 0.5 zlo zhi\n{vectors[0, 1]:.16g} 0 0 xy xz yz\n\nAtoms\n\n")
        for i in range(n):
            file.write(f"{i + 1} 1 {2 * radius[i]:.16g} 1.0 {position[i, 0]:.16g} {position[i, 1]:.16g} 0.0\n")


def run(sample, folder, path, stiffness, inertial_number, *, strain, friction=0.4):
    """Columns by name: progress (1 - h/h0 or 2 exy), t, s [P], volumetric_strain, exx, eyy, sxx, syy, sxy. sample:
    (positions (n, 2), radii (n), lattice vectors (2, 2) as columns). Throws RuntimeError if LAMMPS fails."""
    os.makedirs(folder, exist_ok=True)
    position, radius, vectors = sample
    mass = numpy.pi * radius ** 2
    step = 0.2 * numpy.sqrt(mass.min() / stiffness)
    write_start(os.path.join(folder, "start.data"), position, radius, vectors)
    motion, free = PATHS[path]
    values = dict(kn=stiffness, kt=stiffness / 2, gn=f"{2 * DAMPING * numpy.sqrt(2 * stiffness / mass.mean()):.10g}",
                  step=f"{step:.12g}",
                  friction=friction, motion=motion.format(rate=inertial_number), free=free,
                  preload_steps=int(PRELOAD / step),
                  steps=int(numpy.ceil(strain / inertial_number / step)),
                  every=max(1, round(ROW_STRAIN / inertial_number / step)))
    with open(os.path.join(folder, "in.cell"), "w", encoding="utf-8") as file:
        file.write(SCRIPT.format(**values))
    done = subprocess.run(["lmp", "-in", "in.cell", "-log", "log.lammps", "-screen", "none"], cwd=folder,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{folder}: lmp failed: {(done.stderr or done.stdout)[-500:]}")
    return history(folder, path)


def history(folder, path):
    """The columns of run() in a folder where LAMMPS has finished."""
    _, width, height, tilt, sxx, syy, sxy = numpy.loadtxt(os.path.join(folder, "history.txt")).T
    exx, eyy = -numpy.log(width / width[0]), -numpy.log(height / height[0])
    middle = 0.5 * (height[1:] + height[:-1])
    shear = -numpy.concatenate([[0], numpy.cumsum(numpy.diff(tilt) / middle)])
    return {"progress": 1 - height / height[0] if path == "drained" else shear, "t": numpy.hypot((syy - sxx) / 2, sxy),
            "s": (sxx + syy) / 2,
            "volumetric_strain": 1 - width * height / (width[0] * height[0]), "exx": exx, "eyy": eyy, "sxx": sxx,
            "syy": syy, "sxy": sxy}
