"""What recorders write on."""

from __future__ import annotations

import numpy as np
import pytest
from tests.recorded import cart_world

from gazelle.errors import InterfaceError
from gazelle.recording.tape import Known, Tape, is_recorded

_POSES = np.zeros((1, 7), np.float32)
_MS = 1_000_000


def _tape() -> Tape:
    tape = Tape()
    tape.know("world", Known(cart_world, ("cart::body",)))
    return tape


def test_moments_of_worlds_that_change_are_stretches() -> None:
    tape = _tape()
    tape.add_moment("world", 0, _POSES)
    tape.add_moment("later", 20 * _MS, np.zeros((2, 7)))
    tape.add_moment("later", 40 * _MS, np.zeros((2, 7)))
    found = tape.recording()
    assert found is not None and len(found.stretches) == 1
    tape.know("later", Known(cart_world, ("cart::body", "cart::ball")))
    found = tape.recording()
    assert found is not None
    assert [one.poses.shape for one in found.stretches] == [(1, 1, 7), (2, 2, 7)]


def test_nothing_is_recorded_before_a_world_is_known() -> None:
    tape = Tape()
    tape.add_moment("world", 0, _POSES)
    assert tape.recording() is None
    assert tape.seconds == 0.0


def test_time_that_goes_back_goes_on() -> None:
    tape = _tape()
    for time_ns in (0, 20 * _MS, 40 * _MS, 0, 20 * _MS):
        tape.add_moment("world", time_ns, _POSES)
    found = tape.recording()
    assert found is not None
    assert found.stretches[0].times_ns.tolist() == [0, 20 * _MS, 40 * _MS, 60 * _MS]
    assert tape.seconds == pytest.approx(0.06)


def test_fast_topics_are_thinned_out_but_not_transforms() -> None:
    tape = _tape()
    for step in range(101):
        tape.add_moment("world", step * _MS, _POSES)
        tape.add_message("/odom", "nav_msgs/msg/Odometry", step * _MS, step)
        tape.add_message("/tf", "tf2_msgs/msg/TFMessage", step * _MS, step)
    found = tape.recording()
    assert found is not None
    counts = {one.name: len(one.messages) for one in found.topics}
    assert counts == {"/odom": 9, "/tf": 101}


def test_a_topic_that_cannot_be_read_is_left_out() -> None:
    def decode(message: str) -> str:
        if message == "bad":
            raise InterfaceError("no such type")
        return message

    tape = _tape()
    tape.add_moment("world", 0, _POSES)
    tape.add_message("/a", "std_msgs/msg/String", 0, "good")
    tape.add_message("/b", "my_msgs/msg/Thing", 0, "bad")
    found = tape.recording(decode)
    assert found is not None and [one.name for one in found.topics] == ["/a"]


def test_pictures_clouds_and_hidden_topics_are_recorded_when_asked_for() -> None:
    assert is_recorded("/odom", "nav_msgs/msg/Odometry", None)
    assert not is_recorded("/image", "sensor_msgs/msg/Image", None)
    assert not is_recorded("/_gazelle/poses", "gazelle_msgs/msg/Frames", None)
    assert not is_recorded("/rosout_agg", "rcl_interfaces/msg/Log", None)
    assert is_recorded("/image", "sensor_msgs/msg/Image", ["/image"])
    assert not is_recorded("/odom", "nav_msgs/msg/Odometry", [])
