"""SDF ``<pose>``: numbers, rotation formats and the frame it is relative to."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from itertools import count
from typing import cast

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import name_of
from gazelle.description.sdf_reader.frame_graph import FrameGraph, FramePoint
from gazelle.description.xml import Tag, floats_from
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["PoseResolver", "named_children", "pose_of", "read_pose", "relative_to_of"]

_FORMATS = ("euler_rpy", "quat_xyzw")
_SHAPES = frozenset({"collision", "visual"})


@dataclass(frozen=True, slots=True)
class PoseResolver:
    """A model's frames together with where problems are reported."""

    context: ReadContext
    frames: FrameGraph

    def in_link(self, tag: Tag, link: str) -> Pose:
        """Return the pose of a link's child (collision, visual, sensor, light) in the link."""
        written, relative_to = pose_of(tag, self.context), relative_to_of(tag)
        if relative_to in ("", link):
            return written
        user = FramePoint(
            tag.name, tag.attributes.get("name", ""), relative_to, written, "", tag.span
        )
        T_model_thing = self.frames.placed(written, relative_to, default=link, user=user)
        return self.frames.pose(link).inverse() @ T_model_thing

    def named(self, tag: Tag, kind: str) -> tuple[Tag, ...]:
        """Return the children of this kind that have a name of their own; report the others."""
        return named_children(tag, kind, self.context)


def read_pose(tag: Tag | None, context: ReadContext) -> Pose:
    """Return the pose in a ``<pose>`` element as written, identity when it is None or empty.

    Understands ``rotation_format`` (``euler_rpy``, ``quat_xyzw``) and ``degrees`` of SDF 1.9.
    The frame it is relative to is for the caller (`relative_to_of`).
    """
    if tag is None or not tag.text:
        return IDENTITY_POSE
    rotation_format = tag.attributes.get("rotation_format", "euler_rpy")
    if rotation_format not in _FORMATS:
        message = f"<pose rotation_format='{rotation_format}'> is not known; euler_rpy is used"
        context.diagnostics.report(
            "sdf.bad-value", message, tag.span, fix="write one of: " + ", ".join(_FORMATS)
        )
    if rotation_format == "quat_xyzw":
        return _quaternion_pose(tag, context)
    values = _numbers(tag, 6, context)
    roll, pitch, yaw = values[3:]
    if tag.attributes.get("degrees", "").strip().lower() in ("true", "1"):
        roll, pitch, yaw = (math.radians(value) for value in (roll, pitch, yaw))
    return Pose.from_xyz_rpy((values[0], values[1], values[2]), (roll, pitch, yaw))


def pose_of(tag: Tag, context: ReadContext) -> Pose:
    """Return the pose in the ``<pose>`` child (SDF 1.0's ``<origin pose>`` is reported)."""
    return read_pose(tag.find("pose"), context)


def relative_to_of(tag: Tag) -> str:
    """Return what the ``<pose>`` child is relative to, empty for the default.

    SDF 1.5 and 1.6 called the attribute ``frame``.
    """
    pose = tag.find("pose")
    if pose is None:
        return ""
    return pose.attributes.get("relative_to", pose.attributes.get("frame", "")).strip()


def named_children(tag: Tag, kind: str, context: ReadContext) -> tuple[Tag, ...]:
    """Return the children of a kind by unique name; nameless and repeated ones are reported.

    Nobody refers to shapes but sensors, so Gazebo loads both of one name; here the second one
    gets a name of its own. Of all else the first one counts.
    """
    found: dict[str, Tag] = {}
    for child in tag.find_all(kind):
        name = name_of(child, context)
        if not name:
            continue
        if name in found:
            other = _free_name(name, found) if kind in _SHAPES else ""
            effect = f"becomes '{other}'" if other else "is left out"
            owner = tag.attributes.get("name", "")
            message = (
                f"{kind} with name '{name}' stands twice in {tag.name} '{owner}' (first in line "
                f"{found[name].span.line}); the second one {effect}"
            )
            code = "sdf.duplicate-shape" if other else "sdf.duplicate-name"
            context.diagnostics.report(code, message, child.span)
            if other:
                found[other] = replace(child, attributes={**child.attributes, "name": other})
            continue
        found[name] = child
    return tuple(found.values())


def _quaternion_pose(tag: Tag, context: ReadContext) -> Pose:
    px, py, pz, x, y, z, w = _numbers(tag, 7, context)
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    if norm < 1e-9:
        message = "the quaternion of <pose> has length 0; no rotation is used"
        context.diagnostics.report("sdf.bad-value", message, tag.span, fix="write 0 0 0 1")
        return Pose((px, py, pz))
    return Pose((px, py, pz), cast(tuple[float, float, float, float], _scaled((x, y, z, w), norm)))


def _scaled(values: tuple[float, ...], norm: float) -> tuple[float, ...]:
    return tuple(value / norm for value in values)


def _numbers(tag: Tag, count: int, context: ReadContext) -> tuple[float, ...]:
    identity = (0.0,) * count if count == 6 else (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    return floats_from(
        tag.text,
        count,
        identity,
        what="<pose>",
        span=tag.span,
        diagnostics=context.diagnostics,
    )


def _free_name(name: str, taken: Collection[str]) -> str:
    return next(free for number in count(1) if (free := f"{name}_{number}") not in taken)
