# diptych: arrays of the maps, with 16 bits per number, each stored once
# SPDX-License-Identifier: LGPL-2.1-or-later

import base64

import numpy as np

LARGEST = 65534  # code of the largest value; 65535 is NaN


class Store:
    """Arrays as {"low", "high", "data"}: value = low + code (high - low)/65534, codes of 16 bits, low byte first, in
    base64.

    Equal arrays share one entry, such as the positions of grains at the end of a window and of the stage that ends
    there.
    """

    def __init__(self):
        self.entries = []
        self._known = {}

    def add(self, values):
        """Index of the entry of an array of any shape, which is stored flat. None for None."""
        if values is None:
            return None
        values = np.asarray(values, dtype=float).ravel()
        finite = values[np.isfinite(values)]
        low, high = (float(finite.min()), float(finite.max())) if len(finite) else (0.0, 0.0)
        scale = LARGEST / (high - low) if high > low else 0.0
        codes = np.where(np.isfinite(values), np.rint((np.nan_to_num(values) - low) * scale), LARGEST + 1).astype("<u2")
        data = base64.b64encode(codes).decode("ascii")
        key = (low, high, data)
        if key not in self._known:
            self._known[key] = len(self.entries)
            self.entries.append({"low": low, "high": high, "data": data})
        return self._known[key]
