# diptych: report.html of a study with ranges
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..charts import sensitivity as figures
from ..data.sensitivity import labels
from .writing import template
from ..tables import sensitivity as tables
from ..tables import study as study_tables
from ..tables.wording import suffix, typeset

ENOUGH = 0.9  # Q² below this: the indices say little


def page(study):
    record = study.record["sensitivity"]
    names = labels(record)
    parts = [{"title": typeset(one["quantity"])
              + (f" ({suffix(one['unit']).strip()})" if suffix(one["unit"]).strip() else ""),
              "basis": tables.basis(one, record), "doubtful": one["q2"] is not None and one["q2"] < ENOUGH,
              "chart": figures.indices(one, names) if one["parameters"] else None, "table": tables.indices(one, names),
              "panel": one["panel"]}
             for one in record["indices"]]
    failed = [point for point in study_tables.points(study) if point["messages"]]
    return template("sensitivity.html").render(
        record=study.record, n_points=record["points"], parts=parts, ranges=tables.ranges(record), failed=failed,
        several=len({part["panel"] for part in parts}) > 1, disturbed=study_tables.disturbed(study),
        provenance=study_tables.provenance(study))
