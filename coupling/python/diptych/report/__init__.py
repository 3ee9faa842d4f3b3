# diptych: the report of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages and pictures of folders: page -> charts, tables -> data; data uses none of the others."""


class InputError(Exception):
    """A file of the folder is missing, broken or has another format."""
