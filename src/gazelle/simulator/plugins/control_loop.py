"""The control loop of a robot as tasks of the world, and its sensors as hardware reads them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

from gazelle.control.hardware.sensor_states import (
    FORCE_TORQUE_STATES,
    IMU_STATES,
    SensorReadout,
)
from gazelle.control.resource_manager import Robot
from gazelle.description.model import ForceTorqueSpec, ImuSpec, Model
from gazelle.simulator.plugins.context import Host, PluginContext, SensorPlace
from gazelle.simulator.sensor_set import sensor_places

if TYPE_CHECKING:
    from gazelle.control.controller_manager import ControllerManager

__all__ = ["ModelSensors", "check_controllers", "control_period", "run_control_loop"]


class ModelSensors:
    """IMUs and force-torque sensors of one model.

    They have their own noise, so that readings do not depend on who else reads a sensor. As in
    Gazebo a reading stands for a period of the sensor's update rate.
    """

    def __init__(self, host: Host, model: Model) -> None:
        self._host = host
        self._places = {
            place.sensor.name: replace(place, name=f"{place.name} of its controllers")
            for place in reversed(tuple(sensor_places(model)))
            if isinstance(place.sensor.spec, ImuSpec | ForceTorqueSpec)
        }

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the sensors."""
        return tuple(self._places)

    def find(self, name: str) -> SensorReadout | None:
        """Return a sensor by its name; of several the first, as in Gazebo."""
        place = self._places.get(name)
        if place is None:
            return None
        frame = place.link_name.split("::", 1)[1]
        if isinstance(place.sensor.spec, ImuSpec):
            return SensorReadout(IMU_STATES, frame, self._held(place, self._imu))
        return SensorReadout(FORCE_TORQUE_STATES, frame, self._held(place, self._wrench))

    def _held(
        self, place: SensorPlace, read: Callable[[SensorPlace], Sequence[float]]
    ) -> Callable[[], Sequence[float]]:
        rate_hz = place.sensor.update_rate_hz
        period_ns = max(1, round(1e9 / rate_hz)) if rate_hz > 0 else 1
        engine = self._host.engine
        last: list[tuple[int, Sequence[float]]] = []

        def reading() -> Sequence[float]:
            now_ns = engine.time_ns
            is_due = not last or now_ns < last[0][0]
            if is_due or now_ns // period_ns != last[0][0] // period_ns:
                last[:] = [(now_ns, read(place))]
            return last[0][1]

        return reading

    def _imu(self, place: SensorPlace) -> Sequence[float]:
        spec = place.sensor.spec
        assert isinstance(spec, ImuSpec)
        record = self._host.sensors.imu_at(
            place.name, place.link_name, place.sensor.T_link_sensor, spec
        )
        return (
            *record.orientation_xyzw,
            *record.angular_velocity_rad_s,
            *record.linear_acceleration_m_s2,
        )

    def _wrench(self, place: SensorPlace) -> Sequence[float]:
        record = self._host.sensors.measurements.force_torque(place)
        return (*record.force_n.tolist(), *record.torque_nm.tolist())


def control_period(context: PluginContext, period_ns: int, what: str) -> Fraction:
    """Return a control period in whole steps: Gazebo updates when at least a period has passed.

    Args:
        context: the plug-in, for reports.
        period_ns: as the user wants it.
        what: key or parameter that sets it, for messages.
    """
    step_ns = context.host.engine.step_ns
    steps = max(1, -(-period_ns // step_ns))
    if steps * step_ns != period_ns:
        text = f"{what} asks for a control period of {period_ns * 1e-9:g} s, which physics steps"
        text += f" of {step_ns * 1e-9:g} s cannot give: it is {steps * step_ns * 1e-9:g} s"
        if period_ns < step_ns:
            text += " (Desired controller update period is faster than the gazebo simulation"
            text += " period)"
        context.report("control.period", text)
    return Fraction(steps)


def run_control_loop(context: PluginContext, manager: ControllerManager, steps: Fraction) -> None:
    """Update a manager every so many steps, and let hardware write at every step that needs it.

    What happens after step k is what Gazebo does before step k + 1.
    """
    loop = _Loop(context, manager)
    name = f"{context.model.name} controllers"
    context.resources.task(name, steps, loop.update)
    if steps > 1 and any(item.writes_every_step for item in manager.robot.components):
        context.resources.task(f"{name}, every step", Fraction(1), loop.write)
    context.resources.on_reset(loop.reset)


def check_controllers(context: PluginContext, manager: ControllerManager, steps: Fraction) -> None:
    """Report what can be known before the first step: names, limits and gains that do not fit."""
    from gazelle.control.checks import (
        LoopDynamics,
        check_control,
        joint_inertias,
        moveit_controllers,
    )

    engine, model, robot = context.host.engine, context.model, manager.robot
    # Locks that were just asked for are built in now.
    engine.ensure_compiled()
    full = {f"{model.name}::{name}": name for name in robot.joints}
    inertias = {full[name]: value for name, value in joint_inertias(engine, full).items()}
    tree = context.host.node.parameters.get("/move_group", {})
    check_control(
        {joint.name: joint for joint in model.joints},
        robot.joints,
        manager.source,
        context.host.diagnostics,
        moveit=moveit_controllers(tree if isinstance(tree, dict) else {}),
        absent=robot.absent,
        loop=LoopDynamics(inertias, engine.step_ns * 1e-9, int(steps)),
        span=context.plugin.span,
    )


class _Loop:
    def __init__(self, context: PluginContext, manager: ControllerManager) -> None:
        self._engine = context.host.engine
        self._manager = manager
        self._robot: Robot = manager.robot
        self._last_ns = self._engine.time_ns

    def update(self) -> None:
        now = self._engine.time_ns
        period, self._last_ns = now - self._last_ns, now
        self._manager.update(now, period)

    def write(self) -> None:
        for component in self._robot.components:
            if component.writes_every_step and self._robot.lifecycle.writes(component.name):
                component.write(self._engine.time_ns, self._engine.step_ns)

    def reset(self) -> None:
        self._last_ns = self._engine.time_ns
        for component in self._robot.components:
            component.reset()
        self._manager.reset()
