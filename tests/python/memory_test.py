# diptych: memory and reference counts over a thousand calls
# SPDX-License-Identifier: LGPL-2.1-or-later
import gc
import sys
import weakref

import numpy as np
import pytest

import diptych
from operators_test import band_of, column


def resident_kb():
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


def growth_kb(call, n):
    """Growth of the resident memory over n calls, after n/5 calls that fill the pools of the allocator."""
    for _ in range(max(n // 5, 1)):
        call()
    gc.collect()
    before = resident_kb()
    for _ in range(n):
        call()
    gc.collect()
    return resident_kb() - before


GRAINS, PAIRS = column(200, 1.0)
MESH = diptych.grid((-1, 0), (1, 400), 1.0)
POINTS, MOVED, PLATEN = band_of(50, 12, n=300)
PATH = np.zeros((50, 3))
def refused():
    with pytest.raises(diptych.SceneError):
        diptych.scene({"sample": {"grains": -1}})


CALLS = {
    "map_stress": lambda: diptych.map_stress(GRAINS, PAIRS, MESH),  # 20 kB of results each: a leak would add 20 MB
    "probe": lambda: diptych.probe(GRAINS, [(-1, 0), (1, 0), (1, 400), (-1, 400)], PAIRS, resamples=0),
    "shear_strain": lambda: diptych.shear_strain(POINTS, MOVED, radius=5),
    "strips": lambda: diptych.strips(POINTS, MOVED, 1.0, platen_increment=PLATEN),
    "integrate": lambda: diptych.integrate({"law": "mohr_coulomb"}, PATH),
    "solve": lambda: diptych.solve((np.eye(80), np.full(80, -1.0), np.full(40, 0.3))),
    "error": refused,
    "scene": lambda: diptych.scene({"sample": {"grains": 20}}),
    "panel": lambda: diptych.DiscretePanel({"sample": {"grains": 20}}),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_thousand_calls_do_not_leak(name):
    assert growth_kb(CALLS[name], 1000) < 3000  # kB; a leak of the smallest result would add more


def test_views_keep_their_snapshot_alive_and_nothing_else_does(panels):
    snapshot = panels[0].snapshot()
    before = sys.getrefcount(snapshot)
    views = [snapshot.position for _ in range(1000)]
    assert sys.getrefcount(snapshot) == before + 1000
    del views
    assert sys.getrefcount(snapshot) == before
    assert growth_kb(panels[0].snapshot, 1000) < 3000  # a snapshot is 100 kB
    assert growth_kb(lambda: panels[0].history, 200) < 3000


def test_unused_panels_and_callbacks_are_deleted():
    class Callback:
        calls = 0

        def __call__(self, row):
            Callback.calls += 1
            return Callback.calls % 2 == 0

    callback = Callback()
    panel = diptych.DiscretePanel({"sample": {"grains": 30}, "loading": {"axial_strain": 0.02}}, on_step=callback)
    panel.run()
    callback.panel = panel  # a reference cycle
    watched, references = weakref.ref(panel), sys.getrefcount(callback)
    for _ in range(50):
        panel.run()
    assert sys.getrefcount(callback) == references and Callback.calls > 50
    del panel, callback
    gc.collect()
    assert watched() is None


def test_continuum_panels_release_their_memory():
    scene = diptych.scene({"continuum": {"mesh": "rectangle", "rectangle_width": 20, "rectangle_height": 20}})
    assert growth_kb(lambda: diptych.ContinuumPanel(scene).prepare(), 20) < 6000  # one panel takes more than 1 MB
