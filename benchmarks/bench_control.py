"""Speed of the controllers: the 6-DOF arm of the peers, moved in its engine and by its stack.

Prints steps of 1 ms per CPU second beside the figures of Gazebo Classic 11: the recorded one of the
design's arm under PD servos, and one of this very arm. That one was measured so, on a machine with
two cores: ``python benchmarks/bench_control.py --sdf > arm.world``, ``gzserver arm.world``, for
each joint ``gz joint -m arm -j joint0 --pos-t 0.3 --pos-p 200 --pos-d 10``, and iterations of
``gz stats -p`` over the CPU time of gzserver (five times: 19,640 to 26,300).
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable

import mujoco
import numpy as np

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Model, World
from gazelle.engine import Engine
from gazelle.geometry import Pose
from gazelle.simulator import Simulation

RUNS = 7
DOFS = 6
GAZEBO_SERVOS = 16_100
"""Steps per CPU second of Gazebo Classic 11 with the design's arm, a PD servo a joint."""
GAZEBO_THIS_ARM = 20_450
"""The same with the arm of this file."""

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


def arm_world() -> str:
    """Return the arm as a world of SDF 1.6, without ground and stepped as fast as possible."""
    parts = [
        '<sdf version="1.6"><world name="default"><physics type="ode"><max_step_size>0.001'
        "</max_step_size><real_time_update_rate>0</real_time_update_rate></physics>"
        '<model name="arm">'
    ]
    for index, (x, y, z) in enumerate(AXES):
        mass = 3.0 - 0.4 * index
        bend, spin = mass * 0.3**2 / 12, mass * 0.05**2 / 2
        parent = f"link{index - 1}" if index else "world"
        parts.append(
            f"""<link name="link{index}"><pose>0 0 {0.3 * index} 0 0 0</pose><inertial>
            <pose>0 0 0.15 0 0 0</pose><mass>{mass}</mass><inertia><ixx>{bend}</ixx>
            <iyy>{bend}</iyy><izz>{spin}</izz></inertia></inertial></link>
            <joint name="joint{index}" type="revolute"><parent>{parent}</parent>
            <child>link{index}</child><axis><xyz>{x} {y} {z}</xyz><limit><lower>-3</lower>
            <upper>3</upper><effort>200</effort><velocity>3</velocity></limit>
            <dynamics><damping>0.1</damping></dynamics></axis></joint>"""
        )
    return "".join([*parts, "</model></world></sdf>"])


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


def described_arm() -> str:
    """Return the same arm as a ROS 1 robot under gazebo_ros_control."""
    parts = ['<robot name="arm"><link name="world"/>']
    parent = "world"
    for index, axis in enumerate(AXES):
        mass = 3.0 - 0.4 * index
        bend, spin = mass * 0.3**2 / 12, mass * 0.05**2 / 2
        parts.append(
            f"""<link name="link{index}"><inertial><origin xyz="0 0 0.15"/><mass value="{mass}"/>
            <inertia ixx="{bend}" iyy="{bend}" izz="{spin}" ixy="0" ixz="0" iyz="0"/></inertial>
            </link><joint name="joint{index}" type="revolute"><parent link="{parent}"/>
            <child link="link{index}"/><origin xyz="0 0 {0.3 if index else 0}"/>
            <axis xyz="{axis[0]} {axis[1]} {axis[2]}"/><dynamics damping="0.1"/>
            <limit lower="-3" upper="3" effort="200" velocity="3"/></joint>
            <transmission name="t{index}"><type>transmission_interface/SimpleTransmission</type>
            <joint name="joint{index}">
            <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
            <actuator name="m{index}"/></transmission>"""
        )
        parent = f"link{index}"
    parts.append(
        '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo></robot>'
    )
    return "".join(parts)


def controllers(word: str) -> dict[str, dict[str, object]]:
    """Return the parameters of a stack: one controller a joint, or one for all."""
    pid = {"p": 600.0, "i": 0.0, "d": 40.0}
    names = [f"joint{index}" for index in range(DOFS)]
    states: dict[str, dict[str, object]] = {
        "states": {"type": "joint_state_controller/JointStateController", "publish_rate": 50}
    }
    if word == "one a joint":
        kind = "effort_controllers/JointPositionController"
        return {**states, **{f"c_{n}": {"type": kind, "joint": n, "pid": pid} for n in names}}
    kind = "effort_controllers/JointGroupPositionController"
    group = {"type": kind, "joints": names, **{name: {"pid": pid} for name in names}}
    return {**states, "group": group}


def stack_factor(word: str, seconds: float) -> float:
    """Real-time factor, of CPU time, of a whole simulation with its controllers at 1 kHz."""
    stack = controllers(word)
    sim = Simulation.load(described_arm(), parameters={"arm": stack})
    manager = sim.controller_manager()
    for name in stack:
        manager.load(name)
    manager.start(*stack)
    for index in range(DOFS):
        sim.server.engine.joint(f"arm::joint{index}").set_state(0.1 * (index + 1))
    # Swinging joints keep the arm awake.
    sim.server.engine.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    try:
        return seconds / median_time(lambda: sim.run(seconds=seconds))
    finally:
        sim.close()


def print_stacks(seconds: float) -> None:
    print()
    for word in ("one a joint", "one for all"):
        factor = stack_factor(word, seconds)
        print(f"effort PID at 1 kHz, {word}: {factor:.1f} times real time on one CPU (goal 15)")


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
            f"{words}: {rate:,.0f} steps per CPU second; Gazebo Classic {GAZEBO_SERVOS:,}"
            f" (recorded), ratio {rate / GAZEBO_SERVOS:.1f}; with this arm {GAZEBO_THIS_ARM:,},"
            f" ratio {rate / GAZEBO_THIS_ARM:.1f}"
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
    parser.add_argument("--sdf", action="store_true", help="print the arm as a world for Gazebo")
    options = parser.parse_args()
    if options.sdf:
        print(arm_world())
        return
    steps = options.steps
    print(f"6-DOF arm, steps of 1 ms, median of {RUNS} runs of {steps}\n")
    print_servos(steps)
    print_calls()
    print_stacks(steps / 4000)


if __name__ == "__main__":
    main()
