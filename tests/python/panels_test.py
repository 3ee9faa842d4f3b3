# diptych: tests of the panels: same bits as the program, callbacks, interruption, threads
# SPDX-License-Identifier: LGPL-2.1-or-later
import os
import signal
import subprocess
import sys
import threading
import time

import h5py
import numpy as np
import pytest

import diptych
from conftest import QUICK

GRAIN_FIELDS = ("position", "displacement", "velocity", "rotation", "spin", "internal_moment", "mean_internal_moment",
                "rattler")


def same_history(a, b):
    for name in a:
        if not name.endswith("cpu_s"):
            np.testing.assert_array_equal(a[name], b[name], name)


def same_snapshots(a, b, fields):
    assert len(a) == len(b) > 1
    for one, other in zip(a, b):
        for name in fields:
            np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)


def test_both_panels_have_the_bits_of_the_program(panels, folder, tmp_path):
    left = diptych.load(folder)
    for panel, results, fields in zip(panels, (left.discrete, left.continuum, left.coarse),
                                      (GRAIN_FIELDS,
                                       *2 * (("position", "displacement", "rotation", "stress", "strain", "cells"),))):
        same_history(panel.history, results.history)
        same_snapshots(panel.snapshots, results.snapshots, fields)
    panels[0].write(tmp_path)
    assert (tmp_path / "discrete.csv").read_bytes() == (folder / "discrete.csv").read_bytes()
    with h5py.File(tmp_path / "discrete.h5") as a, h5py.File(folder / "discrete.h5") as b:
        names = []
        b.visititems(lambda name, what: names.append(name) if isinstance(what, h5py.Dataset) else None)
        assert len(names) > 40
        for name in names:
            np.testing.assert_array_equal(a[name], b[name], name)


def test_a_callback_gets_every_step_and_may_take_snapshots(small, panels):
    seen = []
    panel = diptych.DiscretePanel(small)
    panel.on_step = lambda row: seen.append((row["step"], row["axial_strain"], panel.snapshot().axial_strain))
    panel.run()
    history = panel.history
    assert [step for step, *_ in seen] == list(history["step"]) == list(range(1, len(seen) + 1))
    for step, strain, at in seen:
        assert at == pytest.approx(strain, abs=1e-12), step
    same_history(history, panels[0].history)


def test_a_run_stopped_by_a_callback_continues_with_the_same_bits(small, panels):
    for make, whole in ((lambda: diptych.DiscretePanel(small), panels[0]),
                        (lambda: diptych.ContinuumPanel(small, panels[0].snapshots[0]), panels[1])):
        panel = make()
        panel.on_step = lambda row: row["step"] < 4
        assert panel.run() == "stopped" and panel.history["step"][-1] == 4 and panel.stage < 2
        panel.on_step = None
        assert panel.run() == "finished"
        same_history(panel.history, whole.history)
        np.testing.assert_array_equal(panel.snapshot().position, whole.snapshot().position)


def test_a_panel_survives_an_exception_in_a_callback(small, panels):
    def fail(row):
        if row["step"] == 3:
            raise KeyError("mine")

    panel = diptych.DiscretePanel(small, on_step=fail)
    with pytest.raises(KeyError, match="mine"):
        panel.run()
    assert panel.status == "stopped"
    panel.on_step = None
    assert panel.run() == "finished"
    same_history(panel.history, panels[0].history)


@pytest.mark.parametrize("delay", [0.05, 0.9])  # during the preparation of 2000 grains (0.9 s), or shortly after it
def test_ctrl_c_stops_a_run_and_the_panel_continues(delay):
    panel = diptych.DiscretePanel(QUICK)
    timer = threading.Timer(delay, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        panel.run()
    assert time.monotonic() - begin < delay + 5 and panel.status == "stopped"
    panel.on_step = lambda row: False
    assert panel.run() == "stopped" and len(panel.history["step"]) > 0


def test_ctrl_c_stops_a_continuum_which_continues_with_the_same_bits():
    scene = {"continuum": {"mesh": "rectangle", "rectangle_width": 30, "rectangle_height": 30, "law": "linear_elastic",
                           "initial_step": 5e-4, "max_step": 5e-4}, "loading": {"axial_strain": 0.03}}
    panel, whole = diptych.ContinuumPanel(scene), diptych.ContinuumPanel(scene)
    panel.prepare()

    def interrupt(row):
        if row["step"] == 12:
            os.kill(os.getpid(), signal.SIGINT)

    panel.on_step = interrupt
    with pytest.raises(KeyboardInterrupt):
        panel.run()
    assert 12 <= panel.history["step"][-1] < 60
    panel.on_step = None
    assert panel.run() == whole.run() == "finished"
    same_history(panel.history, whole.history)
    np.testing.assert_array_equal(panel.snapshot().stress, whole.snapshot().stress)


def test_panels_in_two_threads_have_the_same_bits_as_one(small, panels):
    two = [diptych.DiscretePanel(small) for _ in range(2)]
    workers = [threading.Thread(target=panel.run) for panel in two]
    for worker in workers:
        worker.start()
    ticks = 0
    while any(worker.is_alive() for worker in workers):
        time.sleep(0.001)
        ticks += 1
    assert ticks > 20  # a run takes at least 0.2 s, during which other threads go on
    for panel in two:
        same_history(panel.history, panels[0].history)


def test_continuum_panels_of_several_threads_take_turns(small, panels):
    """Each has a callback, which needs the GIL while another panel waits for its turn."""
    rows, results = [], []

    def run(_):
        panel = diptych.ContinuumPanel(small, panels[0].snapshots[0], on_step=lambda row: rows.append(row["step"]))
        panel.run()
        results.append((panel.history, panel.snapshot().stress))

    workers = [threading.Thread(target=run, args=(k,)) for k in range(3)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(60)
    assert len(results) == 3 and len(rows) == 3 * len(panels[1].history["step"])
    for history, stress in results:
        same_history(history, panels[1].history)
        np.testing.assert_array_equal(stress, panels[1].snapshot().stress)


def test_a_running_panel_refuses_a_second_call(small):
    panel, refused = diptych.DiscretePanel(small), []

    def again(_):
        for call in (panel._panel.prepare, lambda on_step: panel._panel.advance(1, on_step)):
            with pytest.raises(RuntimeError, match="already at work"):
                call(None)
        reader = threading.Thread(target=read)
        reader.start()
        reader.join()
        return False

    def read():
        with pytest.raises(RuntimeError, match="another thread"):
            panel.snapshot()
        refused.append(True)

    panel.on_step = again
    assert panel.run() == "stopped" and refused == [True]


def test_arrays_share_the_memory_of_their_snapshot_and_outlive_it(panels):
    snapshot = panels[0].snapshots[-1]
    assert np.shares_memory(snapshot.position, snapshot.position) and np.shares_memory(snapshot.window.force,
                                                                                       snapshot.window.force)
    assert not snapshot.position.flags.writeable and not snapshot.contacts.force.flags.writeable
    force, kept = panels[0].snapshot().contacts.force, snapshot.contacts.force.copy()
    np.testing.assert_array_equal(force, kept)  # although its snapshot was deleted
    assert len(snapshot) == 300 and snapshot.position.shape == (300, 2) and snapshot.internal_moment.shape == (300, 2,
                                                                                                               2)
    with pytest.raises(AttributeError, match="snapshot.window"):
        _ = snapshot.contacts.dissipation


def test_given_grains_keep_their_places():
    """Rows of equal discs between smooth walls are in equilibrium."""
    x, y = np.meshgrid(np.arange(6.0), np.arange(6.0))
    position = np.column_stack([x.ravel(), y.ravel()])
    panel = diptych.DiscretePanel({"discrete": {"lateral": "rigid_walls"}, "loading": {"horizontal_over_vertical": 0}},
                                  grains={"position": position, "radius": np.full(36, 0.5)})
    assert panel.prepare() == "finished"
    moved = panel.snapshot().position - position
    assert np.abs(moved - moved.mean(0)).max() < 1e-2
    with pytest.raises(ValueError, match="radius: one entry a grain"):
        diptych.DiscretePanel({}, grains={"position": position, "radius": np.ones(3)})


def test_a_panel_that_does_not_converge_raises_not_converged(small):
    panel = diptych.DiscretePanel(diptych.scene(small, discrete={"max_sweeps": 1, "tolerance": 1e-9}))
    with pytest.raises(diptych.NotConverged):
        panel.run()
    assert panel.status == "not_converged" and panel.report.message


def test_missing_or_impossible_input_of_panels_is_refused(small):
    with pytest.raises(diptych.SceneError, match="snapshot") as thrown:
        diptych.ContinuumPanel(small)
    assert thrown.value.key == "continuum/mesh"
    fixed = diptych.scene(small, discrete={"lateral": "rigid_walls", "drive_left_y": "velocity 1"})
    with pytest.raises(diptych.SceneError, match="no counterpart") as thrown:
        diptych.ContinuumPanel(fixed, None)
    with pytest.raises(FileNotFoundError, match="nowhere"):
        diptych.DiscretePanel(small).write("nowhere")
    with pytest.raises(ValueError, match="stages 1 ... 2"):
        diptych.DiscretePanel(small).advance(3)


@pytest.mark.parametrize("before", ["import h5py", "from mpi4py import MPI"])  # these start HDF5 and MPI themselves
def test_a_process_ends_cleanly_with_panels_alive(before):
    script = (before + "\nimport diptych\n"
              "p = diptych.ContinuumPanel({'continuum': {'mesh': 'rectangle', 'rectangle_width': 8, "
              "'rectangle_height': 8}})\np.prepare(); print(p.snapshot().area)")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and float(done.stdout) == pytest.approx(64) and done.stderr == ""
