"""Which class a controller's type name means."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller

__all__ = ["all_tables", "controller_class", "known_types"]

# Modules of `gazelle.control.controllers` and the classes in them, in the documentation's order.
_FAMILIES: tuple[tuple[str, str], ...] = (
    ("joint_state_controller", "JointStateController"),
    ("joint_state_broadcaster", "JointStateBroadcaster"),
    ("forward_command_controllers", "JointCommandController"),
    ("forward_command_controllers", "JointGroupCommandController"),
    ("forward_command_controllers", "MultiInterfaceCommandController"),
    ("ros1_effort_velocity_controllers", "JointPositionController"),
    ("ros1_effort_velocity_controllers", "JointVelocityController"),
    ("ros1_effort_velocity_controllers", "JointGroupPositionController"),
    ("pid_controller", "PidController"),
    ("ros1_sensor_controllers", "ImuSensorController"),
    ("imu_sensor_broadcaster", "ImuSensorBroadcaster"),
    ("ros1_sensor_controllers", "ForceTorqueSensorController"),
    ("force_torque_sensor_broadcaster", "ForceTorqueSensorBroadcaster"),
    ("range_sensor_broadcaster", "RangeSensorBroadcaster"),
    ("pose_broadcaster", "PoseBroadcaster"),
    ("gps_sensor_broadcaster", "GpsSensorBroadcaster"),
    ("diff_drive_controller", "DiffDriveController"),
    ("ackermann_steering_controller", "AckermannSteeringController"),
    ("bicycle_steering_controller", "BicycleSteeringController"),
    ("tricycle_steering_controller", "TricycleSteeringController"),
    ("tricycle_controller", "TricycleController"),
    ("four_wheel_steering_controller", "FourWheelSteeringController"),
    ("mecanum_drive_controller", "MecanumDriveController"),
    ("omni_wheel_drive_controller", "OmniWheelDriveController"),
    ("joint_trajectory_controller.ros1", "Ros1JointTrajectoryController"),
    ("joint_trajectory_controller.ros2", "Ros2JointTrajectoryController"),
    ("gripper_action_controller", "GripperActionController"),
    ("parallel_gripper_action_controller", "ParallelGripperActionController"),
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
