"""The robot of ROS 1: engine and transmissions behind ros_control's interfaces."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.control.hardware.control_description import ControlDescription, description_of
from gazelle.control.hardware.default_robot_hw_sim import DefaultRobotHWSim
from gazelle.control.hardware.ros1_joint_setup import (
    gains_parameters,
    joints_to_hold,
    read_joint_gains,
    read_ros1_joints,
)
from gazelle.control.hardware.sensor_states import SensorSource, SensorStates, sensor_parts
from gazelle.control.interface_values import InterfaceValues
from gazelle.control.parameter_sources.ros1_parameter_server import ParameterSource
from gazelle.control.resource_manager import HardwareHost, ParameterStore, Robot
from gazelle.description.model import Model

__all__ = ["RobotParameters", "build_ros1_robot"]


@dataclass(frozen=True, slots=True)
class RobotParameters:
    """Where the parameters of a robot lie.

    Attributes:
        store: the parameter store.
        namespace: of the robot, absolute; empty or ``/`` for none.
        gains_namespace: where ``gazebo_ros_control/pid_gains`` lies; the robot's when None.
    """

    store: ParameterStore
    namespace: str = ""
    gains_namespace: str | None = None

    @property
    def prefix(self) -> str:
        """The robot's namespace without a slash at its end."""
        return "/" + self.namespace.strip("/") if self.namespace.strip("/") else ""

    @property
    def gains_prefix(self) -> str:
        """The same of its gains."""
        given = self.gains_namespace
        return self.prefix if given is None else given.rstrip("/")


def build_ros1_robot(
    host: HardwareHost,
    model: Model,
    source: ParameterSource,
    parameters: RobotParameters,
    *,
    description: ControlDescription | None = None,
    sensors: SensorSource | None = None,
    plugin: str = "gazebo_ros_control/DefaultRobotHWSim",
) -> Robot:
    """Return the robot of a model in the world; joints to be held are held from now on.

    Args:
        host: the physics, and where to report.
        model: as it is in the world.
        source: configured controllers: the joints they name are held.
        parameters: the parameter store, and where in it the robot's lie.
        description: joints and transmissions; the model's own when None.
        sensors: what the model can measure; None for nothing.
        plugin: class of the hardware that the file names.
    """
    described = description or description_of(model)
    joints = read_ros1_joints(host, model, described, parameters.store, parameters.prefix)
    gains = gains_parameters(parameters.store, parameters.gains_prefix, host.diagnostics)
    interface_values = InterfaceValues()
    parts = () if sensors is None else sensor_parts(sensors)
    measured = SensorStates(parts, interface_values, sensors, host.diagnostics)
    hardware = DefaultRobotHWSim(
        host.engine,
        interface_values,
        model.name,
        joints,
        sensors=measured,
        gains=read_joint_gains(gains, model, joints),
        held=joints_to_hold(joints, source),
        plugin=plugin,
    )
    interface_values.freeze()
    hardware.start()
    if not joints:
        text = f"no joint of model '{model.name}' can be controlled: it has no <transmission> that"
        text += " drives one of its joints (No valid transmissions found.)"
        host.diagnostics.report("control.no-transmissions", text, model.span)
    resources = {item.name: item for item in hardware.joints}
    return Robot(
        1, model, interface_values, (hardware,), resources, measured.interfaces, measured.frames
    )
