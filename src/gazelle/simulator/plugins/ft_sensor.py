"""Forces: ``libgazebo_ros_ft_sensor`` (ROS 1 and ROS 2) and ``libgazebo_ros_f3d``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import ForceTorqueSpec
from gazelle.geometry import IDENTITY_POSE, cross, inertia_matrix
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.plugins.sensor_publisher import gaussian, publish_at
from gazelle.simulator.scheduler import measured_period_in_steps
from gazelle.simulator.sensor_readings import joint_load

if TYPE_CHECKING:
    from gazelle.engine import LinkHandle
    from gazelle.sensors import WrenchRecord

__all__ = ["F3D_TABLE", "TABLE", "load", "load_f3d", "wrench_message"]

Array = NDArray[np.float64]

TABLE = PluginTable(
    ParameterTable(
        "ft_sensor",
        "A model plug-in that measures what a joint carries, or (ROS 2) all force on a link.",
        ("gazebo_ros_ft_sensor",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic", ros_versions=(1,)),
            Parameter("jointName", "text", "", "the joint", "", aliases=("joint_name",)),
            Parameter("topicName", "text", "", "topic (ROS 1), must be given", ros_versions=(1,)),
            Parameter(
                "body_name", "text", "", "the link, instead of a joint (ROS 2)", ros_versions=(2,)
            ),
            Parameter("frame_name", "text", "world", "`header.frame_id` with `body_name`"),
            Parameter(
                "gaussianNoise",
                "number",
                0.0,
                "sigma of every component",
                "N, N·m",
                aliases=("gaussian_noise",),
            ),
            Parameter("updateRate", "number", 0.0, "publish rate", "Hz", aliases=("update_rate",)),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "geometry_msgs/msg/WrenchStamped",
            rate="`updateRate`",
            frame="child link",
            ros2="wrench",
        ),
    ),
    behaviour=(
        "The wrench is what the child exerts on the parent, in the child link's axes, the torque"
        " about the joint's origin: a hanging mass reads (0, 0, -m g).",
        "With `body_name` it is mass times acceleration of the link and the rate of change of its"
        " spin, world frame, as Gazebo's WorldForce and WorldTorque.",
        "Rates are measured from the last message, so the period is whole steps.",
    ),
    in_both_ros=True,
)

F3D_TABLE = PluginTable(
    ParameterTable(
        "f3d",
        "A model plug-in that publishes all force on a link.",
        ("gazebo_ros_f3d",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("bodyName", "text", "", "the link"),
            Parameter("topicName", "text", "", "topic, must be given"),
            Parameter(
                "frameName", "text", "world", "`header.frame_id` and nothing else, as in Gazebo"
            ),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
            Parameter("updateRate", "refused", "", "no release of this plug-in reads it"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}", "geometry_msgs/msg/WrenchStamped", rate="every step", frame="`frameName`"
        ),
    ),
    behaviour=(
        "Force is mass times acceleration of the centre of mass, torque the rate of change of the"
        " spin, world frame: zero at rest, the weight in free fall.",
    ),
)


def load(context: PluginContext) -> None:
    """Start publishing; one diagnostic and nothing else when joint or link is missing."""
    parameters = context.reader(TABLE)
    ros2 = parameters.is_ros2() or not (parameters.ros_version or parameters.has("topicName"))
    if ros2 and parameters.has("body_name"):
        link_name = context.link_name(parameters.text("body_name"))
        frame = parameters.text("frame_name")
        read = None if link_name is None else _link_reader(context, link_name)
    else:
        joint_name = context.joint_name(parameters.text("jointName"))
        frame = "" if joint_name is None else _child_frame(context, parameters, joint_name)
        read = None if joint_name is None else _joint_reader(context, joint_name)
    topic = "wrench" if ros2 else parameters.text("topicName")
    if not topic:
        _report_no_topic(context)
    elif read is not None:
        _start(context, parameters, context.topic(parameters, topic), frame, read)
    parameters.report_unread()


def load_f3d(context: PluginContext) -> None:
    """Start publishing; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(F3D_TABLE)
    link_name = context.link_name(parameters.text("bodyName"))
    topic, frame = parameters.text("topicName"), parameters.text("frameName")
    if link_name is not None and topic:
        read = _link_reader(context, link_name)
        step = measured_period_in_steps(0.0, context.host.engine.step_ns)
        publish_at(
            context,
            context.topic(parameters, topic),
            "geometry_msgs/WrenchStamped",
            step,
            lambda time_ns: wrench_message(time_ns, frame, *read()),
        )
    elif link_name is not None:
        _report_no_topic(context)
    parameters.report_unread()


def wrench_message(time_ns: int, frame: str, force: Array, torque: Array) -> Any:
    """Return a ``geometry_msgs/WrenchStamped``.

    Args:
        time_ns: of the header.
        frame: in whose axes both are.
        force: (3,), N.
        torque: (3,), N·m.
    """
    wrench = message_type("geometry_msgs/Wrench")(
        force=vector_message(force), torque=vector_message(torque)
    )
    return message_type("geometry_msgs/WrenchStamped")(header=header(time_ns, frame), wrench=wrench)


def _report_no_topic(context: PluginContext) -> None:
    text = f"plug-in '{context.plugin.name}' has no <topicName>; it is left out"
    context.report("parameter.bad-value", text)


def _start(
    context: PluginContext,
    parameters: PluginReader,
    topic: str,
    frame: str,
    read: Callable[[], WrenchRecord],
) -> None:
    noise = gaussian(context, parameters.number("gaussianNoise"))

    def build(time_ns: int) -> Any:
        force, torque = read()
        return wrench_message(time_ns, frame, force + noise(3), torque + noise(3))

    rate_hz = parameters.number("updateRate")
    period = measured_period_in_steps(rate_hz, context.host.engine.step_ns)
    publish_at(context, topic, "geometry_msgs/WrenchStamped", period, build)


def _child_frame(context: PluginContext, parameters: PluginReader, joint_name: str) -> str:
    joint = context.model.joint(joint_name.split("::", 1)[1])
    assert joint is not None
    prefix = context.tf_prefix(context.namespace(parameters)).strip("/")
    return f"{prefix}/{joint.child}" if prefix else joint.child


def _joint_reader(context: PluginContext, joint_name: str) -> Callable[[], WrenchRecord]:
    engine, spec = context.host.engine, ForceTorqueSpec()

    def read() -> WrenchRecord:
        from gazelle.sensors import force_torque_reading

        return force_torque_reading(joint_load(engine, joint_name), spec, IDENTITY_POSE)

    return read


def _link_reader(context: PluginContext, link_name: str) -> Callable[[], WrenchRecord]:
    link = context.host.engine.link(link_name)

    def read() -> WrenchRecord:
        from gazelle.sensors import WrenchRecord

        return WrenchRecord(*_net_wrench(link))

    return read


def _net_wrench(link: LinkHandle) -> tuple[Array, Array]:
    """Return Newton's and Euler's left sides: force on and torque about the centre of mass."""
    inertial = link.link.inertial
    if inertial is None or link.is_static:
        return np.zeros(3), np.zeros(3)
    linear, angular = link.acceleration_world()
    spin = link.velocity_world().angular_rad_s
    pose = link.T_world_link()
    arm = link.com_world() - np.array(pose.position_m)
    at_com = linear + cross(angular, arm) + cross(spin, cross(spin, arm))
    turn = (pose @ inertial.T_link_com).matrix()[:3, :3]
    inertia = turn @ inertia_matrix(inertial.inertia_kg_m2) @ turn.T
    return link.mass_kg * at_com, inertia @ angular + cross(spin, inertia @ spin)
