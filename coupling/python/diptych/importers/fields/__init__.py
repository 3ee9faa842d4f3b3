# diptych: importers of measured displacement fields
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Readers of SPAM, DICe, PIVlab, Ncorr, VTK and tables, and the place for a reader of your own.

A reader is a function that takes FieldOptions and returns a list of FieldFrame in the order of time; register() gives
it a name.
"""

from ...measurement import FieldFrame
from ..frames import refused
from .frames import FieldOptions, table_of, vectors_where
from .readers import read_fields, register

__all__ = ["FieldFrame", "FieldOptions", "read_fields", "refused", "register", "table_of", "vectors_where"]
