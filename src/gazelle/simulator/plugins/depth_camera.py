"""Depth cameras: ``libgazebo_ros_openni_kinect`` and ``libgazebo_ros_depth_camera``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import CameraSpec
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.simulator.plugins.camera_info import image_message, read_calibration
from gazelle.simulator.plugins.camera_stream import CameraStream, camera_place, check_frame
from gazelle.simulator.plugins.camera_table import DEPTH_TABLE, OPENNI_TABLE
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.image_encoding import (
    depth_millimetres,
    encode_pixels,
    encoding_name,
)
from gazelle.simulator.plugins.plugin_parameters import PluginReader

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from gazelle.sensors import CameraRecord

__all__ = ["DepthLimits", "add_colour", "add_depth", "cut_depth", "load", "load_openni"]


@dataclass(frozen=True, slots=True)
class DepthLimits:
    """Depths that are kept, metres; everything else is NaN."""

    near_m: float
    far_m: float


def load(context: PluginContext) -> None:
    """Start ``libgazebo_ros_depth_camera``."""
    parameters = context.reader(DEPTH_TABLE)
    place = camera_place(context)
    if place is not None:
        _start(context, parameters, place, DepthLimits(_near(parameters), math.inf))
    parameters.report_unread()


def load_openni(context: PluginContext) -> None:
    """Start ``libgazebo_ros_openni_kinect``."""
    parameters = context.reader(OPENNI_TABLE)
    place = camera_place(context)
    if place is not None:
        far = parameters.number("pointCloudCutoffMax")
        _start(context, parameters, place, DepthLimits(_near(parameters), far))
    parameters.report_unread()


def cut_depth(record: CameraRecord, limits: DepthLimits) -> NDArray[np.float32]:
    """Return (H, W) planar depth in metres, NaN outside the limits."""
    from gazelle.sensors import depth_image

    assert record.depth_m is not None
    return depth_image(record.depth_m, near_m=limits.near_m, far_m=limits.far_m)


def add_colour(stream: CameraStream, topic: str, spec: CameraSpec) -> None:
    """Publish the colour picture in the sensor's own format."""
    encoding, frame = encoding_name(spec.pixel_format), stream.calibration.frame

    def build(time_ns: int, record: CameraRecord) -> Any:
        assert record.rgb is not None
        return image_message(time_ns, frame, encode_pixels(record.rgb, encoding), encoding)

    stream.add(topic, "sensor_msgs/Image", build, rgb=True)


def add_depth(
    stream: CameraStream,
    depth_topic: str,
    cloud_topic: str,
    limits: DepthLimits,
    place: SensorPlace,
    *,
    millimetres: bool = False,
) -> None:
    """Publish depth picture and cloud."""
    from gazelle.sensors import camera_intrinsics, point_cloud

    spec = place.sensor.spec
    assert isinstance(spec, CameraSpec)
    intrinsics, frame = camera_intrinsics(spec), stream.calibration.frame

    def picture(time_ns: int, record: CameraRecord) -> Any:
        depth = cut_depth(record, limits)
        if millimetres:
            return image_message(time_ns, frame, depth_millimetres(depth), "16UC1")
        return image_message(time_ns, frame, depth, "32FC1")

    def cloud(time_ns: int, record: CameraRecord) -> Any:
        assert record.depth_m is not None
        near_m, far_m = limits.near_m, limits.far_m
        made = point_cloud(record.depth_m, record.rgb, intrinsics, near_m=near_m, far_m=far_m)
        return _cloud_message(time_ns, frame, made)

    stream.add(depth_topic, "sensor_msgs/Image", picture, depth=True)
    stream.add(cloud_topic, "sensor_msgs/PointCloud2", cloud, rgb=True, depth=True)


def _near(parameters: PluginReader) -> float:
    return parameters.number("pointCloudCutoff")


def _start(
    context: PluginContext, parameters: PluginReader, place: SensorPlace, limits: DepthLimits
) -> None:
    spec = place.sensor.spec
    assert isinstance(spec, CameraSpec)
    frame = parameters.text("frameName")
    calibration = read_calibration(context, parameters, spec, frame)
    namespace = join_names(context.namespace(parameters), parameters.text("cameraName"))
    stream = CameraStream(context, place, calibration, namespace)
    # Read so that it counts as known; the sensor's rate governs, as in Gazebo.
    parameters.number("updateRate")

    def topic(key: str) -> str:
        return join_names(namespace, parameters.text(key))

    add_colour(stream, topic("imageTopicName"), spec)
    stream.add_info(topic("cameraInfoTopicName"))
    add_depth(
        stream,
        topic("depthImageTopicName"),
        topic("pointCloudTopicName"),
        limits,
        place,
        millimetres=parameters.flag("useDepth16UC1Format"),
    )
    stream.add_info(topic("depthImageCameraInfoTopicName"))
    check_frame(context, place, frame)


def _cloud_message(time_ns: int, frame: str, points: NDArray[np.void]) -> Any:
    """Return a ``sensor_msgs/PointCloud2`` that shares the cloud's memory."""
    height, width = points.shape
    step = points.dtype.itemsize
    field = message_type("sensor_msgs/PointField")
    fields: Mapping[str, Any] = points.dtype.fields or {}
    return message_type("sensor_msgs/PointCloud2")(
        header=header(time_ns, frame),
        height=height,
        width=width,
        fields=[
            field(name=name, offset=fields[name][1], datatype=7, count=1)
            for name in ("x", "y", "z", "rgb")
        ],
        is_bigendian=False,
        point_step=step,
        row_step=step * width,
        data=points.reshape(-1).view(np.uint8),
        is_dense=not bool(np.isnan(points["z"]).any()),
    )
