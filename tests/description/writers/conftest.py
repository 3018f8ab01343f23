"""Reading texts, and the same model in two formats compared."""

from __future__ import annotations

import math
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.shared_files import SHARED

from gazelle.description.forward_kinematics import movable_joints, posed_model
from gazelle.description.loader import load_models
from gazelle.description.model import Inertial, Model
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.workspace import Workspace

TOLERANCE = 1e-9
REPOSITORY = Path(__file__).parents[3]
OWN_ROS1 = REPOSITORY / "tests/workspaces/ros1"


@pytest.fixture(scope="session")
def workspace() -> Workspace:
    """All packages and models: the examples, the tests' own, and the samples where they are."""
    roots = [*sorted((REPOSITORY / "examples").glob("*_ws")), OWN_ROS1]
    models = [OWN_ROS1 / "src/yard_gazebo/models"]
    if SHARED.is_dir():
        samples = SHARED / "workspaces"
        roots += [samples / name for name in ("catkin_ws", "ros2_ws", "turtlebot3_ws")]
        models.append(samples / "gazebo_models")
    environ = {
        "ROS_PACKAGE_PATH": ":".join(str(root / "src") for root in roots),
        "GAZEBO_MODEL_PATH": ":".join(map(str, models)),
    }
    return Workspace.discover(environ=environ, cwd=REPOSITORY)


class Reading:
    """Reads texts and tells what two models differ in."""

    def model(self, source: str | Path, workspace: Workspace | None = None, **args: Any) -> Model:
        found = Diagnostics()
        models = load_models(source, workspace=workspace, diagnostics=found, **args)
        assert models, [str(item) for item in found]
        return models[0]

    def differences(self, first: Any, second: Any, place: str = "") -> list[str]:
        """Return where two models differ by more than rounding, places in the source apart."""
        if isinstance(first, Tag) and isinstance(second, Tag):
            one, other = _plain(first), _plain(second)
            return [] if one == other else [f"{place}: {one} and {other}"]
        if isinstance(first, Pose) and isinstance(second, Pose):
            away = np.abs(first.matrix() - second.matrix()).max()
            return [] if away < TOLERANCE else [f"{place}: {first} and {second}"]
        if type(first) is not type(second) and not _are_numbers(first, second):
            return [f"{place}: {first!r} and {second!r}"]
        if isinstance(first, tuple):
            if len(first) != len(second):
                return [f"{place}: {len(first)} and {len(second)}"]
            pairs = enumerate(zip(first, second, strict=True))
            return [
                text
                for i, (a, b) in pairs
                for text in self.differences(a, b, f"{place}[{getattr(a, 'name', i)}]")
            ]
        if is_dataclass(first):
            return [
                text
                for field in fields(first)
                if field.compare and field.name not in _IGNORED
                for text in self.differences(
                    getattr(first, field.name), getattr(second, field.name), f"{place}.{field.name}"
                )
            ]
        # A material without a name gets one, as urdfdom demands.
        named = place.endswith(".material.name") and first == "" and second
        return [] if named or _same(first, second) else [f"{place}: {first!r} and {second!r}"]

    def total(self, model: Model) -> tuple[float, np.ndarray, np.ndarray]:
        """Return mass, centre of mass and inertia about it, in the world."""
        bodies = [
            (link.inertial, model.T_world_model @ link.T_model_link @ link.inertial.T_link_com)
            for link in model.links
            if link.inertial is not None
        ]
        mass = sum(item.mass_kg for item, _ in bodies)
        center = sum(item.mass_kg * np.array(pose.position_m) for item, pose in bodies) / mass
        tensor = np.zeros((3, 3))
        for item, pose in bodies:
            turn = pose.matrix()[:3, :3]
            arm = np.array(pose.position_m) - center
            tensor += turn @ _tensor(item) @ turn.T
            tensor += item.mass_kg * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        return mass, center, tensor

    def random_positions(self, model: Model, seed: int) -> dict[str, float]:
        rng = np.random.default_rng(seed)
        return {name: float(rng.uniform(-1, 1)) for name in movable_joints(model)}

    def shapes(self, model: Model, positions: dict[str, float]) -> dict[str, np.ndarray]:
        """Return where every collision and visual is in the world, by kind, name and order."""
        posed = posed_model(model, positions)
        found: dict[str, np.ndarray] = {}
        for link in posed.links:
            base = posed.T_world_model @ link.T_model_link
            for kind, item, pose in (
                *(("c", item, item.T_link_collision) for item in link.collisions),
                *(("v", item, item.T_link_visual) for item in link.visuals),
            ):
                key = f"{kind} {item.name}"
                while key in found:
                    key += "'"
                found[key] = (base @ pose).matrix()
        return found


_IGNORED = frozenset({"span", "type_span", "file", "source_format", "estimated", "raw_text"})


def _plain(tag: Tag) -> tuple[Any, ...]:
    return (tag.name, tag.attributes, tag.text, tuple(_plain(child) for child in tag.children))


def _are_numbers(first: Any, second: Any) -> bool:
    return isinstance(first, float | int) and isinstance(second, float | int)


def _same(first: Any, second: Any) -> bool:
    if _are_numbers(first, second):
        both_huge = abs(first) >= 1e10 and abs(second) >= 1e10
        return math.isclose(first, second, rel_tol=TOLERANCE, abs_tol=1e-12) or both_huge
    return bool(first == second)


def _tensor(inertial: Inertial) -> np.ndarray:
    a, b, c, d, e, f = inertial.inertia_kg_m2
    return np.array([[a, b, c], [b, d, e], [c, e, f]])


@pytest.fixture(scope="session")
def reading() -> Reading:
    return Reading()
