"""What the system does to a running world."""

from __future__ import annotations

import math

import pytest

from gazelle.simulator.wall_clock import Disturbances

_STOOD_STILL = (
    "nothing was computed for 20.0 s: this process was stopped, or the machine had no time for "
    "it; the world goes on from 12.500 s"
)


class Clock:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


class Machine:
    """A process with clocks that the test moves."""

    def __init__(self) -> None:
        self.wall, self.monotonic, self.computing = Clock(), Clock(), Clock()
        self._disturbances = Disturbances(
            wall=self.wall, monotonic=self.monotonic, computing=self.computing
        )

    def told(self, seconds: float, *, work_s: float, idle_s: float = 0.0) -> list[str]:
        """Return what is said after so many seconds with so much computing."""
        self.wall.now_s += seconds
        self.monotonic.now_s += seconds
        self.computing.now_s += work_s
        return list(self._disturbances.look(12.5, idle_s))


@pytest.fixture
def machine() -> Machine:
    return Machine()


def test_a_long_time_without_computing_is_a_standstill(machine: Machine) -> None:
    assert machine.told(20.0, work_s=0.1) == [_STOOD_STILL]
    assert machine.told(0.01, work_s=0.0) == []


def test_compiling_is_no_standstill(machine: Machine) -> None:
    assert machine.told(20.0, work_s=15.0) == []


@pytest.mark.parametrize("idle_s", [19.0, math.inf], ids=["slow world", "paused"])
def test_waiting_for_the_next_step_is_no_standstill(machine: Machine, idle_s: float) -> None:
    assert machine.told(20.0, work_s=0.0, idle_s=idle_s) == []


def test_a_clock_that_is_set_is_told_one_that_is_corrected_is_not(machine: Machine) -> None:
    machine.wall.now_s += 0.02
    assert machine.told(1.0, work_s=1.0) == []
    machine.wall.now_s -= 3600.04
    assert machine.told(1.0, work_s=1.0, idle_s=math.inf) == [
        "the system's clock was set back by 3600.0 s; simulated time goes on as before, stamps of "
        "the system's clock jump"
    ]
    assert machine.told(1.0, work_s=1.0) == []
