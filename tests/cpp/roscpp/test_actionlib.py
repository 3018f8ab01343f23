"""Actions of ROS 1 between C++ and Python."""

from __future__ import annotations

import threading
from typing import Any

from tests.cpp.roscpp.conftest import Probe
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.graph.actions import ActionClient, ActionServer

FIBONACCI = "actionlib_tutorials/Fibonacci"


def test_goals_of_python_are_worked_at_and_cancelled_in_cpp(graph: Graph, probe: Probe) -> None:
    running = probe("action_server")
    running.wait_for_line("ready")
    client = ActionClient(graph.create_node("client"), "fibonacci", FIBONACCI)
    assert client.wait_for_server(stretched(10))
    feedbacks: list[Any] = []
    goal = client.send_goal({"order": 7}, on_feedback=feedbacks.append)
    assert goal.wait(stretched(30))
    assert (goal.status.name, list(goal.result.sequence)) == ("SUCCEEDED", [0, 1, 7])
    assert [list(one.sequence) for one in feedbacks] == [[0, 1]]
    long = client.send_goal({"order": 1000})
    eventually(lambda: long.status.name == "ACTIVE")
    long.cancel()
    assert long.wait(stretched(30))
    assert (long.status.name, list(long.result.sequence)) == ("PREEMPTED", [0, 1, 1000])


def test_goals_of_cpp_are_worked_at_and_cancelled_in_python(graph: Graph, probe: Probe) -> None:
    cancelled = threading.Event()

    def work(goal: Any) -> None:
        goal.accept()
        goal.publish_feedback({"sequence": [0]})
        if goal.request.order < 100:
            goal.succeed({"sequence": [0, 1, 1]}, "well")

    def cancel(goal: Any) -> bool:
        goal.cancel({"sequence": [0]})
        cancelled.set()
        return True

    node = graph.create_node("server")
    server = ActionServer(node, "fibonacci", FIBONACCI, on_goal=work, on_cancel=cancel)
    running = probe("action_client")
    assert running.wait() == 0
    server.close()
    assert cancelled.is_set()
    assert [line for line in running.lines if not line.startswith("gazelle: ")] == [
        "done SUCCEEDED well 1",
        "result 1",
        "active 1",
        "feedback 1",
        "state SUCCEEDED",
        "state PREEMPTED",
    ]
