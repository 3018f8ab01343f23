"""Which joints of a model are axles of wheels."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, JointType, Link, Model, PluginTag

__all__ = ["Wheel", "axis_in_model", "wheels_of"]

_NAME = re.compile(r"wheel|tire|tyre", re.IGNORECASE)
_CASTER = re.compile(r"cast[eo]r|swivel|support", re.IGNORECASE)
_DRIVE = re.compile(r"drive|steer|skid|tricycle", re.IGNORECASE)
_HORIZONTAL = 0.5


class Wheel(NamedTuple):
    """A wheel.

    Attributes:
        joint: its axle.
        link: what turns.
        is_caster: it swivels freely, nothing drives it.
        axis: (3,), unit vector of the axle in the model's frame.
    """

    joint: Joint
    link: Link
    is_caster: bool
    axis: NDArray[np.float64]


def wheels_of(model: Model) -> tuple[Wheel, ...]:
    """Return the joints with a level axis and no limits that are called or driven as wheels."""
    driven = frozenset(_driven(model.plugins))
    above = {joint.child: joint for joint in model.joints}
    links = {link.name: link for link in model.links}
    found = []
    for joint in model.joints:
        link = links.get(joint.child)
        if link is None or not _turns_freely(joint):
            continue
        axis = axis_in_model(joint)
        named = _NAME.search(joint.name) or _NAME.search(joint.child)
        if abs(axis[2]) < _HORIZONTAL and (named or joint.name in driven):
            caster = joint.name not in driven and _swivels(joint, above)
            found.append(Wheel(joint, link, caster, axis))
    return tuple(found)


def axis_in_model(joint: Joint) -> NDArray[np.float64]:
    """Return the unit vector, (3,), of a joint's axis in the model's frame; zeros without one."""
    if joint.axis is None:
        return np.zeros(3)
    axis = np.asarray(joint.T_model_joint.rotate(joint.axis.xyz), dtype=np.float64)
    return axis / max(float(np.linalg.norm(axis)), 1e-12)


def _turns_freely(joint: Joint) -> bool:
    if joint.type is JointType.CONTINUOUS:
        return True
    axis = joint.axis
    # SDF's revolute joints without limits, or with ±1e16.
    return joint.type is JointType.REVOLUTE and axis is not None and axis.upper - axis.lower > 1e3


def _swivels(joint: Joint, above: Mapping[str, Joint]) -> bool:
    if _CASTER.search(joint.name) or _CASTER.search(joint.child):
        return True
    upper = above.get(joint.parent)
    return upper is not None and _turns_freely(upper) and abs(axis_in_model(upper)[2]) > _HORIZONTAL


def _driven(plugins: tuple[PluginTag, ...]) -> Iterator[str]:
    for plugin in plugins:
        if _DRIVE.search(plugin.filename):
            for tag in plugin.parameters.walk():
                if "joint" in tag.name.lower():
                    yield tag.text.strip()
