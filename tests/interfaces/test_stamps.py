from __future__ import annotations

import pytest

from gazelle.interfaces import message_type, ros1_message_type
from gazelle.interfaces.stamps import (
    header,
    ns_of,
    seconds_of,
    set_header,
    set_stamp,
    stamp_message,
    stamped,
)

TIME = 12_000_000_345


@pytest.mark.parametrize("make", [message_type, ros1_message_type])
def test_a_stamp_of_either_generation_takes_and_gives_nanoseconds(make):
    stamp = make("std_msgs/Header")().stamp
    set_stamp(stamp, TIME)
    assert ns_of(stamp) == TIME
    assert seconds_of(stamp) == 12.000000345


def test_a_negative_duration_has_negative_seconds():
    duration = message_type("builtin_interfaces/Duration")()
    set_stamp(duration, -1)
    assert (duration.sec, duration.nanosec) == (-1, 999_999_999)
    assert ns_of(duration) == -1


def test_seconds_are_those_that_were_written():
    assert seconds_of(stamp_message(100_000_000)) == 0.1


def test_a_header_takes_time_and_frame():
    message = message_type("geometry_msgs/PoseStamped")()
    set_header(message, TIME, "map")
    assert message.header == message_type("std_msgs/Header")(
        stamp=stamp_message(TIME), frame_id="map"
    )


def test_a_message_is_made_with_its_header():
    message = stamped("geometry_msgs/PoseStamped", TIME, "map")
    assert message.header == header(TIME, "map")
    assert (ns_of(message.header.stamp), message.header.frame_id) == (TIME, "map")
    assert header(TIME).frame_id == ""
