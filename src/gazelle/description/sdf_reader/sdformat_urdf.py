"""A model of SDF as ROS's nodes see it: a tree of links whose frames are their joints'."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics

__all__ = ["with_links_at_joints"]


def with_links_at_joints(model: Model, diagnostics: Diagnostics) -> Model | None:
    """Return a model whose links stand where the joints to their parents do.

    URDF has no pose of a link: its frame is its joint's. ``robot_state_publisher`` of ROS 2 reads
    SDF by ``sdformat_urdf``, which moves the frames so and the link's parts back.

    Args:
        model: as the SDF reader gives it.
        diagnostics: receives an error when the links are no tree under the canonical link.

    Returns:
        Links and joints under new frames, without visuals, collisions and sensors, whose poses
        would be the old frames'; None when there is no tree.
    """
    above = {}
    for joint in model.joints:
        if joint.child in above:
            message = f"Link [{joint.child}] must only be a child of one joint"
            diagnostics.report("urdf.two-parents", message, joint.span)
            return None
        above[joint.child] = joint
    roots = [link.name for link in model.links if link.name not in above]
    if len(roots) != 1:
        found = ", ".join(f"'{name}'" for name in roots) or "none"
        message = f"model '{model.name}' has {len(roots)} root links ({found}), and a robot has one"
        diagnostics.report("urdf.two-roots", message, model.span)
        return None
    links = tuple(
        replace(
            link,
            T_model_link=above[link.name].T_model_joint
            if link.name in above
            else link.T_model_link,
            visuals=(),
            collisions=(),
            sensors=(),
        )
        for link in model.links
    )
    return replace(model, links=links)
