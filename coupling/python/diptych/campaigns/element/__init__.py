# diptych: element tests, and homogenisation without a continuum
# SPDX-License-Identifier: LGPL-2.1-or-later
