"""Tasks that fall due at exact steps of simulated time; nothing polls between them."""

from __future__ import annotations

import heapq
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction

__all__ = [
    "NEVER",
    "ORDER_CLOCK",
    "ORDER_CONTROL",
    "ORDER_SENSOR",
    "ORDER_STATE",
    "Scheduler",
    "Task",
    "gz_sensor_period_in_steps",
    "measured_period_in_steps",
    "period_in_steps",
    "throttled_period_in_steps",
]

NEVER = 2**62
# Gazebo's order within one step: clock, model plug-ins, sensors, then the world's states.
ORDER_CLOCK = 0
ORDER_CONTROL = 10
ORDER_SENSOR = 20
ORDER_STATE = 30

# Tasks nobody wants are asked again this often, in simulated time: a question costs up to some
# microseconds, and none of them may cut the engine's steps into smaller pieces.
_LOOK_NS = 50_000_000
_MS_NS = 1_000_000


@dataclass(slots=True, eq=False)
class Task:
    """Something to do every so many steps.

    Attributes:
        name: for profiles and messages.
        period_steps: exact period; a fraction keeps the mean rate exact, each tick falls on the
            first step that is not early.
        action: what to do, called with the world standing at that step.
        order: tasks due at the same step run in this order, then as they were added.
        wanted: asked before `action`; when it says no the task sleeps and is asked again at least
            every 50 ms, and whenever `Scheduler.look` is called.
        has_failed: `action` raised something, in a world that goes on all the same.
    """

    name: str
    period_steps: Fraction
    action: Callable[[], None]
    order: int = ORDER_CONTROL
    wanted: Callable[[], bool] | None = None
    has_failed: bool = False
    _start: int = 0
    _tick: int = 0
    _ratio: tuple[int, int] = (1, 1)
    _sequence: int = 0

    def _due(self) -> int:
        # The ceiling of tick × period in whole numbers; Fraction's own arithmetic is slow.
        numerator, denominator = self._ratio
        return self._start - (-self._tick * numerator // denominator)

    def _skip_to(self, iteration: int) -> None:
        """Take the first tick that is not before an iteration."""
        numerator, denominator = self._ratio
        passed = max(0, iteration - self._start - 1)
        self._tick = max(self._tick, passed * denominator // numerator)
        while self._due() < iteration:
            self._tick += 1


def period_in_steps(rate_hz: float, step_ns: int) -> Fraction:
    """Return the exact period of an ``update_rate``; 0 Hz or less means every step.

    Gazebo's cameras carry the delay of one update over to the next, and its plug-ins add the
    period to the time of the last update: both have the mean rate that they are asked for, 30 Hz
    on 1 ms steps in periods of 34, 33 and 33 ms. A period shorter than a step is a step.
    """
    if rate_hz <= 0:
        return Fraction(1)
    return max(_exact(rate_hz, step_ns), Fraction(1))


def measured_period_in_steps(rate_hz: float, step_ns: int) -> Fraction:
    """Return the period of what measures from its last update: whole steps, rounded up.

    So do Gazebo's sensors that are not rendered, whose thread sleeps for a period after each
    update: 5.5 Hz on 1 ms steps is 182 ms.
    """
    return Fraction(math.ceil(period_in_steps(rate_hz, step_ns)))


def gz_sensor_period_in_steps(rate_hz: float, step_ns: int) -> Fraction:
    """Return the period of a gz sensor, which counts in whole milliseconds, rounded down.

    So 30 Hz is 33 ms there. Above 1000 Hz the rate is taken as it is.
    """
    whole_ms = math.floor(_exact(rate_hz, _MS_NS)) if rate_hz > 0 else 0
    if not whole_ms:
        return period_in_steps(rate_hz, step_ns)
    return max(Fraction(whole_ms * _MS_NS, step_ns), Fraction(1))


def throttled_period_in_steps(period: Fraction, rate_hz: float, step_ns: int) -> Fraction:
    """Return the period of a plug-in that skips whole readings of its sensor; 0 Hz skips none.

    Args:
        period: of the sensor, steps.
        rate_hz: of the plug-in.
        step_ns: the world's step.
    """
    if rate_hz <= 0:
        return period
    return period * max(1, math.ceil(_exact(rate_hz, step_ns) / period))


def _exact(rate_hz: float, step_ns: int) -> Fraction:
    return Fraction(1_000_000_000) / (Fraction(rate_hz).limit_denominator(1_000_000) * step_ns)


class Scheduler:
    """All tasks of a world, the next one first."""

    def __init__(self, step_ns: int) -> None:
        self._heap: list[tuple[int, int, int, Task]] = []
        self._asleep: list[Task] = []
        self._sequence = 0
        self._now = 0
        self._step_ns = step_ns
        self._next_look = 0

    def set_step(self, step_ns: int) -> None:
        """Take over a new step size; every task keeps its rate, counted from now."""
        factor = Fraction(self._step_ns, step_ns)
        self._step_ns = step_ns
        for task in tuple(self):
            self.change_period(task, max(task.period_steps * factor, Fraction(1)))

    def add(self, task: Task, *, first: int | None = None) -> Task:
        """Add a task; its first tick is one period from now, or at iteration `first`."""
        task._sequence = self._sequence
        self._sequence += 1
        task._start, task._tick = (self._now, 1) if first is None else (first, 0)
        self._enter(task)
        return task

    def remove(self, task: Task) -> None:
        """Drop a task; removing it twice does nothing."""
        self._asleep = [item for item in self._asleep if item is not task]
        self._heap = [entry for entry in self._heap if entry[3] is not task]
        heapq.heapify(self._heap)

    def change_period(self, task: Task, period_steps: Fraction) -> None:
        """Give a task another period, counted from now."""
        self.remove(task)
        task.period_steps = period_steps
        task._start, task._tick = self._now, 1
        self._enter(task)

    def next_due(self) -> int:
        """Return the iteration to call `run_due` at, `NEVER` when there is no task."""
        due = self._heap[0][0] if self._heap else NEVER
        # Looking after sleeping tasks waits for the next tick of others, but not for long.
        return min(due, self._next_look + self._look_steps()) if self._asleep else due

    def run_due(
        self, iteration: int, failed: Callable[[Task, Exception], None] | None = None
    ) -> int:
        """Run every task due at or before `iteration`, in order; return how many ran.

        Args:
            iteration: where the world stands.
            failed: told what a task raised, the others run; None lets it through.
        """
        self._now = iteration
        if self._asleep and iteration >= self._next_look:
            self.look()
        heap, ran = self._heap, 0
        while heap and heap[0][0] <= iteration:
            task = heap[0][3]
            if task.wanted is not None and not task.wanted():
                heapq.heappop(heap)
                self._asleep.append(task)
                continue
            task._tick += 1
            heapq.heapreplace(heap, (task._due(), task.order, task._sequence, task))
            ran += 1
            try:
                task.action()
            except Exception as error:
                if failed is None:
                    raise
                failed(task, error)
            heap = self._heap
        return ran

    def look(self) -> None:
        """Ask the sleeping tasks whether they are wanted now; those that are keep their ticks."""
        self._next_look = self._now + self._look_steps()
        if not self._asleep:
            return
        sleepers, self._asleep = self._asleep, []
        for task in sleepers:
            if task.wanted is None or task.wanted():
                task._skip_to(self._now)
                self._push(task)
            else:
                self._asleep.append(task)

    def rest(self) -> None:
        """Put to sleep what nobody wants now; otherwise that happens when it is due first."""
        idle = [
            entry[3]
            for entry in self._heap
            if entry[3].wanted is not None and not entry[3].wanted()
        ]
        for task in idle:
            self.remove(task)
        self._asleep += idle

    def restart(self) -> None:
        """Start all tasks over after simulated time went back to zero."""
        tasks = tuple(self)
        self._now = self._next_look = 0
        self._heap, self._asleep = [], []
        for task in tasks:
            task._start, task._tick = 0, 1
            self._push(task)

    def __iter__(self) -> Iterator[Task]:
        """Iterate over the tasks in the order they were added."""
        tasks = [*(entry[3] for entry in self._heap), *self._asleep]
        return iter(sorted(tasks, key=lambda task: task._sequence))

    def _look_steps(self) -> int:
        return max(1, _LOOK_NS // self._step_ns)

    def _enter(self, task: Task) -> None:
        task._ratio = (task.period_steps.numerator, task.period_steps.denominator)
        self._push(task)

    def _push(self, task: Task) -> None:
        heapq.heappush(self._heap, (task._due(), task.order, task._sequence, task))
