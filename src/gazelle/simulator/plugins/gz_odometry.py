"""The gz-sim systems ``OdometryPublisher`` and ``PosePublisher``: true poses as topics."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from gazelle.description.model import JointType, Model
from gazelle.geometry import Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_message, transform_stamped, twist_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.drive import gz_text, gz_topic
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.plugins.sensor_publisher import gaussian, once_per_step, publish_at
from gazelle.simulator.scheduler import ORDER_STATE, period_in_steps

__all__ = ["POSE_TABLE", "TABLE", "load", "load_poses"]

TABLE = PluginTable(
    ParameterTable(
        "gz-sim odometry_publisher",
        "The true pose and velocity of a model, as odometry and tf.",
        (
            "gz-sim-odometry-publisher-system",
            "ignition-gazebo-odometry-publisher-system",
            "gz::sim::systems::OdometryPublisher",
            "ignition::gazebo::systems::OdometryPublisher",
        ),
        (
            Parameter("odom_topic", "text", "/model/{model}/odometry", "topic"),
            Parameter(
                "odom_covariance_topic",
                "text",
                "/model/{model}/odometry_with_covariance",
                "topic with the noise's variance",
            ),
            Parameter("tf_topic", "text", "/model/{model}/pose", "topic of the transform"),
            Parameter("odom_frame", "text", "{model}/odom", "frame"),
            Parameter("robot_base_frame", "text", "{model}/base_footprint", "child frame"),
            Parameter("odom_publish_frequency", "number", 50.0, "publish rate", "Hz"),
            Parameter("dimensions", "number", 2.0, "2 or 3"),
            Parameter("xyz_offset", "vector", (0.0, 0.0, 0.0), "of the frame on the model", "m"),
            Parameter("rpy_offset", "vector", (0.0, 0.0, 0.0), "of the frame on the model", "rad"),
            Parameter("gaussian_noise", "number", 0.0, "sigma of the velocities", "m/s, rad/s"),
        ),
    ),
    topics=(
        Topic(
            "{odom_topic}",
            "nav_msgs/msg/Odometry",
            rate="`odom_publish_frequency`",
            frame="`odom_frame`",
        ),
        Topic(
            "{odom_covariance_topic}",
            "nav_msgs/msg/Odometry",
            rate="`odom_publish_frequency`",
            frame="`odom_frame`",
        ),
        Topic(
            "{tf_topic}",
            "tf2_msgs/msg/TFMessage",
            rate="`odom_publish_frequency`",
            frame="`odom_frame`",
        ),
    ),
    behaviour=(
        "The pose is the model's in the world, not from where it started, as in gz-sim.",
        "Velocities are those of the moment in the body's axes; gz-sim averages ten steps. With"
        " two dimensions height, roll and pitch rates and climbing are left out.",
    ),
)

POSE_TABLE = PluginTable(
    ParameterTable(
        "gz-sim pose_publisher",
        "Poses of a model's links, as transforms.",
        (
            "gz-sim-pose-publisher-system",
            "ignition-gazebo-pose-publisher-system",
            "gz::sim::systems::PosePublisher",
            "ignition::gazebo::systems::PosePublisher",
        ),
        (
            Parameter("topic", "text", "/model/{model}/pose", "topic"),
            Parameter("publish_link_pose", "flag", True, "poses of links"),
            Parameter("publish_model_pose", "flag", False, "pose of the model"),
            Parameter("publish_nested_model_pose", "flag", False, "means the model's pose, too"),
            Parameter("publish_sensor_pose", "flag", False, "poses of sensors"),
            Parameter("use_pose_vector_msg", "flag", False, "all in one message"),
            Parameter(
                "update_frequency", "number", -1.0, "publish rate, each step if not > 0", "Hz"
            ),
            Parameter("static_publisher", "flag", False, "fixed poses on a topic of their own"),
            Parameter(
                "static_update_frequency",
                "number",
                -1.0,
                "its rate; as the other when absent",
                "Hz",
            ),
            Parameter("publish_visual_pose", "refused", "", "poses of visuals are not published"),
            Parameter(
                "publish_collision_pose", "refused", "", "poses of collisions are not published"
            ),
        ),
    ),
    topics=(
        Topic(
            "{topic}, {topic}_static",
            "tf2_msgs/msg/TFMessage with `use_pose_vector_msg`, else"
            " geometry_msgs/msg/TransformStamped one by one",
            rate="`update_frequency`",
            frame="parent",
        ),
    ),
    behaviour=(
        "Every pose is relative to its parent: links to the model, the model to the world, sensors"
        " to their link. Frames are `model/link`, as ros_gz_bridge writes them.",
        "With `static_publisher`, links that no joint moves are published on `…/pose_static`.",
    ),
)
_Row = tuple[str, str, Callable[[], Pose]]


def load(context: PluginContext) -> None:
    """Start the odometry of a model."""
    parameters = context.reader(TABLE)
    dimensions = int(parameters.number("dimensions"))
    if dimensions in {2, 3}:
        _start(context, parameters, is_flat=dimensions == 2)
    else:
        text = f"<dimensions> is {dimensions}, not 2 or 3; plug-in '{context.plugin.name}' is "
        context.report("parameter.bad-value", text + "left out")
    parameters.report_unread()


def _start(context: PluginContext, parameters: PluginReader, *, is_flat: bool) -> None:
    frame, child = (gz_text(context, parameters, key) for key in ("odom_frame", "robot_base_frame"))
    noise = gaussian(context, parameters.number("gaussian_noise"))
    variance = parameters.number("gaussian_noise") ** 2
    offset = Pose.from_xyz_rpy(parameters.vector("xyz_offset"), parameters.vector("rpy_offset"))

    def measure() -> tuple[Pose, Any]:
        pose, linear, angular = _motion(context, offset, is_flat=is_flat)
        return pose, twist_message(linear + noise(3), angular + noise(3))

    read = once_per_step(context, measure)

    def odometry(covariance: float) -> Callable[[int], Any]:
        diagonal = (covariance * np.eye(6)).reshape(36)

        def build(time_ns: int) -> Any:
            message = message_type("nav_msgs/Odometry")(
                header=header(time_ns, frame), child_frame_id=child
            )
            pose, message.twist.twist = read()
            message.pose.pose = pose_message(pose)
            message.pose.covariance = message.twist.covariance = diagonal
            return message

        return build

    def transform(time_ns: int) -> Any:
        moved = transform_stamped(time_ns, frame, child, read()[0])
        return message_type("tf2_msgs/TFMessage")(transforms=[moved])

    step_ns = context.host.engine.step_ns
    period = period_in_steps(parameters.number("odom_publish_frequency"), step_ns)
    for key, type_name, build in (
        ("odom_topic", "nav_msgs/Odometry", odometry(0.0)),
        ("odom_covariance_topic", "nav_msgs/Odometry", odometry(variance)),
        ("tf_topic", "tf2_msgs/TFMessage", transform),
    ):
        topic = gz_topic(context, parameters, key)
        publish_at(context, topic, type_name, period, build, order=ORDER_STATE)


def _motion(context: PluginContext, offset: Pose, *, is_flat: bool) -> tuple[Pose, Any, Any]:
    """Return pose in the world, linear and angular velocity in the body's axes."""
    engine, model = context.host.engine, context.model
    link = engine.link(f"{model.name}::{model.canonical_link}")
    pose = engine.model_pose(model.name) @ offset
    linear, angular = link.velocity_world()
    linear = linear + np.cross(
        angular, np.subtract(pose.position_m, link.T_world_link().position_m)
    )
    if not is_flat:
        axes = pose.matrix()[:3, :3]
        return pose, linear @ axes, angular @ axes
    x, y, _ = pose.position_m
    heading = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, pose.rpy_rad[2])).matrix()[:3, :3]
    spin = (angular @ pose.matrix()[:3, :3])[2]
    along = linear * np.array([1.0, 1.0, 0.0]) @ heading
    return Pose((x, y, 0.0), pose.quat_xyzw), along, np.array([0.0, 0.0, spin])


def load_poses(context: PluginContext) -> None:
    """Start publishing the poses inside a model."""
    parameters = context.reader(POSE_TABLE)
    rows, moving = _rows(context, parameters), _moving_links(context.model)
    topic = gz_topic(context, parameters, "topic")
    rate_hz, is_vector = (
        parameters.number("update_frequency"),
        parameters.flag("use_pose_vector_msg"),
    )
    static_hz = parameters.number("static_update_frequency", rate_hz)
    if parameters.flag("static_publisher"):
        fixed = [row for row in rows if row[1] not in moving]
        rows = [row for row in rows if row[1] in moving]
        _publish(context, f"{topic}_static", static_hz, fixed, is_vector=is_vector)
    _publish(context, topic, rate_hz, rows, is_vector=is_vector)
    parameters.report_unread()


def _publish(
    context: PluginContext, topic: str, rate_hz: float, rows: list[_Row], *, is_vector: bool
) -> None:
    engine = context.host.engine
    type_name = "tf2_msgs/TFMessage" if is_vector else "geometry_msgs/TransformStamped"
    publisher = context.resources.publisher(topic, type_name)

    def publish() -> None:
        moved = [
            transform_stamped(engine.time_ns, parent, child, read()) for parent, child, read in rows
        ]
        for message in [message_type(type_name)(transforms=moved)] if is_vector else moved:
            publisher.publish(message)

    name = f"{context.plugin.name} {topic}"
    period = period_in_steps(rate_hz, engine.step_ns)
    if rows:
        context.resources.task(
            name, period, publish, order=ORDER_STATE, wanted=lambda: publisher.matched
        )


def _rows(context: PluginContext, parameters: PluginReader) -> list[_Row]:
    """Return parent frame, child frame and what reads the pose, as the keys ask for."""
    engine, model = context.host.engine, context.model
    rows: list[_Row] = []
    has_model = parameters.flag("publish_nested_model_pose")
    if parameters.has("publish_model_pose"):
        has_model = parameters.flag("publish_model_pose")
    if has_model:
        rows.append((engine.world.name, model.name, lambda: engine.model_pose(model.name)))

    def of_link(name: str) -> Callable[[], Pose]:
        link = engine.link(f"{model.name}::{name}")
        return lambda: engine.model_pose(model.name).inverse() @ link.T_world_link()

    has_links, has_sensors = (
        parameters.flag(key) for key in ("publish_link_pose", "publish_sensor_pose")
    )
    for link in model.links:
        frame = f"{model.name}/{link.name}".replace("::", "/")
        if has_links:
            rows.append((model.name, frame, of_link(link.name)))
        for sensor in link.sensors if has_sensors else ():
            rows.append((frame, f"{frame}/{sensor.name}", partial(_given, sensor.T_link_sensor)))
    return rows


def _given(pose: Pose) -> Pose:
    return pose


def _moving_links(model: Model) -> set[str]:
    """Return the frames of links that joints move; the canonical link never counts (gz-sim)."""
    ends = {
        end
        for joint in model.joints
        if joint.type is not JointType.FIXED
        for end in (joint.parent, joint.child)
    }
    return {f"{model.name}/{end}".replace("::", "/") for end in ends - {model.canonical_link}}
