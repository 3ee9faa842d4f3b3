# diptych: result folders as RO-Crates
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A result folder with ro-crate-metadata.json, which repositories of research data read: RO-Crate 1.1, profile Process
Run Crate 0.5. Each provenance.json in the folder or below is the record of one run."""

import os
import shutil
import zipfile
from collections.abc import Iterable, Sequence
from typing import Any
from urllib.parse import quote

from ... import _diptych
from ...errors import SceneError
from ...files import LEVELLED, part_of, read_json, read_provenance, sha256_of
from ...measurement import FACTS, FIELD, HISTORY
from ..runs.folders import write_json

Entity = dict[str, Any]

METADATA = "ro-crate-metadata.json"
CRATE, PROFILE = "https://w3id.org/ro/crate/1.1", "https://w3id.org/ro/wfrun/process/0.5"
CONTEXT = [CRATE + "/context", {"sha256": "http://schema.org/sha256"}]  # version 1.1 does not define this term
LICENCE, PAPER = "https://spdx.org/licenses/LGPL-2.1-or-later", "https://hal.science/hal-01825188"
# As in CITATION.cff, and the entities that every crate has.
FIXED = [
    {"@id": METADATA, "@type": "CreativeWork", "conformsTo": {"@id": CRATE}, "about": {"@id": "./"}},
    {"@id": PROFILE, "@type": "CreativeWork", "name": "Process Run Crate", "version": "0.5"},
    {"@id": "#licence", "@type": "CreativeWork", "name": "No licence chosen",
     "description": "The owner of these results has not chosen a licence. Name one here before you publish them."},
    {"@id": LICENCE, "@type": "CreativeWork", "name": "LGPL-2.1-or-later",
     "description": "GNU Lesser General Public License, version 2.1 or later"},
    {"@id": "#developers", "@type": "Organization", "name": "The Diptych developers"},
    {"@id": PAPER, "@type": "ScholarlyArticle", "name": "Numerical investigation of shear zones in granular materials",
     "author": "J. J. Moreau", "datePublished": "1997"}]

_FORMATS = {".csv": "text/csv", ".gif": "image/gif", ".h5": "application/x-hdf5", ".html": "text/html",
            ".json": "application/json", ".log": "text/plain", ".prm": "text/plain", ".pvd": "application/xml",
            ".vtu": "application/xml"}
_MEANINGS = {"scene.prm": "the scene with every parameter", "provenance.json": "program, machine, costs and checksums",
             "import.json": "files of another code, and what their checks found",
             "measured.json": "facts of a measured field", "measured.h5": "its points at every instant",
             "discrete.csv": "the grains at every step", "discrete.h5": "the grains at every stage",
             "continuum.csv": "the continuum at every load step", "continuum.h5": "the continuum at every stage",
             "comparison.json": "numbers of the comparison with intervals", "comparison.h5": "fields of both panels",
             "comparison.csv": "numbers of the comparison as a table", "summary.csv": "the first answer as a table",
             "ensemble.prm": "the scene of all samples", "ensemble.json": "means, intervals and verdicts",
             "ensemble.csv": "numbers of all samples", "report.html": "the results as one page"}
_PANELS = ("discrete", "continuum", "continuum_coarse")


def _references(ids: Iterable[str]) -> list[Entity]:
    return [{"@id": one} for one in ids]


def _files_of(folder: str) -> list[str]:
    """Paths below the folder. Locks, unfinished files and an earlier description are left out."""
    found = (os.path.relpath(os.path.join(root, name), folder) for root, _, names in os.walk(folder) for name in names
             if not name.startswith(".") and not name.endswith(".part"))
    return sorted(path for path in found if path != METADATA)


def _file(folder: str, path: str) -> Entity:
    full, name = os.path.join(folder, path), os.path.basename(path)
    about = {"description": _MEANINGS[name]} if name in _MEANINGS else {}
    return {"@id": quote(path), "@type": "File", "name": path, "contentSize": str(os.path.getsize(full)), **about,
            "sha256": sha256_of(full),
            "encodingFormat": _FORMATS.get(os.path.splitext(name)[1], "application/octet-stream")}


def _inputs(here: str, scene: Any) -> list[tuple[str, str]]:
    """(path, SHA-256) of the files elsewhere that a run or an import has read; "": changed since, or not known."""
    imports = [path for name in ("import.json", FACTS) if os.path.exists(path := os.path.join(here, name))]
    if imports:
        record = read_json(imports[0])
        return list(zip(record["files"], record.get("sha256") or [""] * len(record["files"])))
    if scene is None:
        return []
    measured = os.path.join(here, LEVELLED)
    folder = read_json(measured)["folder"] if os.path.exists(measured) else ""
    beside = [os.path.join(folder, name) for name in (FIELD, FACTS, HISTORY) if folder]
    changed = any(_diptych.changes_since(scene.in_folder(here, scene.name)))
    return [(path, "" if changed else sha256_of(path)) for _, path in scene.input_files()] + [
        (path, sha256_of(path) if os.path.exists(path) else "") for path in beside]


def _program(record: Any) -> Entity:
    return {"@id": f"#diptych-{record['version']}-{record['git_revision']}", "@type": "SoftwareApplication",
            "name": "Diptych", "softwareVersion": f"{record['version']}+{record['git_revision']}",
            "license": {"@id": LICENCE}, "author": {"@id": "#developers"}, "citation": {"@id": PAPER},
            "description": "A granular sample grain by grain and as a continuum. Built with "
            + ", ".join(f"{name} {version}" for name, version in record["libraries"].items())}


def _run(folder: str, at: str, record: Any, files: Sequence[str]) -> list[Entity]:
    """The action of the record in the folder `at`, first, and the entities that it names. files: those of the run."""
    here = os.path.normpath(os.path.join(folder, at))
    scene, program = _diptych.resolved_scene(os.path.join(here, "scene.prm")), _program(record)
    scenes = [path for path in files if path == os.path.join(at, "ensemble.prm")
              or (scene is not None and path == os.path.join(at, "scene.prm"))]  # that of an import is a proposal
    inputs: list[Entity] = [{"@id": f"#seeds/{quote(at)}", "@type": "PropertyValue", "name": "seeds of the samples",
                             "value": ", ".join(map(str, record["seeds"]))}] if scenes else []
    for path, checksum in _inputs(here, scene):
        about = {"sha256": checksum} if checksum else {"description": "changed since, or its checksum is not known"}
        inputs.append({"@id": f"#input/{quote(at)}/{quote(path)}", "@type": "CreativeWork", "name": path, **about})
    failed = [record[part].get("message") or "stopped" for part in _PANELS
              if part in record and not record[part]["finished"]]
    failed = failed or ["stopped" for path in files if path.endswith("checkpoint.h5")]  # killed
    return [{"@id": f"#run/{quote(at)}", "@type": "CreateAction", "description": record["command"],
             "name": " ".join([*record["command"].split()[:2], record["scene"]]).rstrip(),
             "endTime": record["date"].replace("Z", "+00:00"), "instrument": {"@id": program["@id"]},
             "actionStatus": f"http://schema.org/{'Failed' if failed else 'Completed'}ActionStatus",
             **({"error": "; ".join(failed)} if failed else {}),
             "object": _references([*map(quote, scenes), *(one["@id"] for one in inputs)]),
             "result": _references(quote(path) for path in files if path not in scenes)}, program, *inputs]


def metadata(folder: str) -> Entity:
    """The content of ro-crate-metadata.json. Raises SceneError without a record of a run, ValueError for a file that
    was changed after the run."""
    files = _files_of(folder)
    records = {os.path.dirname(path): read_provenance(os.path.join(folder, path)) for path in files
               if os.path.basename(path) == "provenance.json"}
    if not records:
        raise SceneError(f"{folder}: has no provenance.json, here or below, so no run to describe; diptych run SCENE "
                         "makes a result folder")
    parts: dict[str, list[str]] = {at: [] for at in ("", *records)}
    for path in files:
        at = os.path.dirname(path)
        while at not in parts:
            at = os.path.dirname(at)
        parts[at].append(path)
    for at in records:
        _diptych.check_part(os.path.normpath(os.path.join(folder, at)), "")
    runs = [_run(folder, at, record, parts[at]) for at, record in records.items()]
    inner = [{"@id": quote(at) + "/", "@type": "Dataset", "name": at, "hasPart": _references(map(quote, parts[at]))}
             for at in records if at]
    root = {"@id": "./", "@type": "Dataset", "name": os.path.basename(os.path.realpath(folder)),
            "description": f"Results of Diptych: {', '.join(sorted({action['name'] for action, *_ in runs}))}",
            "datePublished": max(action["endTime"] for action, *_ in runs), "license": {"@id": "#licence"},
            "conformsTo": {"@id": PROFILE}, "mentions": _references(action["@id"] for action, *_ in runs),
            "hasPart": _references([*map(quote, parts[""]), *(one["@id"] for one in inner)])}
    entities = [root, *FIXED, *inner, *(_file(folder, path) for path in files), *(one for run in runs for one in run)]
    return {"@context": CONTEXT, "@graph": list({one["@id"]: one for one in entities}.values())}


def write_crate(folder: str, file: str) -> None:
    """Writes ro-crate-metadata.json to the folder, and all files of the folder to a zip file. The same folder gives the
    same bytes. Raises SceneError if the file exists, or lies in the folder that it is to hold."""
    if os.path.exists(file):
        raise SceneError(f"--crate {file}: exists; name a new file")
    if os.path.realpath(file).startswith(os.path.realpath(folder) + os.sep):
        raise SceneError(f"--crate {file}: lies in {folder}, which it is to hold; name a file elsewhere")
    write_json(os.path.join(folder, METADATA), metadata(folder), 2)
    os.makedirs(os.path.dirname(os.path.abspath(file)), exist_ok=True)
    with part_of(file) as part, zipfile.ZipFile(part, "w") as crate:
        for path in (METADATA, *_files_of(folder)):
            entry = zipfile.ZipInfo.from_file(os.path.join(folder, path), path, strict_timestamps=False)
            entry.date_time, entry.compress_type = (1980, 1, 1, 0, 0, 0), zipfile.ZIP_DEFLATED
            with open(os.path.join(folder, path), "rb") as source, crate.open(entry, "w") as target:
                shutil.copyfileobj(source, target, 1 << 20)
