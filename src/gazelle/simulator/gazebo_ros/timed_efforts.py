"""Efforts and wrenches that begin later or end by themselves."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gazelle.interfaces.stamps import ns_of
from gazelle.simulator.scheduler import ORDER_CONTROL, Task

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["JointEfforts", "at_time", "duration_ns"]


def duration_ns(duration: Any) -> int | None:
    """Return a ROS duration in nanoseconds, None for a negative one: for ever."""
    total = ns_of(duration)
    return None if total < 0 else total


def at_time(server: WorldServer, start: Any, action: Callable[[], None]) -> None:
    """Run an action now, or at a simulated time (``builtin_interfaces/Time``) in the future."""
    wait_ns = ns_of(start) - server.time_ns
    if wait_ns <= 0:
        action()
    else:
        once(server, wait_ns, action)


def once(server: WorldServer, wait_ns: int, action: Callable[[], None]) -> None:
    """Run an action once after some simulated time, on the first step that is not early."""
    steps = max(1, -(-wait_ns // server.engine.step_ns))
    first = server.engine.iteration + steps

    def run() -> None:
        server.scheduler.remove(task)
        action()

    task = Task("once", Fraction(steps), run, ORDER_CONTROL)
    server.scheduler.add(task, first=first)


class JointEfforts:
    """Sums the efforts that ``apply_joint_effort`` put on joints and ends them in time."""

    def __init__(self, server: WorldServer) -> None:
        self._server = server
        self._active: dict[str, list[float]] = {}

    def add(self, joint: str, effort: float, start: Any, duration: Any) -> None:
        """Apply an effort from a time on for a duration; a negative one is for ever."""
        lasting = duration_ns(duration)
        entry = float(effort)

        def begin() -> None:
            self._active.setdefault(joint, []).append(entry)
            self._write(joint)
            if lasting is not None:
                once(self._server, lasting, end)

        def end() -> None:
            if entry in self._active.get(joint, []):
                self._active[joint].remove(entry)
                self._write(joint)

        at_time(self._server, start, begin)

    def clear(self, joint: str) -> None:
        """End all efforts on a joint."""
        if self._active.pop(joint, None) is not None:
            self._server.engine.joint(joint).set_effort(0.0)

    def forget(self, model: str) -> None:
        """End all efforts on a model's joints; it was brought to rest."""
        for joint in [one for one in self._active if one.startswith(f"{model}::")]:
            del self._active[joint]

    def _write(self, joint: str) -> None:
        engine = self._server.engine
        # Its model may have gone since it was asked for, or another has its name.
        if joint in engine.joint_names and engine.joint(joint).is_driveable:
            engine.joint(joint).set_effort(sum(self._active[joint]))
