# diptych: comparison with a measurement
# SPDX-License-Identifier: LGPL-2.1-or-later
