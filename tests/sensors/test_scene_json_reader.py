"""A world that was told to viewers is the same world to look at."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from tests.recorded import cart_world

from gazelle.description.loader import load_world
from gazelle.description.model import (
    CameraSpec,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Heightmap,
    Link,
    Material,
    MeshShape,
    Model,
    Polyline,
    Visual,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.sensors.scene_json import world_value
from gazelle.sensors.scene_json_reader import world_of_value
from gazelle.workspace import Workspace

_SHAPES = (
    Cylinder(0.1, 0.2),
    Capsule(0.1, 0.2),
    Cone(0.1, 0.2),
    Ellipsoid((0.1, 0.2, 0.3)),
    MeshShape("package://p/a.stl", Path("/p/a.stl"), (1.0, 2.0, 3.0), "part", True),
    MeshShape("package://p/b.stl", None),
    Heightmap("file://h.png", Path("/h.png"), (9.0, 9.0, 2.0), (1.0, 0.0, 0.0)),
    Polyline((((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)),), 0.5),
)


def _again(world: World) -> tuple[Any, Any]:
    """What viewers are told of a world, and of the world that is read of that."""
    told = json.loads(json.dumps(world_value(world)))
    after = json.loads(json.dumps(world_value(world_of_value(told))))
    return _seen(told), _seen(after)


def _seen(told: Any) -> Any:
    """Without what only physics needs."""
    for body in told["bodies"]:
        body |= {"collisions": [], "inertial": None}
        body["pose"] = [round(number, 9) + 0.0 for number in body["pose"]]
    for model in told["models"]:
        model["joints"] = []
    return {**told, "joints": [], "gravity": []}


def test_a_cart_with_its_camera_comes_back() -> None:
    before, after = _again(cart_world())
    assert after == before
    model = world_of_value(json.loads(json.dumps(world_value(cart_world())))).model("cart")
    assert model is not None
    (sensor,) = model.links[0].sensors
    assert isinstance(sensor.spec, CameraSpec) and sensor.spec.horizontal_fov_rad == 1.2


@pytest.mark.parametrize("shape", _SHAPES, ids=lambda one: type(one).__name__)
def test_every_shape_comes_back(shape: Any) -> None:
    blue = Material("Gazebo/Blue", diffuse=(0.0, 0.0, 1.0, 0.5), texture=Path("/a.png"))
    visual = Visual("v", shape, Pose((1.0, 2.0, 3.0)), blue, transparency=0.25, cast_shadows=False)
    model = Model("m", Pose((0.0, 0.0, 1.0)), links=(Link("l", visuals=(visual,)),))
    before, after = _again(World(models=(model,)))
    assert after == before


def test_the_workshop_comes_back(examples_dir: Path) -> None:
    file = examples_dir / "scout_ws/src/scout_robot/worlds/workshop.world"
    world = load_world(file, workspace=Workspace.discover(), diagnostics=Diagnostics())
    before, after = _again(world)
    assert after == before
