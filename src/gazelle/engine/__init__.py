"""The physics engine: `World` values in, motion out; MuJoCo does the work."""

from __future__ import annotations

from gazelle.engine.contact_readings import Contact
from gazelle.engine.engine import Engine, EngineState
from gazelle.engine.joint_group import JointGroup
from gazelle.engine.joint_handles import JointHandle
from gazelle.engine.link_handles import LinkHandle
from gazelle.engine.state import Acceleration, Snapshot, Velocity, Wrench

__all__ = [
    "Acceleration",
    "Contact",
    "Engine",
    "EngineState",
    "JointGroup",
    "JointHandle",
    "LinkHandle",
    "Snapshot",
    "Velocity",
    "Wrench",
]
