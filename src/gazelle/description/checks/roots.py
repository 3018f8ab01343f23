"""The root of a URDF's tree: what KDL and Gazebo make of it."""

from __future__ import annotations

from gazelle.description.model import Link, Model
from gazelle.diagnostics import Diagnostics

__all__ = ["check_root"]


def check_root(model: Model, diagnostics: Diagnostics) -> None:
    """Report a root link with mass, which KDL leaves out."""
    root = _root(model)
    if model.source_format != "urdf" or root is None or root.name == "world":
        return
    if root.inertial is None or root.inertial.estimated or len(model.links) == 1:
        return
    text = (
        f"the root link '{root.name}' has an inertia. KDL keeps none for a root: "
        "robot_state_publisher warns, and dynamics computed with KDL lack its mass"
    )
    fix = (
        '<link name="base_footprint"/>\n'
        '<joint name="base_footprint_joint" type="fixed">\n'
        f'  <parent link="base_footprint"/>\n  <child link="{root.name}"/>\n</joint>'
    )
    place = root.inertial.span or root.span
    diagnostics.report("robot.root-inertia", text, place, fix=f"add an empty root:\n{fix}")


def _root(model: Model) -> Link | None:
    children = {joint.child for joint in model.joints}
    return next((link for link in model.links if link.name not in children), None)
