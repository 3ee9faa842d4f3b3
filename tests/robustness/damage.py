# diptych: files damaged as disks, editors, programs and people do
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each function takes the case's dice and content, and returns other content (text as bytes), or changes an HDF5 file in place."""

import os
import re

import h5py
import numpy

ODD = ["nan", "inf", "-inf", "-0", "1e400", "-1e400", "1e-400", "0x10", "", "ä", "a b", "1,2", "1;2", "1e", "--", "true", "null",
       "99999999999999999999", "-1", "0", "1e300", "%s%n", "$HOME", "../..", "\\", "#", "\u0663", "1.5.2", "+", "\"", "'", "{}", "[", "*"]


def cut(dice, content):
    return content[:dice.randrange(len(content) + 1)]


def flip_bytes(dice, content):
    content = bytearray(content)
    for _ in range(dice.choice([1, 1, 2, 10])):
        if content:
            content[dice.randrange(len(content))] = dice.randrange(256)
    return bytes(content)


def flip_bit(dice, content):
    content = bytearray(content)
    if content:
        content[dice.randrange(len(content))] ^= 1 << dice.randrange(8)
    return bytes(content)


def zero_block(dice, content):
    """As a disk leaves it that lost its power."""
    size = min(len(content), dice.choice([16, 512, 4096]))
    place = dice.randrange(len(content) - size + 1)
    return content[:place] + bytes(size) + content[place + size:]


def lose_block(dice, content):
    place = dice.randrange(len(content) + 1)
    return content[:place] + content[place + dice.choice([1, 7, 100, 4096]):]


def lines_of(change):
    def changed(dice, content):
        lines = content.split(b"\n")
        change(dice, lines)
        return b"\n".join(lines)
    changed.__name__ = change.__name__
    return changed


@lines_of
def repeat_line(dice, lines):
    k = dice.randrange(len(lines))
    lines.insert(dice.randrange(len(lines) + 1), lines[k])


@lines_of
def drop_line(dice, lines):
    del lines[dice.randrange(len(lines))]


@lines_of
def swap_lines(dice, lines):
    a, b = dice.randrange(len(lines)), dice.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]


@lines_of
def long_line(dice, lines):
    k, word = dice.randrange(len(lines)), dice.choice([b"x", b" ", b"1 ", b"1,", b"=", b"#", b"\\", b"(", b"0.1, "])
    lines[k] += word * (dice.choice([26000, 300000]) // len(word))


@lines_of
def long_list(dice, lines):
    k = dice.randrange(len(lines))
    lines[k] = re.sub(rb"[^=:]*$", b" " + b", ".join(b"%d" % n for n in range(100000)), lines[k], count=1)


@lines_of
def odd_bytes(dice, lines):
    k = dice.randrange(len(lines))
    place = dice.randrange(len(lines[k]) + 1)
    lines[k] = lines[k][:place] + dice.choice([b"\0", b"\xff", b"\xc3", b"\xed\xa0\x80", b"\r", b"\x1b[2J", b"\xe2\x80\xa8"]) + lines[k][place:]


@lines_of
def odd_word(dice, lines):
    """A word or number of a line becomes another."""
    full = [k for k, line in enumerate(lines) if re.search(rb"[\w.+-]+", line)]
    if not full:
        return
    k = dice.choice(full)
    word = dice.choice(list(re.finditer(rb"[\w.+-]+", lines[k])))
    lines[k] = lines[k][:word.start()] + dice.choice(ODD).encode() + lines[k][word.end():]


def carriage_returns(_, content):
    return content.replace(b"\n", b"\r\n")


def byte_order_mark(dice, content):
    return dice.choice([b"\xef\xbb\xbf" + content, content.decode("utf-8", "replace").encode("utf-16")])


def nothing(_, content):
    return b""


def blanks(dice, content):
    return dice.choice([b"\n", b" ", b"\0" * 1000, b"\xff" * 100, b"#" * 1000])


def twice(_, content):
    return content + content


TEXT = (cut, cut, flip_bytes, flip_bytes, flip_bit, lose_block, repeat_line, drop_line, swap_lines, long_line, long_list, odd_bytes,
        odd_bytes, odd_word, odd_word, odd_word, odd_word, carriage_returns, byte_order_mark, nothing, blanks, twice)
BYTES = (cut, cut, flip_bytes, flip_bit, flip_bit, zero_block, lose_block, nothing, blanks, twice)


def damage_text(dice, content):
    for _ in range(dice.choice([1, 1, 1, 2, 3])):
        content = dice.choice(TEXT)(dice, content)
    return content


def damage_bytes(dice, content):
    return dice.choice(BYTES)(dice, content)


def items(path, kind):
    found = []
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.append(name) if isinstance(item, kind) else None)
    return found


def replace(file, name, values, **storage):
    """`storage`: of h5py's create_dataset."""
    attributes = dict(file[name].attrs)
    del file[name]
    file.create_dataset(name, data=values, **storage)
    for key, value in attributes.items():
        file[name].attrs[key] = value


def checked(dice, file, name, values):
    """Mostly the checksum that the array had: what was changed is then a number of the program's own, as far as its file tells."""
    return {"fletcher32": True, "chunks": True} if file[name].fletcher32 and numpy.size(values) and numpy.ndim(values) and dice.random() < 0.7 else {}


def pipe_beside(path, name):
    """What leads there never ends, if it is followed."""
    pipe = os.path.join(os.path.dirname(path), name)
    if not os.path.lexists(pipe):
        os.mkfifo(pipe)
    return pipe


def odd_bits(dice, file, name, values):
    """Whole numbers in some of the bits of 64, as the library allows and no program writes."""
    kind = h5py.h5t.STD_I64LE.copy()
    kind.set_precision(dice.choice([5, 13, 32]))
    kind.set_offset(dice.choice([0, 7, 31]))
    del file[name]
    array = h5py.h5d.create(file.id, name.encode(), kind, h5py.h5s.create_simple(values.shape))
    array.write(h5py.h5s.ALL, h5py.h5s.ALL, numpy.arange(values.size).reshape(values.shape))
    return f"odd bits of {name}"


def led_outside(dice, path, file, name):
    """An array that stands in another file: by a link, or by where its numbers are."""
    values = file[name][()] if isinstance(file.get(name), h5py.Dataset) else numpy.zeros(3)
    del file[name]
    pipe = pipe_beside(path, "pipe.h5")
    if dice.random() < 0.5 or not (isinstance(values, numpy.ndarray) and values.size and values.dtype.kind in "if"):
        target = dice.choice(["pipe.h5", pipe, "/dev/zero", "other.h5", "../pipe.h5"])
        file[name] = h5py.ExternalLink(target, dice.choice(["/x", "/", "/" + name]))
        return f"external link {target} as {name}"
    target = dice.choice([pipe, "/dev/zero", "/dev/null", "/etc/passwd"])
    file.create_dataset(name, shape=values.shape, dtype=values.dtype, external=[(target, 0, h5py.h5f.UNLIMITED)])
    return f"numbers of {name} in {target}"


def changed_values(dice, values, kind):
    """One array in another shape, type or with values that cannot be."""
    flat = values.ravel()
    if kind == "rows":
        return values[:5]
    if kind == "shape":
        return flat if values.ndim > 1 else flat.reshape(-1, 1)
    if kind == "type":
        return dice.choice([values.astype("f4"), values.astype("i8"), numpy.array(["x"] * max(1, len(flat)), dtype="S3")])
    if kind == "empty":
        return values[:0]
    if kind == "scalar":
        return flat[0] if flat.size else 0.0
    if kind == "more":
        return numpy.concatenate([values, values]) if values.size else numpy.zeros((3,) + values.shape[1:], values.dtype)
    if flat.size:
        flat = flat.copy()
        odd = [-1, 10**9, -2**31, 2**31 - 1] if flat.dtype.kind == "i" else [numpy.nan, numpy.inf, -1e300, 1e300, -1.0, 0.0]
        flat[dice.randrange(flat.size)] = dice.choice(odd)
    return flat.reshape(values.shape)


def damage_arrays(dice, path, often=""):
    """What a program that means well leaves: an HDF5 file that is one, with something missing or changed. `often`: pattern of arrays
    that are. Returns what was done, and whether it can be told from a whole file: more than a number is another."""
    datasets, groups = items(path, h5py.Dataset), items(path, h5py.Group)
    kind = dice.choice(["dataset", "dataset", "dataset", "missing", "group", "attribute", "attribute", "kind", "link", "outside"])
    with h5py.File(path, "r+") as file:
        if not datasets:  # links into other files are all that it holds
            datasets, kind = list(file), dice.choice(["missing", "kind", "link", "outside"])
        name = dice.choice([one for one in datasets if re.search(often, one)] or datasets if dice.random() < 0.7 else datasets)
        if kind == "missing":
            del file[name]
        elif kind == "group" and groups:
            name = dice.choice(groups)
            del file[name]
        elif kind == "attribute":
            owners = [one for one in groups + datasets + ["/"] if len(file[one].attrs)]
            if owners:
                name = dice.choice(owners)
                key = dice.choice(sorted(file[name].attrs))
                new = dice.choice([None, numpy.zeros(1000), "word", numpy.nan, -1.0, numpy.zeros(0), 10**9, numpy.array([b"axial_strain"] * 4000), numpy.array([b""]),
                                   "x" * 5000])
                del file[name].attrs[key]
                if new is not None:
                    file[name].attrs[key] = new
                return f"attribute {name}@{key}: {new!r:.30}", new is None or isinstance(new, (str, numpy.ndarray))
        elif kind == "kind":
            del file[name]
            file.create_group(name)
        elif kind == "outside":
            return led_outside(dice, path, file, name), True
        elif kind == "link":
            del file[name]
            file[name] = dice.choice([h5py.SoftLink("/nowhere"), h5py.SoftLink("/" + name)])
        else:
            values = numpy.asarray(file[name][()])
            if values.dtype.kind in "if" and values.ndim:
                change = dice.choice(["rows", "shape", "type", "value", "empty", "scalar", "more", "bits"])
                if change == "bits":
                    return odd_bits(dice, file, name, values), True
                values = changed_values(dice, values, change)
                replace(file, name, values, **checked(dice, file, name, values))
                return f"{change} of {name}", change not in ("value", "type")
            del file[name]
    return f"{kind} {name}", True
