"""How drive plug-ins are told to drive, run and end."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any, NamedTuple

from gazelle.engine import JointHandle
from gazelle.simulator.plugins.context import PluginContext, join_names
from gazelle.simulator.plugins.parameters import PluginReader

__all__ = ["Velocity", "gz_text", "gz_topic", "needed_joints", "run_drive", "take_velocities"]


class Velocity(NamedTuple):
    """A command.

    Attributes:
        forward, sideways: m/s.
        turn: rad/s; an angle for what is steered.
    """

    forward: float = 0.0
    sideways: float = 0.0
    turn: float = 0.0


def needed_joints(
    context: PluginContext, parameters: PluginReader, keys: Iterable[str]
) -> dict[str, str] | None:
    """Return the joints of some keys, ``model::joint``; None when one is missing, reported."""
    found = {key: context.joint_name(parameters.text(key)) for key in keys}
    names = {key: name for key, name in found.items() if name is not None}
    return names if len(names) == len(found) else None


def take_velocities(context: PluginContext, topic: str, take: Callable[[Velocity], None]) -> None:
    """Listen to commands; a topic takes ``Twist`` and ``TwistStamped``."""

    def hear(message: Any) -> None:
        twist = getattr(message, "twist", message)
        linear = twist.linear
        take(Velocity(float(linear.x), float(linear.y), float(twist.angular.z)))

    context.resources.subscription(topic, None, hear, announced="geometry_msgs/msg/Twist")


def run_drive(
    context: PluginContext,
    joints: Iterable[JointHandle],
    period: Fraction,
    update: Callable[[], None],
    reset: Callable[[], None],
) -> None:
    """Update a drive every so many steps until it is closed, which lets its joints go."""
    moved = tuple(joints)

    def release() -> None:
        for joint in moved:
            joint.release()

    context.resources.task(f"{context.plugin.name} drive", period, update)
    context.resources.on_reset(reset)
    context.resources.on_close(release)


def gz_text(context: PluginContext, parameters: PluginReader, key: str) -> str:
    """Return a name of the new Gazebo's, in which a table says ``{model}`` and ``{link}``."""
    text, model = parameters.text(key), context.model
    return text.replace("{model}", model.name).replace("{link}", model.canonical_link)


def gz_topic(context: PluginContext, parameters: PluginReader, key: str) -> str:
    """Return a topic of the new Gazebo's: absolute, whatever the namespace."""
    return join_names("/", gz_text(context, parameters, key))
