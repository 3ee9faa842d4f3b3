# diptych: what all campaigns share: workers, folders, input files, statistics
# SPDX-License-Identifier: LGPL-2.1-or-later
