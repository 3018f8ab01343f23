"""Behaviour of ros2_control's mock_components/GenericSystem."""

from __future__ import annotations

import math

import pytest
from tests.control.hardware.rig import Rig, block, joint, ros2_rig, rotor

ALL = ("position", "velocity", "acceleration")


def mock(*parts: str, **parameters: str) -> Rig:
    options = "".join(f'<param name="{key}">{value}</param>' for key, value in parameters.items())
    own = block(*parts, plugin="mock_components/GenericSystem", parameters=options)
    return ros2_rig(rotor("j"), rotor("k"), own)


def dynamic(name: str) -> str:
    states = "".join(f'<state_interface name="{item}"/>' for item in ALL)
    return joint(name, ALL, states=states)


def tick(rig: Rig, count: int = 1) -> None:
    for _ in range(count):
        rig.robot.read(0, 10_000_000)


def test_states_begin_at_their_initial_values_or_zero() -> None:
    states = (
        '<state_interface name="position"><param name="initial_value">0.4</param>'
        '</state_interface><state_interface name="velocity"/>'
    )
    rig = mock(joint("j", states=states))
    assert rig.state("j/position") == 0.4
    assert rig.state("j/velocity") == 0.0


def test_commands_come_back_as_states_and_nan_changes_nothing() -> None:
    rig = mock(joint("j", ("position", "velocity")))
    rig.command(j_position=0.5, j_velocity=math.nan)
    tick(rig)
    assert (rig.state("j/position"), rig.state("j/velocity")) == (0.5, 0.0)


def test_position_states_have_the_following_offset() -> None:
    rig = mock(joint("j", ("position", "velocity")), position_state_following_offset="0.1")
    assert rig.state("j/position") == pytest.approx(0.1)
    rig.command(j_position=0.5, j_velocity=2.0)
    assert rig.state("j/position") == pytest.approx(0.6)
    assert rig.state("j/velocity") == 2.0


def test_a_custom_interface_can_have_the_offset_instead() -> None:
    states = '<state_interface name="position"/><state_interface name="actual_position"/>'
    rig = mock(
        joint("j", states=states),
        position_state_following_offset="0.1",
        custom_interface_with_following_offset="actual_position",
    )
    rig.command(j_position=0.5)
    assert rig.state("j/position") == 0.5
    assert rig.state("j/actual_position") == pytest.approx(0.6)


def test_disabled_commands_do_not_come_back() -> None:
    rig = mock(joint("j"), disable_commands="true")
    rig.command(j_position=0.5)
    assert rig.state("j/position") == 0.0


def test_a_mimic_has_its_leaders_states_times_the_multiplier() -> None:
    rig = mock(
        joint("j", ("position", "velocity")),
        joint("k", (), more='<param name="mimic">j</param><param name="multiplier">-2</param>'),
    )
    rig.command(j_position=0.5, j_velocity=0.25)
    assert rig.state("k/position") == -1.0
    assert rig.state("k/velocity") == -0.5


def test_sensors_and_gpios_can_have_commands() -> None:
    sensor = '<sensor name="ft"><state_interface name="force.x"/></sensor>'
    gpio = (
        '<gpio name="io"><command_interface name="out"/><state_interface name="out"/>'
        '<state_interface name="in"><param name="initial_value">3</param></state_interface></gpio>'
    )
    plain = mock(joint("j"), sensor, gpio)
    assert set(plain.robot.interface_values.command_index) == {"j/position", "io/out"}
    assert math.isnan(plain.state("ft/force.x"))
    assert plain.state("io/in") == 3.0
    plain.robot.interface_values.commands[plain.robot.interface_values.command_index["io/out"]] = (
        1.0
    )
    assert plain.state("io/out") == 1.0
    rig = mock(joint("j"), sensor, gpio, mock_sensor_commands="true", mock_gpio_commands="true")
    index = rig.robot.interface_values.command_index
    assert set(index) == {"j/position", "ft/force.x", "io/out", "io/in"}
    rig.robot.interface_values.commands[index["ft/force.x"]] = 7.0
    assert rig.state("ft/force.x") == 7.0


def test_dynamics_integrate_the_command_that_is_claimed() -> None:
    rig = mock(dynamic("j"), calculate_dynamics="true")
    rig.claim("j/velocity")
    rig.command(j_velocity=2.0)
    tick(rig, 100)
    interface_values = rig.robot.interface_values
    assert interface_values.states[interface_values.state_index["j/position"]] == pytest.approx(2.0)
    rig.claim("j/acceleration")
    rig.command(j_acceleration=-1.0)
    tick(rig, 100)
    assert interface_values.states[interface_values.state_index["j/velocity"]] == pytest.approx(1.0)
    rig.claim("j/position")
    start = interface_values.states[interface_values.state_index["j/position"]]
    rig.command(j_position=start + 0.01)
    tick(rig)
    assert interface_values.states[interface_values.state_index["j/velocity"]] == pytest.approx(1.0)


def test_dynamics_allow_one_command_a_joint() -> None:
    own = joint("j", (*ALL, "effort"), states='<state_interface name="position"/>')
    rig = mock(own, calculate_dynamics="true")
    check = rig.robot.check_switch
    assert check(frozenset(["j/velocity"]), frozenset()) == ""
    text = check(frozenset(["j/velocity", "j/position"]), frozenset())
    assert text == ("Got multiple (2) starting interfaces for joint 'j' - this is not supported!")
    assert "has to have 'position', 'velocity', or" in check(frozenset(["j/effort"]), frozenset())


def test_reset_goes_back_to_the_initial_values() -> None:
    rig = mock(joint("j"))
    rig.command(j_position=0.5)
    assert rig.state("j/position") == 0.5
    rig.hardware.reset()
    assert rig.state("j/position") == 0.0
