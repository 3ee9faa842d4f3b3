# diptych: calibrations of the continuum's law, or of the friction of the grains
# SPDX-License-Identifier: LGPL-2.1-or-later
