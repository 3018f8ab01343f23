"""Speed of the controllers: the 6-DOF arm of the peers, moved in its engine and by its stack.

Prints steps of 1 ms per CPU second beside the figures that were recorded of Gazebo Classic 11 for
the same arm. Run it with ``python benchmarks/bench_control.py``.
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import numpy as np

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Model, World
from gazelle.engine import Engine
from gazelle.geometry import Pose

RUNS = 7
DOFS = 6
GAZEBO_SERVOS = 16_100
"""Steps per CPU second of Gazebo Classic 11 with this arm under a PD servo a joint."""

AXES = ((0, 0, 1), (0, 1, 0), (0, 1, 0), (1, 0, 0), (0, 1, 0), (1, 0, 0))


def arm() -> Model:
    """Six rods of 0.3 m on the world; no collisions."""
    links, joints = [], []
    for index, axis in enumerate(AXES):
        mass = 3.0 - 0.4 * index
        bend = mass * 0.3**2 / 12
        inertia = (bend, 0.0, 0.0, bend, 0.0, mass * 0.05**2 / 2)
        pose = Pose((0.0, 0.0, 0.3 * index))
        links.append(
            Link(f"link{index}", pose, inertial=Inertial(mass, Pose((0, 0, 0.15)), inertia))
        )
        limits = JointAxis(axis, lower=-3.0, upper=3.0, effort=200.0, velocity=3.0, damping=0.1)
        parent = f"link{index - 1}" if index else "world"
        joints.append(
            Joint(f"joint{index}", JointType.REVOLUTE, parent, links[-1].name, pose, axis=limits)
        )
    return Model("arm", links=tuple(links), joints=tuple(joints))


def engine_of_arm() -> Engine:
    return Engine(World(models=(arm(),)))


def wave(step: int) -> np.ndarray:
    return 0.5 * np.sin(0.002 * step + np.arange(DOFS))


def servo_rate(steps: int, period: int) -> float:
    """Steps per CPU second of joints locked to a moving position, commanded every few steps."""
    engine = engine_of_arm()
    group = engine.joint_group([f"arm::joint{index}" for index in range(DOFS)])
    targets = [wave(step) for step in range(0, steps + period, period)]

    def run() -> None:
        for target in targets:
            group.lock_position(target, steps=period)
            engine.step(period)

    return steps / median_time(run)


def motor_rate(steps: int) -> float:
    """Steps per CPU second of position motors with their efforts limited, holding."""
    engine = engine_of_arm()
    for index in range(DOFS):
        engine.joint(f"arm::joint{index}").set_position_target(0.3 + 0.1 * index)

    def run() -> None:
        for step in range(0, steps, 100):
            engine.joint("arm::joint0").set_position_target(0.3 + 0.001 * (step % 200))
            engine.step(100)

    return steps / median_time(run)


def call_us(action: Callable[[], object], calls: int = 20_000) -> float:
    def run() -> None:
        for _ in range(calls):
            action()

    return median_time(run) / calls * 1e6


def median_time(run: Callable[[], object]) -> float:
    run()
    times = []
    for _ in range(RUNS):
        start = time.process_time()
        run()
        times.append(time.process_time() - start)
    return statistics.median(times)


def print_servos(steps: int) -> None:
    for words, rate in (
        ("position servos (a command every 10 steps)", servo_rate(steps, 10)),
        ("position servos (a command every step)", servo_rate(steps, 1)),
        ("position motors with effort limits", motor_rate(steps)),
    ):
        print(
            f"{words}: {rate:,.0f} steps per CPU second, Gazebo Classic {GAZEBO_SERVOS:,}"
            f" (recorded), ratio {rate / GAZEBO_SERVOS:.1f}"
        )


def print_calls() -> None:
    engine = engine_of_arm()
    group = engine.joint_group([f"arm::joint{index}" for index in range(DOFS)])
    position, velocity, effort = np.zeros((3, DOFS))
    for words, action in (
        ("read", lambda: group.read(position, velocity)),
        ("set_effort", lambda: group.set_effort(effort)),
    ):
        print(f"{words} of {DOFS} joints: {call_us(action):.1f} µs a call")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--steps", type=int, default=20_000, help="steps per run")
    steps = parser.parse_args().steps
    print(f"6-DOF arm, steps of 1 ms, median of {RUNS} runs of {steps}\n")
    print_servos(steps)
    print_calls()


if __name__ == "__main__":
    main()
