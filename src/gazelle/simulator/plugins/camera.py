"""``libgazebo_ros_camera`` of ROS 1 and ROS 2."""

from __future__ import annotations

from gazelle.description.model import CameraSpec
from gazelle.simulator.plugins.camera_info import read_calibration
from gazelle.simulator.plugins.camera_stream import CameraStream, camera_place, check_frame
from gazelle.simulator.plugins.camera_table import CAMERA_TABLE, TRIGGERED_TABLE
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.depth_camera import DepthLimits, add_colour, add_depth, cut_depth
from gazelle.simulator.plugins.image_transport import add_transports
from gazelle.simulator.plugins.multicamera import start_multicamera_ros2
from gazelle.simulator.plugins.plugin_parameters import PluginReader
from gazelle.simulator.sensor_set import camera_members

__all__ = ["load", "load_triggered"]


def load(context: PluginContext) -> None:
    """Start publishing the pictures of the camera the plug-in stands in."""
    parameters = context.reader(CAMERA_TABLE)
    place = camera_place(context)
    if place is not None:
        ros2 = parameters.is_ros2()
        if ros2 and len(camera_members(place)) > 1:
            start_multicamera_ros2(context, parameters, place)
        elif ros2:
            _start_ros2(context, parameters, place)
        else:
            _start_ros1(context, parameters, place)
    parameters.report_unread()


def load_triggered(context: PluginContext) -> None:
    """Start the camera of ROS 1 that takes pictures on a trigger."""
    parameters = context.reader(TRIGGERED_TABLE)
    place = camera_place(context)
    if place is not None:
        stream = _start_ros1(context, parameters, place)
        camera = join_names(context.namespace(parameters), parameters.text("cameraName"))
        stream.wait_for_triggers(join_names(camera, parameters.text("triggerTopicName")))
    parameters.report_unread()


def _start_ros1(
    context: PluginContext, parameters: PluginReader, place: SensorPlace
) -> CameraStream:
    spec = place.sensor.spec
    assert isinstance(spec, CameraSpec)
    frame = parameters.text("frameName")
    calibration = read_calibration(context, parameters, spec, frame)
    namespace = join_names(context.namespace(parameters), parameters.text("cameraName"))
    stream = CameraStream(
        context,
        place,
        calibration,
        namespace,
        largest_rate_hz=parameters.number("updateRate"),
    )
    image_topic = context.host.node.resolve_name(
        join_names(namespace, parameters.text("imageTopicName"))
    )
    add_colour(stream, image_topic, spec)
    stream.add_info(join_names(namespace, parameters.text("cameraInfoTopicName")))
    add_transports(context, stream, image_topic)
    return stream


def _start_ros2(context: PluginContext, parameters: PluginReader, place: SensorPlace) -> None:
    spec = place.sensor.spec
    assert isinstance(spec, CameraSpec)
    frame = parameters.text("frameName", place.link_name.split("::")[-1])
    calibration = read_calibration(context, parameters, spec, frame)
    camera = parameters.text("cameraName", place.sensor.name)
    namespace = join_names(context.namespace(parameters), camera)
    rate_hz = parameters.number("updateRate")
    stream = CameraStream(context, place, calibration, namespace, largest_rate_hz=rate_hz)

    def topic(name: str) -> str:
        named = context.topic(parameters, f"{camera}/{name}")
        return context.host.node.resolve_name(named)

    add_colour(stream, topic("image_raw"), spec)
    stream.add_info(topic("camera_info"))
    add_transports(context, stream, topic("image_raw"))
    if parameters.flag("triggered"):
        stream.wait_for_triggers(topic("image_trigger"))
    if spec.kind != "rgb":
        limits = DepthLimits(parameters.number("min_depth"), parameters.number("max_depth"))
        add_depth(stream, topic("depth/image_raw"), topic("points"), limits, place)
        stream.add_info(topic("depth/camera_info"))
        add_transports(
            context,
            stream,
            topic("depth/image_raw"),
            depth_of=lambda record: cut_depth(record, limits),
        )
        check_frame(context, place, frame)
