"""Which class a controller's type name means."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from gazelle.control.controllers.controller import Controller
from gazelle.control.table import ControllerTable

__all__ = ["all_tables", "controller_class", "known_types"]

# Modules of `gazelle.control.controllers` and the classes in them, in the documentation's order.
_FAMILIES: tuple[tuple[str, str], ...] = (
    ("joint_state_controller", "JointStateController"),
    ("joint_state_broadcaster", "JointStateBroadcaster"),
    ("joint_command", "JointCommandController"),
    ("joint_group_command", "JointGroupCommandController"),
    ("joint_group_command", "MultiInterfaceCommandController"),
    ("joint_position", "JointPositionController"),
    ("joint_velocity", "JointVelocityController"),
    ("joint_group_position", "JointGroupPositionController"),
    ("pid_controller", "PidController"),
    ("ros1_sensors", "ImuSensorController"),
    ("imu_sensor_broadcaster", "ImuSensorBroadcaster"),
    ("ros1_sensors", "ForceTorqueSensorController"),
    ("force_torque_broadcaster", "ForceTorqueSensorBroadcaster"),
    ("range_sensor_broadcaster", "RangeSensorBroadcaster"),
    ("pose_broadcaster", "PoseBroadcaster"),
    ("gps_sensor_broadcaster", "GpsSensorBroadcaster"),
    ("diff_drive", "DiffDriveController"),
    ("ackermann_steering", "AckermannSteeringController"),
    ("bicycle_steering", "BicycleSteeringController"),
    ("tricycle_steering", "TricycleSteeringController"),
    ("tricycle", "TricycleController"),
    ("four_wheel_steering", "FourWheelSteeringController"),
    ("mecanum_drive", "MecanumDriveController"),
    ("omni_wheel_drive", "OmniWheelDriveController"),
    ("joint_trajectory.ros1", "Ros1JointTrajectoryController"),
    ("joint_trajectory.ros2", "Ros2JointTrajectoryController"),
    ("gripper_action", "GripperActionController"),
    ("gripper_action_parallel", "ParallelGripperActionController"),
)


@cache
def _by_type() -> dict[str, type[Controller]]:
    found: dict[str, type[Controller]] = {}
    for module_name, class_name in _FAMILIES:
        module = import_module(f"gazelle.control.controllers.{module_name}")
        controller: type[Controller] = getattr(module, class_name)
        for name in controller.TABLE.parameters.types:
            found[name] = controller
    return found


def controller_class(type_name: str) -> type[Controller] | None:
    """Return the class of a type, None when there is none.

    ``::`` is understood for ``/``, as some ROS 2 files write it.
    """
    return _by_type().get(type_name.replace("::", "/"))


def known_types() -> tuple[str, ...]:
    """Return all type names."""
    return tuple(sorted(_by_type()))


def all_tables() -> tuple[ControllerTable, ...]:
    """Return every table, in the order of the documentation."""
    tables = {cls.TABLE.parameters.family: cls.TABLE for cls in _by_type().values()}
    return tuple(tables.values())
