# diptych: the summary of a run or an ensemble
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A frame that prints its numbers in a narrow terminal, too. It needs pandas, which loads slowly."""

import pandas as pd

PRINTED = ["measured", "grains", "continuum", "difference", "difference_low", "difference_high", "unit", "verdict"]


class Summary(pd.DataFrame):
    """The rows of a summary. Printed, it has four digits and leaves out empty columns and intervals of the panels."""

    def __repr__(self) -> str:
        with pd.option_context("display.max_columns", None, "display.max_colwidth", None, "display.float_format",
                               "{:.4g}".format):
            return repr(pd.DataFrame(self.reindex(columns=PRINTED).dropna(axis=1, how="all")))
