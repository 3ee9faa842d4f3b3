# diptych: tables of homogenised grains
# SPDX-License-Identifier: LGPL-2.1-or-later

from .wording import number, rounded

# key -> (head, unit of the form of numbers)
FRAME = {"s": ("s", "pressure of the files"), "t_over_s": ("t/s", "[95 %]"),
         "direction_deg": ("direction of σ₁", "degrees [95 %]"), "solid_fraction": ("solid fraction", ""),
         "coordination_number": ("contacts per grain", ""), "rattlers": ("rattlers", "grains"),
         "anisotropy": ("anisotropy", "[95 %]"), "fabric_direction_deg": ("direction of the fabric", "degrees [95 %]"),
         "volumetric_strain": ("volumetric strain", "%")}
FORMS = {"direction_deg": ("", 1), "fabric_direction_deg": ("", 1), "volumetric_strain": ("%", 2),
         "coordination_number": ("", 2)}
BAND = {"angle_deg": ("inclination", "degrees [95 %]"), "width_10_90_d": ("width 10–90", "d [95 %]"),
        "offset_d": ("offset", "d [95 %]"), "jump": ("jump", "of the platens’ travel [95 %]"),
        "dilation_deg": ("dilation", "degrees [95 %]")}
STRAIN = {"strain_xx": "ε xx", "strain_yy": "ε yy", "strain_xy": "ε xy"}


def frames(result):
    """One row per frame; "missing" where the files hold no forces."""
    across = result.loading_variable
    rows = [[across.number(frame["progress"])] + [_cell(frame, key) for key in FRAME] for frame in result.frames]
    return {"head": [(across.word, across.unit.strip()), *FRAME.values()], "rows": rows}


def _cell(frame, key):
    if frame.get(key) is None:
        return "missing"
    if key == "s":
        return number(frame[key])
    text = rounded(frame[key], *FORMS.get(key, ("", None)))
    return text.removesuffix(" %").removesuffix("\u00a0%")


def increments(result):
    """One row per increment and band."""
    across, rows = result.loading_variable, []
    for one in result.record["increments"]:
        place = f"{across.number(one['from'])}–{across.number(one['to'])}"
        strain = [rounded(one[key], "%", 3).removesuffix("\u00a0%") if one[key] is not None else "missing"
                  for key in STRAIN]
        for band in one["bands"] or [None]:
            values = [rounded(band[key], "", 2 if key == "jump" else 1) for key in BAND if band]
            values = values or [one["band_verdict"]]
            rows.append([place, *strain, *values, *[""] * (len(BAND) - len(values))])
            place, strain = "", [""] * len(strain)
    strains = [(name, "%") for name in STRAIN.values()]
    return {"head": [(across.word, across.unit.strip()), *strains, *BAND.values()], "rows": rows}
