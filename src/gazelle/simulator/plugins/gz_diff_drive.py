"""The gz-sim system ``DiffDrive`` (and its Ignition names)."""

from __future__ import annotations

import math

from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.diff_drive import GZ_TABLE
from gazelle.simulator.plugins.diff_drive_geometry import check_drive
from gazelle.simulator.plugins.diff_drive_kinematics import (
    EncoderOdometry,
    SpeedLimiter,
    wheel_speeds,
)
from gazelle.simulator.plugins.drive import Velocity, gz_topic, run_drive, take_velocities
from gazelle.simulator.plugins.drive_odometry import DriveOdometry, gz_odometry_setup
from gazelle.simulator.plugins.plugin_parameters import PluginReader
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["load"]

# gz-sim commands joint velocities outright; the engine needs some bound on the torque.
_TORQUE_NM = 1e3
# gz-sim limits and commands at every step; a hundredth of a second is fine enough.
_CONTROL_HZ = 100.0


def load(context: PluginContext) -> None:
    """Start a drive; one diagnostic and nothing else when a joint is missing."""
    parameters = context.reader(GZ_TABLE)
    left = [context.joint_name(name) for name in parameters.texts("left_joint")]
    right = [context.joint_name(name) for name in parameters.texts("right_joint")]
    if not left or not right:
        text = f"plug-in '{context.plugin.name}' names no left or no right joint; it is left out"
        context.report("plugin.missing-joint", text)
    elif None not in left and None not in right:
        names = ([name for name in left if name], [name for name in right if name])
        _GzDrive(context, parameters, names)
    parameters.report_unread()


class _GzDrive:
    """One running drive."""

    def __init__(
        self,
        context: PluginContext,
        parameters: PluginReader,
        names: tuple[list[str], list[str]],
    ) -> None:
        self._context = context
        self._engine = context.host.engine
        self._joints = [[self._engine.joint(name) for name in side] for side in names]
        separation = parameters.number("wheel_separation")
        self._separation_m = separation
        self._radius_m = parameters.number("wheel_radius")
        check_drive(
            context, (names[0][0], names[1][0]), separation, 2 * self._radius_m, exchanged=False
        )
        self._reckoning = EncoderOdometry(separation, self._radius_m, exchanged=False)
        self._last_angles = self._angles()
        self._command = Velocity()
        self._linear = _limiter(parameters, "velocity", "acceleration")
        self._angular = _limiter(parameters, "angular_velocity", "angular_acceleration")
        self._offer(parameters)
        self._start(parameters)

    def _offer(self, parameters: PluginReader) -> None:
        context = self._context
        take_velocities(context, gz_topic(context, parameters, "topic"), self._take)
        self._odometry = DriveOdometry(context, gz_odometry_setup(context, parameters))

    def _start(self, parameters: PluginReader) -> None:
        context, step_ns = self._context, self._engine.step_ns
        period = period_in_steps(parameters.number("odom_publish_frequency"), step_ns)
        self._publish_period_s = float(period * step_ns) * 1e-9
        control = period_in_steps(_CONTROL_HZ, step_ns)
        self._control_period_s = float(control * step_ns) * 1e-9
        joints = (joint for side in self._joints for joint in side)
        run_drive(context, joints, control, self._control, self._reset)
        context.resources.task(f"{context.plugin.name} odometry", period, self._publish)

    def _take(self, command: Velocity) -> None:
        self._command = command

    def _control(self) -> None:
        linear = self._linear.follow(self._command.forward, self._control_period_s)
        angular = self._angular.follow(self._command.turn, self._control_period_s)
        speeds = wheel_speeds(linear, angular, self._separation_m, exchanged=False)
        for joints, speed in zip(self._joints, speeds, strict=True):
            for joint in joints:
                joint.set_velocity_target(speed / self._radius_m, _TORQUE_NM)

    def _publish(self) -> None:
        angles, last = self._angles(), self._last_angles
        self._last_angles = angles
        reckoning = self._reckoning
        reckoning.update(angles[0] - last[0], angles[1] - last[1], self._publish_period_s)
        motion = (reckoning.forward_m_s, 0.0, reckoning.yaw_rate_rad_s)
        self._odometry.publish(reckoning.pose(), motion)

    def _angles(self) -> tuple[float, float]:
        left, right = (math.fsum(j.position for j in side) / len(side) for side in self._joints)
        return left, right

    def _reset(self) -> None:
        self._command = Velocity()
        self._linear.value = self._angular.value = 0.0
        self._reckoning.reset()
        self._last_angles = self._angles()


def _limiter(parameters: PluginReader, speed: str, rate: str) -> SpeedLimiter:
    return SpeedLimiter(
        parameters.number(f"min_{speed}"),
        parameters.number(f"max_{speed}"),
        parameters.number(f"min_{rate}"),
        parameters.number(f"max_{rate}"),
    )
