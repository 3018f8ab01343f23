from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.hardware.rig import INERTIA, Rig, block, joint, ros2_rig, rotor

WIDE = 'lower="-30" upper="30" effort="10" velocity="4"'
GZ = "gz_ros2_control/GazeboSimSystem"
ALL = ("position", "velocity", "effort")


def arm(name: str = "j") -> str:
    """A rotor that gravity turns."""
    body = rotor(name, limit=WIDE, axis="0 1 0")
    return body.replace('<mass value="1"/>', '<origin xyz="1 0 0"/><mass value="1"/>')


def message(rig: Rig, code: str) -> str:
    (finding,) = rig.diagnostics.by_code(code)
    return f"{finding.message} {finding.fix}"


def test_a_position_command_is_reached_within_a_period_and_carried() -> None:
    rig = ros2_rig(arm(), block(joint("j")), gravity=True)
    rig.claim("j/position")
    rig.run(10, j_position=0.05)
    assert rig.position("j") == pytest.approx(0.05, abs=1e-6)
    rig.run(500, j_position=0.05)
    assert rig.position("j") == pytest.approx(0.05, abs=1e-6)
    assert rig.state("j/position") == pytest.approx(0.05, abs=1e-6)


def test_a_velocity_command_acts_whatever_the_load_is() -> None:
    rig = ros2_rig(arm(), block(joint("j", ALL)), gravity=True)
    rig.claim("j/velocity")
    positions = rig.run(500, j_velocity=-2.0)[:, 0]
    assert np.diff(positions[10:]) == pytest.approx(-0.002, rel=1e-3)


def test_an_effort_command_accelerates_by_effort_over_inertia() -> None:
    rig = ros2_rig(rotor("j", limit=WIDE), block(joint("j", ALL)))
    rig.claim("j/effort")
    rig.run(500, j_effort=2.0)
    assert rig.velocity("j") == pytest.approx(2.0 / INERTIA * 0.5, rel=1e-9)
    rig.run(1, j_effort=99.0)
    rig.command(j_effort=99.0)
    assert rig.state("j/effort") == 10.0


def test_initial_values_put_the_joints_before_the_first_step() -> None:
    states = (
        '<state_interface name="position"><param name="initial_value">0.4</param>'
        '</state_interface><state_interface name="velocity"/>'
    )
    rig = ros2_rig(arm(), block(joint("j", states=states)), gravity=True)
    assert rig.position("j") == 0.4
    rig.run(300)
    assert rig.position("j") == pytest.approx(0.4, abs=1e-6)


@pytest.mark.parametrize("is_gz", [False, True])
def test_joints_hold_until_they_are_commanded(is_gz: bool) -> None:
    plugin = GZ if is_gz else "gazebo_ros2_control/GazeboSystem"
    rig = ros2_rig(arm(), block(joint("j", ALL), plugin=plugin), is_gz=is_gz, gravity=True)
    rig.run(500)
    assert rig.position("j") == pytest.approx(0.0, abs=1e-4)
    # Claimed, but nothing was commanded yet.
    rig.claim("j/effort")
    rig.run(500)
    assert rig.position("j") == pytest.approx(0.0, abs=1e-4)
    rig.run(200, j_effort=0.0)
    assert rig.position("j") > 0.05


def test_joints_hold_again_where_they_are_when_released() -> None:
    rig = ros2_rig(arm(), block(joint("j", ALL)), gravity=True)
    rig.claim("j/effort")
    rig.run(200, j_effort=0.0)
    rig.drop("j/effort")
    where = rig.position("j")
    rig.run(300)
    assert rig.position("j") == pytest.approx(where, abs=1e-6)


def test_without_hold_joints_they_move_freely() -> None:
    rig = ros2_rig(arm(), block(joint("j", ALL)), hold=False, gravity=True)
    rig.run(300)
    fallen = rig.position("j")
    assert fallen > 0.1
    rig.claim("j/position")
    rig.run(300, j_position=0.0)
    assert rig.position("j") == pytest.approx(0.0, abs=1e-6)
    rig.drop("j/position")
    rig.run(300)
    assert rig.position("j") == pytest.approx(fallen, rel=0.05)


def test_a_passive_joint_is_never_held() -> None:
    rig = ros2_rig(arm(), block(joint("j", ())), gravity=True)
    rig.run(300)
    assert rig.position("j") > 0.1


def test_commands_stay_within_min_and_max() -> None:
    bounded = joint("j", ()).replace(
        "<state_interface",
        '<command_interface name="position"><param name="min">-0.3</param>'
        '<param name="max">0.2</param></command_interface><state_interface',
        1,
    )
    rig = ros2_rig(rotor("j"), block(bounded))
    rig.claim("j/position")
    rig.run(100, j_position=1.0)
    assert rig.position("j") == pytest.approx(0.2, abs=1e-6)
    rig.run(100, j_position=-1.0)
    assert rig.position("j") == pytest.approx(-0.3, abs=1e-6)
    free = ros2_rig(
        rotor("j", limit=WIDE),
        block(bounded.replace('name="j">', 'name="j"><limits enable="false"/>')),
    )
    free.claim("j/position")
    free.run(100, j_position=1.0)
    assert free.position("j") == pytest.approx(1.0, abs=1e-6)


def test_of_several_claimed_commands_one_counts() -> None:
    for is_gz, plugin in ((False, "gazebo_ros2_control/GazeboSystem"), (True, GZ)):
        rig = ros2_rig(rotor("j", limit=WIDE), block(joint("j", ALL), plugin=plugin), is_gz=is_gz)
        rig.claim("j/position", "j/velocity")
        rig.run(300, j_position=0.1, j_velocity=1.0)
        assert rig.velocity("j") == pytest.approx(1.0 if is_gz else 0.0, abs=1e-3)


def test_a_servo_of_gz_makes_up_for_a_tenth_of_the_error_in_a_period() -> None:
    rig = ros2_rig(
        rotor("j", limit='lower="-30" upper="30" effort="1000" velocity="4"'),
        block(joint("j"), plugin=GZ),
        is_gz=True,
    )
    rig.claim("j/position")
    positions = rig.run(300, j_position=1.0)[:, 0]
    errors = 1.0 - positions[9::10]
    assert errors[1:11] / errors[:10] == pytest.approx(0.9, abs=1e-3)


def test_a_motor_of_gz_has_the_effort_limit() -> None:
    rig = ros2_rig(rotor("j", limit=WIDE), block(joint("j", ALL), plugin=GZ), is_gz=True)
    rig.claim("j/velocity")
    rig.run(50, j_velocity=3.0)
    assert rig.velocity("j") == pytest.approx(10.0 / INERTIA * 0.05, rel=1e-3)


@pytest.mark.parametrize("where", ["block", "parameters"])
def test_gains_make_efforts_of_position_errors(where: str) -> None:
    words = {"kp": 20.0, "ki": 0.0, "kd": 4.0}
    more = "".join(f'<param name="pos_{key}">{value}</param>' for key, value in words.items())
    own = joint("j", more=more if where == "block" else "")
    gains = {"position": {"j": words}} if where == "parameters" else {}
    rig = ros2_rig(rotor("j", limit=WIDE), block(own), gains=gains)
    rig.claim("j/position")
    measured = rig.run(800, j_position=0.4)[:, 0]
    position, speed, last, expected = 0.0, 0.0, 0.0, []
    for _ in range(800):
        error = 0.4 - position
        effort = float(np.clip(20.0 * error + 4.0 * (error - last) / 0.001, -10.0, 10.0))
        last = error
        speed += effort / INERTIA * 0.001
        position += speed * 0.001
        expected.append(position)
    assert measured == pytest.approx(expected, abs=1e-9)


def test_gains_make_efforts_of_velocity_errors() -> None:
    own = joint("j", ("velocity",), more='<param name="vel_kp">2.0</param>')
    rig = ros2_rig(rotor("j", "continuous", 'effort="10" velocity="4"'), block(own))
    rig.claim("j/velocity")
    rig.run(500, j_velocity=3.0)
    assert rig.velocity("j") == pytest.approx(3.0 * (1 - math.exp(-2.0 / INERTIA * 0.5)), rel=2e-3)


@pytest.mark.parametrize("is_gz", [False, True])
def test_a_mimic_of_the_block_follows(is_gz: bool) -> None:
    follower = joint(
        "b", (), more='<param name="mimic">a</param><param name="multiplier">-2</param>'
    )
    plugin = GZ if is_gz else "gazebo_ros2_control/GazeboSystem"
    limit = 'lower="-30" upper="30" effort="1000" velocity="4"'
    rig = ros2_rig(
        rotor("a", limit=limit),
        rotor("b", limit=limit),
        block(joint("a", ALL), follower, plugin=plugin),
        is_gz=is_gz,
    )
    assert rig.hardware.writes_every_step
    rig.claim("a/velocity")
    rig.run(500, a_velocity=0.5)
    # gz-sim's follower is driven at the error of a period: it lags by that.
    assert rig.position("b") == pytest.approx(-2 * rig.position("a"), abs=0.02)
    assert rig.position("a") > 0.2


def test_a_mimic_of_the_description_follows_in_the_physics() -> None:
    follower = rotor("b", limit=WIDE, more='<mimic joint="a" multiplier="-2"/>')
    rig = ros2_rig(rotor("a", limit=WIDE), follower, block(joint("a"), joint("b", ())))
    assert not rig.hardware.writes_every_step
    rig.claim("a/position")
    rig.run(300, a_position=0.4)
    assert rig.position("b") == pytest.approx(-0.8, abs=1e-3)


@pytest.mark.parametrize("word", ALL)
@pytest.mark.parametrize("is_gz", [False, True])
def test_after_a_reset_everything_happens_again(word: str, is_gz: bool) -> None:
    plugin = GZ if is_gz else "gazebo_ros2_control/GazeboSystem"
    rig = ros2_rig(arm(), block(joint("j", ALL), plugin=plugin), is_gz=is_gz, gravity=True)
    rig.claim(f"j/{word}")
    first = rig.run(200, **{f"j_{word}": 0.3})
    rig.engine.reset()
    rig.hardware.reset()
    assert rig.run(200, **{f"j_{word}": 0.3}).tolist() == first.tolist()


def test_other_joints_go_on_while_one_is_switched() -> None:
    rig = ros2_rig(
        rotor("a", limit=WIDE), rotor("b", limit=WIDE), block(joint("a", ALL), joint("b", ALL))
    )
    rig.claim("a/velocity")
    rig.run(100, a_velocity=1.0)
    rig.claim("b/velocity")
    rig.run(100, a_velocity=1.0, b_velocity=-1.0)
    assert (rig.velocity("a"), rig.velocity("b")) == pytest.approx((1.0, -1.0), abs=1e-3)
    rig.drop("a/velocity")
    rig.run(100, b_velocity=-1.0)
    assert (rig.velocity("a"), rig.velocity("b")) == pytest.approx((0.0, -1.0), abs=1e-3)
