"""``gz model --list``, ``-m NAME -p -l -j``: models in the new Gazebo's words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gazelle.cli.gz.options import GzCommand, GzError, GzOption
from gazelle.cli.gz.world_link import WorldLink, world_link
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces.poses import pose_of

__all__ = ["COMMAND", "OPTIONAL", "run"]

COMMAND = GzCommand(
    "model",
    "Print information about models. Entities have no numbers here, and joints have\n\tneither "
    "axis nor pose.",
    (
        GzOption("list", "", "Get a list of the available models."),
        GzOption("model", "m", "Select the model to be shown.", takes=True),
        GzOption("pose", "p", "Print the pose of the model."),
        GzOption("link", "l", "Select a link to show all its information, or all.", takes=True),
        GzOption("joint", "j", "Select a joint to show all its information, or all.", takes=True),
        GzOption("sensor", "s", "Not here; see gz topic -l.", takes=True),
    ),
)
# Their value may be left out.
OPTIONAL = ("link", "joint", "sensor")
_JOINT_TYPES = ("revolute", "revolute", "prismatic", "fixed", "ball", "universal")


def run(options: Mapping[str, str]) -> int:
    """List the models or show one.

    Raises:
        GzError: names are missing or unknown, or there is no world.
    """
    if "sensor" in options:
        raise GzError("gz model --sensor is not here; gz topic -l names what sensors publish")
    name = options.get("model", "")
    if "list" not in options and not name:
        raise GzError("-m MODEL names the model, --list names all; see gz help model")
    with world_link() as link:
        if "list" in options:
            print("Available models:")
            print("\n".join(f"    - {one}" for one in link.model_names()))
            return 0
        pose = link.model_pose(name)
        parts = [part for part in ("pose", "link", "joint") if part in options]
        _show(link, name, pose, {part: options.get(part, "") for part in parts})
    return 0


def _show(link: WorldLink, model: str, pose: Any, parts: Mapping[str, str]) -> None:
    found = link.call("get_model_properties", "gazebo_msgs/GetModelProperties", model_name=model)
    shows_all = not parts
    if shows_all or "pose" in parts:
        print("\n".join(["Model:", f"  - Name: {model}", *_pose_lines(pose, "  ")]))
    if shows_all or "link" in parts:
        for name in _chosen("link", model, parts.get("link", ""), list(found.body_names)):
            print("\n".join(_link(link, model, name)))
    if shows_all or "joint" in parts:
        for name in _chosen("joint", model, parts.get("joint", ""), list(found.joint_names)):
            print("\n".join(_joint(link, model, name)))


def _chosen(kind: str, model: str, word: str, names: Sequence[str]) -> Sequence[str]:
    if not word:
        return names
    if word not in names:
        hint = did_you_mean(word, names) or f"{kind}s: {', '.join(names) or 'none'}"
        raise GzError(f"model[{model}] has no {kind}[{word}]; {hint}")
    return [word]


def _link(link: WorldLink, model: str, name: str) -> list[str]:
    scoped = f"{model}::{name}"
    found = link.call("get_link_properties", "gazebo_msgs/GetLinkProperties", link_name=scoped)
    state = link.call("get_link_state", "gazebo_msgs/GetLinkState", link_name=scoped).link_state
    rows = (
        (found.ixx, found.ixy, found.ixz),
        (found.ixy, found.iyy, found.iyz),
        (found.ixz, found.iyz, found.izz),
    )
    return [
        "  - Link",
        f"    - Name: {name}",
        f"    - Parent: {model}",
        f"    - Mass (kg): {found.mass:.6f}",
        *_pose_lines(found.com, "    ", "Inertial Pose"),
        "    - Inertial Matrix (kg.m^2):",
        *(f"      {_numbers(row)}" for row in rows),
        # The new Gazebo has it relative to the model, the service has it in the world.
        *_pose_lines(state.pose, "    ", "World Pose"),
    ]


def _joint(link: WorldLink, model: str, name: str) -> list[str]:
    scoped = f"{model}::{name}"
    found = link.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name=scoped)
    return [
        "  - Joint",
        f"    - Name: {name}",
        f"    - Parent: {model}",
        f"    - Type: {_JOINT_TYPES[found.type]}",
        f"    - Position: {_numbers(found.position)}",
    ]


def _pose_lines(message: Any, space: str, title: str = "Pose") -> list[str]:
    pose = pose_of(message)
    return [
        f"{space}- {title} [ XYZ (m) ] [ RPY (rad) ]:",
        f"{space}  {_numbers(pose.position_m)}",
        f"{space}  {_numbers(pose.rpy_rad)}",
    ]


def _numbers(values: Sequence[float]) -> str:
    return "[" + " ".join(f"{float(value):.6f}" for value in values) + "]"
