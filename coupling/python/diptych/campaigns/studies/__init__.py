# diptych: studies: points, errors, effects, levels of accuracy, Sobol indices
# SPDX-License-Identifier: LGPL-2.1-or-later
