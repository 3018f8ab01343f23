"""Qualities of service as rosbag2 keeps them: YAML with the numbers of rmw's enumerations."""

from __future__ import annotations

from gazelle.documents.yaml import YamlError, load_yaml
from gazelle.graph import Qos

__all__ = ["offered_qos", "read_qos"]

_ENDLESS = "  {}:\n    sec: 9223372036\n    nsec: 854775807\n"
_LATCHED_WORDS = (1, "transient_local")
_BEST_EFFORT_WORDS = (2, "best_effort")


def offered_qos(*, reliable: bool = True, latched: bool = False, depth: int = 10) -> str:
    """Return the profile of one publisher, as version 8 of the metadata writes it."""
    return (
        f"- history: 1\n  depth: {depth}\n"
        f"  reliability: {1 if reliable else 2}\n  durability: {1 if latched else 2}\n"
        + _ENDLESS.format("deadline")
        + _ENDLESS.format("lifespan")
        + "  liveliness: 1\n"
        + _ENDLESS.format("liveliness_lease_duration")
        + "  avoid_ros_namespace_conventions: false"
    )


def read_qos(text: str) -> Qos:
    """Return what the first profile asks for; the default where the text says nothing."""
    try:
        profiles = load_yaml(text) if text else None
    except YamlError:
        profiles = None
    if not isinstance(profiles, list) or not profiles or not isinstance(profiles[0], dict):
        return Qos()
    one = profiles[0]
    depth = one.get("depth")
    return Qos(
        one.get("reliability") not in _BEST_EFFORT_WORDS,
        one.get("durability") in _LATCHED_WORDS,
        depth if isinstance(depth, int) and depth > 0 else Qos().depth,
    )
