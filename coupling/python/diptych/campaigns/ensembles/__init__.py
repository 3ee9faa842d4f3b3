# diptych: ensembles: means and verdicts over samples
# SPDX-License-Identifier: LGPL-2.1-or-later
