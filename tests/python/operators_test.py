# diptych: tests of the operators against numbers derived by hand
# SPDX-License-Identifier: LGPL-2.1-or-later
import glob
import os

import numpy as np
import pytest
import scipy.sparse

import diptych
from conftest import SOURCE, program

METHODS = ("segments", "centroid", "laguerre", "kernel", "projection")


def column(n, force):
    """A column of n discs of radius 1 between two walls, pressed by `force`; the lower wall is at y = 0."""
    position = np.column_stack([np.zeros(n), 1 + 2.0 * np.arange(n)])
    i, j = np.append(np.arange(n), n - 1), np.append(np.arange(n) - 1, -2)  # -1 lower, -2 upper wall
    push = np.tile([0.0, force], (n + 1, 1))
    push[-1] = [0, -force]
    grains = {"position": position, "radius": np.ones(n)}
    walls = {-1: ((0, 0), (0, 1)), -2: ((0, 2 * n), (0, -1))}
    return grains, diptych.contacts(grains, i, j, push, walls=walls)


@pytest.mark.parametrize("method", METHODS)
def test_a_column_of_discs_carries_force_over_width(method):
    """The branches add up to the height 2 n, so sigma_yy = F 2 n / (2 x 2 n) = F / 2. All other components are zero."""
    grains, pairs = column(10, 3.0)
    stress = diptych.map_stress(grains, pairs, diptych.grid((-1, 0), (1, 20), 1.0), method)
    np.testing.assert_allclose(stress.total, [[0, 0], [0, 1.5]], atol=1e-12)
    assert stress.total_relative_error < 1e-12 and stress.area.sum() == pytest.approx(40)
    if method == "segments":
        assert stress.outside_share == 0
        np.testing.assert_allclose(stress.solid_fraction.mean(), np.pi / 4)


def test_tables_of_an_import_need_no_other_names():
    """The column again, with ids from 7 on in another order and walls below zero, as in contacts_0.csv."""
    grains, pairs = column(10, 3.0)
    ids, order = 7 + np.arange(10), np.random.default_rng(1).permutation(10)
    table = {"id": ids[order], "x": grains["position"][order, 0], "y": grains["position"][order, 1], "r": np.ones(10)}
    bodies = {name: np.where(pairs[name] < 10, pairs[name] + 7, 9 - pairs[name]) for name in ("i", "j")}
    rows = {**bodies, **{p + axis: pairs[of][:, k] for p, of in (("p", "point"), ("f", "force"))
                         for k, axis in enumerate("xy")}}
    mesh = diptych.grid((-1, 0), (1, 20), 1.0)
    expected = diptych.map_stress(grains, pairs, mesh).stress
    np.testing.assert_allclose(diptych.map_stress(table, rows, mesh).stress, expected, atol=1e-12)
    with pytest.raises(ValueError, match="body 6 of 'i' is not a grain"):
        diptych.map_stress(table, {**rows, "i": np.full(len(rows["i"]), 6)}, mesh)
    with pytest.raises(ValueError, match="'point' is missing; points may be px, py"):
        diptych.map_stress(table, {name: rows[name] for name in ("i", "j", "fx", "fy")}, mesh)


def test_a_map_of_a_snapshot_sums_to_its_moments(panels):
    snapshot = panels[0].snapshots[-1]
    expected = (snapshot.mean_internal_moment + snapshot.mean_spin_term[:, None, None] * np.eye(2)).sum(0)  # symmetric
    for mesh in (None, panels[1].snapshots[-1]):
        stress = diptych.map_stress(snapshot, mesh=mesh)
        total = np.einsum("k,kab->ab", stress.area, stress.symmetric)
        np.testing.assert_allclose(total, expected, rtol=1e-10)
    s1, s2, _ = diptych.principal(stress.stress)
    np.testing.assert_allclose(stress.t, 0.5 * (s1 - s2), atol=1e-12)
    np.testing.assert_allclose(stress.s, 0.5 * (s1 + s2), atol=1e-12)


def test_contacts_may_name_the_wall_first():
    grains, pairs = column(2, 1.0)
    walls = {-1: ((0, 0), (0, 1)), -2: ((0, 4), (0, -1))}
    turned = diptych.contacts(grains, [-1, 1, 1], [0, 0, -2], [[0, -1.0], [0, 1], [0, -1]], walls=walls)
    for name in ("i", "j", "point", "normal", "force"):
        np.testing.assert_array_equal(turned[name], pairs[name], name)
    with pytest.raises(ValueError, match="body 7"):
        diptych.contacts(grains, [0], [7], [[0, 1.0]])


def band_of(angle, width, n=4000, noise=0.0):
    """Points in 60 x 80 with a tanh displacement across a line through the middle; the platen moves down."""
    rng = np.random.default_rng(1)
    points = rng.uniform([-30, -40], [30, 40], (n, 2))
    s = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    across = points @ np.array([-s[1], s[0]])
    displacement = -0.5 * s * np.tanh(across / (width / 2.197))[:, None] + noise * rng.normal(size=(n, 2))
    return points, displacement, -s


def test_a_synthetic_band_is_found():
    points, displacement, platen = band_of(50, 12, noise=0.02)
    report = diptych.find_bands(points, displacement, 1.0, platen_increment=platen)
    assert report.verdict.startswith("one band") and report.converged
    band = report.bands[0]
    assert band.angle_deg == pytest.approx(50, abs=0.5) and band.width_10_90 == pytest.approx(12, rel=0.05)
    assert abs(band.offset) < 0.3 and abs(band.jump) == pytest.approx(1, abs=0.03)
    low, high = band.interval["angle_deg"][1:]
    assert low < band.angle_deg < high
    ends = band.line(10)
    assert np.linalg.norm(ends[1] - ends[0]) == pytest.approx(10)
    assert np.abs(ends @ band.normal - band.centre @ band.normal - band.offset).max() < 1e-12
    strips = diptych.strips(points, displacement, 1.0, band, platen_increment=platen)
    assert strips["mean"][0] == pytest.approx(-strips["mean"][-1], abs=0.05) and abs(strips["mean"][0]) > 0.4
    assert strips.count.sum() <= len(points) and len(strips.edges) == 17


def test_bands_of_snapshots_are_those_of_the_comparison(panels, small):
    grains, nodes, _ = panels
    window = diptych.compare(scene=small, discrete=grains, continuum=nodes).numbers["windows"][0]
    of_grains = diptych.increment(grains.snapshots[0], grains.snapshots[-1])
    frame = {name: of_grains[name] for name in ("mean_diameter", "platen_increment", "centre", "width", "height")}
    of_nodes = {**diptych.increment(nodes.snapshots[0], nodes.snapshots[-1]), **frame}
    for panel, field in (("discrete", of_grains), ("continuum", of_nodes)):
        report = diptych.find_bands(**field, seed=small["sample"]["seed"])
        assert report.verdict == window[panel]["band_verdict"], panel
        # None is NaN
        np.testing.assert_array_equal(report.bic, np.array(window[panel]["bic_of_0_1_2_bands"], dtype=float))
        expected = [band["angle_deg"]["value"] for band in window[panel]["bands"]]
        assert [band.angle_deg for band in report.bands] == expected


def test_an_affine_field_is_diffuse_with_the_right_shear_strain():
    """u = G x with G = [[0.01, 0.004], [0.002, -0.02]]: eps_1 - eps_2 = sqrt(0.03^2 + 0.006^2)."""
    points, _, _ = band_of(50, 12)
    given = np.array([[0.01, 0.004], [0.002, -0.02]])
    displacement = points @ given.T
    assert diptych.find_bands(points, displacement, 1.0).bands == []
    shear = diptych.shear_strain(points, displacement, radius=2.5)
    lonely = np.isnan(shear)  # fewer than four neighbours
    assert lonely.mean() < 0.01
    np.testing.assert_allclose(shear[~lonely], np.hypot(0.03, 0.006), rtol=1e-9)
    gradient = diptych.displacement_gradient(points, displacement, radius=2.5)
    np.testing.assert_allclose(gradient[~lonely] - given, 0, atol=1e-12)


def test_probes_of_grains_and_of_their_stress_map_agree_with_the_walls():
    grains, pairs = column(10, 3.0)
    whole = [(-1, -1e-9), (1, -1e-9), (1, 20 + 1e-9), (-1, 20 + 1e-9)]  # includes the contacts at the walls
    of_grains = diptych.probe(grains, whole, pairs, resamples=0)
    np.testing.assert_allclose(of_grains.stress, [[0, 0], [0, 1.5]], atol=1e-12)
    assert of_grains.count == 10 and of_grains.contacts == 11 and of_grains.solid_fraction == pytest.approx(np.pi / 4)
    np.testing.assert_allclose(of_grains.fabric, [[0, 0], [0, 1]], atol=1e-12)
    assert of_grains.s1 == pytest.approx(1.5) and of_grains.direction_deg == pytest.approx(90)
    of_cells = diptych.probe(diptych.map_stress(grains, pairs, diptych.grid((-1, 0), (1, 20), 1.0)), whole)
    np.testing.assert_allclose(of_cells.stress, of_grains.stress, atol=1e-12)


def test_probes_have_intervals_and_circles_tractions(panels):
    snapshot = panels[0].snapshots[-1]
    middle = 0.5 * (snapshot.position.min(0) + snapshot.position.max(0))
    square = diptych.probe(snapshot, middle + 6 * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]), block=3)
    value, low, high = square.interval["t_over_s"]
    assert low < value < high and value == pytest.approx(square.t_over_s)
    circle = diptych.probe(snapshot, (*middle, 6.0), block=3)
    assert circle.normal.shape == circle.predicted_normal.shape == (36,) and 0 < circle.relative_l2.value < 1


def test_an_elastic_law_follows_hooke():
    """Uniaxial strain: sigma_yy = E (1 - nu) / ((1 + nu)(1 - 2 nu)) eps, the others nu / (1 - nu) of it."""
    e, nu, strain = 100.0, 0.2, np.linspace(0, 1e-3, 5)
    path = np.column_stack([0 * strain, strain, 0 * strain])
    answer = diptych.integrate({"law": "linear_elastic", "youngs_modulus": e, "poisson_ratio": nu}, path)
    gain = e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) * strain
    np.testing.assert_allclose(answer.stress[:, 1, 1], 1 + gain, rtol=1e-12)
    np.testing.assert_allclose(answer.stress[:, 0, 0], 1 + nu / (1 - nu) * gain, rtol=1e-12)
    np.testing.assert_allclose(answer.stress_zz, answer.stress[:, 0, 0], rtol=1e-12)
    shear = diptych.integrate({"law": "linear_elastic", "youngs_modulus": e, "poisson_ratio": nu},
                              [[0, 0, 0], [0, 0, 1e-3]])
    assert shear.stress[-1, 0, 1] == pytest.approx(e / (1 + nu) * 1e-3)  # 2 G eps_xy
    tied = diptych.integrate({"law": "linear_elastic", "youngs_modulus": e, "poisson_ratio": nu},
                             {"eyy": strain, "volume": 0, "sxy": 1e-2 * (strain > 0)})
    np.testing.assert_allclose(tied.stress[:, 1, 1] - 1, e / (1 + nu) * strain, atol=1e-12)
    np.testing.assert_allclose(tied.strain[-1], [[-1e-3, 1e-2 * (1 + nu) / e], [1e-2 * (1 + nu) / e, 1e-3]], rtol=1e-9)


def test_mohr_coulomb_has_its_strength_and_its_path_again():
    """t = s sin(phi) + c cos(phi) at a constant lateral stress of 1 = s - t."""
    law = {"law": "mohr_coulomb", "hardening": "constant", "friction_angle_peak": 30, "dilatancy_angle_peak": 10,
           "cohesion": 0.1}
    path = diptych.biaxial(law, axial_strain=0.05)
    t = (np.sin(np.radians(30)) + 0.1 * np.cos(np.radians(30))) / (1 - np.sin(np.radians(30)))
    assert 0.5 * (path["syy"] - path["sxx"])[-1] == pytest.approx(t, rel=1e-6)
    again = diptych.integrate(law, np.column_stack([path["exx"], path["eyy"], path["exy"]]))
    np.testing.assert_allclose(again.stress[:, 1, 1], path["syy"], rtol=1e-8)
    np.testing.assert_allclose(again.stress[:, 0, 0], 1, rtol=1e-8)
    np.testing.assert_allclose(again.equivalent_plastic_strain, path["equivalent_plastic_strain"], atol=1e-10)
    assert again.reliable.all()
    mixed = diptych.integrate(law, {"eyy": path["eyy"], "sxx": 1, "exy": 0})
    np.testing.assert_allclose(mixed.stress[:, 1, 1], path["syy"], rtol=1e-10)


def test_the_result_says_where_the_law_is_not_exact_and_how_far_a_stress_was_reached():
    """Equal strains in the plane, nu = 0.2: the stress in the plane grows 2.5 times faster than sigma_zz, t/s -> 0.43
    in space. t/s = 0 in the plane, all that cosserat_mohr_coulomb sees. Strength in the second path: s1 = 3 + 0.2 sqrt
    3 = 3.3464."""
    law = {"law": "cosserat_mohr_coulomb", "hardening": "constant", "friction_angle_peak": 20,
           "dilatancy_angle_peak": 5, "youngs_modulus": 500}
    grown = np.linspace(0, 0.05, 51)
    answer = diptych.integrate(law, {"exx": grown, "eyy": grown, "exy": 0})
    assert answer.reliable[1] and not answer.reliable[-1] and answer.verdict[-1] == "zz_outside"
    law["law"] = "mohr_coulomb"
    assert diptych.integrate(law, {"exx": grown, "eyy": grown, "exy": 0}).reliable.all()
    law.update(friction_angle_peak=30, cohesion=0.1)
    with pytest.raises(diptych.NotConverged, match="syy = 3.346") as stopped:
        diptych.integrate(law, {"syy": np.linspace(1, 4, 31), "sxx": 1, "exy": 0})
    assert stopped.value.reached.stress[-1, 1, 1] == pytest.approx(3 + 0.2 * np.sqrt(3), abs=2e-4)


def test_one_contact_is_solved_by_hand():
    """W = diag(2, 3), q = (-1, 0.5), mu = 0.3: r_n = 0.5; sticking needs r_t = -1/6, more than mu r_n = 0.15: it
    slips."""
    for w in (np.diag([2.0, 3.0]), scipy.sparse.csr_matrix(np.diag([2.0, 3.0]))):
        solution = diptych.solve((w, [-1.0, 0.5], [0.3]))
        np.testing.assert_allclose(solution.r, [[0.5, -0.15]], rtol=1e-12)
        np.testing.assert_allclose(solution.u, [[0, 0.05]], atol=1e-12)
        assert solution.status == "converged"


def test_stored_problems_are_solved_as_by_the_program():
    path = sorted(glob.glob(os.path.join(SOURCE, "tests", "discrete", "contact_problems", "*.h5")))[0]
    printed = dict(line.split(": ", 1) for line in program("solve", path).splitlines() if ": " in line)
    solution = diptych.solve(path)
    assert solution.sweeps == int(printed["sweeps"]) and solution.status == printed["status"]
    assert solution.residual == pytest.approx(float(printed["residual"]), rel=1e-5) and solution.residual <= 1e-8
    again = diptych.solve(path, guess=solution.r)
    assert again.sweeps <= solution.sweeps


@pytest.mark.parametrize("call, error, message", [
    (lambda: diptych.map_stress({"position": [[0, 0, 0]], "radius": [1]}, column(2, 1)[1]), ValueError,
     r"position: .*\(n, 2\)"),
    (lambda: diptych.map_stress({"position": [[0, 0]], "radius": [-1]}, column(2, 1)[1]), ValueError,
     "radius: 1 positive numbers"),
    (lambda: diptych.map_stress(column(2, 1)[0], {"i": [0]}), ValueError, "'j' is missing"),
    (lambda: diptych.map_stress(column(1, 1)[0], column(2, 1)[1], diptych.grid((0, 0), (1, 1), 1)), ValueError,
     "contact 1 joins"),
    (lambda: diptych.map_stress(*column(2, 1), method="magic"), diptych.SceneError, "averaging = 'magic'"),
    (lambda: diptych.map_stress(*column(2, 1), mesh=([[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2, 9]])), ValueError,
     "node 9 of 4"),
    (lambda: diptych.find_bands(np.zeros((5, 2)), np.zeros((4, 2)), 1), ValueError, "displacement"),
    (lambda: diptych.find_bands(*band_of(50, 12)[:2], 1.0, max_bands=7), diptych.SceneError, "comparison/max_bands"),
    (lambda: diptych.find_bands(np.full((50, 2), np.nan), np.ones((50, 2)), 1.0), ValueError, "finite"),
    (lambda: diptych.probe(column(2, 1)[0], [(0, 0), (0, 1), (1, 0)], column(2, 1)[1]), ValueError, "anticlockwise"),
    (lambda: diptych.integrate({"law": "rubber"}, [[0, 0, 0]]), diptych.SceneError, "continuum/law"),
    (lambda: diptych.integrate({}, [[[0, 1], [0, 0]]]), ValueError, r"path\[0\] must be finite and symmetric"),
    (lambda: diptych.integrate({}, {"eyy": [0, 1], "sxx": 2, "exy": 0}), ValueError,
     r"path\[0\]: column 'sxx' = 2 is not"),
    (lambda: diptych.integrate({}, {"eyy": [0, 1], "sxx": 1}), ValueError, "path has 2 columns"),
    (lambda: diptych.integrate({}, {"eyy": 0, "szz": 1, "exy": 0}), ValueError,
     "'szz' is not allowed; give one of exx"),
    (lambda: diptych.integrate({}, {"exx": 0, "eyy": [0, 1], "volume": 0}), ValueError, "one follows from the others"),
    (lambda: diptych.biaxial({}, path="undrained"), ValueError, "constant_volume"),
    (lambda: diptych.solve((np.eye(3), [1, 2], [0.3])), ValueError, "must have 2 rows"),
    (lambda: diptych.solve("nowhere.h5"), ValueError, "nowhere.h5"),
    (lambda: diptych.solve((np.eye(2), [1, 2], [0.3]), solver="gauss"), diptych.SceneError, "discrete/solver"),
])
def test_the_message_names_the_wrong_argument(call, error, message):
    with pytest.raises(error, match=message):
        call()
