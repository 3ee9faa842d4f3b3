# diptych: rows of text
# SPDX-License-Identifier: LGPL-2.1-or-later
