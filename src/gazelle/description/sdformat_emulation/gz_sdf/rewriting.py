"""Documents changed for printing: angles in degrees, includes left as they were written."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.records import Document
from gazelle.description.sdformat_emulation.gz_sdf.rotations import euler_of, quaternion_of
from gazelle.description.sdformat_emulation.gz_sdf.specification import Definition, specification
from gazelle.description.sdformat_emulation.gz_sdf.values import notation_of, pose_of, printed_pose
from gazelle.geometry import Pose

__all__ = ["Snap", "with_angles_in_degrees", "with_includes"]


class Snap(NamedTuple):
    """Angles within `tolerance_deg` of a multiple of `interval_deg` become that multiple."""

    interval_deg: int
    tolerance_deg: float = 0.01


def with_angles_in_degrees(
    element: SdfElement, definition: Definition, snap: Snap | None = None
) -> SdfElement:
    """Return a copy in which every pose has its angles in degrees and says so."""
    definition = definition.resolved
    known = definition.children
    children = [
        with_angles_in_degrees(child, known[child.name], snap) if child.name in known else child
        for child in element.children
    ]
    changed = replace(element, children=children, attributes=dict(element.attributes))
    if definition.value is None or definition.value.kind != "pose":
        return changed
    pose = pose_of(element.text, notation_of(element.attributes))
    changed.text = printed_pose(_snapped(pose, snap), degrees=True)
    if element.name == "pose":
        own = {"degrees": "true", "rotation_format": "euler_rpy"}
        changed.attributes = own | {k: v for k, v in element.attributes.items() if k not in own}
    return changed


def with_includes(document: Document) -> SdfElement:
    """Return the document with ``<include>`` where an element of another file stands.

    Merged includes stay merged.
    """
    assert document.root is not None
    root = specification(document.console.release)
    return _with_includes(document.root, root, document)


def _with_includes(
    element: SdfElement, definition: Definition | None, document: Document
) -> SdfElement:
    include = document.included_from.get(id(element))
    if include is not None:
        return replace(include, attributes={})
    known = definition.resolved.children if definition is not None else {}
    children = [_with_includes(one, known.get(one.name), document) for one in element.children]
    return replace(element, children=children)


def _snapped(pose: Pose, snap: Snap | None) -> Pose:
    if snap is None:
        return pose
    x, y, z, w = pose.quat_xyzw
    angles = [_snap(math.degrees(angle), snap) for angle in euler_of((w, x, y, z))]
    w, x, y, z = quaternion_of(*map(math.radians, angles))
    return Pose(pose.position_m, (x, y, z, w))


def _snap(angle_deg: float, snap: Snap) -> float:
    nearest = round(angle_deg / snap.interval_deg) * snap.interval_deg
    return float(nearest) if abs(angle_deg - nearest) < snap.tolerance_deg else angle_deg
