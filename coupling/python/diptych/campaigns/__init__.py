# diptych: campaigns of many runs: studies, ensembles, plans, calibrations
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Campaigns of many runs. `python -m diptych` is the part of the program that does them."""
