"""Preserved fixed joints whose child has no mass: Gazebo drops the child all the same."""

from __future__ import annotations

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.urdf_reader.fixed_joint_lumping import lumped_links
from gazelle.diagnostics import Diagnostics

__all__ = ["check_preserved"]


def check_preserved(model: Model, diagnostics: Diagnostics) -> None:
    """Report links without mass that ``preserveFixedJoint`` keeps apart from those with mass."""
    if model.source_format != "urdf":
        return
    heads = lumped_links(model)
    has_mass = {
        heads.get(link.name, link.name)
        for link in model.links
        if link.inertial is not None and not link.inertial.estimated
    }
    for joint in model.joints:
        if joint.type is not JointType.FIXED or not joint.disable_fixed_joint_lumping:
            continue
        parent, child = (heads.get(name, name) for name in (joint.parent, joint.child))
        is_root = all(other.child != parent for other in model.joints) and parent != "world"
        if is_root and parent not in has_mass and child in has_mass:
            _report(joint, parent, ", and with it the whole robot: nothing appears", diagnostics)
        elif child not in has_mass:
            below = [other.child for other in model.joints if other.parent == child]
            lost = f" with all that hangs on it, such as '{below[0]}'" if below else ""
            _report(joint, child, lost, diagnostics)


def _report(joint: Joint, massless: str, lost: str, diagnostics: Diagnostics) -> None:
    text = (
        f"the fixed joint '{joint.name}' is preserved, but '{massless}' has no <inertial>: Gazebo "
        f"drops that link{lost}; here it is kept"
    )
    fix = (
        f"remove <preserveFixedJoint> (<disableFixedJointLumping>) from '{joint.name}', or give "
        f"'{massless}' an <inertial> with a small mass, such as 0.01 kg and 1e-6 kg·m²"
    )
    diagnostics.report("robot.preserved-massless", text, joint.span, fix=fix)
