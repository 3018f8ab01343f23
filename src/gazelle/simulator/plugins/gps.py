"""GPS: ``libgazebo_ros_gps_sensor`` (ROS 2) and ``libhector_gazebo_ros_gps``."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import GpsSpec
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, SensorPlace
from gazelle.simulator.plugins.hector_noise import ErrorSource, error_parameters, read_model
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.plugins.sensor_publisher import (
    once_per_step,
    publish_at,
    sensor_period,
    sensor_place,
)
from gazelle.simulator.scheduler import period_in_steps

if TYPE_CHECKING:
    from gazelle.sensors import DriftModel, GeodeticPosition

__all__ = ["HECTOR_TABLE", "TABLE", "fix_message", "load", "load_hector"]

Array = NDArray[np.float64]
_UNKNOWN, _DIAGONAL_KNOWN = 0, 2
_SERVICE_GPS = 1
_RATE_HZ = 4.0

TABLE = PluginTable(
    ParameterTable(
        "gps_sensor",
        "The ROS 2 plug-in of gps sensors.",
        ("gazebo_ros_gps_sensor",),
        (Parameter("frame_name", "text", "", "frame; the link's name when empty"),),
    ),
    topics=(
        Topic(
            "~/out",
            "sensor_msgs/msg/NavSatFix",
            rate="sensor's `update_rate`",
            frame="`frame_name`",
        ),
        Topic(
            "~/vel",
            "geometry_msgs/msg/Vector3Stamped (east, north, up)",
            rate="sensor's `update_rate`",
            frame="`frame_name`",
        ),
    ),
    behaviour=(
        "The world's `<spherical_coordinates>` place it on the WGS 84 ellipsoid, exactly, not on a"
        " flat Earth.",
        "`<heading_deg>` counts as in Gazebo Classic: x points to 180° − heading, from east to"
        " north, so worlds with x to the east write 180. Sensors of type `navsat` and all sensors"
        " of gz-sim worlds take it as SDF describes it.",
        "Noise is in metres; the covariance has its variances.",
    ),
)

HECTOR_TABLE = PluginTable(
    ParameterTable(
        "hector gps",
        "The GPS of hector_gazebo_plugins, a model plug-in.",
        ("hector_gazebo_ros_gps",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topics"),
            Parameter("bodyName", "text", "", "the link; the model's first when absent"),
            Parameter("frameId", "text", "/world", "frame of the data", "", aliases=("frameName",)),
            Parameter("topicName", "text", "fix", "topic of fixes"),
            Parameter("velocityTopicName", "text", "fix_velocity", "topic of velocities"),
            Parameter("updateRate", "number", _RATE_HZ, "publish rate", "Hz"),
            Parameter("referenceLatitude", "number", 49.9, "of the world's origin", "deg"),
            Parameter("referenceLongitude", "number", 8.9, "of the world's origin", "deg"),
            Parameter("referenceHeading", "number", 0.0, "compass heading of x", "deg"),
            Parameter("referenceAltitude", "number", 0.0, "of the world's origin", "m"),
            Parameter(
                "useWorldSphericalCoordinates",
                "flag",
                False,
                "take the reference from the world, where none of the keys above says otherwise",
            ),
            Parameter("status", "number", 0.0, "`status.status`"),
            Parameter("service", "number", 0.0, "`status.service`"),
            *error_parameters("m"),
            *error_parameters("m/s", prefix="velocity"),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
    topics=(
        Topic("{topicName}", "sensor_msgs/msg/NavSatFix", rate="`updateRate`", frame="`frameId`"),
        Topic(
            "{velocityTopicName}",
            "geometry_msgs/msg/Vector3Stamped",
            rate="`updateRate`",
            frame="`frameId`",
        ),
    ),
    behaviour=(
        "Degrees come from the radii of curvature at the reference, as in the original.",
        "Headings are a compass's: 0 means that x points north, 90 east.",
        "The velocity is north, west, up.",
        "An error of the velocity moves the position's drift along.",
        "`set_reference_geopose` and dynamic_reconfigure are not offered.",
    ),
)


def load(context: PluginContext) -> None:
    """Start publishing the fixes of the gps sensor the plug-in stands in."""
    parameters = context.reader(TABLE)
    place = sensor_place(context, GpsSpec, "a gps sensor")
    if place is not None:
        frame = parameters.text("frame_name") or place.link_name.split("::")[-1]
        _publish_sensor(context, parameters, place, frame)
    parameters.report_unread()


def _publish_sensor(
    context: PluginContext, parameters: PluginReader, place: SensorPlace, frame: str
) -> None:
    measurements, spec = context.host.sensors.measurements, place.sensor.spec
    assert isinstance(spec, GpsSpec)
    across, up = spec.horizontal_position_noise, spec.vertical_position_noise
    variances = np.square([across.stddev, across.stddev, up.stddev])
    read = once_per_step(context, lambda: measurements.gps(place))

    def fix(time_ns: int) -> Any:
        position = read().position
        return fix_message(time_ns, frame, position, variances, service=_SERVICE_GPS)

    def velocity(time_ns: int) -> Any:
        return _stamped(time_ns, frame, read().velocity_enu_m_s)

    period = sensor_period(context, place)
    out, vel = context.topic(parameters, "~/out"), context.topic(parameters, "~/vel")
    publish_at(context, out, "sensor_msgs/NavSatFix", period, fix)
    publish_at(context, vel, "geometry_msgs/Vector3Stamped", period, velocity)


def fix_message(
    time_ns: int,
    frame: str,
    place: GeodeticPosition,
    variances: Array | None,
    *,
    status: int = 0,
    service: int = 0,
) -> Any:
    """Return a ``sensor_msgs/NavSatFix``.

    Args:
        time_ns: of the header.
        frame: of the header.
        place: on Earth.
        variances: (3,), m², the diagonal of the covariance; None for an unknown one.
        status: of ``NavSatStatus``.
        service: of ``NavSatStatus``.
    """
    covariance = np.zeros((3, 3)) if variances is None else np.diag(variances)
    navigation = message_type("sensor_msgs/NavSatStatus")(status=status, service=service)
    return message_type("sensor_msgs/NavSatFix")(
        header=header(time_ns, frame),
        status=navigation,
        latitude=place.latitude_deg,
        longitude=place.longitude_deg,
        altitude=place.altitude_m,
        position_covariance=covariance.reshape(9),
        position_covariance_type=_UNKNOWN if variances is None else _DIAGONAL_KNOWN,
    )


def load_hector(context: PluginContext) -> None:
    """Start hector's plug-in; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(HECTOR_TABLE)
    first = context.model.links[0].name if context.model.links else ""
    link_name = context.link_name(parameters.text("bodyName") or first)
    if link_name is not None:
        reference, heading_rad = _reference(context, parameters)
        _start_hector(context, parameters, link_name, reference, heading_rad)
    parameters.report_unread()


def _reference(context: PluginContext, parameters: PluginReader) -> tuple[GeodeticPosition, float]:
    from gazelle.sensors import GeodeticPosition

    latitude, longitude, altitude, heading = (
        parameters.number(f"reference{word}")
        for word in ("Latitude", "Longitude", "Altitude", "Heading")
    )
    origin = context.host.engine.world.spherical_coordinates
    if parameters.flag("useWorldSphericalCoordinates") and origin is not None:
        own = parameters.has
        latitude = latitude if own("referenceLatitude") else origin.latitude_deg
        longitude = longitude if own("referenceLongitude") else origin.longitude_deg
        altitude = altitude if own("referenceAltitude") else origin.elevation_m
        heading = heading if own("referenceHeading") else 90.0 - origin.heading_deg
    return GeodeticPosition(latitude, longitude, altitude), math.radians(heading)


def _start_hector(
    context: PluginContext,
    parameters: PluginReader,
    link_name: str,
    reference: GeodeticPosition,
    heading_rad: float,
) -> None:
    from gazelle.sensors import flat_earth_position, north_west_up

    frame, model = parameters.text("frameId"), read_model(parameters)
    read = _hector_reader(context, link_name, model, read_model(parameters, prefix="velocity"))
    status, service = int(parameters.number("status")), int(parameters.number("service"))

    def fix(time_ns: int) -> Any:
        x, y, z = read()[0].tolist()
        place = flat_earth_position((x, y, z), reference, heading_rad)
        return fix_message(time_ns, frame, place, model.variances, status=status, service=service)

    def velocity(time_ns: int) -> Any:
        x, y, z = read()[1].tolist()
        return _stamped(time_ns, frame, north_west_up((x, y, z), heading_rad))

    period = period_in_steps(parameters.number("updateRate"), context.host.engine.step_ns)
    topic = context.topic(parameters, parameters.text("topicName"))
    publish_at(context, topic, "sensor_msgs/NavSatFix", period, fix)
    topic = context.topic(parameters, parameters.text("velocityTopicName"))
    publish_at(context, topic, "geometry_msgs/Vector3Stamped", period, velocity)


def _hector_reader(
    context: PluginContext, link_name: str, position: DriftModel, velocity: DriftModel
) -> Callable[[], tuple[Array, Array]]:
    """Return position and velocity with errors, the same ones for both topics of a moment."""
    link = context.host.engine.link(link_name)
    of_position = ErrorSource(context, position, "position")
    of_velocity = ErrorSource(context, velocity, "velocity")

    def read() -> tuple[Array, Array]:
        noisy = of_velocity.apply(link.velocity_world().linear_m_s)
        place = np.array(link.T_world_link().position_m)
        return of_position.apply(place, of_velocity.drift), noisy

    return once_per_step(context, read)


def _stamped(time_ns: int, frame: str, vector: Any) -> Any:
    return message_type("geometry_msgs/Vector3Stamped")(
        header=header(time_ns, frame), vector=vector_message(vector)
    )
