"""Plug-ins and other elements that higher layers interpret; reading ``<plugin>``."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan

__all__ = [
    "ActuatorTag",
    "PluginTag",
    "Ros2ControlTag",
    "TransmissionJoint",
    "TransmissionTag",
    "read_plugin",
    "read_plugins",
]


@dataclass(frozen=True, slots=True)
class PluginTag:
    """A ``<plugin>``: its parameters stay XML, the plug-in itself interprets them.

    Attributes:
        name: ``name`` attribute.
        filename: library as written, such as ``libgazebo_ros_diff_drive.so``.
        parameters: the ``<plugin>`` element.
        reference: link or joint of an enclosing ``<gazebo reference>``, may be empty.
    """

    name: str
    filename: str
    parameters: Tag
    reference: str = ""

    @property
    def span(self) -> SourceSpan:
        """Place of the ``<plugin>`` tag."""
        return self.parameters.span


@dataclass(frozen=True, slots=True)
class TransmissionJoint:
    """A joint of a transmission with its hardware interfaces and role."""

    name: str
    hardware_interfaces: tuple[str, ...] = ()
    role: str = ""
    mechanical_reduction: float = 1.0
    offset: float = 0.0
    span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class ActuatorTag:
    """An actuator of a transmission."""

    name: str
    mechanical_reduction: float = 1.0
    hardware_interfaces: tuple[str, ...] = ()
    role: str = ""


@dataclass(frozen=True, slots=True)
class TransmissionTag:
    """A URDF ``<transmission>`` in either syntax (PR2's ``type`` attribute or ROS Indigo's)."""

    name: str
    type: str
    joints: tuple[TransmissionJoint, ...] = ()
    actuators: tuple[ActuatorTag, ...] = ()
    span: SourceSpan | None = None
    type_span: SourceSpan | None = None


@dataclass(frozen=True, slots=True)
class Ros2ControlTag:
    """A URDF ``<ros2_control>`` block, left as XML for the control layer."""

    name: str
    type: str
    element: Tag = field(repr=False)

    @property
    def span(self) -> SourceSpan:
        """Place of the ``<ros2_control>`` tag."""
        return self.element.span


def read_plugin(tag: Tag, *, reference: str = "") -> PluginTag:
    """Return a plug-in's tag; what its parameters mean is for the plug-in.

    Args:
        tag: the ``<plugin>`` element.
        reference: link or joint of an enclosing ``<gazebo reference>``, or the scope of a
            nested model such as ``arm`` or ``arm::gripper``.
    """
    return PluginTag(
        name=tag.attributes.get("name", ""),
        filename=tag.attributes.get("filename", ""),
        parameters=tag,
        reference=reference,
    )


def read_plugins(tag: Tag, *, reference: str = "") -> tuple[PluginTag, ...]:
    """Return the plug-ins among a tag's children, in document order."""
    return tuple(read_plugin(child, reference=reference) for child in tag.find_all("plugin"))
