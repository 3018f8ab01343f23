"""``libhector_gazebo_ros_imu``, with its drifting errors."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import ImuSpec
from gazelle.geometry import Pose
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.hector_noise import ErrorSource, error_parameters, read_model
from gazelle.simulator.plugins.imu import GRAVITY, OFFSETS, offset_pose, publish_readings
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable
from gazelle.simulator.scheduler import period_in_steps

if TYPE_CHECKING:
    from gazelle.sensors import ImuRecord

__all__ = ["TABLE", "load"]

Array = NDArray[np.float64]

TABLE = PluginTable(
    ParameterTable(
        "hector imu",
        "The IMU of hector_gazebo_plugins.",
        ("hector_gazebo_ros_imu",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("bodyName", "text", "", "the link; the model's first when absent"),
            Parameter("frameId", "text", "", "frame of the data", "", aliases=("frameName",)),
            Parameter("topicName", "text", "imu", "topic"),
            Parameter("serviceName", "text", "", "calibration; `{topicName}/calibrate` when empty"),
            Parameter("updateRate", "number", 0.0, "publish rate", "Hz"),
            Parameter("gaussianNoise", "number", 0.0, "sigma of all, unless 0", "m/s², rad/s"),
            *error_parameters("m/s²", prefix="accel"),
            *error_parameters("rad/s", prefix="rate"),
            *error_parameters("rad", axes=1, prefix="yaw"),
            *OFFSETS,
            Parameter("biasTopicName", "refused", "", "the bias topic is not offered"),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
            Parameter("headingDrift", "refused", "", "no release of the plug-in reads it"),
            Parameter("headingGaussianNoise", "refused", "", "no release of the plug-in reads it"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "sensor_msgs/msg/Imu",
            rate="`updateRate`, 0 is every step",
            frame="`frameId`, else `bodyName`",
        ),
    ),
    services=(Topic("{serviceName}", "std_srvs/srv/Empty", kind="service"),),
    behaviour=(
        GRAVITY,
        "Accelerations and rates have scale, offset, drift and noise each; offset and drift of the"
        " acceleration tilt the orientation, those of the yaw turn it, as a real filter's do.",
        "The calibration service sets the rates' drift to zero.",
        "Not offered: the bias topic, `set_accel_bias`, `set_rate_bias` and dynamic_reconfigure.",
    ),
)


def load(context: PluginContext) -> None:
    """Start publishing; one diagnostic and nothing else when the link is missing."""
    parameters = context.reader(TABLE)
    first = context.model.links[0].name if context.model.links else ""
    link_name = context.link_name(parameters.text("bodyName") or first)
    if link_name is not None:
        _start(context, parameters, link_name)
    parameters.report_unread()


def _start(context: PluginContext, parameters: PluginReader, link_name: str) -> None:
    common = parameters.number("gaussianNoise")
    models = [
        read_model(parameters, prefix="accel", gaussian_noise=common),
        read_model(parameters, prefix="rate", gaussian_noise=common),
        read_model(parameters, axes=1, prefix="yaw"),
    ]
    accel, rate, yaw = (
        ErrorSource(context, model, name)
        for model, name in zip(models, ("accel", "rate", "yaw"), strict=True)
    )
    sensors, offset, clean = context.host.sensors, offset_pose(parameters), ImuSpec()
    engine, name = context.host.engine, f"{context.model.name}::{context.plugin.name}"

    def read() -> ImuRecord:
        from gazelle.sensors import ImuRecord

        true = sensors.imu_at(name, link_name, offset, clean)
        force = accel.apply(true.linear_acceleration_m_s2)
        spin = rate.apply(true.angular_velocity_rad_s)
        yaw.apply(np.zeros(1))
        size = float(np.linalg.norm(engine.gravity_m_s2)) or 1.0
        tilt = _orientation_error(true.orientation_xyzw, accel.bias / size, float(yaw.bias[0]))
        return ImuRecord((tilt @ Pose(quat_xyzw=true.orientation_xyzw)).quat_xyzw, spin, force)

    def calibrate(request: Any, response: Any) -> None:
        rate.drift = np.zeros(3)

    topic = parameters.text("topicName")
    service = parameters.text("serviceName") or f"{topic}/calibrate"
    context.resources.service(context.topic(parameters, service), "std_srvs/Empty", calibrate)
    frame = parameters.text("frameId") or link_name.split("::", 1)[1]
    period = period_in_steps(parameters.number("updateRate"), engine.step_ns)
    # Only the white noise counts, and nothing is said about the orientation, as in the original.
    spins, forces = np.array(models[1].gaussian_noise), np.array(models[0].gaussian_noise)
    sigmas = (np.zeros(3), spins, forces)
    publish_readings(context, context.topic(parameters, topic), frame, period, read, sigmas=sigmas)


def _orientation_error(
    quat_xyzw: tuple[float, float, float, float], bias_g: Array, yaw_rad: float
) -> Pose:
    """Return the turn of an orientation filter that takes a bias for a part of gravity."""
    x, y, _ = Pose(quat_xyzw=quat_xyzw).rotate((bias_g[0], bias_g[1], bias_g[2]))
    size = math.sqrt(1.0 + 0.25 * (x * x + y * y))
    tilt = Pose(quat_xyzw=(0.5 * y / size, -0.5 * x / size, 0.0, 1.0 / size))
    return Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, yaw_rad)) @ tilt
