# diptych: `diptych import` runs python3 -m diptych.importers
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Imports a sample of another code."""

import sys

from . import main

sys.exit(main())
