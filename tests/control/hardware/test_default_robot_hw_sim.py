from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.hardware.rig import INERTIA, STEP_S, Rig, ros1_rig, rotor, transmission

FREE = 'effort="10" velocity="1000"'


def effort_rig(limit: str = FREE, kind: str = "continuous", more: str = "") -> Rig:
    return ros1_rig(rotor("j", kind, limit, more=more), transmission("j"))


def test_an_effort_accelerates_a_joint_by_effort_over_inertia() -> None:
    rig = effort_rig()
    rig.claim("j/effort")
    rig.run(500, j_effort=2.0)
    assert rig.velocity("j") == pytest.approx(2.0 / INERTIA * 0.5, rel=1e-9)
    assert rig.state("j/position") == pytest.approx(rig.position("j"))
    assert rig.state("j/velocity") == pytest.approx(rig.velocity("j"))
    assert rig.state("j/effort") == 2.0


def test_an_effort_is_cut_at_its_limit_and_controllers_see_that() -> None:
    rig = effort_rig('effort="3" velocity="1000"')
    rig.claim("j/effort")
    rig.run(500, j_effort=99.0)
    assert rig.velocity("j") == pytest.approx(3.0 / INERTIA * 0.5, rel=1e-9)
    assert rig.robot.interface_values.commands.tolist() == [3.0]


def test_the_velocity_limit_cuts_efforts_and_does_not_brake() -> None:
    rig = effort_rig('effort="10" velocity="2"')
    rig.claim("j/effort")
    rig.run(1000, j_effort=5.0)
    # It passes the limit within one step of 5 N·m and coasts.
    assert 2.0 <= rig.velocity("j") <= 2.0 + 5.0 / INERTIA * STEP_S


def test_a_soft_limit_stops_a_joint_before_the_hard_one() -> None:
    safety = (
        '<safety_controller soft_lower_limit="-1" soft_upper_limit="1" k_position="8" '
        'k_velocity="20"/>'
    )
    limit = 'lower="-1.5" upper="1.5" effort="10" velocity="2"'
    rig = effort_rig(limit, "revolute", safety)
    rig.claim("j/effort")
    positions = rig.run(8000, j_effort=5.0)[:, 0]
    # At rest the effort that is left is k_velocity · k_position · (limit − position): none.
    assert positions.max() < 1.2
    assert positions[-1] == pytest.approx(1.0, abs=0.02)


def test_commands_start_at_zero_and_stay_after_release() -> None:
    rig = effort_rig()
    rig.run(100)
    assert rig.velocity("j") == 0.0
    rig.claim("j/effort")
    rig.run(100, j_effort=2.0)
    rig.drop("j/effort")
    before = rig.velocity("j")
    rig.run(100)
    # Gazebo leaves the last effort of a stopped controller on the joint.
    assert rig.velocity("j") - before == pytest.approx(2.0 / INERTIA * 0.1, rel=1e-9)


def test_a_position_joint_follows_no_faster_than_its_velocity_limit() -> None:
    rig = ros1_rig(rotor("j"), transmission("j", "Position"))
    rig.claim("j/position")
    positions = rig.run(400, j_position=1.0)[:, 0]
    assert np.diff(positions[:200]) == pytest.approx(4.0 * STEP_S, abs=1e-7)
    assert positions[-1] == pytest.approx(1.0, abs=1e-7)


def test_a_position_joint_turns_back_to_where_it_came_from() -> None:
    rig = ros1_rig(rotor("j"), transmission("j", "Position"))
    rig.claim("j/position")
    rig.run(300, j_position=1.0)
    rig.run(100, j_position=-1.0)
    positions = rig.run(300, j_position=1.0)[:, 0]
    assert np.diff(positions[:90]) == pytest.approx(4.0 * STEP_S, abs=1e-7)
    assert positions[-1] == pytest.approx(1.0, abs=1e-7)


def test_a_position_joint_carries_any_load() -> None:
    arm = rotor("j", limit='lower="-3" upper="3" effort="0.001" velocity="100"', axis="0 1 0")
    arm = arm.replace('<mass value="1"/>', '<origin xyz="1 0 0"/><mass value="50"/>')
    rig = ros1_rig(arm, transmission("j", "Position"), gravity=True)
    rig.claim("j/position")
    rig.run(300, j_position=0.5)
    assert rig.position("j") == pytest.approx(0.5, abs=1e-6)


def test_a_velocity_joint_has_a_motor_with_the_effort_limit() -> None:
    limit = 'lower="-30" upper="30" effort="2" velocity="4"'
    rig = ros1_rig(rotor("j", limit=limit), transmission("j", "Velocity"))
    rig.claim("j/velocity")
    rig.run(100, j_velocity=3.0)
    assert rig.velocity("j") == pytest.approx(2.0 / INERTIA * 0.1, rel=1e-3)
    rig.run(1900, j_velocity=3.0)
    assert rig.velocity("j") == pytest.approx(3.0, abs=1e-4)
    rig.run(500, j_velocity=9.0)
    assert rig.velocity("j") == pytest.approx(4.0, abs=1e-4)


def test_a_velocity_joint_without_effort_cannot_move() -> None:
    limit = 'lower="-3" upper="3" effort="0" velocity="4"'
    rig = ros1_rig(rotor("j", limit=limit), transmission("j", "Velocity"))
    rig.claim("j/velocity")
    rig.run(200, j_velocity=3.0)
    assert rig.velocity("j") == 0.0


GAINS = {"gazebo_ros_control": {"pid_gains": {"j": {"p": 20.0, "i": 0.0, "d": 4.0}}}}


def test_a_position_joint_with_gains_gets_the_effort_of_its_pid() -> None:
    limit = 'lower="-3" upper="3" effort="10" velocity="1000"'
    rig = ros1_rig(rotor("j", limit=limit), transmission("j", "Position"), parameters=GAINS)
    rig.claim("j/position")
    measured = rig.run(1500, j_position=0.4)[:, 0]
    position, speed, last, expected = 0.0, 0.0, 0.0, []
    for _ in range(1500):
        error = 0.4 - position
        effort = float(np.clip(20.0 * error + 4.0 * (error - last) / STEP_S, -10.0, 10.0))
        last = error
        speed += effort / INERTIA * STEP_S
        position += speed * STEP_S
        expected.append(position)
    assert measured == pytest.approx(expected, abs=1e-9)
    assert "control.ideal-servo" not in rig.codes()


def test_a_velocity_joint_with_gains_gets_the_effort_of_its_pid() -> None:
    gains = {"gazebo_ros_control": {"pid_gains": {"j": {"p": 2.0}}}}
    rig = ros1_rig(rotor("j", "continuous", FREE), transmission("j", "Velocity"), parameters=gains)
    rig.claim("j/velocity")
    rig.run(500, j_velocity=3.0)
    assert rig.velocity("j") == pytest.approx(3.0 * (1 - math.exp(-2.0 / INERTIA * 0.5)), rel=2e-3)


def test_pids_run_at_every_step_between_two_updates() -> None:
    rig = ros1_rig(rotor("j"), transmission("j", "Position"), parameters=GAINS)
    rig.period = 10
    assert rig.hardware.writes_every_step
    rig.claim("j/position")
    rig.run(2000, j_position=0.4)
    assert rig.position("j") == pytest.approx(0.4, abs=0.02)


def test_pid_of_a_continuous_joint_goes_the_short_way() -> None:
    rig = ros1_rig(rotor("j", "continuous", FREE), transmission("j", "Position"), parameters=GAINS)
    rig.claim("j/position")
    positions = rig.run(3000, j_position=math.pi + 1.0)[:, 0]
    assert positions[-1] == pytest.approx(1.0 - math.pi, abs=1e-2)


def test_position_joints_without_gains_are_said_to_be_ideal() -> None:
    rig = ros1_rig(rotor("j"), transmission("j", "Position"))
    (finding,) = rig.diagnostics.by_code("control.ideal-servo")
    assert "/rig/gazebo_ros_control/pid_gains/<joint> (No p gain specified" in finding.message


CONTROLLERS = {
    "arm": {"type": "effort_controllers/JointTrajectoryController", "joints": ["j"]},
    "base": {"type": "effort_controllers/JointVelocityController", "joint": "wheel"},
}


def pendulum(**options: object) -> Rig:
    arm = rotor("j", axis="0 1 0").replace(
        '<mass value="1"/>', '<origin xyz="1 0 0"/><mass value="1"/>'
    )
    return ros1_rig(
        arm, transmission("j"), rotor("wheel", "continuous", FREE), transmission("wheel"),
        gravity=True, **options,
    )  # fmt: skip


def test_joints_that_a_configured_controller_names_hold_until_claimed() -> None:
    rig = pendulum(parameters=CONTROLLERS)
    rig.run(500)
    assert rig.position("j") == pytest.approx(0.0, abs=1e-6)
    rig.claim("j/effort")
    rig.run(500)
    assert rig.position("j") > 0.3


def test_joints_that_nobody_names_fall_as_in_gazebo() -> None:
    rig = pendulum()
    rig.run(500)
    assert rig.position("j") > 0.3


def test_wheels_do_not_hold() -> None:
    rig = pendulum(parameters=CONTROLLERS)
    rig.engine.joint("rig::wheel").set_state(velocity=1.0)
    rig.run(100)
    assert rig.velocity("wheel") == pytest.approx(1.0)


@pytest.mark.parametrize("kind", ["JointTrajectoryController", "JointPositionController"])
def test_continuous_joints_that_a_controller_of_positions_names_hold(kind: str) -> None:
    arm = {"type": f"effort_controllers/{kind}", "joints": ["wheel"]}
    rig = pendulum(parameters={"arm": arm})
    rig.engine.joint("rig::wheel").set_state(velocity=1.0)
    rig.run(100)
    assert rig.position("wheel") == pytest.approx(0.0, abs=2e-3)
    assert rig.velocity("wheel") == pytest.approx(0.0, abs=1e-3)


def test_a_held_joint_put_elsewhere_holds_there() -> None:
    rig = pendulum(parameters=CONTROLLERS)
    rig.engine.joint("rig::j").set_state(position=0.7)
    rig.run(300)
    assert rig.position("j") == pytest.approx(0.7, abs=1e-6)


def test_reset_holds_again_what_was_never_claimed() -> None:
    rig = pendulum(parameters=CONTROLLERS)
    rig.run(10)
    rig.engine.reset()
    rig.hardware.reset()
    rig.run(300)
    assert rig.position("j") == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("interface", ["Position", "Velocity", "Effort"])
def test_commands_act_again_after_a_reset(interface: str) -> None:
    word = interface.lower()
    rig = ros1_rig(rotor("j"), transmission("j", interface))
    rig.claim(f"j/{word}")
    first = rig.run(200, **{f"j_{word}": 0.5})
    rig.engine.reset()
    rig.hardware.reset()
    again = rig.run(200, **{f"j_{word}": 0.5})
    assert again.tolist() == first.tolist()


def test_emergency_stop_cuts_efforts_and_speeds_and_keeps_positions() -> None:
    rig = ros1_rig(
        rotor("e"), transmission("e"), rotor("p"), transmission("p", "Position"),
        rotor("v", limit='lower="-30" upper="30" effort="10" velocity="4"'),
        transmission("v", "Velocity"),
    )  # fmt: skip
    rig.claim("e/effort", "p/position", "v/velocity")
    wanted = {"e_effort": 1.0, "p_position": 1.0, "v_velocity": 2.0}
    rig.run(100, **wanted)
    coasting, stopped_at = rig.velocity("e"), rig.position("p")
    rig.hardware.set_stop(True)
    rig.run(300, **wanted)
    assert rig.velocity("e") == pytest.approx(coasting)
    assert rig.position("p") == pytest.approx(stopped_at, abs=5e-3)
    assert rig.velocity("v") == pytest.approx(0.0, abs=1e-4)
    rig.hardware.set_stop(False)
    rig.run(500, **wanted)
    assert rig.position("p") == pytest.approx(1.0, abs=1e-6)
    assert rig.velocity("v") == pytest.approx(2.0, abs=1e-3)


def test_joint_limits_of_the_parameter_store_count() -> None:
    limits = {"joint_limits": {"j": {"has_effort_limits": True, "max_effort": 1.0}}}
    rig = ros1_rig(rotor("j", "continuous", FREE), transmission("j"), parameters=limits)
    rig.claim("j/effort")
    rig.run(100, j_effort=9.0)
    assert rig.velocity("j") == pytest.approx(1.0 / INERTIA * 0.1, rel=1e-9)
    assert rig.robot.joints["j"].limits.max_effort == 1.0


def test_efforts_are_measured_once_somebody_asks() -> None:
    rig = effort_rig()
    rig.claim("j/effort")
    rig.run(10, j_effort=2.0)
    place = rig.robot.interface_values.state_index["j/effort"]
    assert math.isnan(rig.robot.interface_values.states[place])
    assert rig.state("j/effort") == 2.0
