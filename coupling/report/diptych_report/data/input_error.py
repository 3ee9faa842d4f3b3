# diptych: error of a wrong input file
# SPDX-License-Identifier: LGPL-2.1-or-later


class InputError(Exception):
    """A file is missing, broken or has another format; the message names it."""
