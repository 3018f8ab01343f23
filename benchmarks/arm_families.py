"""Planning problems of two arms in furniture that stands a little elsewhere each time.

They are made in the manner of MotionBenchMaker (C. Chamzas et al., "MotionBenchMaker: a tool to
generate and benchmark motion planning datasets", IEEE RA-L 7, 2022): a family has one piece of
furniture with things in it; each of its problems moves and turns the furniture and its things, and
asks for a way from the arm's named state to a pose of the tip before one of the things.

Links of real arms are meshes of some hundred corners; so are these, made of the shapes of
``tests/motion/arms``.
"""

from __future__ import annotations

import math
import re
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from gazelle.description.loader import load_models
from gazelle.description.model import Box, Cylinder
from gazelle.description.srdf import load_srdf
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Patience, Solver
from gazelle.motion.model import RobotModel
from gazelle.motion.scene import PlanningScene, WorldObject

__all__ = ["ARMS", "FAMILIES", "Arm", "arm_named", "problem_of"]

_FOLDER = Path(__file__).parents[1] / "tests" / "motion" / "arms"
_SIDES = 48
_STAND_OFF_M = 0.1
_TRIES = 200
Point = tuple[float, float, float]


class Arm(NamedTuple):
    """An arm of this repository.

    Attributes:
        name: of its files.
        state: named state that problems start at.
        approach: axis of the tip's frame that points at things.
    """

    name: str
    state: str
    approach: int


ARMS = {
    "seven": Arm("seven", "ready", 2),
    "ur_like": Arm("ur_like", "up", 0),
}


@dataclass(frozen=True)
class _Thing:
    """A box or a cylinder (radius, length) in the frame of its furniture."""

    name: str
    size: tuple[float, ...]
    at: Point


@dataclass(frozen=True)
class Family:
    """Furniture, things that may be reached for, and how much both are moved.

    Attributes:
        things: all of it; the frame stands on the floor at its front, x points into it.
        targets: names of what may be reached for.
        distance_m: of the frame from the base.
        moved_m: how far the furniture is moved at most.
        turned_rad: how far it is turned at most.
        slid_m: how far each target is moved on what it stands on.
        from_above: whether the tip may come from above as well.
    """

    things: tuple[_Thing, ...]
    targets: tuple[str, ...]
    distance_m: float
    moved_m: float = 0.06
    turned_rad: float = 0.2
    slid_m: float = 0.08
    from_above: bool = False


def _shelves(
    heights: tuple[float, ...], depth: float, width: float, columns: int, *, walls: bool
) -> tuple[_Thing, ...]:
    """Return shelf boards with walls or posts between them, and cans on all but the top."""
    board, low, high = 0.03, heights[0], heights[-1]
    middle, tall = (low + high) / 2.0, high - low
    found = [
        _Thing(f"board_{number}", (depth, width, board), (depth / 2.0, 0.0, height))
        for number, height in enumerate(heights)
    ]
    for side in (-1.0, 1.0):
        y = side * (width - board) / 2.0
        if walls:
            found.append(
                _Thing(f"wall_{side:+.0f}", (depth, board, tall), (depth / 2.0, y, middle))
            )
            continue
        for x in (board / 2.0, depth - board / 2.0):
            found.append(_Thing(f"post_{side:+.0f}_{x:.2f}", (board, board, tall), (x, y, middle)))
    if not walls:
        found.append(_Thing("divider", (depth, board, tall), (depth / 2.0, 0.0, middle)))
    for row, height in enumerate(heights[:-1]):
        for column in range(columns):
            y = width * ((column + 0.5) / columns - 0.5)
            at = (depth * (0.3 + 0.2 * (column % 2)), y, height + board / 2.0 + 0.071)
            found.append(_Thing(f"can_{row}_{column}", (0.03, 0.14), at))
    return tuple(found)


def _crate(front_m: float, bars: tuple[float, ...]) -> tuple[_Thing, ...]:
    """Return an open box, its front as high as given, or barred at some heights."""
    size, board, low = 0.62, 0.03, 0.12
    middle, x = low + size / 2.0, size / 2.0
    found = [
        _Thing("bottom", (size, size, board), (x, 0.0, low)),
        _Thing("back", (board, size, size), (size, 0.0, middle)),
        _Thing("left", (size, board, size), (x, size / 2.0, middle)),
        _Thing("right", (size, board, size), (x, -size / 2.0, middle)),
        _Thing("cube", (0.07, 0.07, 0.07), (x, 0.0, low + board / 2.0 + 0.036)),
    ]
    if front_m:
        found.append(_Thing("front", (board, size, front_m), (0.0, 0.0, low + front_m / 2.0)))
    if bars:
        found.append(_Thing("cap", (size, size, board), (x, 0.0, low + size)))
    found += [_Thing(f"bar_{z:g}", (board, size, board), (0.0, 0.0, low + z)) for z in bars]
    return tuple(found)


def _table(height_m: float, under: bool) -> tuple[_Thing, ...]:
    """Return a table with clutter, and a can on it or below it."""
    deep, wide, board = 0.8, 1.4, 0.03
    x = deep / 2.0
    found = [_Thing("top", (deep, wide, board), (x, 0.0, height_m))]
    found += [
        _Thing(f"leg_{a:g}_{b:g}", (0.05, 0.05, height_m), (a, b, height_m / 2.0))
        for a in (0.05, deep - 0.05)
        for b in (-wide / 2.0 + 0.05, wide / 2.0 - 0.05)
    ]
    on = height_m + board / 2.0
    clutter = [
        ("vase", (0.05, 0.3), (0.45, 0.3, on + 0.151)),
        ("book", (0.18, 0.03, 0.28), (0.3, -0.25, on + 0.141)),
        ("screen", (0.03, 0.3, 0.3), (0.6, 0.0, on + 0.151)),
        ("parcel", (0.22, 0.22, 0.2), (0.35, -0.5, on + 0.101)),
        ("jar", (0.04, 0.16), (0.2, 0.2, on + 0.081)),
    ]
    found += [_Thing(*one) for one in clutter]
    at = (0.22, 0.0, 0.12 if under else on + 0.071)
    found.append(_Thing("can", (0.03, 0.12), at))
    if under:
        found.append(_Thing("stool", (0.2, 0.2, 0.05), (0.22, 0.0, 0.03)))
    return tuple(found)


def _cans(things: tuple[_Thing, ...]) -> tuple[str, ...]:
    return tuple(thing.name for thing in things if thing.name.startswith("can"))


def _family(things: tuple[_Thing, ...], **how: object) -> Family:
    return Family(things, **({"targets": _cans(things)} | how))  # type: ignore[arg-type]


FAMILIES: dict[str, Family] = {
    "shelf, small": _family(_shelves((0.25, 0.58), 0.5, 0.9, 3, walls=True), distance_m=0.42),
    "shelf, tall": _family(
        _shelves((0.02, 0.32, 0.62, 0.92), 0.5, 1.0, 3, walls=True), distance_m=0.42
    ),
    "shelf, thin": _family(
        _shelves((0.05, 0.3, 0.55, 0.8), 0.4, 1.0, 4, walls=False), distance_m=0.42
    ),
    "box": _family(
        _crate(0.25, ()), targets=("cube",), distance_m=0.3, slid_m=0.12, from_above=True
    ),
    "cage": _family(_crate(0.0, (0.1, 0.42)), targets=("cube",), distance_m=0.34, slid_m=0.05),
    "table, on it": _family(_table(0.2, under=False), distance_m=0.4, from_above=True),
    "table, under it": _family(_table(0.45, under=True), distance_m=0.35, slid_m=0.05),
}


def arm_named(name: str) -> RobotModel:
    """Return one of `ARMS` whose cylinders are meshes."""
    told = Diagnostics()
    text = (_FOLDER / f"{name}.urdf").read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        text = re.sub(r'<cylinder radius="(.+?)" length="(.+?)"/>', _mesh_in(Path(folder)), text)
        (model,) = load_models(text, workspace=None, diagnostics=told)
        file = _FOLDER / f"{name}.srdf"
        srdf = load_srdf(file, robot=model, workspace=None, diagnostics=told)
        robot = RobotModel.build(model, srdf, diagnostics=told)
        # Meshes are read when the first scene is built.
        CollisionChecker(PlanningScene.of(robot), "arm", diagnostics=told)
    assert not list(told), [str(one) for one in told]
    return robot


def problem_of(
    robot: RobotModel, family: str, number: int
) -> tuple[PlanningScene, str, FloatArray, FloatArray]:
    """Return scene, group, start and goal of one problem, the same ones on every machine."""
    arm, furniture = ARMS[robot.name], FAMILIES[family]
    rng = np.random.default_rng([number, *family.encode(), *robot.name.encode()])
    group = robot.group("arm")
    start = group.space.array(dict(group.states[arm.state]))
    for _ in range(_TRIES):
        scene, target = _scene(robot, furniture, rng)
        checker = CollisionChecker(scene, "arm")
        if not checker.is_valid(start):
            continue
        solver = Solver(robot, "arm")
        for T_base_tip in _poses(furniture, target, arm.approach, rng):
            goal = solver.ik(
                T_base_tip, seed_q=start, patience=Patience(attempts=30), validity=checker, rng=rng
            )
            if goal is not None:
                return scene, "arm", start, goal
    raise AssertionError(f"{robot.name}: '{family}' {number} leaves the arm no room")


def _scene(
    robot: RobotModel, family: Family, rng: np.random.Generator
) -> tuple[PlanningScene, Pose]:
    """Return the scene, and the pose of what is to be reached for."""
    away = family.distance_m + rng.uniform(0.0, family.moved_m)
    side = rng.uniform(-family.moved_m, family.moved_m)
    turn = rng.uniform(-family.turned_rad, family.turned_rad)
    around = rng.uniform(-math.pi / 2.0, math.pi / 2.0)
    T_base_front = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, around))
    T_base_front = T_base_front @ Pose.from_xyz_rpy((away, side, 0.0), (0.0, 0.0, turn))
    chosen = str(rng.choice(family.targets))
    scene, target = PlanningScene.of(robot), Pose()
    for thing in family.things:
        x, y, z = thing.at
        if thing.name in family.targets:
            dx, dy = rng.uniform(-family.slid_m, family.slid_m, 2)
            x, y = x + 0.5 * dx, y + dy
        pose = T_base_front @ Pose((x, y, z))
        size = thing.size
        shape = Cylinder(*size) if len(size) == 2 else Box((size[0], size[1], size[2]))
        scene = scene.with_object(WorldObject.single(thing.name, shape, pose))
        if thing.name == chosen:
            target = pose
    return scene, target


def _poses(
    family: Family, target: Pose, approach: int, rng: np.random.Generator
) -> Iterator[FloatArray]:
    """Yield poses of the tip before a thing, which its axis points at."""
    for _ in range(6):
        heading = rng.uniform(-0.5, 0.5)
        pitch = rng.uniform(0.9, 1.5) if family.from_above else rng.uniform(0.0, 0.35)
        into = target.matrix()[:3, :3] @ np.array(
            [math.cos(heading) * math.cos(pitch), math.sin(heading) * math.cos(pitch),
             -math.sin(pitch)]
        )  # fmt: skip
        roll = rng.uniform(-math.pi, math.pi)
        side = np.cross(into, [0.0, 0.0, 1.0])
        side /= np.linalg.norm(side)
        up = np.cross(side, into)
        second = math.cos(roll) * side + math.sin(roll) * up
        columns = [into, second, np.cross(into, second)]
        pose = np.eye(4)
        for place, column in enumerate(columns):
            pose[:3, (approach + place) % 3] = column
        pose[:3, 3] = np.asarray(target.position_m) - _STAND_OFF_M * into
        yield pose


def _mesh_in(folder: Path) -> Callable[[re.Match[str]], str]:
    """Return what writes a cylinder with rounded edges and says where it is."""

    def write(found: re.Match[str]) -> str:
        radius, length = float(found[1]), float(found[2])
        file = folder / f"{radius}_{length}.stl"
        file.write_bytes(_stl(radius, length))
        return f'<mesh filename="{file.as_uri()}"/>'

    return write


def _stl(radius: float, length: float) -> bytes:
    edge = 0.1 * min(radius, length)
    rings = [
        (radius - edge, -length / 2.0), (radius, edge - length / 2.0),
        (radius, length / 2.0 - edge), (radius - edge, length / 2.0),
    ]  # fmt: skip
    angles = np.linspace(0.0, 2.0 * math.pi, _SIDES, endpoint=False)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    corners = np.concatenate([np.c_[r * circle, np.full(_SIDES, z)] for r, z in rings])
    faces = []
    for ring in range(len(rings) - 1):
        for k in range(_SIDES):
            a, b = ring * _SIDES + k, ring * _SIDES + (k + 1) % _SIDES
            faces += [(a, b, b + _SIDES), (a, b + _SIDES, a + _SIDES)]
    last = (len(rings) - 1) * _SIDES
    for k in range(1, _SIDES - 1):
        faces += [(0, k + 1, k), (last, last + k, last + k + 1)]
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    triangles = np.zeros(len(faces), kind)
    triangles["corners"] = corners[np.array(faces)]
    return bytes(80) + np.uint32(len(faces)).tobytes() + triangles.tobytes()
