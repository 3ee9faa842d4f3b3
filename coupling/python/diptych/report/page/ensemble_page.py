# diptych: report.html of an ensemble of seeds
# SPDX-License-Identifier: LGPL-2.1-or-later

from ..charts import ensemble as figures
from ..charts import profiles
from ..data.ensemble import load
from .writing import write
from ..tables import ensemble as tables
from ..tables import summary


def draw(folder):
    results = load(folder)
    rows = tables.verdict_rows(results)
    labelled = [(row["text"], verdict) for row, verdict in zip(rows, results.record["verdicts"])]
    dots = [(figures.dots(verdict, tables.panel_quantities(results, verdict), label, scale), caption)
            for verdict, label, scale, caption in tables.captions(results)]
    lines = tables.curve_caption(results)
    curves = [(figures.curves(results, "stress_ratio", "stress ratio t/s"),
               "Stress ratio of the whole sample." + lines),
              (figures.curves(results, "volumetric_strain", "volumetric strain (%)", 100),
               "Volumetric strain 1 − V/V₀; dilation is negative." + lines)]
    last = max(results.profiles, default=None)
    across = None if last is None else profiles.of_means(results.profiles[last], "means over the samples")
    write(folder, "ensemble.html", record=results.record, first=summary.first(results.record), verdicts=rows,
          validation=tables.validation_table(results), differences=figures.differences(labelled), dots=dots,
          curves=curves, across=across, bands=tables.band_table(results), members=tables.members(results),
          quantities=tables.quantity_table(results), provenance=tables.provenance(results),
          fitted=results.parameters_from)
