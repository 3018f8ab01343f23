"""``gz model``: a model's pose and facts; spawning, moving and deleting it."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number
from gazelle.cli.gz.protobuf_text import protobuf_text
from gazelle.cli.gz.world_link import WorldLink, pose_line, world_link
from gazelle.documents import read_text_limited
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_of, set_pose

__all__ = ["COMMAND", "run"]

COMMAND = GzCommand(
    "model",
    "Change properties of a model, delete a model, or\n\tspawn a new model. If a name for the "
    "world, option -w, is\n\tnot specified, the first world found on the Gazebo master\n\twill "
    "be used.",
    (
        GzOption("world-name", "w", "World name; Gazelle has one world.", takes=True),
        GzOption("model-name", "m", "Model name.", takes=True),
        GzOption("delete", "d", "Delete a model."),
        GzOption("spawn-file", "f", "Spawn model from SDF file.", takes=True),
        GzOption("spawn-string", "s", "Spawn model from SDF string, pass by a pipe."),
        GzOption("info", "i", "Output model information to the terminal."),
        GzOption("pose", "p", "Output model pose as a space separated 6-tuple: x y z R P Y."),
        GzOption("pose-x", "x", "x value", takes=True),
        GzOption("pose-y", "y", "y value", takes=True),
        GzOption("pose-z", "z", "z value", takes=True),
        GzOption("pose-R", "R", "roll in radians.", takes=True),
        GzOption("pose-P", "P", "pitch in radians.", takes=True),
        GzOption("pose-Y", "Y", "yaw in radians.", takes=True),
    ),
)
_PLACES = ("pose-x", "pose-y", "pose-z", "pose-R", "pose-P", "pose-Y")
_JOINT_TYPES = ("REVOLUTE", "REVOLUTE", "PRISMATIC", "FIXED", "BALL", "UNIVERSAL")


def run(options: Mapping[str, str]) -> int:
    """Do what the options say to one model.

    Raises:
        GzError: the model's name is missing or unknown, or the world refuses.
    """
    name = options.get("model-name", "")
    if not name:
        raise GzError("A model name is required using the (-m) command line argument")
    with world_link() as link:
        if "delete" in options:
            link.check_model(name)
            link.call("delete_model", "gazebo_msgs/DeleteModel", model_name=name)
        elif "spawn-file" in options or "spawn-string" in options:
            _spawn(link, name, options)
        elif "info" in options:
            sys.stdout.write(protobuf_text(_facts(link, name)))
        elif "pose" in options:
            print(pose_line(_xyz_rpy(link.model_pose(name))))
        elif any(coordinate in options for coordinate in _PLACES):
            _move(link, name, options)
        else:
            raise GzError(f"nothing to do with model[{name}]; see gz help model")
    return 0


def _spawn(link: WorldLink, name: str, options: Mapping[str, str]) -> None:
    if "spawn-file" in options:
        file = options["spawn-file"]
        try:
            text = read_text_limited(file)
        except (OSError, UnicodeDecodeError) as error:
            raise GzError(f"Unable to open file[{file}]: {error}") from None
    else:
        text = sys.stdin.read()
    if not text.strip():
        raise GzError("the model's text is empty")
    pose = _pose_of(tuple(number(options, coordinate) for coordinate in _PLACES))
    kind = "gazebo_msgs/SpawnModel"
    link.call("spawn_sdf_model", kind, model_name=name, model_xml=text, initial_pose=pose)


def _move(link: WorldLink, name: str, options: Mapping[str, str]) -> None:
    # A place that is not given keeps its value.
    now = _xyz_rpy(link.model_pose(name))
    wanted = tuple(
        number(options, coordinate, value) for coordinate, value in zip(_PLACES, now, strict=True)
    )
    state = message_type("gazebo_msgs/ModelState")(model_name=name, pose=_pose_of(wanted))
    link.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state)


def _facts(link: WorldLink, name: str) -> dict[str, Any]:
    pose = link.model_pose(name)
    found = link.call("get_model_properties", "gazebo_msgs/GetModelProperties", model_name=name)
    return {
        "name": name,
        "is_static": bool(found.is_static),
        "pose": _pose_fields(pose),
        "joint": [_joint(link, name, joint) for joint in found.joint_names],
        "link": [_link(link, name, body) for body in found.body_names],
    }


def _joint(link: WorldLink, model: str, name: str) -> dict[str, Any]:
    scoped = f"{model}::{name}"
    found = link.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name=scoped)
    angles = [float(value) for value in found.position]
    return {"name": scoped, "angle": angles, "type": _JOINT_TYPES[found.type]}


def _link(link: WorldLink, model: str, name: str) -> dict[str, Any]:
    scoped = f"{model}::{name}"
    found = link.call("get_link_state", "gazebo_msgs/GetLinkState", link_name=scoped)
    return {"name": scoped, "world_pose": _pose_fields(found.link_state.pose)}


def _pose_fields(pose: Any) -> dict[str, Any]:
    position, turn = pose.position, pose.orientation
    return {
        "position": {axis: float(getattr(position, axis)) for axis in "xyz"},
        "orientation": {axis: float(getattr(turn, axis)) for axis in "xyzw"},
    }


def _xyz_rpy(message: Any) -> tuple[float, ...]:
    pose = pose_of(message)
    return (*pose.position_m, *pose.rpy_rad)


def _pose_of(xyz_rpy: tuple[float, ...]) -> Any:
    x, y, z, roll, pitch, yaw = xyz_rpy
    pose = Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
    message = message_type("geometry_msgs/Pose")()
    set_pose(message, pose)
    return message
