"""What a viewer is told about a world and a robot."""

from __future__ import annotations

import json

import pytest

from gazelle.description.model import (
    Box,
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    MeshShape,
    Model,
    Visual,
    World,
)
from gazelle.geometry import Pose
from gazelle.sensors.scene_json import pose_value, robot_value, world_value

_UP = Pose((0.0, 0.0, 1.0))
_ASIDE = Pose((2.0, 0.0, 0.0))


@pytest.fixture
def arm() -> Model:
    """A base, and an arm that turns a metre above it."""
    box = Visual("shape", Box((1.0, 2.0, 3.0)))
    mesh = Collision("mesh", MeshShape("package://p/a.stl", None))
    return Model(
        name="arm",
        T_world_model=_ASIDE,
        links=(
            Link("base", T_model_link=_UP, visuals=(box,)),
            Link("upper", T_model_link=_UP @ _UP, collisions=(mesh,), inertial=_BOX_OF_12_KG),
        ),
        joints=(
            Joint("turn", JointType.CONTINUOUS, "base", "upper", _UP @ _UP, JointAxis()),
            Joint("stay", JointType.FIXED, "world", "base", _UP),
        ),
    )


# Edges 1, 2 and 3 m: m (b² + c²) / 12.
_BOX_OF_12_KG = Inertial(12.0, inertia_kg_m2=(13.0, 0.0, 0.0, 10.0, 0.0, 5.0))


def test_bodies_are_at_their_initial_places_in_the_world(arm: Model) -> None:
    value = world_value(World(models=(Model("first"), arm)))
    assert [body["name"] for body in value["bodies"]] == ["arm::base", "arm::upper"]
    assert value["bodies"][1]["pose"] == [2.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0]
    assert [model["bodies"] for model in value["models"]] == [[], [0, 1]]
    assert value["bodies"][0]["model"] == 1


def test_robot_starts_at_its_root_link(arm: Model) -> None:
    value = robot_value(Model("arm", links=arm.links, joints=arm.joints[:1]))
    assert [body["name"] for body in value["bodies"]] == ["base", "upper"]
    assert [body["pose"][2] for body in value["bodies"]] == [0.0, 1.0]


def test_joint_lies_in_its_child_and_unlimited_is_null(arm: Model) -> None:
    turn, stay = world_value(World(models=(arm,)))["joints"]
    assert (turn["parent"], turn["child"], turn["pose"]) == (0, 1, pose_value(Pose()))
    assert (turn["axis"], turn["lower"], turn["upper"]) == ([0.0, 0.0, 1.0], None, None)
    assert (stay["parent"], stay["axis"]) == (-1, [0.0, 0.0, 0.0])


def test_inertia_is_drawn_as_the_box_that_has_it(arm: Model) -> None:
    inertial = world_value(World(models=(arm,)))["bodies"][1]["inertial"]
    assert inertial["diagonal"] == [13.0, 10.0, 5.0]
    assert sorted(inertial["box"]) == pytest.approx([1.0, 2.0, 3.0])


def test_value_is_json_and_names_files_of_meshes(arm: Model) -> None:
    value = json.loads(json.dumps(world_value(World(models=(arm,)), version=3), allow_nan=False))
    geometry = value["bodies"][1]["collisions"][0]["geometry"]
    assert (geometry["type"], geometry["uri"]) == ("mesh", "package://p/a.stl")
    assert value["bodies"][0]["visuals"][0]["geometry"] == {"type": "box", "size": [1.0, 2.0, 3.0]}
    assert (value["version"], value["kind"]) == (3, "world")
