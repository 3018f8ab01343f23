"""Tasks that fall due at exact steps of simulated time; nothing polls between them."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction

__all__ = [
    "NEVER",
    "ORDER_CLOCK",
    "ORDER_CONTROL",
    "ORDER_SENSOR",
    "ORDER_STATE",
    "Scheduler",
    "Task",
    "period_in_steps",
    "sensor_period_in_steps",
]

NEVER = 2**62
# Gazebo's order within one step: clock, model plug-ins, sensors, then the world's states.
ORDER_CLOCK = 0
ORDER_CONTROL = 10
ORDER_SENSOR = 20
ORDER_STATE = 30

# A task nobody wants looks again this often, in simulated time.
_IDLE_NS = 20_000_000


@dataclass(slots=True, eq=False)
class Task:
    """Something to do every so many steps.

    Attributes:
        name: for profiles and messages.
        period_steps: exact period; a fraction keeps the mean rate exact, each tick falls on the
            first step that is not early.
        action: what to do, called with the world standing at that step.
        order: tasks due at the same step run in this order, then as they were added.
        wanted: asked before `action`; False skips the tick and looks again 20 ms later.
        runs: how often `action` has run.
    """

    name: str
    period_steps: Fraction
    action: Callable[[], None]
    order: int = ORDER_CONTROL
    wanted: Callable[[], bool] | None = None
    runs: int = 0
    _start: int = 0
    _tick: int = 0
    _sequence: int = 0
    _alive: bool = field(default=True, repr=False)

    def _due(self) -> int:
        return self._start + math.ceil(self._tick * self.period_steps)


def period_in_steps(rate_hz: float, step_ns: int) -> Fraction:
    """Return the exact period of a plug-in's ``updateRate``; 0 Hz or less means every step.

    Gazebo's plug-ins add the period to the time of the last update, so the mean rate is exact.
    A period shorter than a step is a step.
    """
    if rate_hz <= 0:
        return Fraction(1)
    period = Fraction(1_000_000_000) / (Fraction(rate_hz).limit_denominator(1_000_000) * step_ns)
    return max(period, Fraction(1))


def sensor_period_in_steps(rate_hz: float, step_ns: int) -> Fraction:
    """Return the period of a sensor's ``update_rate`` in whole steps, rounded up.

    Gazebo's sensors measure from the last update, so 5.5 Hz on 1 ms steps is 182 ms.
    """
    return Fraction(math.ceil(period_in_steps(rate_hz, step_ns)))


class Scheduler:
    """All tasks of a world, the next one first."""

    def __init__(self, step_ns: int) -> None:
        self._heap: list[tuple[int, int, int, Task]] = []
        self._sequence = 0
        self._now = 0
        self._step_ns = step_ns

    def set_step(self, step_ns: int) -> None:
        """Take over a new step size; every task keeps its rate, counted from now."""
        factor = Fraction(self._step_ns, step_ns)
        self._step_ns = step_ns
        for task in tuple(self):
            period = max(task.period_steps * factor, Fraction(1))
            if task.order == ORDER_SENSOR:
                period = Fraction(math.ceil(period))
            self.change_period(task, period)

    def add(self, task: Task, *, first: int | None = None) -> Task:
        """Add a task; its first tick is one period from now, or at iteration `first`."""
        task._sequence = self._sequence
        task._alive = True
        self._sequence += 1
        task._start, task._tick = (self._now, 1) if first is None else (first, 0)
        self._push(task)
        return task

    def remove(self, task: Task) -> None:
        """Drop a task; removing it twice does nothing."""
        task._alive = False
        self._heap = [entry for entry in self._heap if entry[3] is not task]
        heapq.heapify(self._heap)

    def change_period(self, task: Task, period_steps: Fraction) -> None:
        """Give a task another period, counted from now."""
        self.remove(task)
        task.period_steps = period_steps
        self.add(task)

    def next_due(self) -> int:
        """Return the iteration of the next tick, `NEVER` when there is no task."""
        return self._heap[0][0] if self._heap else NEVER

    def run_due(self, iteration: int) -> int:
        """Run every task due at or before `iteration`, in order; return how many ran."""
        self._now = iteration
        ran = 0
        while self._heap and self._heap[0][0] <= iteration:
            task = heapq.heappop(self._heap)[3]
            if task.wanted is None or task.wanted():
                task._tick += 1
                self._push(task)
                task.runs += 1
                ran += 1
                task.action()
            else:
                task._tick += self._idle_ticks(task)
                self._push(task)
        return ran

    def restart(self) -> None:
        """Start all tasks over after simulated time went back to zero."""
        self._now = 0
        tasks = sorted((entry[3] for entry in self._heap), key=lambda task: task._sequence)
        self._heap = []
        for task in tasks:
            task._start, task._tick = 0, 1
            self._push(task)

    def __iter__(self) -> Iterator[Task]:
        """Iterate over the tasks in the order they were added."""
        return iter(sorted((entry[3] for entry in self._heap), key=lambda task: task._sequence))

    def _idle_ticks(self, task: Task) -> int:
        period_ns = task.period_steps * self._step_ns
        return max(1, int(_IDLE_NS // period_ns))

    def _push(self, task: Task) -> None:
        if task._alive:
            heapq.heappush(self._heap, (task._due(), task.order, task._sequence, task))
