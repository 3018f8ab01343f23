"""twist_mux: which of several commands passes."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type
from gazelle.nodes.twist_mux.parameters import Choice, Input, read_inputs

_S = 1_000_000_000
_TWIST: Any = message_type("geometry_msgs/msg/Twist")
_TOPICS = [
    {"name": "nav", "topic": "nav_vel", "timeout": 0.5, "priority": 10},
    {"name": "joy", "topic": "joy_vel", "timeout": 0.5, "priority": 100},
]
_LOCKS = [{"name": "pause", "topic": "pause", "timeout": 0.0, "priority": 50}]


def _choice(locks: Any = ()) -> Choice:
    found = Diagnostics()
    choice = Choice(
        read_inputs("topics", _TOPICS, "/mux", found), read_inputs("locks", locks, "/mux", found)
    )
    assert not len(found)
    return choice


def test_the_highest_topic_that_was_heard_in_time_passes() -> None:
    nav, joy = (choice := _choice()).topics
    nav.heard_ns = 10 * _S
    assert choice.passes(nav, 10 * _S)
    joy.heard_ns = 10 * _S
    assert (choice.passes(nav, 10 * _S), choice.passes(joy, 10 * _S)) == (False, True)
    nav.heard_ns = 11 * _S
    assert choice.passes(nav, 11 * _S)


def test_a_lock_holds_topics_below_it_only() -> None:
    choice = _choice(_LOCKS)
    (nav, joy), (lock,) = choice.topics, choice.locks
    lock.locked, nav.heard_ns = True, 10 * _S
    assert not choice.passes(nav, 10 * _S)
    joy.heard_ns = 10 * _S
    assert choice.passes(joy, 10 * _S)
    assert choice.lock_priority(10 * _S) == 50


def test_a_lock_with_a_timeout_holds_when_it_is_silent() -> None:
    lock = Input("stop", "stop", timeout_s=0.5, priority=255, heard_ns=10 * _S)
    assert not lock.is_locked(10 * _S)
    assert lock.is_locked(11 * _S)


def test_of_equal_priorities_the_first_passes() -> None:
    one, other = Input("a", "a", 0.0, 7), Input("b", "b", 0.0, 7)
    choice = Choice((one, other), ())
    assert (choice.passes(one, 0), choice.passes(other, 0)) == (True, False)


def test_groups_of_ros2_are_read_by_name_and_priorities_are_kept_in_range() -> None:
    found = Diagnostics()
    given = {
        "z": {"topic": "z_vel", "timeout": 1, "priority": 300},
        "a": {"topic": "a_vel", "timeout": 0.5, "priority": -1},
    }
    a, z = read_inputs("topics", given, "/mux", found)
    assert (a.name, a.topic, a.priority) == ("topics.a", "a_vel", 0)
    assert (z.name, z.timeout_s, z.priority) == ("topics.z", 1.0, 255)
    (told,) = found
    assert "'topics.a' has priority 0, which never passes" in told.message


@pytest.mark.parametrize(
    ("group", "text", "fix"),
    [
        ({"topic": "x", "priority": 1}, "'nav' has no timeout; it is left out", "add timeout"),
        (
            {"topic": "x", "timeout": 1.0, "prioritet": 1},
            "'nav' has no priority; it is left out",
            "did you mean 'prioritet'?",
        ),
        (
            {"topic": "x", "timeout": "1 s", "priority": 1},
            "'nav': timeout is '1 s', not a number; it is left out",
            "write a number",
        ),
    ],
)
def test_an_input_that_is_not_whole_is_left_out_and_told(
    group: dict[str, Any], text: str, fix: str
) -> None:
    found = Diagnostics()
    assert read_inputs("topics", [{"name": "nav", **group}], "/mux", found) == ()
    (told,) = found
    assert text in told.message
    assert told.fix.startswith(fix)


def _publisher(bench: Any, topic: str, kind: Any) -> Any:
    made = bench.node.create_publisher(topic, kind)
    bench.eventually(lambda: made.matched)
    return made


def test_node_of_ros1_passes_commands_and_obeys_locks(bench: Any) -> None:
    bench.node.parameters.set("/twist_mux/topics", _TOPICS)
    bench.node.parameters.set("/twist_mux/locks", _LOCKS)
    got = bench.listen("/drive", "geometry_msgs/msg/Twist")
    states = bench.listen("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray")
    bench.start("twist_mux/twist_mux", "cmd_vel_out:=drive")
    nav = _publisher(bench, "/nav_vel", _TWIST)
    lock = _publisher(bench, "/pause", "std_msgs/msg/Bool")
    twist = _TWIST()
    twist.linear.x = 0.3
    nav.publish(twist)
    assert bench.eventually(lambda: got)[0].linear.x == 0.3
    lock.publish(message_type("std_msgs/msg/Bool")(data=True))

    def held() -> Any:
        values = {one.key: one.value for one in states[-1].status[0].values} if states else {}
        return values if values.get("current priority") == "50" else None

    values = bench.eventually(held)
    assert values["lock pause"] == " locked (listening to pause @ 0.000000s with priority #50)"
    assert states[-1].status[0].name == "twist_mux: Twist mux status"
    nav.publish(twist)
    joy = _publisher(bench, "/joy_vel", _TWIST)
    joy.publish(_TWIST())
    bench.eventually(lambda: len(got) > 1)
    assert [one.linear.x for one in got] == [0.3, 0.0]


def test_node_of_ros2_takes_its_groups_and_stamps(bench: Any) -> None:
    got = bench.listen("/cmd_vel_out", "geometry_msgs/msg/TwistStamped")
    words = ("topic:=nav_vel", "timeout:=0.5", "priority:=10")
    given = [word for one in words for word in ("-p", f"topics.navigation.{one}")]
    bench.start("twist_mux/twist_mux", "--ros-args", "-p", "use_stamped:=true", *given)
    stamped: Any = message_type("geometry_msgs/msg/TwistStamped")()
    stamped.twist.angular.z = 0.5
    _publisher(bench, "/nav_vel", type(stamped)).publish(stamped)
    assert bench.eventually(lambda: got)[0].twist.angular.z == 0.5


def test_a_mux_without_topics_says_why_nothing_comes(bench: Any, capsys: Any) -> None:
    bench.start("twist_mux/twist_mux", "--ros-args", "-r", "__node:=mux")
    told = bench.eventually(lambda: capsys.readouterr().err)
    assert "/mux: no topic is given, so nothing will ever come on cmd_vel_out" in told


def test_slips_in_groups_and_flags_that_are_none_are_told(bench: Any, capfd: Any) -> None:
    words = ("topic:=nav_vel", "timeout:=0.5", "priority:=10", "name:=nav")
    given = [word for one in words for word in ("-p", f"topics.navigation.{one}")]
    bench.start("twist_mux/twist_mux", "--ros-args", "-p", "use_stamped:=maybe", *given)
    assert bench.stop() == [0]
    told = capfd.readouterr().err
    assert "parameter 'use_stamped' is 'maybe', not true or false; False is used" in told
    assert "parameter 'topics.navigation.name' is not one of twist_mux; it has no effect" in told


def test_a_file_of_ros2_counts_in_ros1_too(bench: Any, capsys: Any) -> None:
    inner = {"topics": {"navigation": {"topic": "nav_vel", "timeout": 0.5, "priority": 10}}}
    bench.node.parameters.set("/mux", {"twist_mux": {"ros__parameters": inner}})
    bench.start("twist_mux/twist_mux", "__name:=mux")
    told = bench.eventually(lambda: capsys.readouterr().out)
    assert "subscribed to topic 'nav_vel': timeout = 0.500000s, priority = 10." in told
