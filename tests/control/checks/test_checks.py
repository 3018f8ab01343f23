"""Cross-checks before the first step: names, limits, gains."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gazelle.control.checks import (
    LoopDynamics,
    MoveItController,
    check_control,
    configured_controllers,
    disagreements,
    joint_inertias,
    largest_stable_factor,
    moveit_controllers,
    spectral_radius,
    table_text,
)
from gazelle.control.parameter_sources.ros1_parameter_server import StoreSource
from gazelle.control.resource_manager import JointResource
from gazelle.description.model import Joint, JointAxis, JointType
from gazelle.diagnostics import Diagnostics
from gazelle.simulator import Simulation
from gazelle.simulator.intra_process_node import LocalParameters

ARM = {
    "arm_controller": {
        "type": "effort_controllers/JointTrajectoryController",
        "joints": ["joint_1", "jiont_2"],
        "gains": {"joint_1": {"p": 10.0, "d": 1.0}},
    },
    "wheels": {
        "type": "diff_drive_controller/DiffDriveController",
        "left_wheel": ["left"],
        "right_wheel": "right",
    },
}
URDF = {"joint_1": "revolute", "joint_2": "revolute", "left": "continuous", "mount": "fixed"}


def _source(tree: dict[str, Any]) -> StoreSource:
    store = LocalParameters()
    store.set("/robot", tree)
    return StoreSource(store, "/robot")


def _hardware(*names: str, interface: str = "effort") -> dict[str, JointResource]:
    return {name: JointResource(name, (interface,), ("position",)) for name in names}


def test_joints_of_every_kind_of_controller_are_read() -> None:
    arm, wheels = configured_controllers(_source(ARM))
    assert arm.joints == ("joint_1", "jiont_2")
    assert [(item.joint, item.p, item.d, item.key) for item in arm.gains] == [
        ("joint_1", 10.0, 1.0, "gains.joint_1")
    ]
    assert wheels.joints == ("left", "right")
    assert wheels.gains == ()


def test_one_table_of_what_disagrees_with_nearest_names() -> None:
    rows = disagreements(
        URDF,
        _hardware("joint_1", "left", "mount"),
        configured_controllers(_source(ARM)),
        (MoveItController("arm_controler", ("joint_1", "joint_2")),),
    )
    assert table_text(rows).splitlines() == [
        "name           URDF      hardware  controllers     MoveIt",
        "mount          fixed     effort    –               –              the joint is fixed",
        "jiont_2        –         –         arm_controller  –              the robot has no such "
        "joint; did you mean 'joint_2' or 'joint_1'?",
        "right          –         –         wheels          –              the robot has no such "
        "joint",
        "joint_2        revolute  –         –               arm_controler  no transmission or "
        "<ros2_control> gives it to controllers",
        "arm_controler  –         –         –               arm_controler  no such controller is "
        "configured; did you mean 'arm_controller'?",
    ]


def test_joints_of_hardware_that_was_not_loaded_are_not_blamed_again() -> None:
    source = _source({"c": {"type": "a/B", "joints": ["joint_1", "joint_2", "jiont_2"]}})
    controllers = configured_controllers(source)
    rows = disagreements(URDF, {}, controllers, absent=("joint_1", "joint_2", "jiont_2"))
    assert [(row.name, row.remark.partition(";")[0]) for row in rows] == [
        ("jiont_2", "the robot has no such joint")
    ]


def test_word_joint_of_an_unknown_controller_need_not_mean_one() -> None:
    """Typing errors are told all the same: it may be a controller of the user's own."""
    source = _source({"twist": {"type": "a/Twist", "joints": ["tool", "joint_3", "left"]}})
    rows = disagreements(URDF, _hardware("left"), configured_controllers(source))
    assert [row.name for row in rows] == ["joint_3"]


def test_names_that_agree_give_no_table() -> None:
    source = _source({"c": {"type": "a/B", "joints": ["joint_1"]}})
    planned = (MoveItController("c", ("joint_1",)),)
    found = disagreements(URDF, _hardware("joint_1"), configured_controllers(source), planned)
    assert found == ()


def test_joint_that_moveit_plans_and_nobody_moves_is_told() -> None:
    source = _source({"c": {"type": "a/B", "joints": ["joint_1"]}})
    planned = (MoveItController("c", ("joint_1", "joint_2")),)
    hardware = _hardware("joint_1", "joint_2")
    (row,) = disagreements(URDF, hardware, configured_controllers(source), planned)
    assert row.name == "joint_2"
    assert row.remark == "MoveIt plans for it, no controller moves it"


@pytest.mark.parametrize(
    "tree",
    [
        {"controller_list": [{"name": "/c", "joints": ["a", "b"]}, "nonsense"]},
        {
            "moveit_simple_controller_manager": {
                "controller_names": ["c"],
                "c": {"joints": ["a", "b"]},
            }
        },
        {"controller_names": ["c"], "c": {"joints": ["a", "b"]}},
    ],
)
def test_both_layouts_of_moveit_are_read(tree: dict[str, Any]) -> None:
    assert moveit_controllers(tree) == (MoveItController("c", ("a", "b")),)
    assert moveit_controllers({"x": 1}) == ()


def test_all_findings_are_reported_with_their_codes() -> None:
    def joint(name: str, **limits: float) -> Joint:
        return Joint(name, JointType.REVOLUTE, "a", "b", axis=JointAxis(**limits))

    joints = {"joint_1": joint("joint_1", effort=0.0), "left": joint("left", velocity=0.0)}
    hardware = {**_hardware("joint_1"), **_hardware("left", interface="velocity")}
    found = Diagnostics()
    check_control(joints, hardware, _source(ARM), found, loop=LoopDynamics({"joint_1": 1e-4}))
    codes = [item.code for item in found]
    assert codes == [
        "control.names-disagree",
        "control.zero-limit",
        "control.zero-limit",
        "control.unstable-gains",
    ]
    messages = [item.message for item in found]
    assert "jiont_2" in messages[0]
    assert "every command is cut to 0" in messages[1]
    assert "joint 'left' has the velocity limit 0" in messages[2]
    assert (
        "gains p 10, d 1 of joint 'joint_1' are unstable: it has an inertia of 0.0001"
        in messages[3]
    )
    assert list(found)[3].fix.startswith("use at most p ")


def test_gains_of_a_controller_that_the_hardware_cannot_have_are_not_judged() -> None:
    joints = {"joint_1": Joint("joint_1", JointType.REVOLUTE, "a", "b", axis=JointAxis())}
    effort = {"type": "effort_controllers/JointPositionController", "joint": "joint_1"}
    source = _source({"one": {**effort, "pid": {"p": 800.0, "d": 80.0}}})
    for interface, codes in (("effort", ["control.unstable-gains"]), ("position", [])):
        found = Diagnostics()
        hardware = _hardware("joint_1", interface=interface)
        check_control(joints, hardware, source, found, loop=LoopDynamics({"joint_1": 1e-4}))
        assert [item.code for item in found] == codes


def test_unclaimed_joint_may_have_zero_limits() -> None:
    joints = {"x": Joint("x", JointType.REVOLUTE, "a", "b", axis=JointAxis(effort=0.0))}
    found = Diagnostics()
    check_control(joints, _hardware("x"), _source({}), found)
    assert not list(found)


@pytest.mark.parametrize("period_steps", [1, 2, 5])
@pytest.mark.parametrize(("p", "d"), [(1000.0, 9.0), (10.0, 5.0), (500.0, 3.0)])
def test_verdict_is_that_of_the_motion(p: float, d: float, period_steps: int) -> None:
    inertia, step_s = 1e-3, 1e-3
    factor = largest_stable_factor(p, d, inertia, step_s, period_steps=period_steps)
    assert 0 < factor < 1
    for scale, diverges in ((0.98 * factor, False), (1.02 * factor, True)):
        last = _swing(scale * p, scale * d, inertia, step_s, period_steps)
        assert (last > 1e3) == diverges


def _swing(p: float, d: float, inertia: float, step_s: float, period_steps: int) -> float:
    """Return the largest deflection at the end of a run that starts at 1."""
    q, v, before, effort, largest = 1.0, 0.0, 1.0, 0.0, 0.0
    for k in range(20_000):
        if k % period_steps == 0:
            effort = -p * q - d * (q - before) / (step_s * period_steps)
            before = q
        v += step_s * effort / inertia
        q += step_s * v
        if k > 18_000:
            largest = max(largest, abs(q))
        if abs(q) > 1e6:
            return abs(q)
    return largest


def test_every_step_is_jurys_criterion() -> None:
    h, inertia = 1e-3, 0.02
    for p, d in ((1e4, 10.0), (7e4, 4.9), (1.0, 19.0), (7.9e4, 0.01)):
        jury = p * h * h / inertia + 2 * d * h / inertia < 4
        assert (spectral_radius(p, d, inertia, h) <= 1 + 1e-9) == jury


def test_velocity_gains_are_stable_up_to_twice_inertia_per_step() -> None:
    assert largest_stable_factor(4.0, 0.0, 1e-3, 1e-3, of_velocity=True) == pytest.approx(0.5)
    assert largest_stable_factor(1.9, 0.0, 1e-3, 1e-3, of_velocity=True) == 1.0


def test_damping_of_the_joint_helps() -> None:
    args = (20.0, 0.0, 1e-3, 1e-3)
    weak = spectral_radius(*args, period_steps=4)
    strong = spectral_radius(*args, period_steps=4, damping=2.0)
    assert weak > 1 > strong


def test_gains_without_damping_at_a_long_period_are_told_to_add_some() -> None:
    tree = {"c": {"type": "effort_controllers/JointPositionController", "joint": "j"}}
    tree["c"]["pid"] = {"p": 20.0}
    joints = {"j": Joint("j", JointType.REVOLUTE, "a", "b", axis=JointAxis())}
    found = Diagnostics()
    check_control(
        joints, _hardware("j"), _source(tree), found, loop=LoopDynamics({"j": 1e-3}, period_steps=4)
    )
    (only,) = found
    assert only.fix == "every p needs some d at this period: try d 0.08"
    assert spectral_radius(20.0, 0.08, 1e-3, 1e-3, period_steps=4) < 1


_TWO_LINKS = """
<robot name="arm">
  <link name="world"/>
  <link name="a"><inertial><mass value="2"/><origin xyz="0.5 0 0"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.04"/></inertial></link>
  <link name="b"><inertial><mass value="1"/><origin xyz="0.3 0 0"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
  <joint name="one" type="continuous"><parent link="world"/><child link="a"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="two" type="continuous"><parent link="a"/><child link="b"/>
    <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"""


def test_inertia_is_the_effort_over_the_acceleration_of_a_free_joint() -> None:
    with Simulation.load(_TWO_LINKS, world=None) as sim:
        engine = sim.server.engine
        found = joint_inertias(engine, ["arm::one", "arm::two"])
        for name in ("one", "two"):
            sim.reset()
            sim.joint(name).command_effort(1e-3)
            sim.step(1)
            acceleration = sim.joint(name).velocity / sim.step_s
            assert found[f"arm::{name}"] == pytest.approx(1e-3 / acceleration, rel=1e-3)
            sim.joint(name).release()
    # The outer joint moves the inner link the other way: less than izz + m r² of its own.
    assert found["arm::two"] < 0.02 + 1 * 0.3**2
    assert np.isfinite(list(found.values())).all()
