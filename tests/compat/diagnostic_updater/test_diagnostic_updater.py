"""diagnostic_updater: tasks, their statuses and their publication, with rospy and with rclpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.graph import Node
from gazelle.interfaces import message_type

_HELP = """
import gazelle.compat.diagnostic_updater.rates as rates
now = [100.0]
rates.seconds = lambda: now[0]
def values(stat):
    return {one.key: one.value for one in stat.values}
def run(task):
    return task.run(DiagnosticStatusWrapper())
"""


def test_statuses_of_ros_1_merge_and_take_values(passes: Callable[..., Any]) -> None:
    passes("""
import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from diagnostic_updater import *
import diagnostic_updater
assert (diagnostic_updater.OK, diagnostic_updater.WARN, diagnostic_updater.ERROR) == (0, 1, 2)
stat = DiagnosticStatusWrapper()
assert isinstance(stat, DiagnosticStatus)
stat.summary(DiagnosticStatus.OK, "fine")
stat.mergeSummary(1, "warm")
assert (stat.level, stat.message) == (1, "warm")
stat.mergeSummary(DiagnosticStatus(level=2, message="hot"))
assert (stat.level, stat.message) == (2, "warm; hot")
stat.mergeSummary(0, "cool")
assert (stat.level, stat.message) == (2, "warm; hot")
stat.add("volts", 12.5)
assert (stat.values[0].key, stat.values[0].value) == ("volts", "12.5")
stat.clearSummary()
assert (stat.level, stat.message) == (0, "")

class Low(DiagnosticTask):
    def run(self, stat):
        stat.summary(1, "low")
        stat.add("low", 1)
        return stat

both = CompositeDiagnosticTask("both")
both.addTask(Low("low"))
both.addTask(FunctionDiagnosticTask("high", lambda stat: (stat.summary(2, "high"), stat)[1]))
stat = both.run(DiagnosticStatusWrapper())
assert (stat.level, stat.message, stat.values[0].key) == (2, "low; high", "low"), stat
assert both.getName() == "both"
assert Heartbeat().run(stat).message == "Alive"
""")


def test_rates_and_stamps_are_judged(passes: Callable[..., Any]) -> None:
    passes(f"""
import rospy
from diagnostic_updater import *
{_HELP}
bound = {{"min": 10, "max": 10}}
task = FrequencyStatus(FrequencyStatusParam(bound, 0.1, 2))
stat = run(task)
assert (stat.level, stat.message) == (2, "No events recorded.")
def tick(count):
    for _ in range(count):
        task.tick()
    now[0] += 1.0
    return run(task)
stat = tick(10)
assert (stat.level, stat.message) == (0, "Desired frequency met"), stat
assert values(stat) == {{
    "Events in window": "10", "Events since startup": "10",
    "Duration of window (s)": "1.000000", "Actual frequency (Hz)": "10.000000",
    "Target frequency (Hz)": "10.000000",
    "Minimum acceptable frequency (Hz)": "9.000000",
    "Maximum acceptable frequency (Hz)": "11.000000"}}, values(stat)
stat = tick(14)
assert (stat.level, stat.message) == (1, "Frequency too high.")
assert values(stat)["Actual frequency (Hz)"] == "12.000000"
bound["max"] = 100
assert tick(10).level == 0
assert tick(1).message == "Frequency too low."
task.clear()
assert run(task).message == "No events recorded."

task = TimeStampStatus(TimeStampStatusParam(-1, 5))
assert (run(task).level, run(task).message) == (1, "No data since last update.")
task.tick(rospy.Time(now[0] - 2))
assert run(task).message == "Timestamps are reasonable."
task.tick(now[0] + 3.0)
stat = run(task)
assert (stat.level, stat.message) == (2, "Timestamps too far in future seen.")
assert values(stat)["Early diagnostic update count:"] == "1"
task.tick(now[0] - 9.0)
task.tick(0.0)
stat = run(task)
assert stat.message == "Zero timestamp seen."
assert values(stat)["Late diagnostic update count:"] == "1"
assert TimeStampStatus().params.max_acceptable == 5
""")


def test_an_updater_of_rospy_publishes_when_its_period_is_over(
    passes: Callable[..., Any], node: Node, eventually: Callable[..., Any]
) -> None:
    node.graph.parameters.set("/driver/diagnostic_period", 1000.0)
    seen: list[Any] = []
    array = message_type("diagnostic_msgs/DiagnosticArray")
    node.create_subscription("/diagnostics", array, seen.append)
    done = passes("""
import rospy
from std_msgs.msg import Header
from sensor_msgs.msg import Imu
from diagnostic_updater import *
rospy.init_node("driver")
updater = Updater()
def check(stat):
    stat.summary(1, "warm")
    stat.add("degrees", 40)
    return stat
updater.add("motor", check)
updater.add(Heartbeat())
updater.verbose = True
sent = []
updater.publish = sent.append
updater.update()
assert not sent
updater.force_update()
updater.setHardwareID("motor 7")
updater.force_update()
first, second = sent
assert [one.name for one in first] == ["motor", "Heartbeat"]
assert first[0].hardware_id == "" and second[0].hardware_id == "motor 7"
assert (second[0].level, second[0].message, second[1].message) == (1, "warm", "Alive")
updater.broadcast(2, "going down")
assert [(one.name, one.level, one.message) for one in sent[-1]] == [
    ("motor", 2, "going down"), ("Heartbeat", 2, "going down")]
assert updater.removeByName("motor") and not updater.removeByName("motor")
updater.setHardwareID("")
updater.force_update()
updater.force_update()
diagnosed = DiagnosedPublisher(
    rospy.Publisher("imu", Imu, queue_size=1), updater,
    FrequencyStatusParam({"min": 0}), TimeStampStatusParam())
diagnosed.publish(Imu(header=Header(stamp=rospy.Time.now())))
updater.force_update()
assert sent[-1][1].name == "/imu topic status", sent[-1]
assert sent[-1][1].message == "Desired frequency met; Timestamps are reasonable.", sent[-1]
del updater.publish
while not updater._of._publisher.get_num_connections():
    rospy.rostime.wallsleep(0.01)
updater.force_update()
""")
    eventually(lambda: [one for one in seen if len(one.status) > 1])
    last = next(one for one in seen if len(one.status) > 1)
    assert last.status[0].name == "driver: Heartbeat" and last.header.stamp.sec > 0
    assert "Non-zero diagnostic status. Name: 'motor', 1: 'warm'" in done.text
    assert done.text.count("diagnostic_updater: No HW_ID was set. This is probably a bug") == 1


def test_an_updater_of_rclpy_runs_by_a_timer(
    passes: Callable[..., Any], node: Node, eventually: Callable[..., Any]
) -> None:
    seen: list[Any] = []
    array = message_type("diagnostic_msgs/DiagnosticArray")
    node.create_subscription("/diagnostics", array, seen.append)
    passes("""
import rclpy
from rclpy.node import Node
from rclpy.time import Time
from diagnostic_msgs.msg import DiagnosticStatus
import diagnostic_updater
rclpy.init()
node = Node("driver", namespace="arm")
try:
    diagnostic_updater.Updater()
except TypeError as error:
    assert "missing 1 required positional argument: 'node'" in str(error)
updater = diagnostic_updater.Updater(node, period=0.01)
updater.setHardwareID("none")
assert node.get_parameter("diagnostic_updater.period").value == updater.period == 0.01
count = [0]
def check(stat):
    count[0] += 1
    stat.summary(DiagnosticStatus.WARN, "warm")
    stat.add("count", str(count[0]))
    return stat
updater.add("motor", check)
while node.count_subscribers("/diagnostics") == 0:
    rclpy.spin_once(node, timeout_sec=0.01)
begun = count[0]
while count[0] < begun + 3:
    rclpy.spin_once(node)
updater.period = 1000.0
assert updater.period == 1000.0
reached = count[0]
rclpy.spin_once(node, timeout_sec=0.1)
rclpy.spin_once(node, timeout_sec=0.1)
assert count[0] <= reached + 1, (count, reached)
stamps = diagnostic_updater.TimeStampStatus()
stamps.tick(node.get_clock().now())
stamps.tick(Time(nanoseconds=0))
stat = stamps.run(diagnostic_updater.DiagnosticStatusWrapper())
assert (stat.level, stat.message) == (DiagnosticStatus.ERROR, "Zero timestamp seen."), stat
""")
    eventually(lambda: [one for one in seen if one.status[0].values])
    status = next(one for one in seen if one.status[0].values).status[0]
    assert (status.name, status.message) == ("driver: motor", "warm")
    assert status.hardware_id == "none" and status.values[0].key == "count"
