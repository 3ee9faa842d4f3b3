# diptych: names of the panels and of the theory lines
# SPDX-License-Identifier: LGPL-2.1-or-later

PANEL_NAMES = {"discrete": "Grains", "continuum": "Continuum"}
PANE_NAMES = {**PANEL_NAMES, "measured": "Measurement"}
DIFFUSE = "diffuse: no band"
DIFFUSE_ZONE = "diffuse zone"
# key of "theory" -> name and formula of the line
THEORY = {"coulomb_deg": ("Coulomb", "45° + φ/2"), "arthur_deg": ("Arthur", "45° + (φ + ψ)/4"),
          "roscoe_deg": ("Roscoe", "45° + ψ/2")}
