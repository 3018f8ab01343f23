"""Which joints of a ROS 1 robot hold still until a controller claims them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from gazelle.control.hardware.ros1_joints import Ros1Joint
from gazelle.control.sources.source import ParameterSource
from gazelle.description.model import JointType

__all__ = ["joints_to_hold"]


def joints_to_hold(joints: Sequence[Ros1Joint], source: ParameterSource) -> frozenset[str]:
    """Return the joints that a configured controller names, wheels and other continuous ones not.

    In Gazebo an arm falls between the spawn and the start of its controllers; here it waits.
    """
    named: set[str] = set()
    for controller in source.controllers():
        named |= set(_words(source.tree(controller)))
    return frozenset(
        joint.name
        for joint in joints
        if joint.interface and joint.name in named and joint.type is not JointType.CONTINUOUS
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
