# diptych: the report of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later
"""page -> charts, tables -> data; data uses none of the others."""


class InputError(Exception):
    """A file of the folder is missing, broken or has another format."""
