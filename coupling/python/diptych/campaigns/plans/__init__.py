# diptych: plans: settings for an accuracy, from pilot runs
# SPDX-License-Identifier: LGPL-2.1-or-later
