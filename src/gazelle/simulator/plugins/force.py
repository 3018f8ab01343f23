"""``libgazebo_ros_force``: a wrench on a link from a topic, ROS 1 and 2."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.engine.link_handles import TimedWrench
from gazelle.geometry import Vector3
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

__all__ = ["TABLE", "load"]


_FRAMES = ("world", "link")
_ZERO = (0.0, 0.0, 0.0)

TABLE = PluginTable(
    ParameterTable(
        "force",
        "Applies the last wrench of a topic to a link, until the next one.",
        ("gazebo_ros_force",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic", ros_versions=(1,)),
            Parameter("bodyName", "text", "", "the link", "", aliases=("link_name",)),
            Parameter("topicName", "text", "gazebo_ros_force", "commands", ros_versions=(1,)),
            Parameter("force_frame", "text", "world", "world or link (ROS 2)", ros_versions=(2,)),
        ),
    ),
    topics=(
        Topic("{topicName}", "geometry_msgs/msg/Wrench", kind="listens", ros2="gazebo_ros_force"),
    ),
    behaviour=(
        "The force acts at the centre of mass, in the world's frame; ROS 2 knows"
        " `force_frame` link, which turns it with the link.",
    ),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start listening; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(TABLE)
    name = context.link_name(parameters.text("bodyName"))
    frame = parameters.text("force_frame")
    if frame not in _FRAMES:
        text = f"<force_frame> is '{frame}', not 'world' or 'link'; the plug-in is left out"
        context.report("parameter.bad-value", text, fix=did_you_mean(frame, _FRAMES))
    elif name is not None:
        _Force(context, parameters, name, turns=frame == "link")
    parameters.report_unread()


class _Force:
    """One running plug-in."""

    def __init__(
        self, context: PluginContext, parameters: PluginReader, link: str, *, turns: bool
    ) -> None:
        self._engine = context.host.engine
        self._link = self._engine.link(link)
        self._turns = turns
        self._command: tuple[Vector3, Vector3] = (_ZERO, _ZERO)
        self._acting: TimedWrench | None = None
        topic = context.topic(parameters, parameters.text("topicName"))
        resources = context.resources
        resources.subscription(topic, "geometry_msgs/Wrench", self._take)
        if turns:
            resources.task(f"{context.plugin.name} force", Fraction(1), self._turn)
        resources.on_reset(self._reset)
        resources.on_close(self._end)

    def _take(self, message: Any) -> None:
        force, torque = message.force, message.torque
        self._command = (
            (float(force.x), float(force.y), float(force.z)),
            (float(torque.x), float(torque.y), float(torque.z)),
        )
        self._apply()

    def _turn(self) -> None:
        if self._acting is not None:
            self._apply()

    def _apply(self) -> None:
        self._end()
        force, torque = self._command
        if any(force) or any(torque):
            if self._turns:
                pose = self._link.T_world_link()
                force, torque = pose.rotate(force), pose.rotate(torque)
            self._acting = self._link.apply_wrench(force, torque)

    def _end(self) -> None:
        if self._acting is not None:
            self._engine.end_wrench(self._acting)
            self._acting = None

    def _reset(self) -> None:
        self._command = (_ZERO, _ZERO)
        self._end()
