# diptych: the dense biaxial test in LAMMPS
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The test of ../dense_biaxial with springs and dashpots (LAMMPS, gran/hooke/history) on a snapshot of the discrete
panel.

The left and the lower wall are fixed, the upper one descends from an affine start, the right one is a piston of mass
sqrt(N) m under P x height with P = 1. All walls are smooth. The springs are those of the method `penalty`: kt = kn/2,
normal damping that never makes a contact attract, none along the tangent, step 0.2 sqrt(m_min/kn) by default. First
the springs are pressed without friction for PRELOAD d sqrt(rho/P)."""
import os
import re
import subprocess

import h5py
import numpy

PRELOAD = 30.
DAMPING = 0.2  # Share of the critical damping of a pair of mean mass.
ROW_STRAIN = 4e-5  # Strain between two rows of the history.

SCRIPT = """units lj
dimension 2
boundary f f p
newton off
comm_modify vel yes
atom_style sphere
atom_modify map yes
read_data start.data
group grains type 1
group piston type 2
set group grains density/disc 1.0
set group piston density/disc {piston_density}
variable V equal 0.0
timestep {step}
pair_style gran/hooke/history {kn} {kt} {gn} 0.0 0.0 0 limit_damping
pair_coeff * *
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes exclude type 1 2
variable up equal -v_V*step*dt
variable right equal x[{piston}]-{width}
variable width equal x[{piston}]
variable height equal {height}+v_up
region left plane 0 0 0 1 0 0 side in
region lower plane 0 0 0 0 1 0 side in
region right plane {width} 0 0 -1 0 0 side in move v_right NULL NULL
region upper plane 0 {height} 0 0 -1 0 side in move NULL v_up NULL
fix wl grains wall/gran/region hooke/history {kn} NULL {gn} 0.0 0.0 0 limit_damping region left contacts
fix wb grains wall/gran/region hooke/history {kn} NULL {gn} 0.0 0.0 0 limit_damping region lower contacts
fix wr grains wall/gran/region hooke/history {kn} NULL {gn} 0.0 0.0 0 limit_damping region right contacts
fix wu grains wall/gran/region hooke/history {kn} NULL {gn} 0.0 0.0 0 limit_damping region upper contacts
compute fr grains reduce sum f_wr[2]
variable push equal -v_height-c_fr
fix push piston setforce v_push 0.0 0.0
fix move_piston piston nve
fix move_grains grains nve/sphere disc
fix flat all enforce2d
compute rad grains property/atom radius
variable ml atom c_rad*f_wl[2]
variable mr atom -c_rad*f_wr[2]
variable mb atom c_rad*f_wb[3]
variable mu atom -c_rad*f_wu[3]
compute mw grains reduce sum v_ml v_mr v_mb v_mu
compute pr all pressure NULL pair
compute ke grains ke
variable box equal lx*ly
variable mxx equal c_pr[1]*v_box+c_mw[1]+c_mw[2]
variable myy equal c_pr[2]*v_box+c_mw[3]+c_mw[4]
variable mxy equal c_pr[4]*v_box
variable strain equal -v_up/{height}
thermo 100000
thermo_style custom step time v_strain v_width c_ke v_mxx v_myy c_fr c_mw[1]
run {preload_steps}
reset_timestep 0
variable V equal {speed}
{law}
velocity grains ramp vy 0.0 -{speed} y 0.0 {height} sum no
velocity grains set 0.0 NULL 0.0
velocity piston set 0.0 0.0 0.0
set group grains omega 0.0 0.0 0.0
fix out grains ave/time {every} 1 {every} v_strain v_width v_height v_mxx v_myy v_mxy c_ke &
  file history.txt format " %.9g"
run {steps}
"""

SLIDING = """pair_style gran/hooke/history {kn} {kt} {gn} 0.0 {friction} 0 limit_damping
pair_coeff * *"""
# The same with couples between grains: a spring kt Re^2 and the bound mu Re |N|, Re = Ri Rj / (Ri + Rj).
ROLLING = """pair_style granular
pair_coeff * * hooke {kn} {gn} damping mass_velocity tangential linear_history {kt} 0.0 {friction} &
  rolling sds {kt} 0.0 {rolling} limit_damping"""


def read_sample(path):
    """(positions from the corner, radii, width, height) of the first stage."""
    with h5py.File(path) as file:
        stage = file["stage_0000"]
        corner = [stage.attrs["left_x"], stage.attrs["lower_y"]]
        return (stage["grains/position"][:, :2] - corner, stage["grains/radius"][:],
                float(stage.attrs["right_x"] - corner[0]), float(stage.attrs["upper_y"] - corner[1]))


def write_start(path, position, radius, width, height):
    n = len(radius)
    with open(path, "w") as file:
        file.write(f"biaxial\n\n{n + 1} atoms\n2 atom types\n-4 {1.5 * width} xlo xhi\n-6 {1.1 * height} ylo yhi\n"
                   "-0.5 0.5 zlo zhi\n\nAtoms\n\n")
        for i in range(n):
            file.write(f"{i + 1} 1 {2 * radius[i]:.16g} 1.0 {position[i, 0]:.16g} {position[i, 1]:.16g} 0.0\n")
        file.write(f"{n + 1} 2 0.2 1.0 {width:.16g} -4.0 0.0\n")


def timed_runs(log):
    """[(CPU seconds = loop time x CPU share, steps)] of all runs in a log: preload, then loading."""
    with open(log) as file:
        text = file.read()
    loops = re.findall(r"Loop time of (\S+) on \S+ procs for (\d+) steps", text)
    shares = re.findall(r"([\d.]+)% CPU use", text)
    return [(float(seconds) * float(share) / 100, int(steps)) for (seconds, steps), share in zip(loops, shares)]


def run(sample, folder, stiffness, inertial_number, strain, *, fraction=0.2, friction=0.4, rolling_friction=0.):
    """(columns by name, CPU seconds of the loading). Columns: axial_strain, t, s [P], volumetric_strain, kinetic_energy
    [P d^2]. fraction: step / sqrt(m_min/kn). rolling_friction: that of the discrete panel, whose couples are at most
    this x 2 Re |N|. Throws RuntimeError if LAMMPS fails."""
    os.makedirs(folder, exist_ok=True)
    position, radius, width, height = read_sample(sample)
    mass = numpy.pi * radius ** 2
    step, n = fraction * numpy.sqrt(mass.min() / stiffness), len(radius)
    write_start(os.path.join(folder, "start.data"), position, radius, width, height)
    values = dict(kn=stiffness, kt=stiffness / 2, gn=f"{2 * DAMPING * numpy.sqrt(2 * stiffness / mass.mean()):.10g}",
                  step=f"{step:.12g}", height=f"{height:.16g}", width=f"{width:.16g}", piston=n + 1, friction=friction,
                  piston_density=numpy.sqrt(n) * mass.mean() / (0.01 * numpy.pi),
                  speed=f"{inertial_number * height:.12g}",
                  preload_steps=int(PRELOAD / step), steps=int(numpy.ceil(strain / inertial_number / step)),
                  every=max(1, round(ROW_STRAIN / inertial_number / step)))
    law = (ROLLING if rolling_friction else SLIDING).format(rolling=2 * rolling_friction, **values)
    with open(os.path.join(folder, "in.biaxial"), "w") as file:
        file.write(SCRIPT.format(law=law, **values))
    done = subprocess.run(["lmp", "-in", "in.biaxial", "-log", "log.lammps", "-screen", "none"], cwd=folder,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{folder}: lmp failed: {(done.stderr or done.stdout)[-500:]}")
    rows = numpy.loadtxt(os.path.join(folder, "history.txt"))
    area = rows[:, 2] * rows[:, 3]
    sxx, syy, sxy = (rows[:, k] / area for k in (4, 5, 6))
    columns = {"axial_strain": rows[:, 1], "t": numpy.hypot((syy - sxx) / 2, sxy), "s": (sxx + syy) / 2,
               "volumetric_strain": 1 - area / area[0], "kinetic_energy": rows[:, 7]}
    return columns, timed_runs(os.path.join(folder, "log.lammps"))[-1][0]
