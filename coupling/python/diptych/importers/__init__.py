# diptych: importers of other codes' samples
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Readers of LAMMPS, LIGGGHTS, Yade, LMGC90, MercuryDPM and tables, and the place for a reader of your own.

A reader is a function that takes Options and returns a list of Frame in ascending order; register() gives it a name.
"""

from .frames import Frame, Options, Wall, contacts_of, refused
from .readers import check, check_frames, read, register
from .table_files import read_table
from .tables import Table, grains_of
from .text import read_lines
from .walls import sorted_files

__all__ = ["Frame", "Options", "Table", "Wall", "check", "check_frames", "contacts_of", "grains_of", "read",
           "read_lines", "read_table", "refused", "register", "sorted_files"]
