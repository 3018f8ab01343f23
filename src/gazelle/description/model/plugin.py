"""Plug-ins and other pass-through elements that higher layers interpret."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.xml import Tag
from gazelle.diagnostics import SourceSpan

__all__ = ["ActuatorTag", "PluginTag", "Ros2ControlTag", "TransmissionJoint", "TransmissionTag"]


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
