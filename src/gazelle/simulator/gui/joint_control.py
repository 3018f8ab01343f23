"""Forces and targets that a person gives to joints: Gazebo's Joints tab."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

from gazelle.errors import NotFoundError
from gazelle.simulator.plugins.gazebo_pid import GazeboPid
from gazelle.simulator.scheduler import ORDER_CONTROL, Task

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["Gains", "JointControl"]

_EVERY_STEP = Fraction(1)


class Gains(NamedTuple):
    """PID gains; Gazebo's tab starts with 1, 0.1 and 0.01."""

    p: float = 1.0
    i: float = 0.1
    d: float = 0.01


class JointControl:
    """One command at a time for each joint; it acts until it is replaced or freed."""

    def __init__(self, server: WorldServer) -> None:
        """Command nothing."""
        self._server = server
        self._tasks: dict[str, Task] = {}
        server.world_resources.on_calm(self._forget)

    def push(self, name: str, effort: float) -> None:
        """Keep a force (N) or torque (N·m) on ``model::joint``.

        Raises:
            NotFoundError: there is no such joint.
        """
        self.free(name)
        self._server.engine.joint(name).set_effort(effort)

    def hold(self, name: str, position: float, gains: Gains) -> None:
        """Drive a joint to a position, rad or m, with a PID on its effort.

        Raises:
            NotFoundError: there is no such joint.
        """
        joint = self._server.engine.joint(name)
        self._drive(name, gains, lambda: joint.position - position)

    def turn(self, name: str, velocity: float, gains: Gains) -> None:
        """Keep a joint at a velocity, rad/s or m/s, with a PID on its effort.

        Raises:
            NotFoundError: there is no such joint.
        """
        joint = self._server.engine.joint(name)
        self._drive(name, gains, lambda: joint.velocity - velocity, of_velocity=True)

    def free(self, name: str) -> None:
        """End what was commanded.

        Raises:
            NotFoundError: there is no such joint.
        """
        task = self._tasks.pop(name, None)
        if task is not None:
            self._server.scheduler.remove(task)
        self._server.engine.joint(name).set_feedback(0.0, 0.0, 0.0)

    def _forget(self, model: str) -> None:
        for name in [one for one in self._tasks if one.startswith(f"{model}::")]:
            self._server.scheduler.remove(self._tasks.pop(name))

    def _drive(
        self, name: str, gains: Gains, error: Callable[[], float], *, of_velocity: bool = False
    ) -> None:
        self.free(name)
        engine = self._server.engine
        joint = engine.joint(name)
        stiffness, damping = (0.0, gains.p) if of_velocity else (gains.p, gains.d)
        pid = GazeboPid(gains.p, gains.i, gains.d)

        def update() -> None:
            try:
                effort = pid.update(error(), engine.step_ns * 1e-9)
                joint.set_feedback(effort, stiffness, damping)
            except NotFoundError:
                # Its model was deleted.
                self._server.scheduler.remove(self._tasks.pop(name))

        task = Task(f"joint {name}", _EVERY_STEP, update, ORDER_CONTROL)
        self._tasks[name] = self._server.scheduler.add(task)
