"""Several cameras in one sensor: ``libgazebo_ros_multicamera``, and ROS 2's camera plug-in."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import CameraSpec
from gazelle.parameters import ParameterTable, Topic
from gazelle.simulator.plugins.camera_info import Calibration, read_calibration
from gazelle.simulator.plugins.camera_stream import CameraStream, camera_place
from gazelle.simulator.plugins.camera_table import CAMERA_TABLE
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.depth_camera import add_colour
from gazelle.simulator.plugins.image_transport import add_transports
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.sensor_set import camera_members

__all__ = ["TABLE", "load", "start_multicamera_ros2"]

_SIDES = ("left", "right")

TABLE = PluginTable(
    ParameterTable(
        "multicamera",
        "A stereo pair: the cameras of the multicamera sensor around it.",
        ("gazebo_ros_multicamera",),
        CAMERA_TABLE.parameters.rows,
    ),
    topics=(
        Topic(
            "{cameraName}/left/{imageTopicName}, {cameraName}/right/{imageTopicName}",
            "sensor_msgs/msg/Image",
            rate="sensor's `update_rate`",
            frame="`frameName`",
        ),
        Topic(
            "{cameraName}/left/{cameraInfoTopicName}, {cameraName}/right/{cameraInfoTopicName}",
            "sensor_msgs/msg/CameraInfo",
            rate="sensor's `update_rate`",
            frame="`frameName`",
        ),
        Topic(
            "{camera_name}/{name}/image_raw, {camera_name}/{name}/camera_info",
            "the same (ROS 2)",
            rate="sensor's `update_rate`",
            frame="`frame_name`",
        ),
    ),
    behaviour=(
        "Cameras whose names hold `left` or `right` are published, as in Gazebo; the right one's"
        " P[3] has the baseline: -fx `hackBaseline`.",
        "In ROS 2 the camera plug-in takes a multicamera sensor; there every camera is published"
        " below its own name.",
    ),
)


def load(context: PluginContext) -> None:
    """Start publishing the pictures of a stereo pair."""
    parameters = context.reader(TABLE)
    place = camera_place(context)
    if place is not None:
        for member in camera_members(place):
            _start_ros1(context, parameters, member)
    parameters.report_unread()


def _start_ros1(context: PluginContext, parameters: PluginReader, place: SensorPlace) -> None:
    spec = place.sensor.spec
    assert isinstance(spec, CameraSpec)
    side = next((word for word in _SIDES if word in spec.name), None)
    if side is None:
        text = f"camera '{spec.name}' of sensor '{place.name}' is neither left nor right by its "
        context.report("parameter.bad-value", text + "name; it is not published")
        return
    calibration = read_calibration(context, parameters, spec, parameters.text("frameName"))
    baseline_m = calibration.baseline_m if side == "right" else 0.0
    camera = join_names(context.namespace(parameters), parameters.text("cameraName"), side)
    image = join_names(camera, parameters.text("imageTopicName"))
    info = join_names(camera, parameters.text("cameraInfoTopicName"))
    stream = CameraStream(
        context,
        place,
        replace(calibration, baseline_m=baseline_m),
        camera,
        largest_rate_hz=parameters.number("updateRate"),
    )
    _publish(context, stream, spec, image, info)


def start_multicamera_ros2(
    context: PluginContext, parameters: PluginReader, place: SensorPlace
) -> None:
    """Publish every camera of a multicamera below its own name."""
    frame = parameters.text("frameName", place.link_name.split("::")[-1])
    camera = parameters.text("cameraName", place.sensor.name)
    namespace = join_names(context.namespace(parameters), camera)
    for member in camera_members(place):
        spec = member.sensor.spec
        assert isinstance(spec, CameraSpec)
        calibration: Calibration = read_calibration(context, parameters, spec, frame)
        image, info = (
            context.host.node.resolve_name(
                context.topic(parameters, f"{camera}/{spec.name}/{name}")
            )
            for name in ("image_raw", "camera_info")
        )
        stream = CameraStream(
            context,
            member,
            calibration,
            join_names(namespace, spec.name),
            largest_rate_hz=parameters.number("updateRate"),
        )
        _publish(context, stream, spec, image, info)


def _publish(
    context: PluginContext, stream: CameraStream, spec: CameraSpec, image: str, info: str
) -> None:
    topic = context.host.node.resolve_name(image)
    add_colour(stream, topic, spec)
    stream.add_info(info)
    add_transports(context, stream, topic)
