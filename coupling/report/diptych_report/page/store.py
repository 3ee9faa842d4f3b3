# diptych: arrays of the maps, with 12 bits per number, each stored once
# SPDX-License-Identifier: LGPL-2.1-or-later

import base64

import numpy as np

LARGEST = 4094  # code of the largest value; 4095 is NaN


def packed(codes):
    """Bytes of 12-bit codes. Three bytes per pair: low 8 bits of the first; its high 4 bits with the low 4 of the second; the rest."""
    first, second = np.append(codes, np.zeros(len(codes) % 2, codes.dtype)).reshape(-1, 2).T
    return np.stack([first & 255, first >> 8 | (second & 15) << 4, second >> 4], axis=1).astype(np.uint8).tobytes()


class Store:
    """Arrays as {"low", "high", "size", "data"}: value = low + code (high - low)/4094, two codes in three bytes (packed), base64.

    Equal arrays share one entry, such as the positions of grains at the end of a window and of the stage that ends there.
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
        codes = np.where(np.isfinite(values), np.rint((np.nan_to_num(values) - low) * scale), LARGEST + 1).astype(np.uint16)
        data = base64.b64encode(packed(codes)).decode("ascii")
        key = (low, high, len(values), data)
        if key not in self._known:
            self._known[key] = len(self.entries)
            self.entries.append({"low": low, "high": high, "size": len(values), "data": data})
        return self._known[key]
