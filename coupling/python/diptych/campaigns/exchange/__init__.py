# diptych: the commands import and export
# SPDX-License-Identifier: LGPL-2.1-or-later
