# diptych: tests of result folders as RO-Crates, and of the files that describe the project to repositories
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rules are those of RO-Crate 1.1 (https://w3id.org/ro/crate/1.1) and of the profile Process Run Crate 0.5
(https://w3id.org/ro/wfrun/process/0.5)."""

import hashlib
import json
import os
import re
import shutil
import zipfile
from urllib.parse import unquote

import pytest

from conftest import QUICK, SMALL, SOURCE, options, program
from diptych.__main__ import main
from diptych.campaigns.exchange import crates


@pytest.fixture()
def run(folder, tmp_path):
    return shutil.copytree(folder, tmp_path / "a run")


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


def checked(folder, file):
    """Entities of the crate of a folder by @id, after a check of all rules."""
    assert main(["report", str(folder), "--crate", str(file), "--quiet"]) == 0
    with zipfile.ZipFile(file) as crate:
        stored = {name: crate.read(name) for name in crate.namelist()}
    assert stored == {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*")
                      if path.is_file() and path.suffix != ".part"}
    document = json.loads(stored.pop("ro-crate-metadata.json"))
    assert document["@context"][0] == "https://w3id.org/ro/crate/1.1/context"
    entities = {one["@id"]: one for one in document["@graph"]}
    assert len(entities) == len(document["@graph"])
    named = set(re.findall(r'{"@id": "([^"]*)"}', json.dumps(document)))
    assert named - set(entities) == {"https://w3id.org/ro/crate/1.1"}
    descriptor, root = entities["ro-crate-metadata.json"], entities["./"]
    assert descriptor["conformsTo"] == {"@id": "https://w3id.org/ro/crate/1.1"} and descriptor["about"] == {"@id": "./"}
    assert root["conformsTo"] == {"@id": "https://w3id.org/ro/wfrun/process/0.5"}
    assert all(root[key] for key in ("name", "description", "license"))
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\+00:00", root["datePublished"])
    parts = [part["@id"] for one in entities.values() for part in one.get("hasPart", [])]
    sets = [one["@id"] for one in entities.values() if one["@type"] == "Dataset"]
    data = [one["@id"] for one in entities.values() if one["@type"] in ("Dataset", "File")]
    assert sorted(["./", *parts]) == sorted(data)
    assert sorted(unquote(part) for part in parts if part not in sets) == sorted(stored)
    for part in set(parts) - set(sets):
        content = stored[unquote(part)]
        assert entities[part]["contentSize"] == str(len(content)) and "/" in entities[part]["encodingFormat"]
        assert entities[part]["sha256"] == hashlib.sha256(content).hexdigest()
    actions = [one for one in entities.values() if one["@type"] == "CreateAction"]
    assert [one["@id"] for one in actions] == [one["@id"] for one in root["mentions"]] and actions
    for one in actions:
        assert entities[one["instrument"]["@id"]]["@type"] == "SoftwareApplication"
        assert one["result"] and all(one[key] for key in ("name", "description", "endTime"))
        assert {entities[given["@id"]]["@type"] for given in one["object"]} <= {"File", "CreativeWork", "PropertyValue"}
    return entities


def objects(entities):
    return [entities[given["@id"]] for given in entities["#run/"]["object"]]


def test_a_run_is_a_crate_with_its_scene_seed_program_and_command(run, tmp_path):
    entities, record = checked(run, tmp_path / "new" / "run.zip"), json.loads((run / "provenance.json").read_text())
    scene, seeds = objects(entities)
    assert (scene["name"], seeds["value"]) == ("scene.prm", str(record["seeds"][0]))
    action = entities["#run/"]
    assert action["description"] == record["command"] and action["actionStatus"].endswith("/CompletedActionStatus")
    instrument = entities[action["instrument"]["@id"]]
    assert instrument["softwareVersion"] == f"{record['version']}+{record['git_revision']}"
    assert entities["discrete.h5"]["description"] == "the grains at every stage"
    checked(run, tmp_path / "again.zip")  # with the first description in the folder
    assert (tmp_path / "again.zip").read_bytes() == (tmp_path / "new" / "run.zip").read_bytes()


def test_runs_in_a_folder_are_parts_and_one_that_did_not_finish_says_why(run, tmp_path):
    study = tmp_path / "study"
    for name in "ab":
        shutil.copytree(run, study / "runs" / name)
    record = json.loads((run / "provenance.json").read_text())
    record["continuum"] |= {"finished": False, "message": "the step became too small"}
    for name, text in (("study.json", "{}"), ("half.csv.part", ""), ("runs/b/provenance.json", json.dumps(record))):
        (study / name).write_text(text)
    entities = checked(study, tmp_path / "study.zip")
    assert [one["@id"] for one in entities["./"]["hasPart"]] == ["study.json", "runs/a/", "runs/b/"]
    assert entities["#run/runs/b"]["error"] == "the step became too small" and "error" not in entities["#run/runs/a"]
    (study / "runs" / "a" / "continuum_checkpoint.h5").write_text("")
    assert checked(study, tmp_path / "killed.zip")["#run/runs/a"]["actionStatus"].endswith("/FailedActionStatus")


def test_inputs_elsewhere_have_the_checksum_of_the_time_when_they_were_read(run, tmp_path):
    program("export", run, "--format", "csv", "--output", tmp_path / "csv", "--quiet")
    tables = sorted((tmp_path / "csv").iterdir())
    sums = [(str(path), sha256(path)) for path in tables]
    assert main(["import", "csv", *map(str, tables), "--output", str(tmp_path / "mine"), "--quiet"]) == 0
    os.remove(tables[0])
    imported = objects(checked(tmp_path / "mine", tmp_path / "mine.zip"))
    assert [(one["name"], one["sha256"]) for one in imported] == sums
    field = tmp_path / "field.csv"
    field.write_text("x,y,u,v\n" + "".join(f"{k % 6},{k // 6},0,{-0.01 * (k // 6)}\n" for k in range(48)))
    assert main(["import", "field", "csv", str(field), "--output", str(tmp_path / "dic"), "--quiet", "--mean-diameter",
                 "1", "--subset", "0"]) == 0
    measured, = objects(checked(tmp_path / "dic", tmp_path / "dic.zip"))
    assert (measured["name"], measured["sha256"]) == (str(field), sha256(field))
    program("discrete", QUICK, *options(SMALL), "--set", f"sample/file={run}/discrete.h5", "--output",
            tmp_path / "grains", "--quiet")
    sample = objects(checked(tmp_path / "grains", tmp_path / "grains.zip"))[-1]
    assert sample["sha256"] == sha256(run / "discrete.h5")
    (run / "discrete.h5").write_bytes(b"another")
    assert "sha256" not in objects(checked(tmp_path / "grains", tmp_path / "changed.zip"))[-1]


@pytest.mark.parametrize("fault, message", [("exists", "exists; name a new file"), ("inside", "name a file elsewhere"),
                                            ("no record", "has no provenance.json"), ("changed", "was changed after")])
def test_a_crate_is_refused_and_nothing_is_written(run, tmp_path, capsys, fault, message):
    file = run / "run.zip" if fault == "inside" else tmp_path / "run.zip"
    if fault == "exists":
        file.write_text("mine")
    if fault == "no record":
        os.remove(run / "provenance.json")
    if fault == "changed":
        (run / "discrete.csv").write_text("a\n")
    before = sorted(tmp_path.rglob("*"))
    assert main(["report", str(run), "--crate", str(file)]) == 2
    assert message in capsys.readouterr().err and sorted(tmp_path.rglob("*")) == before
    assert fault != "exists" or file.read_text() == "mine"


def test_the_files_that_describe_the_project_agree():
    cff, cmake, meta, zenodo = (open(os.path.join(SOURCE, name), encoding="utf-8").read() for name in (
        "CITATION.cff", "CMakeLists.txt", ".codemeta.json", ".zenodo.json"))
    meta, zenodo = json.loads(meta), json.loads(zenodo)
    cited = dict(re.findall(r'^(\S+): "?(.+?)"?$', cff, re.MULTILINE))
    developers, = re.findall(r"^  - name: (.*)$", cff, re.MULTILINE)
    paper, = re.findall(r'^    title: (.*)$(?:.*\n)*?    year: (\d+)$(?:.*\n)*?    url: "(.*)"$', cff, re.MULTILINE)
    shared = {"version": cited["version"], "keywords": re.findall(r"^  - (\w[\w ]*)$", cff, re.MULTILINE),
              "description": " ".join(re.search(r"abstract: >-\n((?:  .*\n)+)", cff)[1].split())}
    assert shared.items() <= meta.items() and shared.items() <= zenodo.items()
    assert f"project(diptych VERSION {cited['version']} " in cmake
    assert (meta["name"], zenodo["title"]) == (cited["title"].split(":")[0], cited["title"])
    assert meta["datePublished"] == zenodo["publication_date"] == cited["date-released"]
    assert meta["license"] == crates.LICENCE == "https://spdx.org/licenses/" + cited["license"]
    assert zenodo["license"] == cited["license"].lower()
    fixed = {one["@id"]: one for one in crates.FIXED}
    assert meta["author"][0]["name"] == zenodo["creators"][0]["name"] == fixed["#developers"]["name"] == developers
    assert (fixed[crates.PAPER]["name"], fixed[crates.PAPER]["datePublished"], crates.PAPER) == paper
    assert (meta["referencePublication"]["name"], meta["referencePublication"]["@id"]) == paper[::2]
    assert zenodo["related_identifiers"][0]["identifier"] == paper[2]
