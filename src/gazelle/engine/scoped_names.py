"""Names inside the compiled model: everything is ``model::name``, extras end in ``//what``."""

from __future__ import annotations

__all__ = [
    "bridge",
    "joint_part",
    "lock",
    "part_of",
    "root_joint",
    "rotor_body",
    "rotor_joint",
    "scoped",
    "slip_body",
    "tendon",
    "weld",
]

_MARK = "//"


def scoped(model: str, name: str) -> str:
    """Return ``model::name``."""
    return f"{model}::{name}"


def joint_part(joint: str, part: str) -> str:
    """Return the name of a further degree of freedom of a joint, such as a screw's slide."""
    return f"{joint}{_MARK}{part}"


def root_joint(link: str) -> str:
    """Return the name of the free joint that carries a root link."""
    return f"{link}{_MARK}root"


def rotor_body(joint: str) -> str:
    """Return the name of the flywheel body of a motor."""
    return f"{joint}{_MARK}rotor"


def rotor_joint(joint: str) -> str:
    """Return the name of the flywheel's degree of freedom."""
    return f"{joint}{_MARK}rotor-angle"


def tendon(joint: str) -> str:
    """Return the name of the clutch between a motor's flywheel and its joint."""
    return f"{joint}{_MARK}clutch"


def lock(joint: str) -> str:
    """Return the name of the constraint that holds a joint at a position."""
    return f"{joint}{_MARK}lock"


def weld(first: str, second: str) -> str:
    """Return the name of the constraint that holds two links together."""
    return f"{first}{_MARK}weld{_MARK}{second}"


def bridge(joint: str) -> str:
    """Return the name of the body between a joint that closes a loop and its child."""
    return f"{joint}{_MARK}bridge"


def slip_body(link: str) -> str:
    """Return the name of the body that carries the collisions of a wheel that slips."""
    return f"{link}{_MARK}slip-body"


def part_of(name: str, index: int) -> str:
    """Return the name of one convex part of a collision."""
    return name if index == 0 else f"{name}{_MARK}part-{index}"
