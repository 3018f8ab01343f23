"""Time, Duration, Rate, Timer and sleep on a simulated clock that the test moves."""

from __future__ import annotations

import itertools
import signal
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type

Run = Callable[..., Any]


@pytest.fixture
def set_clock(graph: Graph, node: Node) -> Callable[[float], None]:
    """Makes it so many seconds past the start of simulated time."""
    graph.parameters.set("/use_sim_time", True)
    clock = message_type("rosgraph_msgs/msg/Clock")
    publisher = node.create_publisher("/clock", clock, latch=True)

    def publish(seconds: float) -> None:
        message = clock()
        message.clock.sec, nanoseconds = divmod(round(seconds * 1e9), 10**9)
        message.clock.nanosec = nanoseconds
        publisher.publish(message)

    return publish


_ARITHMETIC = """
import rospy
from rospy import Duration, Time
assert Time(3, 1_500_000_000) == Time(4, 500_000_000) == Time.from_sec(4.5)
assert Time(5) - Time(2) == Duration(3) and Time(5) - Duration(2) == Time(3)
assert (Duration(1.5) * 2).to_sec() == 3.0 and -Duration(1) == Duration(-1)
assert Duration(-0.25).secs == -1 and Duration(-0.25).nsecs == 750_000_000
assert Duration(3) / 2 == Duration(1.5) and abs(Duration(-2)) == Duration(2)
assert Time(1) < Time(1, 1) and Time(2).to_nsec() == 2_000_000_000 and bool(Time(0)) is False
assert isinstance(Time(1) + Duration(1), Time)
try:
    Time.now()
    raise AssertionError("nothing raised")
except rospy.ROSInitException as error:
    assert "Have you called init_node()?" in str(error)
rospy.init_node("wall")
assert rospy.rostime.is_wallclock() and rospy.get_time() > 1.7e9
"""


def test_times_and_durations_compute_as_genpys(passes: Run) -> None:
    passes(_ARITHMETIC)


_LOOP = """
import rospy
rospy.init_node("loop")
rate = rospy.Rate(10)
print("start", rospy.get_time(), flush=True)
for _ in range(3):
    rate.sleep()
    print("tick", rospy.get_time(), flush=True)
rospy.sleep(1.0)
print("slept", rospy.Time.now().to_sec(), flush=True)
try:
    rospy.sleep(100)
except rospy.ROSTimeMovedBackwardsException as error:
    print("back by", round(-error.time, 3), flush=True)
"""


def test_rate_and_sleep_follow_the_simulated_clock(program: Run, set_clock: Run) -> None:
    set_clock(10.0)
    loop = program(_LOOP)
    loop.wait_for_line("^start 10.0$")
    for time_s in (10.1, 10.2, 10.3):
        set_clock(time_s)
        loop.wait_for_line(f"^tick {time_s}$")
    moved = itertools.count(104)
    # Step by step, since the sleep begins when the program gets to it.
    loop.eventually(lambda: set_clock(next(moved) / 10) or "slept" in loop.text)
    assert float(loop.wait_for_line("^slept").split()[1]) >= 11.3
    loop.eventually(lambda: _noticed_going_back(set_clock, loop))
    assert loop.wait() == 0


def _noticed_going_back(set_clock: Run, loop: Any) -> bool:
    set_clock(60.0)
    set_clock(50.0)
    return "back by" in loop.text


def test_shutdown_wakes_a_sleep_on_a_clock_that_stands_still(program: Run, set_clock: Run) -> None:
    set_clock(1.0)
    sleeper = program(
        "import rospy\nrospy.init_node('sleeper')\nprint('ready', flush=True)\n"
        "try:\n    rospy.sleep(5)\nexcept rospy.ROSInterruptException:\n    print('woken')\n"
    )
    sleeper.wait_for_line("^ready$")
    assert sleeper.stop(signal.SIGTERM) == 0
    assert "woken" in sleeper.lines


_TIMER = """
import sys
import rospy
rospy.init_node("timed")
def say(*words):
    # One write: two threads speak, and print writes every word on its own.
    sys.stdout.write(" ".join(map(str, words)) + "\\n")
    sys.stdout.flush()
def tick(event):
    last = event.last_real and event.last_real.to_sec()
    say("event", event.current_real.to_sec(), event.current_expected.to_sec(), last)
    if event.current_real.to_sec() > 5.25:
        rospy.signal_shutdown("enough")
rospy.Timer(rospy.Duration(0.1), tick)
rospy.Timer(rospy.Duration(0.15), lambda event: say("once"), oneshot=True)
say("ready")
rospy.spin()
"""


def test_timers_follow_the_simulated_clock(program: Run, set_clock: Run) -> None:
    set_clock(5.0)
    timed = program(_TIMER)
    timed.wait_for_line("^ready$")
    set_clock(5.1)
    timed.wait_for_line("^event 5.1 5.1 None$")
    set_clock(5.2)
    timed.wait_for_line("^event 5.2 5.2 5.1$")
    timed.wait_for_line("^once$")
    set_clock(5.3)
    timed.wait_for_line("^event 5.3 5.3 5.2$")
    assert timed.wait() == 0
    assert timed.lines.count("once") == 1
