"""Which interfaces a ROS 2 trajectory controller may be told to use, and on which joints."""

from __future__ import annotations

import numpy as np

from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.joint_trajectory.joints import joint_names
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Indices

__all__ = ["INTERFACES", "check_interfaces", "columns_of", "command_joints", "read_interfaces"]

INTERFACES = ("position", "velocity", "acceleration", "effort")


def read_interfaces(context: ControllerContext, key: str) -> tuple[str, ...]:
    """Return ``command_interfaces`` or ``state_interfaces``, in the order of `INTERFACES`.

    Raises:
        ControllerError: the list is missing or empty, or has a word that is no interface.
    """
    context.parameters.require(key)
    names = context.parameters.texts(key)
    where = f"controller '{context.name}': '{context.parameters.full_name(key)}'"
    if not names:
        raise ControllerError(f"{where} parameter is empty")
    known = INTERFACES if key == "command_interfaces" else INTERFACES[:3]
    for name in names:
        if name not in known:
            raise ControllerError(f"{where} has '{name}', it may have {', '.join(known)}")
    return tuple(name for name in INTERFACES if name in names)


def check_interfaces(
    context: ControllerContext, commands: tuple[str, ...], states: tuple[str, ...]
) -> None:
    """Insist on the combinations that ros2_controllers takes.

    Raises:
        ControllerError: it would not take these.
    """
    needs_states = commands in {("velocity",), ("effort",), ("position", "effort")}
    rules = (
        (
            "velocity" in commands and len(commands) > 1 and "position" not in commands,
            "'velocity' command interface can be used either alone or 'position' command "
            "interface has to be present",
        ),
        (
            "acceleration" in commands and not {"velocity", "position"} <= set(commands),
            "'acceleration' command interface can only be used if 'velocity' and 'position' "
            "command interfaces are present",
        ),
        (
            "effort" in commands and commands not in {("effort",), ("position", "effort")},
            "'effort' command interface has to be used alone or with a 'position' interface",
        ),
        (
            "position" not in states,
            "'velocity' state interface cannot be used if 'position' interface is missing.",
        ),
        (
            "acceleration" in states and "velocity" not in states,
            "'acceleration' state interface cannot be used if 'position' and 'velocity' "
            "interfaces are not present.",
        ),
        (
            needs_states and "velocity" not in states,
            f"'{commands[-1]}' command interface can only be used alone if 'velocity' and "
            "'position' state interfaces are present",
        ),
    )
    for is_broken, text in rules:
        if is_broken:
            raise ControllerError(f"controller '{context.name}': {text}")


def command_joints(context: ControllerContext, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return ``command_joints``, the joints themselves when there are none.

    Raises:
        ControllerError: there are more of them than joints.
    """
    if not context.parameters.texts("command_joints"):
        return names
    commanded = joint_names(context, "command_joints")
    if len(commanded) <= len(names):
        return commanded
    text = "The 'command_joints' parameter must not exceed the size of the 'joints' parameter."
    raise ControllerError(f"controller '{context.name}': {text}")


def columns_of(
    context: ControllerContext, commanded: tuple[str, ...], names: tuple[str, ...]
) -> Indices | None:
    """Return which of the joints are commanded, (M,), None when all are.

    Raises:
        ControllerError: fewer are commanded, and they are not among the joints.
    """
    if len(commanded) == len(names):
        return None
    if not set(commanded) <= set(names):
        text = "'command_joints' parameter must be a subset of 'joints' parameter, if their size "
        raise ControllerError(f"controller '{context.name}': {text}is not equal.")
    return np.array([names.index(name) for name in commanded], dtype=np.intp)
