"""Laser scanners: ``libgazebo_ros_laser``, ``gpu_laser`` and the ROS 2 ``ray_sensor``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import LidarSpec
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, SensorPlace
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.plugins.sensor_publisher import prefixed_frame, sensor_place
from gazelle.simulator.scheduler import ORDER_SENSOR

if TYPE_CHECKING:
    from gazelle.sensors import LidarRecord

__all__ = [
    "ROS2_TABLE",
    "TABLE",
    "cloud_builder",
    "lidar_place",
    "load",
    "load_ray_sensor",
    "scan_builder",
    "start_scans",
]

TABLE = PluginTable(
    ParameterTable(
        "laser",
        "Publishes the scans of the ray sensor it stands in.",
        ("gazebo_ros_laser", "gazebo_ros_gpu_laser"),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("topicName", "text", "/world", "topic"),
            Parameter("frameName", "text", "/world", "frame of the scan"),
            Parameter("gaussianNoise", "refused", "", "the sensor's <noise> is used"),
            Parameter("alwaysOn", "refused", "", "scans are computed while somebody subscribes"),
            Parameter("updateRate", "refused", "", "the sensor's rate governs"),
            Parameter("hokuyoMinIntensity", "refused", "", "no release of the plug-in reads it"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "sensor_msgs/msg/LaserScan",
            rate="sensor's `update_rate`",
            frame="`frameName`",
        ),
    ),
    behaviour=(
        "The sensor's `update_rate` governs; 5.5 Hz on 1 ms steps is a period of 182 ms, as in"
        " Gazebo. Those of `gpu_ray` sensors, which Gazebo renders, are exact on average.",
        "Beyond the range is `inf`; `time_increment` and `scan_time` are 0, as in Gazebo.",
        "`ray` sensors see collisions, `gpu_ray` sensors visuals.",
    ),
)

ROS2_TABLE = PluginTable(
    ParameterTable(
        "ray_sensor",
        "The ROS 2 plug-in of ray sensors, with a choice of message.",
        ("gazebo_ros_ray_sensor",),
        (
            Parameter("output_type", "text", "sensor_msgs/PointCloud2", "message type"),
            Parameter("frame_name", "text", "", "frame; the link's name when empty"),
            Parameter("min_intensity", "number", 0.0, "points below are left out of clouds"),
            Parameter("radiation_type", "text", "infrared", "of Range: ultrasound or infrared"),
        ),
    ),
    topics=(Topic("~/out", "{output_type}", rate="sensor's `update_rate`", frame="`frame_name`"),),
    behaviour=("The topic is `~/out`, below the plug-in's name, unless it is remapped.",),
)
_OUTPUTS = ("LaserScan", "PointCloud", "PointCloud2", "Range")


def load(context: PluginContext) -> None:
    """Start publishing scans of the sensor the plug-in stands in."""
    parameters = context.reader(TABLE)
    place = lidar_place(context)
    if place is not None:
        topic = context.topic(parameters, parameters.text("topicName"))
        frame = prefixed_frame(context, parameters, "frameName")
        start_scans(context, place, topic, "sensor_msgs/LaserScan", scan_builder(place, frame))
    parameters.report_unread()


def load_ray_sensor(context: PluginContext) -> None:
    """Start the ROS 2 plug-in."""
    parameters = context.reader(ROS2_TABLE)
    place = lidar_place(context)
    if place is not None:
        kind = _output_kind(context, parameters)
        frame = parameters.text("frame_name") or place.link_name.split("::")[-1]
        topic = context.topic(parameters, "~/out")
        builders: dict[str, Callable[[int, LidarRecord], Any]] = {
            "LaserScan": scan_builder(place, frame),
            "PointCloud": _points_builder(frame, parameters.number("min_intensity")),
            "PointCloud2": cloud_builder(frame, parameters.number("min_intensity")),
            "Range": _range_builder(place, frame, parameters.text("radiation_type")),
        }
        start_scans(context, place, topic, f"sensor_msgs/{kind}", builders[kind])
    parameters.report_unread()


def lidar_place(context: PluginContext) -> SensorPlace | None:
    """Return the lidar the plug-in stands in; reports a wrong place and returns None."""
    return sensor_place(context, LidarSpec, "a ray sensor")


def start_scans(
    context: PluginContext,
    place: SensorPlace,
    topic: str,
    type_name: str,
    build: Callable[[int, LidarRecord], Any],
) -> None:
    """Publish a message made of each scan, at the sensor's rate, while somebody listens."""
    host = context.host
    publisher = context.resources.publisher(topic, type_name, reliable=False)

    def publish() -> None:
        publisher.publish(build(host.engine.time_ns, host.sensors.scan(place)))

    period = place.period_in_steps(host.engine.step_ns)
    context.resources.task(
        place.name, period, publish, order=ORDER_SENSOR, wanted=lambda: publisher.matched
    )


def _output_kind(context: PluginContext, parameters: PluginReader) -> str:
    word = parameters.text("output_type").rsplit("/", 1)[-1]
    if word in _OUTPUTS:
        return word
    text = f"<output_type> is '{word}'; PointCloud2 is used"
    context.report("parameter.bad-value", text, fix=did_you_mean(word, _OUTPUTS))
    return "PointCloud2"


def scan_builder(place: SensorPlace, frame: str) -> Callable[[int, LidarRecord], Any]:
    """Return what makes a ``sensor_msgs/LaserScan`` of a scan's middle row."""
    spec = place.sensor.spec
    assert isinstance(spec, LidarSpec)

    def build(time_ns: int, record: LidarRecord) -> Any:
        row = len(record.ranges_m) // 2
        return message_type("sensor_msgs/LaserScan")(
            header=header(time_ns, frame),
            angle_min=float(record.angles.horizontal[0]),
            angle_max=float(record.angles.horizontal[-1]),
            angle_increment=record.angles.increment,
            range_min=spec.range_min_m,
            range_max=spec.range_max_m,
            ranges=record.ranges_m[row],
            intensities=record.intensities[row],
        )

    return build


def _points(record: LidarRecord, least: float) -> tuple[Any, Any]:
    """Return (N, 3) finite points in the sensor's frame and their intensities."""
    yaw, pitch = np.meshgrid(record.angles.horizontal, record.angles.vertical)
    seen = np.isfinite(record.ranges_m) & (record.intensities >= least)
    ranges, yaw, pitch = record.ranges_m[seen], yaw[seen], pitch[seen]
    flat = ranges * np.cos(pitch)
    points = np.stack([flat * np.cos(yaw), flat * np.sin(yaw), ranges * np.sin(pitch)], axis=1)
    return points.astype(np.float32), record.intensities[seen]


def cloud_builder(frame: str, least: float) -> Callable[[int, LidarRecord], Any]:
    """Return what makes a ``sensor_msgs/PointCloud2`` of all points seen."""

    def build(time_ns: int, record: LidarRecord) -> Any:
        points, intensities = _points(record, least)
        data = np.column_stack([points, intensities]).astype(np.float32)
        field = message_type("sensor_msgs/PointField")
        names = ("x", "y", "z", "intensity")
        return message_type("sensor_msgs/PointCloud2")(
            header=header(time_ns, frame),
            height=1,
            width=len(data),
            fields=[
                field(name=name, offset=4 * place, datatype=7, count=1)
                for place, name in enumerate(names)
            ],
            point_step=16,
            row_step=16 * len(data),
            data=np.frombuffer(data.tobytes(), np.uint8),
            is_dense=True,
        )

    return build


def _points_builder(frame: str, least: float) -> Callable[[int, LidarRecord], Any]:
    def build(time_ns: int, record: LidarRecord) -> Any:
        points, intensities = _points(record, least)
        point = message_type("geometry_msgs/Point32")
        channel = message_type("sensor_msgs/ChannelFloat32")
        return message_type("sensor_msgs/PointCloud")(
            header=header(time_ns, frame),
            points=[point(x=float(x), y=float(y), z=float(z)) for x, y, z in points],
            channels=[channel(name="intensity", values=intensities)],
        )

    return build


def _range_builder(
    place: SensorPlace, frame: str, radiation: str
) -> Callable[[int, LidarRecord], Any]:
    spec = place.sensor.spec
    assert isinstance(spec, LidarSpec)

    def build(time_ns: int, record: LidarRecord) -> Any:
        angles = record.angles
        return message_type("sensor_msgs/Range")(
            header=header(time_ns, frame),
            radiation_type=0 if radiation == "ultrasound" else 1,
            field_of_view=max(float(np.ptp(angles.horizontal)), float(np.ptp(angles.vertical))),
            min_range=spec.range_min_m,
            max_range=spec.range_max_m,
            range=float(record.ranges_m.min()),
        )

    return build
