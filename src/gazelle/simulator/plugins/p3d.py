"""``libgazebo_ros_p3d``: the true pose of a link."""

from __future__ import annotations

import numpy as np

from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_message, twist_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.plugins.sensor_publisher import gaussian
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["TABLE", "load"]

TABLE = PluginTable(
    ParameterTable(
        "p3d",
        "Publishes the true pose and velocity of a link as odometry.",
        ("gazebo_ros_p3d",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic", ros_versions=(1,)),
            Parameter("bodyName", "text", "", "the link", "", aliases=("body_name",)),
            Parameter(
                "topicName", "text", "odom", "topic", "", aliases=("topic_name",), ros_versions=(1,)
            ),
            Parameter(
                "frameName",
                "text",
                "world",
                "link that poses are relative to",
                "",
                aliases=("frame_name",),
            ),
            Parameter(
                "xyzOffset",
                "vector",
                (0.0, 0.0, 0.0),
                "added to the position",
                "m",
                aliases=("xyz_offset", "xyzOffsets", "xyz_offsets"),
            ),
            Parameter(
                "rpyOffset",
                "vector",
                (0.0, 0.0, 0.0),
                "added to the orientation",
                "rad",
                aliases=("rpy_offset", "rpyOffsets", "rpy_offsets"),
            ),
            Parameter(
                "gaussianNoise",
                "number",
                0.0,
                "sigma of the velocities' noise",
                "m/s, rad/s",
                aliases=("gaussian_noise",),
            ),
            Parameter("updateRate", "number", 0.0, "publish rate", "Hz", aliases=("update_rate",)),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "nav_msgs/msg/Odometry",
            rate="`updateRate`, 0 is every step",
            frame="`frameName`",
            ros2="odom",
        ),
    ),
    in_both_ros=True,
)
_WORLD = frozenset({"world", "/world", "map", "/map", ""})


def load(context: PluginContext) -> None:
    """Start publishing; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(TABLE)
    link_name = context.link_name(parameters.text("bodyName"))
    if link_name is not None:
        _start(context, parameters, link_name)
    parameters.report_unread()


def _start(context: PluginContext, parameters: PluginReader, link_name: str) -> None:
    engine = context.host.engine
    link = engine.link(link_name)
    frame = parameters.text("frameName")
    reference_name = None if frame in _WORLD else context.link_name(frame)
    reference = engine.link(reference_name) if reference_name else None
    offset = Pose.from_xyz_rpy(parameters.vector("xyzOffset"), parameters.vector("rpyOffset"))
    sigma = parameters.number("gaussianNoise")
    noise = gaussian(context, sigma)
    publisher = context.resources.publisher(
        context.topic(parameters, parameters.text("topicName")), "nav_msgs/Odometry"
    )
    covariance = np.diag([sigma**2] * 6).reshape(36)
    child = link_name.split("::", 1)[1]

    def publish() -> None:
        T_world_frame = reference.T_world_link() if reference else IDENTITY_POSE
        back = T_world_frame.inverse()
        relative = back @ link.T_world_link()
        x, y, z = np.add(relative.position_m, offset.position_m).tolist()
        pose = Pose((x, y, z), (relative @ Pose(quat_xyzw=offset.quat_xyzw)).quat_xyzw)
        linear, angular = link.velocity_world()
        if reference is not None:
            base_linear, base_angular = reference.velocity_world()
            linear, angular = linear - base_linear, angular - base_angular
        message = message_type("nav_msgs/Odometry")(
            header=header(engine.time_ns, frame), child_frame_id=child
        )
        message.pose.pose = pose_message(pose)
        message.pose.covariance = covariance
        message.twist.twist = twist_message(
            np.add(back.rotate(_triple(linear)), noise(3)),
            np.add(back.rotate(_triple(angular)), noise(3)),
        )
        message.twist.covariance = covariance
        publisher.publish(message)

    period = period_in_steps(parameters.number("updateRate"), engine.step_ns)
    name = f"{context.plugin.name} pose"
    context.resources.task(name, period, publish, wanted=lambda: publisher.matched)


def _triple(
    vector: np.ndarray[tuple[int, ...], np.dtype[np.float64]],
) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return (x, y, z)
