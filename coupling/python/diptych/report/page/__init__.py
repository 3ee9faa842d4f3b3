# diptych: the pages
# SPDX-License-Identifier: LGPL-2.1-or-later
