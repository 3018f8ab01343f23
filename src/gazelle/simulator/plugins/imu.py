"""IMUs: ``libgazebo_ros_imu`` and ``libgazebo_ros_imu_sensor``."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import ImuSpec, Noise
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import ORDER_SENSOR, measured_period_in_steps, period_in_steps

if TYPE_CHECKING:
    from gazelle.sensors import ImuRecord

__all__ = [
    "GRAVITY",
    "OFFSETS",
    "SENSOR_TABLE",
    "TABLE",
    "imu_message",
    "load",
    "load_sensor",
    "offset_pose",
    "publish_readings",
]

Sigmas = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]
_NO_SIGMAS: Sigmas = (np.zeros(3), np.zeros(3), np.zeros(3))

OFFSETS = (
    Parameter(
        "xyzOffset", "vector", (0.0, 0.0, 0.0), "mounting position", "m", aliases=("xyzOffsets",)
    ),
    Parameter(
        "rpyOffset", "vector", (0.0, 0.0, 0.0), "mounting turn", "rad", aliases=("rpyOffsets",)
    ),
)
GRAVITY = "At rest the acceleration reads +g along the upward axis, as a real IMU's does."

TABLE = PluginTable(
    ParameterTable(
        "imu",
        "A model plug-in that measures the motion of a link.",
        ("gazebo_ros_imu",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("bodyName", "text", "", "the link"),
            Parameter("frameName", "text", "", "frame of the data"),
            Parameter("topicName", "text", "/default_imu", "topic"),
            Parameter("serviceName", "text", "/default_imu", "calibration service, does nothing"),
            Parameter(
                "gaussianNoise", "number", 0.0, "sigma of rates and accelerations", "rad/s, m/s²"
            ),
            Parameter("updateRate", "number", 0.0, "publish rate", "Hz"),
            *OFFSETS,
            Parameter("imu", "refused", "", "no release of this plug-in reads it"),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "sensor_msgs/msg/Imu",
            rate="`updateRate`, 0 is every step",
            frame="`frameName`, else `bodyName`",
        ),
    ),
    services=(Topic("{serviceName}", "std_srvs/srv/Empty", kind="service"),),
    behaviour=(GRAVITY,),
)

SENSOR_TABLE = PluginTable(
    ParameterTable(
        "imu_sensor",
        "Publishes the readings of the imu sensor it stands in.",
        ("gazebo_ros_imu_sensor",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic", ros_versions=(1,)),
            Parameter("topicName", "text", "imu_data", "topic (ROS 1)", ros_versions=(1,)),
            Parameter("frameName", "text", "", "frame of the data", "", aliases=("frame_name",)),
            Parameter(
                "bodyName",
                "text",
                "",
                "frame of the data when frameName is absent",
                ros_versions=(1,),
            ),
            Parameter(
                "updateRateHZ",
                "number",
                0.0,
                "publish rate, 0 for the sensor's",
                "Hz",
                ros_versions=(1,),
            ),
            Parameter(
                "gaussianNoise", "number", 0.0, "sigma of rates and accelerations", "rad/s, m/s²"
            ),
            Parameter(
                "initialOrientationAsReference",
                "flag",
                False,
                "orientations refer to the first one, not to the world",
                "",
                aliases=("initial_orientation_as_reference",),
            ),
            *OFFSETS,
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "sensor_msgs/msg/Imu",
            rate="`updateRateHZ`, else the sensor's",
            frame="`frameName`, else the link",
            ros2="~/out",
        ),
    ),
    behaviour=(GRAVITY,),
    in_both_ros=True,
)


def load(context: PluginContext) -> None:
    """Start the model plug-in."""
    parameters = context.reader(TABLE)
    link_name = context.link_name(parameters.text("bodyName"))
    sigma = parameters.number("gaussianNoise")
    if link_name is not None:
        frame = parameters.text("frameName") or parameters.text("bodyName")
        spec = _spec(sigma)
        _start_own(context, parameters, link_name, frame, spec)
        name = context.topic(parameters, parameters.text("serviceName"))
        context.resources.service(name, "std_srvs/Empty", lambda request, response: None)
    parameters.report_unread()


def load_sensor(context: PluginContext) -> None:
    """Start the sensor plug-in of ROS 1 or ROS 2."""
    parameters = context.reader(SENSOR_TABLE)
    place = context.place
    if place is None or not isinstance(place.sensor.spec, ImuSpec):
        text = f"plug-in '{context.plugin.name}' needs an imu sensor around it; it is left out"
        context.report("plugin.wrong-place", text)
    else:
        host = context.host
        sensor = place.sensor
        link = place.link_name.split("::")[-1]
        frame = parameters.text("frameName") or parameters.text("bodyName") or link
        ros2 = parameters.is_ros2()
        topic = context.topic(parameters, "~/out" if ros2 else parameters.text("topicName"))
        rate = parameters.number("updateRateHZ")
        period = measured_period_in_steps(rate or sensor.update_rate_hz, host.engine.step_ns)
        offset = offset_pose(parameters)
        sigma = parameters.number("gaussianNoise")
        spec = sensor.spec
        if sigma > 0 or not isinstance(spec, ImuSpec):
            spec = _spec(sigma)
        T_link_imu = sensor.T_link_sensor @ offset
        relative = parameters.flag("initialOrientationAsReference")
        publish_readings(
            context,
            topic,
            frame,
            period,
            lambda: host.sensors.imu_at(
                place.name, place.link_name, T_link_imu, spec, relative=relative
            ),
            # ROS 1 takes its own sigma for the orientation too, ROS 2 the sensor's noises only.
            sigmas=_sigmas(spec, sigma),
        )
    parameters.report_unread()


def _start_own(
    context: PluginContext, parameters: PluginReader, link_name: str, frame: str, spec: ImuSpec
) -> None:
    host, offset = context.host, offset_pose(parameters)
    topic = context.topic(parameters, parameters.text("topicName"))
    period = period_in_steps(parameters.number("updateRate"), host.engine.step_ns)
    name = f"{context.model.name}::{context.plugin.name}"
    publish_readings(
        context,
        topic,
        frame,
        period,
        lambda: host.sensors.imu_at(name, link_name, offset, spec),
        sigmas=_sigmas(spec, parameters.number("gaussianNoise")),
    )


def publish_readings(
    context: PluginContext,
    topic: str,
    frame: str,
    period: Any,
    read: Callable[[], ImuRecord],
    *,
    sigmas: Sigmas = _NO_SIGMAS,
) -> None:
    """Publish readings every so many steps, while somebody listens.

    Args:
        context: the plug-in's.
        topic: absolute name.
        frame: of the data.
        period: in steps.
        read: takes a reading.
        sigmas: of orientation, rates and accelerations, for the covariances.
    """
    engine = context.host.engine
    publisher = context.resources.publisher(topic, "sensor_msgs/Imu")

    def publish() -> None:
        publisher.publish(imu_message(engine.time_ns, frame, read(), sigmas))

    name = f"{context.plugin.name} imu"
    context.resources.task(
        name, period, publish, order=ORDER_SENSOR, wanted=lambda: publisher.matched
    )


def imu_message(time_ns: int, frame: str, record: ImuRecord, sigmas: Sigmas = _NO_SIGMAS) -> Any:
    """Return a ``sensor_msgs/Imu``; variances are the squares of the sigmas."""
    orientation, rate, acceleration = (np.diag(np.square(item)).reshape(9) for item in sigmas)
    x, y, z, w = record.orientation_xyzw
    quaternion = message_type("geometry_msgs/Quaternion")
    return message_type("sensor_msgs/Imu")(
        header=header(time_ns, frame),
        orientation=quaternion(x=float(x), y=float(y), z=float(z), w=float(w)),
        angular_velocity=vector_message(record.angular_velocity_rad_s),
        linear_acceleration=vector_message(record.linear_acceleration_m_s2),
        orientation_covariance=orientation,
        angular_velocity_covariance=rate,
        linear_acceleration_covariance=acceleration,
    )


def offset_pose(parameters: PluginReader) -> Pose:
    """Return where the IMU sits on its link, of ``xyzOffset`` and ``rpyOffset``."""
    xyz, rpy = parameters.vector("xyzOffset"), parameters.vector("rpyOffset")
    return Pose.from_xyz_rpy(xyz, rpy) if any((*xyz, *rpy)) else IDENTITY_POSE


def _spec(sigma: float) -> ImuSpec:
    noise = Noise("gaussian" if sigma > 0 else "none", 0.0, sigma)
    return ImuSpec((noise, noise, noise), (noise, noise, noise))


def _sigmas(spec: ImuSpec, orientation: float) -> Sigmas:
    rates = np.array([noise.stddev for noise in spec.angular_velocity_noise])
    forces = np.array([noise.stddev for noise in spec.linear_acceleration_noise])
    return (np.full(3, orientation), rates, forces)
