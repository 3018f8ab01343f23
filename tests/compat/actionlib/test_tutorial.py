"""The tutorials of actionlib: a server and clients as programs of their own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Node
from gazelle.graph.actions import ActionClient, ActionlibStatus, ActionServer

FIBONACCI = "actionlib_tutorials/Fibonacci"

PACKAGE = """<?xml version="1.0"?>
<package format="2"><name>my_actions</name><version>0.1.0</version><description>d</description>
<maintainer email="a@b.c">a</maintainer><license>x</license>
<buildtool_depend>catkin</buildtool_depend><depend>actionlib</depend></package>
"""
COUNT = "int32 order\n---\nint32[] sequence\n---\nint32[] sequence\n"
SERVER = """#!/usr/bin/env python
import rospy
import actionlib
import my_actions.msg

class FibonacciServer(object):
    _feedback = my_actions.msg.FibonacciFeedback()
    _result = my_actions.msg.FibonacciResult()

    def __init__(self, name):
        self._action_name = name
        self._as = actionlib.SimpleActionServer(
            self._action_name, my_actions.msg.FibonacciAction,
            execute_cb=self.execute_cb, auto_start=False)
        self._as.start()

    def execute_cb(self, goal):
        r = rospy.Rate(50)
        success = True
        self._feedback.sequence = []
        self._feedback.sequence.append(0)
        self._feedback.sequence.append(1)
        print 'executing %s of order %i' % (self._action_name, goal.order)
        for i in xrange(1, goal.order):
            if self._as.is_preempt_requested():
                rospy.loginfo('%s: Preempted' % self._action_name)
                self._as.set_preempted()
                success = False
                break
            self._feedback.sequence.append(
                self._feedback.sequence[i] + self._feedback.sequence[i-1])
            self._as.publish_feedback(self._feedback)
            r.sleep()
        if success:
            self._result.sequence = self._feedback.sequence
            rospy.loginfo('%s: Succeeded' % self._action_name)
            self._as.set_succeeded(self._result, 'counted')

if __name__ == '__main__':
    rospy.init_node('fibonacci')
    server = FibonacciServer(rospy.get_name())
    rospy.spin()
"""
CLIENT = """#!/usr/bin/env python
from __future__ import print_function
import rospy
import actionlib
from my_actions.msg import FibonacciAction, FibonacciGoal

def done(state, result):
    print('done', actionlib.GoalStatus.to_string(state), len(result.sequence))

rospy.init_node('fibonacci_client_py')
client = actionlib.SimpleActionClient('fibonacci', FibonacciAction)
client.wait_for_server()
seen = []
client.send_goal(FibonacciGoal(order=8), done_cb=done, active_cb=lambda: print('active'),
                 feedback_cb=seen.append)
assert client.wait_for_result(rospy.Duration(20))
print('Result:', ', '.join([str(n) for n in client.get_result().sequence]))
print(client.get_state(), client.get_goal_status_text(), len(seen) > 3)
state = client.send_goal_and_wait(FibonacciGoal(order=100000), rospy.Duration(0.2),
                                  rospy.Duration(10.0))
print('cancelled', actionlib.TerminalState.to_string(state))
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A catkin package with an action and two Python 2 programs."""
    folder = tmp_path / "ws" / "src" / "my_actions"
    (folder / "action").mkdir(parents=True)
    (folder / "scripts").mkdir()
    (folder / "package.xml").write_text(PACKAGE)
    (folder / "action" / "Fibonacci.action").write_text(COUNT)
    for name, text in (("server.py", SERVER), ("client.py", CLIENT)):
        script = folder / "scripts" / name
        script.write_text(text)
        script.chmod(0o755)
    return tmp_path / "ws"


@pytest.mark.tutorial
def test_fibonacci_server_and_client_run_unmodified(
    gazelle: Callable[..., Any], graph: Any, package: Path
) -> None:
    server = gazelle("rosrun", "my_actions", "server.py", cwd=package)
    # A client that waits for long says what for.
    server.eventually(graph.actions)
    client = gazelle("rosrun", "my_actions", "client.py", cwd=package)
    assert client.wait() == 0, client.text + server.text
    lines = [line for line in client.lines if not line.startswith("[")]
    assert [line for line in lines if "translated" not in line] == [
        "active",
        "done SUCCEEDED 9",
        "Result: 0, 1, 1, 2, 3, 5, 8, 13, 21",
        "3 counted True",
        "cancelled PREEMPTED",
    ]
    server.wait_for_line("^executing /fibonacci of order 8$")
    assert graph.actions()[0].type_name == "my_actions/action/Fibonacci"
    server.stop()


HEAD = """
import rospy, actionlib
from actionlib_tutorials.msg import *
rospy.init_node('program')
"""


def test_server_without_execute_takes_goals_by_itself(
    program: Callable[..., Any], node: Node, eventually: Callable[..., Any]
) -> None:
    text = """
def on_goal():
    goals.append(server.accept_new_goal())
def tell(_event):
    # Again and again: a message published at once may come before its topic is known.
    # A goal is active a moment before it is in the list.
    if goals and server.is_active():
        server.publish_feedback(FibonacciFeedback([goals[-1].order]))
def on_preempt():
    print('preempt', server.is_preempt_requested(), server.is_new_goal_available())
    if not server.is_new_goal_available():
        server.set_preempted(FibonacciResult([7]), 'as you like')
goals = []
server = actionlib.SimpleActionServer('count', FibonacciAction, auto_start=False)
server.register_goal_callback(on_goal)
server.register_preempt_callback(on_preempt)
server.start()
rospy.Timer(rospy.Duration(0.05), tell)
rospy.spin()
"""
    running = program(HEAD + text)
    client = ActionClient(node, "count", FIBONACCI)
    assert client.wait_for_server(stretched(20)), running.text
    feedback: list[Any] = []
    first = client.send_goal({"order": 1}, on_feedback=feedback.append)
    eventually(lambda: feedback, why=lambda: running.text)
    second = client.send_goal({"order": 2})
    assert first.wait(stretched(30))
    assert first.status is ActionlibStatus.PREEMPTED
    assert "another goal was received by the simple action server" in first.text
    eventually(lambda: second.status is ActionlibStatus.ACTIVE)
    second.cancel()
    assert second.wait(stretched(30))
    assert (second.status.name, second.text) == ("PREEMPTED", "as you like")
    assert list(second.result.sequence) == [7]
    wanted = ["preempt True True", "preempt True False"]
    eventually(lambda: [line for line in running.lines if "preempt" in line] == wanted)


def test_execute_that_fails_or_forgets_the_end_aborts(
    program: Callable[..., Any], node: Node
) -> None:
    text = """
def execute(goal):
    if goal.order:
        raise ValueError('no such order')
server = actionlib.SimpleActionServer('count', FibonacciAction, execute, False)
server.start()
rospy.spin()
"""
    running = program(HEAD + text)
    client = ActionClient(node, "count", FIBONACCI)
    assert client.wait_for_server(stretched(20)), running.text
    failed, forgot = client.send_goal({"order": 1}), None
    assert failed.wait(stretched(30))
    forgot = client.send_goal({"order": 0})
    assert forgot.wait(stretched(30))
    assert (failed.status.name, failed.text) == (
        "ABORTED",
        "Exception in execute callback: no such order",
    )
    assert (forgot.status.name, forgot.text) == ("ABORTED", "No terminal state was set.")
    running.wait_for_line("Your executeCallback did not set the goal to a terminal status")


def test_action_server_hands_goals_and_cancel_requests_to_callbacks(
    program: Callable[..., Any], node: Node, eventually: Callable[..., Any]
) -> None:
    text = """
kept = []
def on_goal(handle):
    kept.append(handle)
    if handle.get_goal().order < 0:
        handle.set_rejected(text='too low')
    else:
        handle.set_accepted('go')
def on_cancel(handle):
    assert handle == kept[-1] and hash(handle) == hash(kept[-1]), kept
    print(actionlib.GoalStatus.to_string(handle.get_goal_status().status), handle.get_goal_id().id)
    handle.set_canceled(FibonacciResult([1]))
    handle.set_succeeded()
server = actionlib.ActionServer('many', FibonacciAction, on_goal, on_cancel, auto_start=False)
server.start()
rospy.spin()
"""
    running = program(HEAD + text)
    client = ActionClient(node, "many", FIBONACCI)
    assert client.wait_for_server(stretched(20)), running.text
    rejected = client.send_goal({"order": -1})
    assert rejected.wait(stretched(30))
    assert (rejected.status.name, rejected.text) == ("REJECTED", "too low")
    goal = client.send_goal({"order": 1})
    eventually(lambda: goal.text == "go")
    goal.cancel()
    assert goal.wait(stretched(30))
    assert goal.status is ActionlibStatus.PREEMPTED
    running.wait_for_line(f"PREEMPTING {goal.goal_id}")
    running.wait_for_line("it is currently in state: 2")


def test_client_that_waits_in_vain_is_told_what_there_is(
    program: Callable[..., Any], node: Node
) -> None:
    server = ActionServer(node, "count", FIBONACCI, on_goal=lambda goal: goal.accept())
    text = "actionlib.SimpleActionClient('/coumt', FibonacciAction).wait_for_server()"
    running = program(HEAD + text)
    running.wait_for_line("action server '/coumt' not found; did you mean '/count'")
    server.close()


def test_clients_see_every_step(passes: Callable[..., Any], node: Node) -> None:
    server = ActionServer(
        node, "count", FIBONACCI, on_goal=lambda goal: goal.accept(), on_cancel=lambda goal: (
            goal.publish_feedback({"sequence": [5]}), goal.cancel({"sequence": [3]}, "bye"))
    )  # fmt: skip
    text = """
client = actionlib.ActionClient('count', FibonacciAction)
assert not actionlib.ActionClient('cuont', FibonacciAction).wait_for_server(rospy.Duration(0.1))
assert client.wait_for_server(rospy.Duration(20))
steps, heard = [], []
def on_step(handle):
    steps.append(actionlib.CommState.to_string(handle.get_comm_state()))
handle = client.send_goal(FibonacciGoal(order=3), on_step, lambda h, f: heard.append((h, f)))
while handle.get_goal_status() != actionlib.GoalStatus.ACTIVE:
    rospy.sleep(0.01)
handle.cancel()
while handle.get_comm_state() != actionlib.CommState.DONE:
    rospy.sleep(0.01)
assert handle.get_terminal_state() == actionlib.TerminalState.PREEMPTED
assert handle.get_goal_status_text() == 'bye', handle.get_goal_status_text()
assert handle.get_result().sequence == (3,)
assert steps[-4:] == ['WAITING_FOR_CANCEL_ACK', 'PREEMPTING', 'WAITING_FOR_RESULT', 'DONE'], steps
assert heard == [] or heard[0][0] == handle
try:
    client.send_goal(3)
except Exception as error:
    assert 'action count takes a actionlib_tutorials/FibonacciGoal, this goal is a builtins.int' \
        in str(error), error
try:
    actionlib.SimpleActionClient('x', FibonacciGoal)
except actionlib.ActionException as error:
    assert 'Type is not an action spec' in str(error)
simple = actionlib.SimpleActionClient('count', FibonacciAction)
assert simple.get_state() == actionlib.GoalStatus.LOST and simple.get_result() is None
assert simple.wait_for_result(rospy.Duration(0.1)) is False
from actionlib.goal_id_generator import GoalIDGenerator
assert GoalIDGenerator().generate_ID().id.startswith('/program-1-')
from actionlib.msg import TestAction
"""
    passes(HEAD + text)
    server.close()
