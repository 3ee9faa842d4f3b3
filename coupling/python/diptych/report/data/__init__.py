# diptych: result folders as plain values
# SPDX-License-Identifier: LGPL-2.1-or-later
