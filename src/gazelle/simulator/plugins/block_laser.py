"""``libgazebo_ros_block_laser``: a scan as ``sensor_msgs/PointCloud``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.laser import lidar_place, start_scans
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.plugins.sensor_publisher import gaussian, prefixed_frame

if TYPE_CHECKING:
    from gazelle.sensors import LidarRecord

__all__ = ["TABLE", "load"]

TABLE = PluginTable(
    ParameterTable(
        "block_laser",
        "Publishes the scans of the ray sensor around it as a cloud of points.",
        ("gazebo_ros_block_laser",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("topicName", "text", "/world", "topic"),
            Parameter("frameName", "text", "/world", "frame of the points"),
            Parameter("gaussianNoise", "number", 0.0, "sigma of coordinates and intensities", "m"),
            Parameter("updateRate", "refused", "", "the sensor's rate governs"),
            Parameter("hokuyoMinIntensity", "refused", "", "no release of the plug-in uses it"),
            Parameter("alwaysOn", "refused", "", "scans are computed while somebody subscribes"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "sensor_msgs/msg/PointCloud",
            rate="sensor's `update_rate`",
            frame="`frameName`",
        ),
    ),
    behaviour=(
        "Every ray gives a point; those that meet nothing lie at infinity, as in Gazebo.",
        "The one channel has the intensities.",
    ),
)


def load(context: PluginContext) -> None:
    """Start publishing clouds of the sensor the plug-in stands in."""
    parameters = context.reader(TABLE)
    place = lidar_place(context)
    if place is not None:
        noise = gaussian(context, parameters.number("gaussianNoise"))
        frame = prefixed_frame(context, parameters, "frameName")

        def build(time_ns: int, record: LidarRecord) -> Any:
            points = _points(record)
            points += noise(points.size).reshape(points.shape)
            intensities = record.intensities.reshape(-1) + noise(len(points))
            point = message_type("geometry_msgs/Point32")
            channel = message_type("sensor_msgs/ChannelFloat32")
            return message_type("sensor_msgs/PointCloud")(
                header=header(time_ns, frame),
                points=[point(x=x, y=y, z=z) for x, y, z in points.tolist()],
                channels=[channel(name="", values=intensities.astype(np.float32))],
            )

        topic = context.topic(parameters, parameters.text("topicName"))
        start_scans(context, place, topic, "sensor_msgs/PointCloud", build)
    parameters.report_unread()


def _points(record: LidarRecord) -> Any:
    """Return (N, 3) points of all rays, row by row; infinite where nothing is met."""
    yaw, pitch = np.meshgrid(record.angles.horizontal, record.angles.vertical)
    directions = np.stack(
        [np.cos(pitch) * np.cos(yaw), np.cos(pitch) * np.sin(yaw), np.sin(pitch)], axis=-1
    )
    # 0 · inf would be NaN.
    directions[directions == 0.0] = np.finfo(np.float64).tiny
    return (record.ranges_m[..., None].astype(np.float64) * directions).reshape(-1, 3)
