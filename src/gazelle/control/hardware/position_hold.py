"""Which joints of a ROS 1 robot hold still until a controller claims them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gazelle.control.hardware.ros1_joints import Ros1Joint
from gazelle.control.sources.source import ParameterSource
from gazelle.description.model import JointType

__all__ = ["joints_to_hold"]

# What the types of controllers that keep joints in place have in their names.
_PLACING = ("Position", "Trajectory", "Gripper")


def joints_to_hold(joints: Sequence[Ros1Joint], source: ParameterSource) -> frozenset[str]:
    """Return the joints that a configured controller names, wheels not.

    In Gazebo an arm falls between the spawn and the start of its controllers; here it waits.
    A continuous joint is a wheel unless a controller of positions or trajectories names it.
    """
    named: set[str] = set()
    placed: set[str] = set()
    for controller in source.controllers():
        words = set(_words(source.tree(controller)))
        named |= words
        if any(word in (source.controller_type(controller) or "") for word in _PLACING):
            placed |= words
    return frozenset(
        joint.name
        for joint in joints
        if joint.interface
        and joint.name in (placed if joint.type is JointType.CONTINUOUS else named)
    )


def _words(value: Any) -> Iterator[str]:
    """Yield every text in a tree of parameters, and every key: gains go by the joint's name."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield str(key)
            yield from _words(inner)
    elif isinstance(value, list | tuple):
        for inner in value:
            yield from _words(inner)
