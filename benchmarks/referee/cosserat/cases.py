# diptych: cases of the comparison with an independent Cosserat model
# SPDX-License-Identifier: LGPL-2.1-or-later
import os

HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "scene.prm")
MILD = {"friction_angle_residual": 27, "dilatancy_angle_residual": 7, "softening_strain": 0.1, "viscosity": 0.01}

# Keys that are added to scene.prm; without a slash they belong to the section continuum.
CASES = {
    "cone": {},
    "cone_fine": {"element_size": 0.5},
    "cone_viscous": {"viscosity": 0.01},
    "wedge": {"law": "cosserat_mohr_coulomb"},
    "wedge_mobilised": {"law": "cosserat_mohr_coulomb", "hardening": "mobilisation", "friction_angle_start": 15,
                        "mobilisation_strain": 0.005},
    "local_cone": {"law": "drucker_prager", **MILD},
    "local_wedge": {"law": "mohr_coulomb", **MILD},
    "tip": {"element_size": 2, "viscosity": 0.001, "internal_length": 2, "initial_step": 0.0001, "max_step": 0.0001,
            "loading/horizontal_over_vertical": 10, "loading/axial_strain": 0.006, "loading/stage_strain": 0.002},
}


def settings(case: str) -> list[str]:
    """Added keys as section/key=value."""
    return [f"{key if '/' in key else 'continuum/' + key}={value}" for key, value in CASES[case].items()]


def keys(case: str) -> dict[str, str]:
    """All keys of the case by name, without their sections."""
    found = {}
    with open(SCENE) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["set"]:
                found[words[1]] = words[3]
    return found | dict(setting.split("/")[1].split("=") for setting in settings(case))


def stages(case: str) -> tuple[float, float]:
    """Axial strains (before, end). Plastic shear is compared as the increment between them, other fields at the end."""
    end, increment = (float(keys(case)[name]) for name in ("axial_strain", "stage_strain"))
    return end - increment, end
