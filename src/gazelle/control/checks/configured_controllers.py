"""Joints and gains that the configured controllers name, and what MoveIt believes of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from gazelle.control.controllers.registry import controller_class
from gazelle.control.parameter_sources.ros1_parameter_server import ParameterSource
from gazelle.diagnostics import SourceSpan
from gazelle.parameters.trees import nested

__all__ = [
    "ConfiguredController",
    "Gains",
    "MoveItController",
    "configured_controllers",
    "moveit_controllers",
]


_MANAGER = "moveit_simple_controller_manager"


@dataclass(frozen=True, slots=True)
class MoveItController:
    """A controller that MoveIt sends trajectories to."""

    name: str
    joints: tuple[str, ...]


def moveit_controllers(tree: Mapping[str, Any]) -> tuple[MoveItController, ...]:
    """Read the parameters of a ``move_group``, of ROS 1 or ROS 2.

    ROS 1 has a ``controller_list`` of dictionaries (``controllers.yaml``), ROS 2 names and a
    branch for each (``moveit_controllers.yaml``). An empty result means there are none.
    """
    listed = tree.get("controller_list")
    if isinstance(listed, list):
        return tuple(_from_list(listed))
    branch = tree.get(_MANAGER, tree)
    names = branch.get("controller_names") if isinstance(branch, Mapping) else None
    if not isinstance(names, list):
        return ()
    found = ((str(name), branch.get(str(name))) for name in names)
    return tuple(
        MoveItController(name, _texts(row.get("joints")) if isinstance(row, Mapping) else ())
        for name, row in found
    )


def _from_list(rows: list[Any]) -> Iterator[MoveItController]:
    for row in rows:
        name = row.get("name") if isinstance(row, Mapping) else None
        # One without a name is an action of a robot's driver, which has no controllers.
        if isinstance(name, str) and name.strip("/"):
            yield MoveItController(name.strip("/"), _texts(row.get("joints")))


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(str(item) for item in value) if isinstance(value, list) else ()


# Parameters whose values are names of joints, over all controllers of both generations.
_JOINT_KEYS = (
    "joint",
    "joints",
    "command_joints",
    "dof_names",
    "left_wheel",
    "right_wheel",
    "left_wheel_names",
    "right_wheel_names",
    "left_wheel_joint",
    "right_wheel_joint",
    "rear_wheel",
    "front_steer",
    "front_wheel",
    "front_left_wheel",
    "front_right_wheel",
    "rear_left_wheel",
    "rear_right_wheel",
    "front_left_wheel_joint",
    "front_right_wheel_joint",
    "back_left_wheel_joint",
    "back_right_wheel_joint",
    "front_left_wheel_command_joint_name",
    "front_right_wheel_command_joint_name",
    "rear_left_wheel_command_joint_name",
    "rear_right_wheel_command_joint_name",
    "front_wheels_names",
    "rear_wheels_names",
    "traction_joint_name",
    "traction_joints_names",
    "steering_joint_name",
    "steering_joints_names",
    "wheel_names",
)


@dataclass(frozen=True, slots=True)
class Gains:
    """Gains of one joint in a controller.

    Attributes:
        of_velocity: the error is one of velocity, not of position.
        key: where they stand in the controller's parameters, with dots.
    """

    joint: str
    p: float
    i: float
    d: float
    of_velocity: bool
    key: str


@dataclass(frozen=True, slots=True)
class ConfiguredController:
    """A controller that the parameters describe, loaded or not.

    Attributes:
        joints: joints it names, in order, without repeats.
        gains: of controllers that command efforts.
        is_known: its type is one of Gazelle's, so that its words mean what they say.
        span: where its joints stand, None when unknown.
    """

    name: str
    type: str
    joints: tuple[str, ...]
    gains: tuple[Gains, ...] = ()
    is_known: bool = True
    span: SourceSpan | None = field(default=None, compare=False)


def configured_controllers(source: ParameterSource) -> tuple[ConfiguredController, ...]:
    """Return every controller with a type, as its parameters describe it."""
    return tuple(_controller(source, name) for name in source.controllers())


def _controller(source: ParameterSource, name: str) -> ConfiguredController:
    tree = nested(source.tree(name))
    type_name = source.controller_type(name) or ""
    names, key = _joint_names(tree)
    gains = tuple(_gains(tree, names, type_name)) if _commands_effort(tree, type_name) else ()
    is_known = controller_class(type_name) is not None
    return ConfiguredController(name, type_name, names, gains, is_known, source.span(name, key))


def _joint_names(tree: Mapping[str, Any]) -> tuple[tuple[str, ...], str]:
    """Return the joints a tree names and the first key that does."""
    names: dict[str, None] = {}
    first = ""
    for key in _JOINT_KEYS:
        value = tree.get(key)
        items = value if isinstance(value, list | tuple) else [value]
        found = [item for item in items if isinstance(item, str) and item]
        names.update(dict.fromkeys(found))
        first = first or (key if found else "")
    # Coupled names, "a/position", are interfaces of a chained controller and no joints.
    return tuple(name for name in names if "/" not in name), first


def _commands_effort(tree: Mapping[str, Any], type_name: str) -> bool:
    if type_name.startswith("effort_controllers/"):
        return True
    return tree.get("command_interfaces") == ["effort"] or tree.get("interface_name") == "effort"


def _gains(tree: Mapping[str, Any], joints: tuple[str, ...], type_name: str) -> Iterator[Gains]:
    of_velocity = "Velocity" in type_name
    for joint in joints:
        for key in (f"gains.{joint}", f"{joint}.pid", "pid"):
            branch: Any = tree
            for word in key.split("."):
                branch = branch.get(word) if isinstance(branch, dict) else None
            if not isinstance(branch, dict) or "p" not in branch:
                continue
            p, i, d = (_number(branch.get(word, 0.0)) for word in ("p", "i", "d"))
            yield Gains(joint, p, i, d, of_velocity, key)
            break


def _number(value: Any) -> float:
    try:
        return float(value)
    except (OverflowError, TypeError, ValueError):
        return 0.0
