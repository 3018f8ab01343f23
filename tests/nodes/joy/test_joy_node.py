"""joy_node: a joystick's events, from a pipe in its place."""

from __future__ import annotations

import os
import struct
from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.joy.device import JoyState, devices, read_event
from gazelle.nodes.joy.parameters import read_options

_BUTTON, _AXIS, _INIT = 1, 2, 0x80


def _event(kind: int, number: int, value: int) -> bytes:
    return struct.pack("<IhBB", 0, value, kind, number)


class Stick:
    """A pipe in place of a joystick."""

    def __init__(self, path: Path) -> None:
        os.mkfifo(path)
        # Opened for both, so that neither end waits for the other.
        self._pipe = os.open(path, os.O_RDWR)

    def send(self, *events: bytes) -> None:
        os.write(self._pipe, b"".join(events))

    def pull_out(self) -> None:
        os.close(self._pipe)


def test_axes_are_turned_and_begin_behind_the_dead_zone() -> None:
    state = JoyState(deadzone=0.2)
    for value in (-32767, 32767, 3000, 16384):
        assert state.take(read_event(_event(_AXIS, 1, value)))
        state.axes.append(state.axes[1])
    assert state.axes[0] == 0.0
    assert state.axes[2:] == pytest.approx([1.0, -1.0, 0.0, -0.375], abs=1e-3)


def test_sticky_buttons_toggle_when_pressed() -> None:
    state = JoyState(sticky_buttons=True)
    seen = []
    for value in (1, 0, 1, 0):
        state.take(read_event(_event(_BUTTON, 0, value)))
        seen.append(state.buttons[0])
    assert seen == [1, 1, 0, 0]
    plain = JoyState()
    plain.take(read_event(_event(_BUTTON, 2, 1)))
    assert plain.buttons == [0, 0, 1]


def test_both_generations_have_their_names_and_defaults() -> None:
    found = Diagnostics()
    first = read_options({}, "/joy", 1, found)
    second = read_options({"device_id": 2, "coalesce_interval_ms": 5}, "/joy", 2, found)
    assert (str(first.path), first.repeat_s, first.frame_id) == (
        "/dev/input/js0", 0.0, "/dev/input/js0",
    )  # fmt: skip
    assert (str(second.path), second.repeat_s, second.coalesce_s) == (
        "/dev/input/js2", 0.05, 0.005,
    )  # fmt: skip
    assert (second.frame_id, second.takes_initial, first.takes_initial) == ("joy", True, False)
    assert not len(found)


def test_an_old_dead_zone_is_told_and_divided() -> None:
    found = Diagnostics()
    assert read_options({"deadzone": 3276.7}, "/joy", 1, found).deadzone == pytest.approx(0.1)
    (told,) = found
    assert "deadzone 3276.7 is not a share from 0 to 0.9; 0.1 is used" in told.message


def test_joysticks_are_listed_by_number(tmp_path: Path) -> None:
    for name in ("js10", "js2", "event0"):
        os.mkfifo(tmp_path / name)
    assert [one.path.name for one in devices(tmp_path)] == ["js2", "js10"]
    assert devices(tmp_path / "absent") == ()


def test_node_sends_buttons_at_once_and_initial_events_together(bench: Any, tmp_path: Path) -> None:
    path = tmp_path / "js0"
    stick = Stick(path)
    got = bench.listen("/joy", "sensor_msgs/msg/Joy")
    bench.start("joy/joy_node", f"_dev:={path}", "_coalesce_interval:=0.2")
    stick.send(
        _event(_AXIS | _INIT, 0, 9000), _event(_AXIS | _INIT, 1, 0), _event(_BUTTON | _INIT, 0, 0)
    )
    first = bench.eventually(lambda: got)[0]
    assert (list(first.axes), list(first.buttons)) == ([0.0, 0.0], [0])
    assert first.header.frame_id == str(path)
    stick.send(_event(_AXIS, 1, -32767), _event(_BUTTON, 0, 1))
    bench.eventually(lambda: any(list(one.buttons) == [1] for one in got))
    assert list(got[-1].axes) == [0.0, 1.0]
    bench.stop()
    stick.pull_out()


def test_ros2_repeats_the_state(bench: Any, tmp_path: Path) -> None:
    path = tmp_path / "js0"
    stick = Stick(path)
    got = bench.listen("/joy", "sensor_msgs/msg/Joy")
    bench.start("joy/joy_node", "--ros-args", "-p", f"dev:={path}", "-p", "autorepeat_rate:=50.0")
    stick.send(_event(_AXIS | _INIT, 0, 32767))
    bench.eventually(lambda: len(got) > 3)
    assert {tuple(one.axes) for one in got} == {(-1.0,)}
    bench.stop()
    stick.pull_out()


def test_no_joystick_is_told_once_and_found_when_it_comes(
    bench: Any, tmp_path: Path, capsys: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gazelle.nodes.joy.node._RETRY_S", 0.01)
    path = tmp_path / "js0"
    got = bench.listen("/joy", "sensor_msgs/msg/Joy")
    bench.start("joy/joy_node", f"_dev:={path}")
    told: list[str] = []

    def said() -> bool:
        told.append(capsys.readouterr().err)
        return "Couldn't open joystick" in "".join(told)

    bench.eventually(said)
    stick = Stick(path)
    stick.send(_event(_BUTTON, 3, 1))
    bench.eventually(lambda: got)
    assert list(got[0].buttons) == [0, 0, 0, 1]
    told.append(capsys.readouterr().err)
    text = "".join(told)
    assert text.count("Couldn't open joystick") == 1
    assert f"Couldn't open joystick {path}. Will retry every second." in text
    bench.stop()
    stick.pull_out()
