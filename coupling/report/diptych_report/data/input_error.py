# diptych: what a drawing refuses
# SPDX-License-Identifier: LGPL-2.1-or-later


class InputError(Exception):
    """A file is missing, broken or of another format; the message names it."""
