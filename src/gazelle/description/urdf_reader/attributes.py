"""Attributes of URDF elements: numbers, words and files, with every mistake reported."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import cast

from gazelle.description.read_context import ReadContext
from gazelle.description.xml import Tag, floats_from
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3
from gazelle.workspace import Resolved

__all__ = ["check_vocabulary", "find_file", "number_attribute", "origin_of", "vector_attribute"]


# A little more, for those who write 6.2832.
_FULL_TURN = 2 * math.pi + 0.01
_DEGREES = 15


def find_file(uri: str, span: SourceSpan, context: ReadContext) -> Resolved:
    """Resolve ``package://``, ``model://``, ``file://`` and plain paths.

    A note of the workspace about a file that was found, such as that only upper and lower case
    differ, is reported.
    """
    found = context.resolve(uri)
    if found.path is not None and found.is_off_path:
        context.report_note(uri, found, span, "urdf.file-note")
    elif found.path is not None and found.note:
        message = f"'{uri}' was found as '{found.path}': {found.note}"
        context.diagnostics.report("urdf.file-note", message, span)
    return found


def number_attribute(tag: Tag, name: str, diagnostics: Diagnostics) -> float | None:
    """Return a finite number; None when the attribute is absent or (reported) unusable."""
    text = tag.attributes.get(name)
    if text is None:
        return None
    what = f"<{tag.name} {name}>"
    nothing = (float("nan"),)
    found = floats_from(
        text, 1, nothing, what=what, span=tag.span, diagnostics=diagnostics, attribute=name
    )
    return None if found is nothing else found[0]


def vector_attribute(tag: Tag, name: str, diagnostics: Diagnostics) -> Vector3 | None:
    """Return three finite numbers; None when the attribute is absent or (reported) unusable."""
    text = tag.attributes.get(name)
    if text is None:
        return None
    what = f"<{tag.name} {name}>"
    found = floats_from(
        text, 3, (), what=what, span=tag.span, diagnostics=diagnostics, attribute=name
    )
    return cast(Vector3, found) if found else None


def origin_of(tag: Tag, diagnostics: Diagnostics) -> Pose:
    """Return the pose in the child ``<origin xyz rpy>``, metres and radians; identity without."""
    origin = tag.find("origin")
    if origin is None:
        return IDENTITY_POSE
    check_vocabulary(origin, diagnostics, attributes=("xyz", "rpy", "quat_xyzw"))
    xyz = vector_attribute(origin, "xyz", diagnostics) or (0.0, 0.0, 0.0)
    turn = _quaternion(origin, diagnostics)
    if turn is not None:
        return Pose(xyz, turn)
    rpy = vector_attribute(origin, "rpy", diagnostics) or (0.0, 0.0, 0.0)
    _check_angles(rpy, origin, diagnostics)
    return Pose.from_xyz_rpy(xyz, rpy)


def _check_angles(rpy: Vector3, origin: Tag, diagnostics: Diagnostics) -> None:
    """Report angles beyond a full turn that are whole degrees, and look like right ones."""
    wrong = [angle for angle in rpy if abs(angle) > _FULL_TURN and angle % _DEGREES == 0]
    if wrong:
        written = " ".join(f"{math.radians(angle) if angle in wrong else angle:g}" for angle in rpy)
        message = f"rpy is {' '.join(f'{angle:g}' for angle in rpy)}: angles are radians here, and "
        message += f"{wrong[0]:g} looks like degrees"
        diagnostics.report("urdf.degrees", message, origin.span, fix=f'write rpy="{written}"')


def check_vocabulary(
    tag: Tag,
    diagnostics: Diagnostics,
    *,
    attributes: Collection[str] = (),
    children: Collection[str] | None = (),
    once: Collection[str] = (),
) -> None:
    """Report unknown attributes and children, and children that may stand only once.

    Args:
        tag: the element.
        diagnostics: receives ``xml.unknown-attribute``, ``xml.unknown-tag``, ``xml.repeated-tag``.
        attributes: the names known here.
        children: the child elements known here; None accepts all.
        once: child elements of which only the first counts.
    """
    for name in tag.attributes:
        if name not in attributes and not name.startswith("xmlns"):
            hint = did_you_mean(name, attributes)
            message = f"<{tag.name}> has no attribute '{name}'; it has no effect"
            diagnostics.report("xml.unknown-attribute", message, tag.span, fix=hint)
    for child in tag.children if children is not None else ():
        if child.name not in (children or ()):
            hint = did_you_mean(child.name, children or ())
            message = f"<{child.name}> is not known inside <{tag.name}>; it has no effect"
            diagnostics.report("xml.unknown-tag", message, child.span, fix=hint)
    for name in once:
        for extra in tag.find_all(name)[1:]:
            message = f"<{name}> stands more than once in <{tag.name}>; the first one counts"
            diagnostics.report("xml.repeated-tag", message, extra.span)


def _quaternion(origin: Tag, diagnostics: Diagnostics) -> tuple[float, float, float, float] | None:
    """``quat_xyzw`` of URDF 1.1 (urdfdom 4); it may not stand beside ``rpy``."""
    text = origin.attributes.get("quat_xyzw")
    if text is None:
        return None
    if "rpy" in origin.attributes:
        message = "<origin> has both rpy and quat_xyzw; quat_xyzw is used"
        diagnostics.report("urdf.origin-twice", message, origin.span)
    what = "<origin quat_xyzw>"
    found = floats_from(
        text, 4, (), what=what, span=origin.span, diagnostics=diagnostics, attribute="quat_xyzw"
    )
    norm = sum(value * value for value in found) ** 0.5
    if not found or norm == 0.0:
        return None
    x, y, z, w = (value / norm for value in found)
    return (x, y, z, w)
