# diptych: reads a study of the time step
# SPDX-License-Identifier: LGPL-2.1-or-later

import os
from dataclasses import dataclass

from diptych_report.data.files import InputError, read_csv, read_json, require


@dataclass
class StepStudy:
    """runs: [(step, {column: array})], the longest step first. verdict: a sentence of the program."""

    verdict: str
    runs: list


def load(folder):
    """Raises InputError if study_step.csv or study_step.json is missing or broken."""
    require(folder, ("study_step.csv", "study_step.json"))
    record = read_json(os.path.join(folder, "study_step.json"))
    table = read_csv(os.path.join(folder, "study_step.csv"))
    if not record.get("steps") or "step" not in table or "time" not in table:
        raise InputError(f"{folder}/study_step.json, study_step.csv: no steps")
    runs = [(step, {name: column[table["step"] == step] for name, column in table.items()}) for step in record["steps"]]
    return StepStudy(str(record.get("verdict", "")), runs)
