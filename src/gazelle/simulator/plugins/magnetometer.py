"""``libhector_gazebo_ros_magnetic`` and ``libhector_gazebo_ros_baro``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.hector_noise import ErrorSource, error_parameters, read_model
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.plugins.sensor_publisher import publish_at
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["BARO_TABLE", "TABLE", "load", "load_baro"]

_COMMON = (
    Parameter("robotNamespace", "text", "", "namespace of the topic"),
    Parameter("bodyName", "text", "", "the link; the model's first when absent"),
    Parameter(
        "frameId", "text", "", "frame of the data; the link when empty", "", aliases=("frameName",)
    ),
    Parameter("updateRate", "number", 0.0, "publish rate, 0 is every step", "Hz"),
    Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
)

TABLE = PluginTable(
    ParameterTable(
        "hector magnetic",
        "The magnetometer of hector_gazebo_plugins, a model plug-in.",
        ("hector_gazebo_ros_magnetic",),
        (
            *_COMMON,
            Parameter("topicName", "text", "magnetic", "topic"),
            Parameter("magnitude", "number", 1.0, "of the field, any unit"),
            Parameter("referenceHeading", "number", 0.0, "compass heading of the world's x", "deg"),
            Parameter("declination", "number", 0.0, "of magnetic north, from true north", "deg"),
            Parameter("inclination", "number", 60.0, "of the field below the horizon", "deg"),
            Parameter("useMagneticFieldMsgs", "flag", False, "publish MagneticField"),
            Parameter(
                "useWorldSphericalCoordinates", "flag", False, "take the heading from the world"
            ),
            *error_parameters("as magnitude"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "geometry_msgs/msg/Vector3Stamped or sensor_msgs/msg/MagneticField",
            rate="`updateRate`",
            frame="`frameId`",
        ),
    ),
    behaviour=(
        "The field is the plug-in's own, not the world's: of the given magnitude, pointing to"
        " magnetic north and down by the inclination, turned into the link's frame.",
        "Headings are a compass's: `referenceHeading` 0 means that the world's x points north.",
        "dynamic_reconfigure is not offered.",
    ),
)

BARO_TABLE = PluginTable(
    ParameterTable(
        "hector baro",
        "The barometer of hector_quadrotor_gazebo_plugins, a model plug-in.",
        ("hector_gazebo_ros_baro",),
        (
            *_COMMON,
            Parameter("topicName", "text", "pressure_height", "topic of the height"),
            *error_parameters("m", axes=1),
            Parameter(
                "altimeterTopicName", "refused", "", "hector_uav_msgs/Altimeter is not published"
            ),
            Parameter("elevation", "refused", "", "only hector_uav_msgs/Altimeter has it"),
            Parameter("qnh", "refused", "", "only hector_uav_msgs/Altimeter has it"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}", "geometry_msgs/msg/PointStamped", rate="`updateRate`", frame="`frameId`"
        ),
    ),
    behaviour=(
        "The height above the world's origin is in `point.z`.",
        "hector_uav_msgs/Altimeter is not published: ROS itself does not know that type.",
    ),
)


def load(context: PluginContext) -> None:
    """Start publishing the field; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(TABLE)
    link_name = _link_name(context, parameters)
    if link_name is not None:
        _start(context, parameters, link_name)
    parameters.report_unread()


def load_baro(context: PluginContext) -> None:
    """Start publishing the height; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(BARO_TABLE)
    link_name = _link_name(context, parameters)
    if link_name is not None:
        link = context.host.engine.link(link_name)
        source = ErrorSource(context, read_model(parameters, axes=1), "height")
        frame = parameters.text("frameId") or link_name.split("::", 1)[1]

        def build(time_ns: int) -> Any:
            height = source.apply(np.array(link.T_world_link().position_m[2:]))
            point = message_type("geometry_msgs/Point")(x=0.0, y=0.0, z=float(height[0]))
            return message_type("geometry_msgs/PointStamped")(
                header=header(time_ns, frame), point=point
            )

        topic = context.topic(parameters, parameters.text("topicName"))
        publish_at(
            context, topic, "geometry_msgs/PointStamped", _period(context, parameters), build
        )
    parameters.report_unread()


def _start(context: PluginContext, parameters: PluginReader, link_name: str) -> None:
    link = context.host.engine.link(link_name)
    field = _field(context, parameters)
    source = ErrorSource(context, read_model(parameters), "field")
    frame = parameters.text("frameId") or link_name.split("::", 1)[1]
    is_field = parameters.flag("useMagneticFieldMsgs")
    type_name = "sensor_msgs/MagneticField" if is_field else "geometry_msgs/Vector3Stamped"
    key = "magnetic_field" if is_field else "vector"

    def build(time_ns: int) -> Any:
        measured = source.apply(np.array(link.T_world_link().inverse().rotate(field)))
        values = {key: vector_message(measured)}
        return message_type(type_name)(header=header(time_ns, frame), **values)

    topic = context.topic(parameters, parameters.text("topicName"))
    publish_at(context, topic, type_name, _period(context, parameters), build)


def _field(context: PluginContext, parameters: PluginReader) -> tuple[float, float, float]:
    """Return the field in the world, whose x points to the reference heading (x, y, up)."""
    heading_deg = parameters.number("referenceHeading")
    origin = context.host.engine.world.spherical_coordinates
    wants_world = parameters.flag("useWorldSphericalCoordinates")
    if wants_world and origin is not None and not parameters.has("referenceHeading"):
        heading_deg = 90.0 - origin.heading_deg
    angle = math.radians(heading_deg - parameters.number("declination"))
    dip, size = math.radians(parameters.number("inclination")), parameters.number("magnitude")
    flat = size * math.cos(dip)
    return (flat * math.cos(angle), flat * math.sin(angle), -size * math.sin(dip))


def _link_name(context: PluginContext, parameters: PluginReader) -> str | None:
    first = context.model.links[0].name if context.model.links else ""
    return context.link_name(parameters.text("bodyName") or first)


def _period(context: PluginContext, parameters: PluginReader) -> Any:
    return period_in_steps(parameters.number("updateRate"), context.host.engine.step_ns)
