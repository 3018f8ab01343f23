"""The part of a robot description that ros_control reads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from gazelle.description.model import Joint, Model, Ros2ControlTag, TransmissionTag
from gazelle.description.read_context import ReadContext
from gazelle.description.robot_description import read_text
from gazelle.description.urdf_reader.joints import read_joint
from gazelle.description.urdf_reader.transmissions import read_transmission
from gazelle.diagnostics import Diagnostics

__all__ = ["ControlDescription", "description_of", "read_description", "read_ros2_controls"]


@dataclass(frozen=True, slots=True)
class ControlDescription:
    """Joints with their limits, and transmissions.

    Attributes:
        joints: by name.
        transmissions: in the order of the file.
    """

    joints: Mapping[str, Joint]
    transmissions: tuple[TransmissionTag, ...]


def description_of(model: Model) -> ControlDescription:
    """Return what a model in the world says itself."""
    return ControlDescription({joint.name: joint for joint in model.joints}, model.transmissions)


def read_description(text: str) -> ControlDescription | None:
    """Read the text of a ``robot_description``; None when it is not a URDF.

    What is wrong in it was said when the robot was spawned.
    """
    diagnostics = Diagnostics()
    robot = read_text(text, diagnostics)
    if robot is None or robot.name != "robot":
        return None
    context = ReadContext(None, diagnostics, "<robot_description>")
    joints: dict[str, Joint] = {}
    for tag in robot.find_all("joint"):
        name = tag.attributes.get("name", "").strip()
        found = read_joint(tag, name, context)
        if found is not None:
            joints.setdefault(name, found.joint)
    tags = (read_transmission(tag, joints, context) for tag in robot.find_all("transmission"))
    return ControlDescription(joints, tuple(tag for tag in tags if tag is not None))


def read_ros2_controls(text: str) -> tuple[Ros2ControlTag, ...]:
    """Read the ``<ros2_control>`` blocks of a ``robot_description``; none when it is not a URDF."""
    robot = read_text(text, Diagnostics())
    if robot is None or robot.name != "robot":
        return ()
    return tuple(
        Ros2ControlTag(tag.attributes.get("name", ""), tag.attributes.get("type", ""), tag)
        for tag in robot.find_all("ros2_control")
    )
