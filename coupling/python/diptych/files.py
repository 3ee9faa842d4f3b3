# diptych: files of result folders
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads JSON, replaces a file by a complete one, and takes checksums."""

import hashlib
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .errors import InputError

LEVELLED = "levelled.json"  # of a result folder beside a measurement


@contextmanager
def part_of(path: str) -> Iterator[str]:
    """PATH.part to write to; it is renamed at the end."""
    part = path + ".part"
    try:
        yield part
        os.replace(part, path)
    except BaseException as error:
        if isinstance(error, OSError) and error.filename is None:  # a full disk
            error.filename = path
        if os.path.isfile(part):
            os.remove(part)
        raise


def sha256_of(path: str) -> str:
    """Checksum of a file."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def read_json(path: str, format: int | None = None) -> Any:
    """The object of a JSON file. Raises InputError, with the path, if it is missing, broken or has another format."""
    try:
        with open(path, encoding="utf-8") as file:
            record = json.load(file)
    except FileNotFoundError:
        raise InputError(f"{path}: is missing") from None
    except ValueError as error:
        raise InputError(f"{path}: no JSON: {error}") from error
    if not isinstance(record, dict):
        raise InputError(f"{path}: an object is expected")
    if format and record.get("format") != format:
        raise InputError(f"{path}: format {record.get('format')!r}, but this version reads format {format}; "
                         "compute it again")
    return record


def read_provenance(path: str) -> Any:
    """The record in provenance.json. Raises InputError if it is not the record of a run."""
    record = read_json(path)
    phases = record.get("phases")
    if record.get("program") != "diptych" or not isinstance(phases, list) or not all(
            isinstance(phase, dict) and {"name", "cpu_s", "peak_memory_mb"} <= phase.keys() for phase in phases):
        raise InputError(f"{path}: is not the record of a run of diptych: 'program' or 'phases' is missing or wrong; "
                         "run it again")
    return record


def read_ensemble(folder: str, format: int | None = None) -> Any:
    """ensemble.json of a folder. One without `folders` is of an earlier version: its members are in seed_K, and only
    the name of a quantity tells its key and window."""
    record = read_json(os.path.join(folder, "ensemble.json"), format)
    if "folders" not in record:
        record["folders"] = [f"seed_{seed}" for seed in record["seeds"]]
        for verdict in record["verdicts"]:
            window, band, key = verdict["quantity"].rpartition(" band ")
            verdict |= {"key": ("band_" if band else "") + key, "window": window}
    return record


def member_folders(record: Any) -> dict[int, str]:
    """The result folders of an ensemble's members by seed, relative to its own. record: of read_ensemble()."""
    return dict(zip(record["seeds"], record["folders"]))


def window_name(start: float, end: float) -> str:
    """Name of a window in ensemble.json. Six digits: those of two samples may differ by rounding."""
    return f"window {start:.6g}-{end:.6g}"


def stage_name(progress: float) -> str:
    """Name of a stage in ensemble.json."""
    return f"stage {progress:.6g}"


def key_of_band(key: str) -> str:
    """Key of a compared quantity among the bands of a comparison: band_angle_deg is their angle_deg."""
    return key.removeprefix("band_")


def number_name(panel: str, key: str, window: str = "") -> str:
    """Name of a compared quantity in ensemble.json. panel: discrete, continuum or continuum_coarse. window: that of a
    band."""
    if not window:
        return f"{panel}_summary {key}"
    of = f"{panel} {window}" if panel == "continuum_coarse" else f"{window} {panel}"
    return f"{of} band {key_of_band(key)}"
