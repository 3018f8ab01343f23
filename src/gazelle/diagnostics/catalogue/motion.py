"""Codes of robots whose motion is planned."""

from __future__ import annotations

from gazelle.diagnostics.catalogue.entry import Entry

__all__ = ["ENTRIES"]

ENTRIES = (
    Entry(
        "motion.continuous-limit",
        "warning",
        "A joint without end has position limits in joint_limits.yaml",
        "MoveIt ignores them; only the URDF's type decides whether a joint has an end.",
        'write type="revolute" with limits in the URDF',
    ),
    Entry(
        "motion.joint-type",
        "warning",
        "A joint is of a type that MoveIt does not know",
        "MoveIt plans for revolute, continuous, prismatic, planar and floating joints.",
        "describe it with joints of these types",
        "Unknown joint type",
    ),
    Entry(
        "motion.loop",
        "warning",
        "A joint closes a loop",
        "Motion is planned for trees; the joint is not looked at.",
        "leave the loop to the simulation",
    ),
    Entry(
        "motion.no-room",
        "warning",
        "Limits leave a joint no room",
        "The lower one is above the upper one, or both are equal, once all files are read.",
        "correct the limits in URDF, safety_controller or joint_limits.yaml",
    ),
)
