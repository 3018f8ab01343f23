"""The link tree of a robot description, as the state publishers need it."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.read_context import ReadContext
from gazelle.description.robot_description import file_of_text, read_text
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.sdf_reader.sdformat_urdf import with_links_at_joints
from gazelle.description.urdf_reader import read_urdf
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GraphError, LaunchError
from gazelle.geometry import IDENTITY_POSE, Pose, quat_xyzw_about_axis
from gazelle.graph import Node
from gazelle.interfaces import message_type

__all__ = [
    "DESCRIPTION",
    "TreeJoint",
    "description_of",
    "joint_tree",
    "published_robot_of",
    "read_description",
    "robot_in",
    "robot_of",
    "segment_names",
    "take_description_file",
]

DESCRIPTION = "robot_description"
_LOOK_S = 0.1
_WORLD = "world"


@dataclass(frozen=True, slots=True)
class TreeJoint:
    """A joint with its pose from parent to child link at zero.

    Attributes:
        T_parent_joint: pose of the joint's frame, which is the child link's in URDF.
    """

    joint: Joint
    T_parent_joint: Pose

    @property
    def is_fixed(self) -> bool:
        """Whether nothing moves it."""
        return self.joint.type is JointType.FIXED

    def T_parent_child(self, position: float) -> Pose:
        """Return the child link's pose in the parent link at a joint position (rad or m)."""
        axis = self.joint.axis.xyz if self.joint.axis is not None else (1.0, 0.0, 0.0)
        if self.joint.type.is_hinge:
            return self.T_parent_joint @ Pose(quat_xyzw=quat_xyzw_about_axis(axis, position))
        if self.joint.type is JointType.PRISMATIC:
            x, y, z = (part * position for part in axis)
            return self.T_parent_joint @ Pose((x, y, z))
        return self.T_parent_joint


def read_description(text: str) -> Model:
    """Read a ``robot_description`` for its links and joints only; meshes are not looked for.

    It may be SDF, as ROS 2's nodes take it by ``sdformat_urdf``.

    Raises:
        LaunchError: the text is no usable robot; the first error in one line, since whoever
            loads the robot into a world reports all of them with their places.
    """
    diagnostics = Diagnostics()
    context = ReadContext(None, diagnostics, file_of_text(text), None, inserts=False)
    root = read_text(text, diagnostics)
    if root is not None and root.name == "sdf":
        model = _sdf_robot(root, context)
    else:
        model = None if root is None else read_urdf(root, context=context)
    if model is None:
        first = diagnostics.errors[0] if diagnostics.errors else None
        where = f" at {first.span}" if first is not None and first.span is not None else ""
        what = f"{first.message}{where} [{first.code}]" if first is not None else "it is empty"
        raise LaunchError(f"robot_description is no robot: {what}")
    return model


def _sdf_robot(root: Tag, context: ReadContext) -> Model | None:
    models = read_sdf(root, context=context).models
    if len(models) == 1:
        return with_links_at_joints(models[0], context.diagnostics)
    if not context.diagnostics.errors:
        message = f"SDFormat xml has {len(models)} models, and a robot is one"
        context.diagnostics.report("urdf.no-robot", message, root.span)
    return None


def robot_of(node: Node) -> Model | None:
    """Return the robot of `description_of`; None when the node has said why not."""
    text = description_of(node)
    return None if text is None else robot_in(node, text)


def description_of(node: Node) -> str | None:
    """Return the nearest ``robot_description``; None when the node has said that there is none.

    The node's own ``robot_description`` remap applies, and the search goes up its namespaces.
    """
    name = node.parameters.search(DESCRIPTION) or node.resolve_name(DESCRIPTION)
    try:
        return str(node.parameters.get(name))
    except (GraphError, KeyError):
        node.log("error", f"Could not find parameter {name} on parameter server")
        return None


def published_robot_of(node: Node, argv: Sequence[str], stop: threading.Event) -> Model | None:
    """Return the robot as ROS 2's nodes find it: a file, a parameter, else the topic.

    Args:
        node: whose parameter and topic ``robot_description`` count.
        argv: the node's own arguments; the first one names a file.
        stop: ends waiting for the topic.

    Raises:
        LaunchError: the file cannot be read.
    """
    if argv:
        return robot_in(node, take_description_file(node, argv[0]))
    if node.parameters.search(DESCRIPTION):
        return robot_of(node)
    topic = node.resolve_name(DESCRIPTION)
    node.log("info", f"Waiting for robot_description to be published on the {topic} topic...")
    found: list[str] = []
    came = threading.Event()

    def take(message: Any) -> None:
        found.append(str(message.data))
        came.set()

    subscription = node.create_subscription(DESCRIPTION, message_type("std_msgs/msg/String"), take)
    while not stop.is_set() and not came.wait(_LOOK_S):
        continue
    subscription.unregister()
    return robot_in(node, found[0]) if found else None


def take_description_file(node: Node, name: str) -> str:
    """Let a file be the node's ``robot_description``, as ROS 2's nodes do with an argument.

    Returns:
        The file's text: another node of this name may take the parameter away.

    Raises:
        LaunchError: it cannot be read, or is no robot.
    """
    try:
        text = Path(name).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise LaunchError(f"Unable to open urdf file: {name}: {error}") from error
    read_description(text)
    node.parameters.set(node.resolve_name(f"~{DESCRIPTION}"), text)
    return text


def robot_in(node: Node, text: str) -> Model | None:
    """Return the robot of a description; None when the node has said what is wrong with it."""
    try:
        return read_description(text)
    except LaunchError as error:
        node.log("fatal", str(error))
        return None


def segment_names(model: Model) -> tuple[str, ...]:
    """Return the frames of a robot by name, a root link ``world`` among them."""
    ends = (joint.parent for joint in model.joints)
    return tuple(sorted({*ends, *(link.name for link in model.links)}))


def joint_tree(model: Model) -> tuple[TreeJoint, ...]:
    """Return all joints with their poses relative to the parent link.

    A root link ``world`` is no link of the model; to the publishers it is a frame like any other.
    """
    poses = {_WORLD: IDENTITY_POSE, **{link.name: link.T_model_link for link in model.links}}
    return tuple(
        TreeJoint(joint, poses[joint.parent].inverse() @ joint.T_model_joint)
        for joint in model.joints
        if joint.parent in poses
    )
