"""rostopic hz, bw and delay."""

from __future__ import annotations

import itertools
import re

import pytest

from gazelle.cli.rostopic import bw, delay, hz
from gazelle.cli.rostopic.bw import BandwidthMeter
from gazelle.cli.rostopic.delay import DelayMeter
from gazelle.cli.rostopic.hz import RateMeter, rate_report
from gazelle.graph import Graph, Node
from gazelle.interfaces import Time, ros1_message_type


@pytest.fixture(autouse=True)
def _often(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (bw, delay, hz):
        monkeypatch.setattr(module, "_PERIOD_S", 0.02)


def _shape(text: str) -> str:
    return re.sub(r"\d+(\.\d+)?", "N", text)


def _blocks(text: str) -> set[str]:
    """The shapes of the two-line reports in an output."""
    return {_shape(one) for one in re.findall(r"average[^\n]*\n[^\n]*", text)}


def test_rate_is_that_of_evenly_spaced_messages() -> None:
    meter = RateMeter()
    for place in range(11):
        meter.add(1.0 + place * 0.1)
    found = meter.read()
    assert found is not None
    assert found.rate_hz == pytest.approx(10.0)
    assert (found.min_s, found.max_s) == (pytest.approx(0.1), pytest.approx(0.1))
    assert found.std_dev_s == pytest.approx(0.0, abs=1e-9)
    assert found.window == 11
    assert meter.read() is None


def test_rate_of_a_window_forgets_older_messages() -> None:
    meter = RateMeter(3)
    for now_s in (1.0, 9.0, 9.5, 10.0):
        meter.add(now_s)
    found = meter.read()
    assert found is not None
    assert (found.rate_hz, found.window) == (pytest.approx(2.0), 3)


def test_rate_starts_afresh_when_time_goes_back(capsys) -> None:
    meter = RateMeter()
    for now_s in (5.0, 6.0, 1.0, 1.5):
        meter.add(now_s)
    found = meter.read()
    assert found is not None
    assert (found.rate_hz, found.window) == (pytest.approx(2.0), 2)
    meter.add(0.0)
    assert capsys.readouterr().out == "time has reset, resetting counters\n"


def test_rates_of_several_topics_are_a_table() -> None:
    meters = {"/a": RateMeter(), "/longer": RateMeter(), "/silent": RateMeter()}
    for place in range(3):
        meters["/a"].add(1 + place * 0.5)
        meters["/longer"].add(1 + place * 0.25)
    assert rate_report(meters).splitlines() == [
        " topic    rate   min_delta   max_delta   std_dev   window",
        "=========================================================",
        "/a        2.0    0.5         0.5         0.0       3     ",
        "/longer   4.0    0.25        0.25        0.0       3     ",
    ]
    assert rate_report(meters) == "no new messages"


def test_hz_prints_as_ros_does(robot: Node, run_until, recorded, pump) -> None:
    kind = ros1_message_type("std_msgs/String")
    publisher = robot.create_publisher("/joint_states", kind)
    pump(lambda: publisher.publish(kind()))
    out = run_until("average rate", "rostopic", "hz", "/joint_states")
    assert out.splitlines()[0] == "subscribed to [/joint_states]"
    assert _blocks(out) == _blocks(recorded("hz").out)


def test_hz_counts_simulated_time(graph: Graph, robot: Node, run_until, pump, capfd) -> None:
    graph.parameters.set("/use_sim_time", True)
    clock = robot.create_publisher("/clock", "rosgraph_msgs/Clock")
    times = itertools.count(1)

    def tick() -> None:
        message = clock.message_class()
        message.clock.sec = next(times)
        clock.publish(message)

    pump(tick)
    out = run_until("average rate", "rostopic", "hz", "/clock")
    # One message a second of simulated time, however fast they come.
    assert re.search(r"average rate: 1\.\d+|average rate: 0\.\d+", out)
    assert "WARNING: may be using simulated time" in capfd.readouterr().err


def test_hz_can_measure_only_some_messages(robot: Node, run_until, pump) -> None:
    kind = ros1_message_type("std_msgs/Int32")
    publisher = robot.create_publisher("/n", kind)
    pump(lambda: [publisher.publish(kind(data=one)) for one in (1, 2)])
    out = run_until("average rate", "rostopic", "hz", "--filter", "m.data == 2", "-w", "5", "/n")
    assert int(out.rstrip().rpartition("window: ")[2]) <= 5


def test_bandwidth_counts_bytes_in_thousands() -> None:
    meter = BandwidthMeter()
    assert meter.report(1.0) == ""
    for place in range(10):
        meter.add(float(place), 2_000)
    assert meter.report(10.0) == (
        "average: 2.00KB/s\n\tmean: 2.00KB min: 2.00KB max: 2.00KB window: 10"
    )
    assert meter.report(100.0).startswith("average: 200.00B/s\n\tmean: 2000.00B")


def test_bandwidth_prints_as_ros_does(robot: Node, run_until, recorded, pump) -> None:
    kind = ros1_message_type("std_msgs/String")
    publisher = robot.create_publisher("/chat", kind)
    message = kind(data="x" * 93)
    pump(lambda: publisher.publish(message))
    out = run_until("average", "rostopic", "bw", "/chat")

    def bytes_of(text: str) -> set[str]:
        # The unit follows the rate, and messages that wait for this process come all at once.
        return {re.sub("[KM]B", "B", one) for one in _blocks(text)}

    assert bytes_of(out) == bytes_of(recorded("bw").out)


def test_delay_is_age_on_arrival() -> None:
    meter = DelayMeter()
    meter.add(10.0, 9.5)
    meter.add(11.0, 10.9)
    assert meter.report() == (
        "average delay: 0.300\n\tmin: 0.100s max: 0.500s std dev: 0.20000s window: 2"
    )
    assert meter.report() == "no new messages"


def test_delay_needs_a_header(robot: Node, run, run_until, pump) -> None:
    robot.create_publisher("/chat", "std_msgs/String")
    found = run("rostopic", "delay", "/chat")
    assert found.code == 1
    assert found.err.startswith("ERROR: msg does not have header")
    kind = ros1_message_type("sensor_msgs/Imu")
    publisher = robot.create_publisher("/imu", kind)
    message = kind()
    message.header.stamp = Time(1)
    pump(lambda: publisher.publish(message))
    assert "average delay: " in run_until("average", "rostopic", "delay", "/imu")
