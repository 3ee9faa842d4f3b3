# diptych: HDF5 files of a result folder, opened for reading
# SPDX-License-Identifier: LGPL-2.1-or-later

import contextlib

import h5py

from diptych_report.data.input_error import InputError


@contextlib.contextmanager
def open_arrays(path):
    """The file. Raises InputError where it is none, or where something in it stands in another file: links may lead to a pipe, which never ends, and to
    what is no result."""
    try:
        with h5py.File(path, "r") as file:
            _demand_inside(path, file, set())
            yield file
    except (OSError, RuntimeError) as error:  # of h5py: a damaged file is either, by the place of the damage
        raise InputError(f"{path}: {error}") from error


def _names(group):
    """In the file's own order: for the order of names, in which h5py goes by itself, the library makes a table first, of which it frees what it never
    filled where the group is damaged."""
    names = []
    group.id.links.iterate(lambda name, *_: names.append(name.decode("utf-8", "surrogateescape")), idx_type=h5py.h5.INDEX_NAME, order=h5py.h5.ITER_NATIVE)
    return names


def _demand_inside(path, group, seen):
    for name in _names(group):
        place = f"{path}: {group.name.rstrip('/')}/{name}"
        link = group.get(name, getlink=True)
        if isinstance(link, h5py.ExternalLink):
            raise InputError(f"{place} stands in another file, {link.filename!r}: links into other files are not followed")
        item = group.get(name)
        if isinstance(item, h5py.Dataset) and (item.external or item.is_virtual):
            raise InputError(f"{place} has its numbers in other files, which are not read")
        if isinstance(item, h5py.Group) and item.id not in seen:
            seen.add(item.id)
            _demand_inside(path, item, seen)
