"""``<origin>`` as urdfdom reads it."""

from __future__ import annotations

from typing import NamedTuple

from gazelle.description.urdfdom_emulation.console import Console
from gazelle.description.urdfdom_emulation.tinyxml import Element
from gazelle.description.urdfdom_emulation.values import (
    BadValueError,
    quaternion_from_rpy,
    vector_of,
)

__all__ = ["Origin", "origin_of"]


class Origin(NamedTuple):
    """A place in metres and a turn."""

    xyz_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    quat_xyzw: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


def origin_of(owner: Element, console: Console) -> Origin:
    """Return the pose in an element's first ``<origin>``.

    Raises:
        Rejected: a vector in it is broken.
    """
    tag = owner.first("origin")
    if tag is None:
        return Origin()
    origin = Origin()
    if (xyz := tag.attributes.get("xyz")) is not None:
        origin = origin._replace(xyz_m=_vector(xyz, 102, console))
    if (rpy := tag.attributes.get("rpy")) is not None:
        turn = quaternion_from_rpy(_vector(rpy, 114, console))
        origin = origin._replace(quat_xyzw=turn)
    return origin


def _vector(text: str, line: int, console: Console) -> tuple[float, float, float]:
    try:
        return vector_of(text)
    except BadValueError as mistake:
        raise console.reject(("pose", line), str(mistake)) from None
