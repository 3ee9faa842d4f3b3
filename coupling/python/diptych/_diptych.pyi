"""Compiled part of the package diptych; use the package. Arrays that share memory are read only."""

from collections.abc import Callable, Mapping
from typing import Any, overload

from numpy.typing import NDArray

Array = NDArray[Any]
__version__: str
git_revision: str

class Scene:
    @property
    def name(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    def dict(self) -> dict[str, dict[str, Any]]: ...
    def text(self) -> str: ...
    def stages(self) -> list[float]: ...

class Contacts:
    def __len__(self) -> int: ...
    @property
    def i(self) -> Array: ...  # (n): first body, a grain
    @property
    def j(self) -> Array: ...  # (n): second body, a grain or a wall
    @property
    def point(self) -> Array: ...  # (n, 2) [length]: contact point
    @property
    def normal(self) -> Array: ...  # (n, 2) [-]: unit vector from j to i
    @property
    def force(self) -> Array: ...  # (n, 2) [pressure length]: on i
    @property
    def shift(self) -> Array: ...  # (n) [length]: x of the image of j that touches i minus x of j
    @property
    def gap(self) -> Array: ...  # (n) [length]: distance of the surfaces; negative: penetration
    @property
    def status(self) -> Array: ...  # (n): 0 open, 1 sticking, 2 slipping
    @property
    def dissipation(self) -> Array: ...  # (n) [pressure length^2]: by friction, over the stage
    @property
    def impact_dissipation(self) -> Array: ...  # (n) [pressure length^2]: along the normal, over the stage

class DiscreteSnapshot:
    def __len__(self) -> int: ...
    @property
    def position(self) -> Array: ...  # (n, 2) [length]: centre
    @property
    def displacement(self) -> Array: ...  # (n, 2) [length]: of the centre since the start of the loading
    @property
    def velocity(self) -> Array: ...  # (n, 2) [length/time]: of the centre
    @property
    def rotation(self) -> Array: ...  # (n) [rad]: since the start of the loading
    @property
    def spin(self) -> Array: ...  # (n) [rad/time]: angular velocity
    @property
    def radius(self) -> Array: ...  # (n) [length]: radius
    @property
    def mass(self) -> Array: ...  # (n) [mass]: mass
    @property
    def internal_moment(self) -> Array: ...  # (n, 2, 2) [pressure length^2]: internal moment in the last step, spin term included
    @property
    def mean_internal_moment(self) -> Array: ...
    @property
    def mean_spin_term(self) -> Array: ...
    @property
    def rattler(self) -> Array: ...  # (n) [-]: 1 for grains without contact force
    @property
    def fixed(self) -> Array: ...
    @property
    def applied_force(self) -> Array: ...  # (n, 2) [pressure length]: lateral action and gravity in the last step
    @property
    def walk(self) -> str: ...  # [-]: the loading variable: axial_strain, shear_strain or time
    @property
    def progress(self) -> float: ...  # [as walk says]: loading variable
    @property
    def axial_strain(self) -> float: ...  # [-]: descent of the upper platen / initial height
    @property
    def shear_strain(self) -> float: ...  # [-]: travel of the upper platen to the right / initial height
    @property
    def time(self) -> float: ...  # [time]: since the start of the loading
    @property
    def step(self) -> float: ...  # [time]: length of the last step
    @property
    def residual(self) -> float: ...  # [-]: natural map relative to the impulses, of the last step
    @property
    def mean_diameter(self) -> float: ...  # [length]: mean diameter d
    @property
    def stress_error(self) -> float: ...
    @property
    def stress_change(self) -> float: ...  # [-]: change of the stress in the last doubling of the sweeps
    @property
    def error_over_residual(self) -> float: ...  # [-]: error of grain stress over residual, measured once in a run; nan: unknown
    @property
    def window_time(self) -> float: ...  # [time]: length of the stage over which means are taken; 0: no stage yet
    @property
    def lower_y(self) -> float: ...  # [length]: height of the lower platen
    @property
    def upper_y(self) -> float: ...  # [length]: height of the upper platen
    @property
    def left_x(self) -> float: ...  # [length]: place of the left wall; nan: none
    @property
    def right_x(self) -> float: ...  # [length]: place of the right wall; nan: none
    @property
    def cell_width(self) -> float: ...  # [length]: width of the periodic cell; 0: none
    @property
    def area(self) -> float: ...  # [length^2]: of the outline
    @property
    def upper_platen_displacement_x(self) -> float: ...  # [length]: since the start of the loading
    @property
    def upper_platen_displacement_y(self) -> float: ...  # [length]: since the start of the loading
    @property
    def lower_platen_force_x(self) -> float: ...  # [pressure length]: of the lower platen on the sample, last step
    @property
    def lower_platen_force_y(self) -> float: ...  # [pressure length]: of the lower platen on the sample, last step
    @property
    def upper_platen_force_x(self) -> float: ...  # [pressure length]: of the upper platen on the sample, last step
    @property
    def upper_platen_force_y(self) -> float: ...  # [pressure length]: of the upper platen on the sample, last step
    @property
    def contacts(self) -> Contacts: ...  # Candidate contacts of the last step; open contacts carry no force.
    @property
    def window(self) -> Contacts: ...  # Every pair that touched since the previous stage, with its mean force.
    @property
    def outline_left(self) -> Array: ...  # (m, 2) [length]: side of the outline, upward
    @property
    def outline_right(self) -> Array: ...  # (m, 2) [length]: side of the outline, upward

class ContinuumSnapshot:
    @property
    def position(self) -> Array: ...  # (n, 2) [length]: current place
    @property
    def displacement(self) -> Array: ...  # (n, 2) [length]: since the start
    @property
    def rotation(self) -> Array: ...  # (n) [rad]: Cosserat rotation since the start; Cosserat laws only
    @property
    def weight(self) -> Array: ...  # (n) [length^2]: lumped area; the sum is the current area
    @property
    def axial_strain(self) -> float: ...  # [-]: descent of the upper platen / initial height
    @property
    def time(self) -> float: ...  # [time]: since the start of the loading
    @property
    def area(self) -> float: ...  # [length^2]: of the sample
    @property
    def lower_platen_force(self) -> Array: ...  # [pressure length]: on the sample
    @property
    def upper_platen_force(self) -> Array: ...  # [pressure length]: on the sample
    @property
    def mean_stress(self) -> Array: ...  # [pressure]: over the area
    @property
    def shear_strain(self) -> float: ...  # [-]: travel of the upper platen to the right / initial height
    @property
    def progress(self) -> float: ...  # [as walk says]: loading variable
    @property
    def walk(self) -> str: ...  # [-]: the loading variable: axial_strain, shear_strain or time
    @property
    def cells(self) -> Array: ...  # nodes of each element: corners anticlockwise, edge midpoints, centre
    @property
    def stress(self) -> Array: ...  # (n, 3, 3) [pressure]: of the cells, Cauchy stress
    @property
    def strain(self) -> Array: ...  # (n, 3, 3) [-]: of the cells, total strain, linearised on the initial shape
    @property
    def plastic_strain(self) -> Array: ...  # (n, 3, 3) [-]: of the cells, sum of increments
    @property
    def couple_stress(self) -> Array: ...  # (n, 2) [pressure length]: of the cells, m_x, m_y, mechanics sign
    @property
    def cell_area(self) -> Array: ...  # (n) [length^2]: of the cells, current area
    @property
    def equivalent_plastic_strain(self) -> Array: ...
    @property
    def dissipation(self) -> Array: ...  # (n) [pressure]: of the cells, plastic work per area since the start
    @property
    def overstress(self) -> Array: ...  # (n) [pressure]: of the cells, part of the yield function carried by viscosity
    @property
    def share_zz_not_intermediate(self) -> Array: ...
    @property
    def acoustic_determinant(self) -> Array: ...  # (n) [-]: of the cells, least det(n C n) relative to the elastic one
    @property
    def localisation_angle(self) -> Array: ...  # (n) [degrees]: of the cells, possible band, from the horizontal
    @property
    def friction_angle(self) -> Array: ...  # (n) [degrees]: of the cells, current value of the law; elastic: 0
    @property
    def solid_fraction(self) -> Array: ...  # (n) [-]: of the cells, of a critical-state law; other laws: 0

class GrainResults:
    @property
    def snapshots(self) -> list[DiscreteSnapshot]: ...
    def history(self) -> dict[str, Any]: ...

class ContinuumResults:
    @property
    def snapshots(self) -> list[ContinuumSnapshot]: ...
    def history(self) -> dict[str, Any]: ...

class GrainPanel:
    def __init__(self, scene: Scene, position: Any = None, radius: Any = None) -> None: ...
    def prepare(self, on_step: Callable[[dict[str, Any]], Any] | None) -> str: ...
    def advance(self, stage: int, on_step: Callable[[dict[str, Any]], Any] | None) -> str: ...
    def snapshot(self) -> DiscreteSnapshot: ...
    def stage(self) -> int: ...
    def history(self) -> dict[str, Any]: ...
    def report(self) -> dict[str, Any]: ...
    def results(self, snapshots: list[DiscreteSnapshot]) -> GrainResults: ...

Keys = Mapping[str, str]
Arrays = Mapping[str, Any]
Told = dict[str, tuple[str, str]]

def read_scene(file: str | None, changes: list[tuple[str, str, str]], compares: bool) -> Scene: ...
def described_keys() -> dict[str, tuple[str, str, str]]: ...
def section_names() -> list[str]: ...
def discrete_columns() -> Told: ...
def continuum_columns() -> Told: ...
def read_grains(folder: str) -> GrainResults: ...
def read_nodes(folder: str) -> ContinuumResults: ...
def write_grains(results: GrainResults, folder: str) -> None: ...
def write_nodes(results: ContinuumResults, folder: str) -> None: ...
def check_files(folder: str) -> None: ...
def compare(scene: Scene, grains: GrainResults, nodes: ContinuumResults, coarse: ContinuumResults | None,
            folder: str) -> tuple[str, list[dict[str, Array]], list[dict[str, Array]]]: ...
def map_stress(grains: Arrays, contacts: Arrays, mesh: Arrays, period: float, keys: Keys) -> dict[str, Any]: ...
def grid(lower: Any, upper: Any, size: float) -> dict[str, Array]: ...
def mesh_of(snapshot: ContinuumSnapshot) -> dict[str, Array]: ...
@overload
def increment(start: DiscreteSnapshot, end: DiscreteSnapshot) -> dict[str, Any]: ...
@overload
def increment(start: ContinuumSnapshot, end: ContinuumSnapshot) -> dict[str, Any]: ...
def find_bands(field: Arrays, frame: Arrays, seed: int, keys: Keys) -> dict[str, Any]: ...
def strips(field: Arrays, frame: Arrays, angle: float, offset: float, n: int) -> dict[str, Any]: ...
def shear_strain(field: Arrays, at: Any, radius: float) -> Array: ...
def theory_lines(friction: float, dilatancy: float) -> tuple[float, float, float]: ...
def probe_grains(grains: DiscreteSnapshot | Arrays, contacts: Arrays | None, corners: Any, angle_deg: float,
                 blocks: Arrays) -> dict[str, Any]: ...
def probe_cells(mesh: Arrays, stress: Any, corners: Any) -> dict[str, Any]: ...
def probe_circle(grains: DiscreteSnapshot | Arrays, contacts: Arrays | None, circle: tuple[float, float, float],
                 blocks: Arrays) -> dict[str, Any]: ...
def check_frames(format: str, frames: list[Any], remarks: list[str], options: Any) -> str: ...
def import_frames(format: str, frames: list[Any], remarks: list[str], options: Any) -> None: ...
def solve_file(path: str, form: str | None, guess: Any, keys: Arrays) -> dict[str, Any]: ...
def solve_arrays(w: tuple[Any, Any, Any], q: Any, friction: Any, guess: Any, keys: Arrays) -> dict[str, Any]: ...
