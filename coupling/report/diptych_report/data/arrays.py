# diptych: opens HDF5 files of a result folder
# SPDX-License-Identifier: LGPL-2.1-or-later

import contextlib

import h5py

from diptych_report.data.input_error import InputError

USUAL = [getattr(h5py.h5t, f"{kind}{order}") for order in ("LE", "BE")
         for kind in ("IEEE_F32", "IEEE_F64", *(f"STD_{sign}{bits}" for sign in "IU" for bits in (8, 16, 32, 64)))]


@contextlib.contextmanager
def open_arrays(path):
    """The open file. Raises InputError if it is no HDF5 file, if it refers to other files (a link may lead to a pipe, which never ends),
    or if it has numbers of unusual types (damaged type descriptions make the library read beyond its memory)."""
    try:
        with h5py.File(path, "r") as file:
            _demand_inside(path, file, set())
            yield file
    except (OSError, RuntimeError) as error:  # h5py raises either for a damaged file
        raise InputError(f"{path}: {error}") from error


def _names(group):
    """Names in the order of the file. h5py's default, the order of names, crashes in damaged groups: the library frees a table that it
    never filled."""
    names = []
    group.id.links.iterate(lambda name, *_: names.append(name.decode("utf-8", "surrogateescape")), idx_type=h5py.h5.INDEX_NAME, order=h5py.h5.ITER_NATIVE)
    return names


def _demand_inside(path, group, seen):
    for name in _names(group):
        place = f"{path}: {group.name.rstrip('/')}/{name}"
        link = group.get(name, getlink=True)
        if isinstance(link, h5py.ExternalLink):
            raise InputError(f"{place} is a link to another file, {link.filename!r}; such links are not followed")
        item = group.get(name)
        if item is not None:
            _demand_types(place, item)
        if isinstance(item, h5py.Dataset) and (item.external or item.is_virtual):
            raise InputError(f"{place} has its numbers in other files; these are not read")
        if isinstance(item, h5py.Group) and item.id not in seen:
            seen.add(item.id)
            _demand_inside(path, item, seen)


def _attributes(item):
    """Names of attributes in the order of the file, as in _names."""
    names = []
    h5py.h5a.iterate(item.id, lambda name, *_: names.append(name), index_type=h5py.h5.INDEX_NAME, order=h5py.h5.ITER_NATIVE)
    return names


def _demand_types(place, item):
    types = [("", item.id.get_type())] if isinstance(item, h5py.Dataset) else []
    types += [(f"@{name.decode('utf-8', 'replace')}", h5py.h5a.open(item.id, name).get_type()) for name in _attributes(item)]
    for where, kind in types:
        if kind.get_class() in (h5py.h5t.INTEGER, h5py.h5t.FLOAT) and kind not in USUAL:
            raise InputError(f"{place}{where} has numbers of an unusual type; allowed are integers of 8 to 64 bits and floats of 32 or 64 bits")
