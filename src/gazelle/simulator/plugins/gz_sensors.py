"""Sensors of gz-sim worlds, which publish by themselves: no plug-in stands in them."""

from __future__ import annotations

import math
from dataclasses import replace

from gazelle.description.model import CameraSpec, ImuSpec, LidarSpec
from gazelle.simulator.plugins.camera_info import Calibration
from gazelle.simulator.plugins.camera_stream import CameraStream
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.depth_camera import DepthLimits, add_colour, add_depth
from gazelle.simulator.plugins.gz_measurements import publish_measurement
from gazelle.simulator.plugins.imu import publish_readings
from gazelle.simulator.plugins.laser import cloud_builder, scan_builder, start_scans

__all__ = ["publish_sensor"]


def publish_sensor(context: PluginContext) -> None:
    """Publish a sensor on its ``<topic>``, as ROS types under gz names.

    The types are those that ros_gz_bridge maps to, the names gz-sensors': scans at the topic and
    ``…/points``, pictures at the topic with ``camera_info`` beside it, RGB-D at ``…/image``,
    ``…/depth_image`` and ``…/points``.
    """
    assert context.place is not None
    place = replace(context.place, is_gz=True)
    spec = place.sensor.spec
    if isinstance(spec, LidarSpec):
        topic, frame = _topic(context, place, "scan"), _frame(place)
        start_scans(context, place, topic, "sensor_msgs/LaserScan", scan_builder(place, frame))
        points = join_names(topic, "points")
        build = cloud_builder(frame, -math.inf)
        start_scans(context, place, points, "sensor_msgs/PointCloud2", build)
    elif isinstance(spec, ImuSpec):
        period = place.period_in_steps(context.host.engine.step_ns)
        sensors, topic = context.host.sensors, _topic(context, place, "imu")
        publish_readings(context, topic, _frame(place), period, lambda: sensors.imu(place))
    elif isinstance(spec, CameraSpec):
        _publish_camera(context, place, spec)
    else:
        publish_measurement(context, place, lambda ending: _topic(context, place, ending))


def _publish_camera(context: PluginContext, place: SensorPlace, spec: CameraSpec) -> None:
    from gazelle.sensors import camera_intrinsics

    lens = camera_intrinsics(spec, convention="camera_info")
    calibration = Calibration(
        spec.optical_frame_id or _frame(place),
        spec.width_px,
        spec.height_px,
        lens.fx,
        lens.cx,
        lens.cy,
        0.0,
        (0.0, 0.0, 0.0, 0.0, 0.0),
    )
    topic = _topic(context, place, "image" if spec.kind == "rgb" else "camera")
    stream = CameraStream(context, place, calibration, topic)
    near = spec.near_m if spec.depth_near_m is None else spec.depth_near_m
    far = spec.far_m if spec.depth_far_m is None else spec.depth_far_m
    limits, points = DepthLimits(near, far), join_names(topic, "points")
    beside = join_names(topic.rsplit("/", 1)[0] or "/", "camera_info")
    if spec.kind == "rgbd":
        add_colour(stream, join_names(topic, "image"), spec)
        add_depth(stream, join_names(topic, "depth_image"), points, limits, place)
        beside = join_names(topic, "camera_info")
    elif spec.kind == "depth":
        add_depth(stream, topic, points, limits, place)
    else:
        add_colour(stream, topic, spec)
    stream.add_info(spec.camera_info_topic or beside)


def _topic(context: PluginContext, place: SensorPlace, ending: str) -> str:
    if place.sensor.topic:
        return join_names("/", place.sensor.topic)
    holder = place.joint_name or place.link_name
    kind, (model, name) = "joint" if place.joint_name else "link", holder.split("::", 1)
    world = context.host.engine.world.name
    path = f"/world/{world}/model/{model}/{kind}/{name}/sensor/{place.sensor.name}/{ending}"
    return join_names(path)


def _frame(place: SensorPlace) -> str:
    return place.sensor.frame_id or place.name.replace("::", "/")
