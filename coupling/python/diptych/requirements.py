# diptych: what the package needs of Python, with messages that say what to install
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Raises ImportError if NumPy is missing or the compiled module belongs to another Python."""

import glob
import os
import sys

try:
    import numpy  # noqa: F401
except ImportError as error:
    raise ImportError(f"diptych needs NumPy, which {sys.executable} does not find. On Debian: install python3-numpy and use "
                      "/usr/bin/python3.") from error
try:
    from . import _diptych  # noqa: F401
except ImportError as error:
    built = [os.path.basename(path) for path in glob.glob(os.path.join(os.path.dirname(__file__), "_diptych*.so"))]
    raise ImportError(f"diptych: the compiled module ({', '.join(built) or 'missing'}) does not load in {sys.executable}, Python "
                      f"{sys.version_info.major}.{sys.version_info.minor}: {error}. Use the Python of the build; on Debian "
                      "/usr/bin/python3.") from error
