"""Elements as text, in the layout that sdformat prints (``ign sdf -p``).

Before that angles may become degrees and includes what they were written as. The specification is
printed, too, as ``-d`` does, without descriptions: those are at sdformat.org.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import NamedTuple

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf_command.console import Console
from gazelle.description.sdformat_emulation.gz_sdf_command.element_reader import Document
from gazelle.description.sdformat_emulation.gz_sdf_command.specification import (
    Definition,
    Parameter,
    specification,
)
from gazelle.description.sdformat_emulation.gz_sdf_command.values import (
    default_text,
    notation_of,
    pose_of,
    printed_pose,
)
from gazelle.description.sdformat_emulation.ignition_math import (
    euler_from_quat_wxyz,
    quat_wxyz_from_euler,
)
from gazelle.description.sdformat_emulation.release import Release
from gazelle.geometry import Pose

__all__ = ["Snap", "described_specification", "to_text", "with_angles_in_degrees", "with_includes"]

_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;"})
_QUOTED = str.maketrans({"&": "&amp;", "<": "&lt;", "'": "&apos;"})


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


def described_specification(release: Release) -> str:
    """Return elements, attributes, types, defaults and what is required, nested as in SDF."""
    lines = _described_lines(specification(release), "", Console(release))
    return "".join(f"{line}\n" for line in lines)


def to_text(element: SdfElement, release: Release = Release.V12, indent: str = "") -> str:
    """Return an element as sdformat's ``Element::ToString`` prints it.

    Characters that would break the text (``&``, ``<`` and, in attributes, ``'``) are escaped;
    sdformat prints them bare, and nothing can read such a file.

    Args:
        element: normalised, as `read_document` returns it.
        release: its specification tells empty values from elements without value.
        indent: spaces before every line.
    """
    root = specification(release)
    definition = root if element.name == root.name else _find(root, element.name)
    return "".join(f"{line}\n" for line in _lines(element, definition, indent))


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
    angles = [_snap(math.degrees(angle), snap) for angle in euler_from_quat_wxyz((w, x, y, z))]
    w, x, y, z = quat_wxyz_from_euler(*map(math.radians, angles))
    return Pose(pose.position_m, (x, y, z, w))


def _snap(angle_deg: float, snap: Snap) -> float:
    nearest = round(angle_deg / snap.interval_deg) * snap.interval_deg
    return float(nearest) if abs(angle_deg - nearest) < snap.tolerance_deg else angle_deg


def _described_lines(definition: Definition, indent: str, console: Console) -> Iterator[str]:
    head = f"{indent}<element name ='{definition.name}' required ='{definition.required}'"
    value = definition.value
    yield head + (_typed(value, console) + _limits(value, console) if value else "") + ">"
    inner = indent + "  "
    for item in definition.attributes:
        typed = _typed(item, console)
        yield f"{inner}<attribute name ='{item.key}'{typed} required ='{int(item.required)}'/>"
    if definition.takes_any:
        yield f"{inner}<element copy_data ='true' required ='*'/>"
    if definition.reference:
        yield f"{inner}<element ref ='{definition.reference}' required ='*'/>"
    for child in definition.children.values():
        yield from _described_lines(child, inner, console)
    yield f"{indent}</element>"


def _typed(value: Parameter, console: Console) -> str:
    default = default_text(value, console, as_typed=True)
    return f" type ='{value.kind}' default ='{default}'"


def _limits(value: Parameter, console: Console) -> str:
    if console.release is Release.V9:
        return ""
    pairs = (("min", value.least), ("max", value.most))
    return "".join(f" {word} ='{limit:.17g}'" for word, limit in pairs if limit is not None)


def _find(root: Definition, name: str) -> Definition | None:
    return root.book.get(name) or root.children.get(name)


def _lines(element: SdfElement, definition: Definition | None, indent: str) -> Iterator[str]:
    attributes = "".join(
        f" {name}='{value.translate(_QUOTED)}'" for name, value in element.attributes.items()
    )
    head = f"{indent}<{element.name}{attributes}"
    if element.children:
        yield f"{head}>"
        children = definition.resolved.children if definition else {}
        for child in element.children:
            yield from _lines(child, children.get(child.name), indent + "  ")
        yield f"{indent}</{element.name}>"
    elif element.text or (definition is not None and definition.resolved.value is not None):
        yield f"{head}>{element.text.translate(_ESCAPES)}</{element.name}>"
    else:
        yield f"{head}/>"
