"""SRDF: what MoveIt knows of a robot besides its URDF."""

from __future__ import annotations

from gazelle.description.srdf.model import (
    Chain,
    CollisionPair,
    EndEffector,
    Group,
    GroupState,
    LinkSpheres,
    Srdf,
    VirtualJoint,
)
from gazelle.description.srdf.reader import link_names, load_srdf, read_srdf

__all__ = [
    "Chain",
    "CollisionPair",
    "EndEffector",
    "Group",
    "GroupState",
    "LinkSpheres",
    "Srdf",
    "VirtualJoint",
    "link_names",
    "load_srdf",
    "read_srdf",
]
