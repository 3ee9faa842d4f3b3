# diptych: damage to files
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Functions of TEXT and BYTES take random numbers and bytes and return other bytes; damage_arrays() changes an HDF5
file."""

import re

import h5py
import numpy

ODD = ["nan", "inf", "-inf", "-0", "1e400", "1e-400", "0x10", "", "ä", "a b", "1,2", "1;2", "1e", "--", "true",
       "99999999999999999999", "-1", "0", "1e300", "%s%n", "../..", "\\", "#", "\u0663", "1.5.2", "+", "\"", "{}", "["]


def flip_bit(dice, content):
    content = bytearray(content)
    if content:
        content[dice.randrange(len(content))] ^= 1 << dice.randrange(8)
    return bytes(content)


def flip_bytes(dice, content):
    content = bytearray(content)
    for _ in range(dice.choice([1, 2, 10]) if content else 0):
        content[dice.randrange(len(content))] = dice.randrange(256)
    return bytes(content)


def cut(dice, content):
    return content[:dice.randrange(len(content) + 1)]


def zero_block(dice, content):
    """A disk that loses its power leaves such blocks."""
    size = min(len(content), dice.choice([16, 512, 4096]))
    place = dice.randrange(len(content) - size + 1)
    return content[:place] + bytes(size) + content[place + size:]


def lose_block(dice, content):
    place = dice.randrange(len(content) + 1)
    return content[:place] + content[place + dice.choice([1, 7, 100, 4096]):]


def nothing(_, __):
    return b""


def twice(_, content):
    return content + content


def carriage_returns(_, content):
    return content.replace(b"\n", b"\r\n")


def byte_order_mark(dice, content):
    return dice.choice([b"\xef\xbb\xbf" + content, content.decode("utf-8", "replace").encode("utf-16")])


def odd_line(dice, content):
    """Repeats, drops, moves or lengthens a line."""
    lines = content.split(b"\n")
    line = lines.pop(dice.randrange(len(lines)))
    long = dice.choice([b"x", b" ", b"1,", b"=", b"#", b"(", b"0.1, "]) * dice.choice([5000, 100000])
    for _ in range(dice.choice([0, 1, 2])):
        lines.insert(dice.randrange(len(lines) + 1), line + dice.choice([b"", b"", long]))
    return b"\n".join(lines)


def odd_bytes(dice, content):
    place = dice.randrange(len(content) + 1)
    return content[:place] + dice.choice([b"\0", b"\xff", b"\xc3", b"\xed\xa0\x80", b"\r", b"\x1b[2J",
                                          b"\xe2\x80\xa8"]) + content[place:]


def odd_word(dice, content):
    words = list(re.finditer(rb"[\w.+-]+", content))
    if not words:
        return content
    word = dice.choice(words)
    return content[:word.start()] + dice.choice(ODD).encode() + content[word.end():]


BYTES = (flip_bit, flip_bit, flip_bytes, cut, zero_block, lose_block, nothing, twice)
TEXT = (flip_bytes, flip_bit, cut, lose_block, odd_line, odd_line, odd_bytes, odd_word, odd_word, odd_word,
        carriage_returns, byte_order_mark, nothing, twice)


def damage_text(dice, content):
    for _ in range(dice.choice([1, 1, 1, 2, 3])):
        content = dice.choice(TEXT)(dice, content)
    return content


def names_of(path, kind):
    found = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.append(name) if isinstance(item, kind) else None)
    return found


def changed_values(dice, values):
    """What is done, and an array of another shape or type, or with an impossible value."""
    flat = values.ravel()
    odd = [-1, 10**9, -2**31] if values.dtype.kind == "i" else [numpy.nan, numpy.inf, -1e300, 1e300, -1.0, 0.0]
    other = values.copy()
    if other.size:
        other.flat[dice.randrange(other.size)] = dice.choice(odd)
    return dice.choice([("value", other), ("value", other), ("rows", values[:5]),
                        ("shape", flat if values.ndim > 1 else flat.reshape(-1, 1)),
                        ("type", values.astype("f4")), ("type", numpy.array(["x"] * max(1, flat.size), dtype="S3")),
                        ("empty", values[:0]),
                        ("scalar", flat[0] if flat.size else 0.0), ("more", numpy.concatenate([values, values]))])


def put(file, name, values, is_checked):
    """`is_checked`: with a valid checksum, as our own files have."""
    attributes = dict(file[name].attrs)
    del file[name]
    file.create_dataset(name, data=values, **({"fletcher32": True, "chunks": True} if is_checked and numpy.size(values)
                                              and numpy.ndim(values) else {}))
    for key, value in attributes.items():
        file[name].attrs[key] = value


def damage_attribute(dice, file, name):
    key = dice.choice(sorted(file[name].attrs))
    new = dice.choice([None, numpy.zeros(1000), "word", numpy.nan, -1.0, numpy.zeros(0), 10**9, numpy.array([b""]),
                       "x" * 5000])
    del file[name].attrs[key]
    if new is not None:
        file[name].attrs[key] = new
    return f"attribute {name}@{key}: {new!r:.30}", new is None or isinstance(new, (str, numpy.ndarray))


def damage_arrays(dice, path, often=""):
    """Leaves a valid HDF5 file in which an item is missing or different. `often`: pattern of the arrays that are
    changed most. Returns what was done, and whether it was more than another number."""
    arrays, groups = names_of(path, h5py.Dataset), names_of(path, h5py.Group)
    kind = dice.choice(["values", "values", "values", "missing", "group", "attribute", "attribute", "kind", "link",
                        "outside"])
    with h5py.File(path, "r+") as file:
        owners = [name for name in [*groups, *arrays, "/"] if len(file[name].attrs)]
        if kind == "attribute" and owners:
            return damage_attribute(dice, file, dice.choice(owners))
        arrays = arrays or list(file)  # a file may hold nothing but links to other files
        name = dice.choice([one for one in arrays if re.search(often, one)] or arrays if dice.random() < 0.7
                           else arrays)
        values = file[name][()] if isinstance(file.get(name), h5py.Dataset) else None
        if kind == "values" and isinstance(values, numpy.ndarray) and values.ndim and values.dtype.kind in "if":
            what, values = changed_values(dice, values)
            put(file, name, values, file[name].fletcher32 and dice.random() < 0.7)
            return f"{what} of {name}", what not in ("value", "type")
        if kind == "group" and groups:
            name = dice.choice(groups)
        del file[name]
        if kind == "kind":
            file.create_group(name)
        elif kind == "link":
            file[name] = dice.choice([h5py.SoftLink("/nowhere"), h5py.SoftLink("/" + name),
                                      h5py.ExternalLink("/dev/zero", "/x")])
        elif kind == "outside":
            file.create_dataset(name, shape=(3,), dtype="f8",
                                external=[(dice.choice(["/dev/zero", "/etc/passwd"]), 0, h5py.h5f.UNLIMITED)])
    return f"{kind} {name}", True
