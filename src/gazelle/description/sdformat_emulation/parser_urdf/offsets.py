"""Plug-ins that name a lumped link: they get its parent's name and an offset."""

from __future__ import annotations

import math

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import chained, composed_by_inverse
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import (
    NumberCrashError,
    brief_text,
    leading_number,
)
from gazelle.description.sdformat_emulation.parser_urdf.elements import remove, value_of
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.urdfdom_emulation.poses import Origin
from gazelle.description.urdfdom_emulation.values import quaternion_from_rpy, rpy_from_quaternion

__all__ = ["replace_body", "vector_from"]

Vector3 = tuple[float, float, float]

_ZERO: Vector3 = (0.0, 0.0, 0.0)
_CORRECTED = "ignition::corrected_offsets"


def replace_body(
    plugin: SdfElement,
    word: str,
    links: tuple[str, str],
    poses: tuple[Origin, Origin],
    console: Console,
) -> None:
    """Replace a link's name in a plug-in's ``bodyName`` or ``frameName``, and shift its offsets.

    Args:
        plugin: an element; anything but a ``<plugin>`` stays as it is.
        word: name of the child.
        links: the lumped link and its parent.
        poses: where the block's own link went by lumping, and the lumped link in its parent.
        console: receives complaints about the offsets.

    Raises:
        NumberCrashError: an offset is beyond any double.
    """
    child = plugin.find(word) if plugin.name == "plugin" else None
    if child is None or value_of(child, console) != links[0]:
        return
    is_v9 = console.release is Release.V9
    remove(plugin, child)
    plugin.add(word, links[1])
    offset = _offset(plugin, poses[0], console)
    moved = (composed_by_inverse if is_v9 else chained)(poses[1], offset)
    plugin.add("xyzOffset", brief_text(moved.xyz_m))
    plugin.add("rpyOffset", brief_text(rpy_from_quaternion(moved.quat_xyzw)))
    if not is_v9:
        plugin.add(_CORRECTED, "1")


def _offset(plugin: SdfElement, offset: Origin, console: Console) -> Origin:
    """Take the written offsets out of a plug-in; what is not written stays as given."""
    is_v9 = console.release is Release.V9
    xyz = plugin.find("xyzOffset")
    if xyz is not None:
        offset = offset._replace(xyz_m=vector_from(value_of(xyz, console), 1.0, console))
        remove(plugin, xyz)
    rpy = plugin.find("rpyOffset")
    if rpy is not None:
        # Degrees in sdformat 9, though every plug-in's documentation says radians.
        scale = math.pi / 180.0 if is_v9 else 1.0
        angles = vector_from(value_of(rpy, console), scale, console)
        offset = offset._replace(quat_xyzw=quaternion_from_rpy(angles))
        remove(plugin, rpy)
    corrected = plugin.find(_CORRECTED)
    if corrected is not None and not is_v9:
        remove(plugin, corrected)
    return offset


def vector_from(text: str, scale: float, console: Console) -> Vector3:
    """Return three numbers with spaces between them, zeros when they are none or not three.

    Raises:
        NumberCrashError: one of them is beyond any double.
    """
    values: list[float] = []
    for index, piece in enumerate(text.split(" ")):
        if not piece:
            continue
        try:
            values.append(scale * leading_number(piece))
        except NumberCrashError as crash:
            if crash.kind != "invalid_argument":
                raise
            message = f"xml key [{text}][{index}] value [{piece}]"
            console.error("no vector", f"{message} is not a valid double from a 3-tuple")
            return _ZERO
    return (values[0], values[1], values[2]) if len(values) == 3 else _ZERO
