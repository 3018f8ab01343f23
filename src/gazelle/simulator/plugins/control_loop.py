"""The control loop of a robot as tasks of the world, for ROS 1 and ROS 2."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from gazelle.control.robot import Robot
from gazelle.simulator.plugins.context import PluginContext

if TYPE_CHECKING:
    from gazelle.control.controller_manager import ControllerManager

__all__ = ["check_controllers", "control_period", "run_control_loop"]


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
