from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import GraphError, NotFoundError
from gazelle.graph import Graph, subscription
from gazelle.graph.actions import (
    ActionClient,
    ActionInfo,
    ActionlibStatus,
    ActionServer,
    ActionTiming,
    CommState,
    Ros2Status,
    ServerGoal,
    actions_of,
)
from gazelle.graph.actions.client_goal import TRANSITIONS, steps
from gazelle.interfaces import message_type, ros1_message_type

FIBONACCI = "actionlib_tutorials/Fibonacci"
_MANY = 20
BOTH = pytest.mark.parametrize("ros_version", [1, 2])


class Served:
    """An action server of one member of the graph."""

    def __init__(self, graph: Graph, make_inbox: Any) -> None:
        self.node = graph.create_node("server", rosout=False)
        self.goals = make_inbox()
        self.accepts = True
        self.server: ActionServer | None = None

    def offer(self, ros_version: Any, **options: Any) -> ActionServer:
        self.server = ActionServer(
            self.node,
            "fibonacci",
            FIBONACCI,
            on_goal=self._on_goal,
            on_cancel=lambda _goal: True,
            ros_version=ros_version,
            **options,
        )
        return self.server

    def goal(self, number: int = 0) -> ServerGoal:
        found: ServerGoal = self.goals.wait_for(number + 1)[number]
        return found

    def _on_goal(self, goal: ServerGoal) -> None:
        if self.accepts:
            goal.accept()
        else:
            goal.reject(text="no")
        self.goals(goal)


@pytest.fixture
def served(graph: Graph, make_inbox: Any) -> Iterator[Served]:
    one = Served(graph, make_inbox)
    yield one
    if one.server is not None:
        one.server.close()


@pytest.fixture
def client(other: Graph) -> ActionClient:
    return ActionClient(other.create_node("client", rosout=False), "fibonacci", FIBONACCI)


@BOTH
def test_goal_feedback_and_result_reach_the_client(
    served: Served, client: ActionClient, inbox: Any, make_inbox: Any, ros_version: Any
) -> None:
    served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    done = make_inbox()
    goal = client.send_goal({"order": 4}, on_feedback=inbox, on_done=done)
    at_server = served.goal()
    assert at_server.goal_id == goal.goal_id
    assert at_server.request.order == 4
    at_server.publish_feedback({"sequence": [0, 1]})
    assert list(inbox.wait_for(1)[0].sequence) == [0, 1]
    at_server.succeed({"sequence": [0, 1, 1]}, "well")
    assert goal.wait(stretched(30))
    assert goal.status.name == "SUCCEEDED"
    assert list(goal.result.sequence) == [0, 1, 1]
    assert (goal.is_done, done.items) == (True, [goal])


@BOTH
def test_sleeping_feedback_callback_keeps_the_newest_and_the_result(
    served: Served, client: ActionClient, eventually: Any, ros_version: Any,
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr(subscription, "MAX_WAITING", 10)
    served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    begun, goes_on = threading.Event(), threading.Event()
    seen: list[int] = []

    def sleep(feedback: Any) -> None:
        begun.set()
        goes_on.wait(stretched())
        seen.append(feedback.sequence[0])

    goal = client.send_goal({"order": 4}, on_feedback=sleep)
    at_server = served.goal()
    for number in range(100):
        at_server.publish_feedback({"sequence": [number]})
    assert begun.wait(stretched(30))
    at_server.succeed({"sequence": [0, 1, 1]})
    told = "a callback of the action /fibonacci is slower than /fibonacci/"
    printed: list[str] = []
    eventually(lambda: printed.append(capsys.readouterr().err) or told in "".join(printed))
    goes_on.set()
    assert goal.wait(stretched(30))
    assert seen[-1] == 99 and len(seen) < 100
    assert list(goal.result.sequence) == [0, 1, 1]


@BOTH
def test_rejected_goal_ends_at_once(served: Served, client: ActionClient, ros_version: Any) -> None:
    served.accepts = False
    served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    goal = client.send_goal({})
    assert goal.wait(stretched(30))
    assert (goal.status.name, goal.is_accepted) == ("REJECTED", False)


@BOTH
def test_cancelled_goal_ends_with_the_servers_result(
    served: Served, client: ActionClient, eventually: Any, ros_version: Any
) -> None:
    served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    goal = client.send_goal({})
    at_server = served.goal()
    eventually(lambda: goal.is_accepted)
    goal.cancel()
    eventually(lambda: at_server.is_cancel_requested)
    at_server.cancel({"sequence": [9]})
    assert goal.wait(stretched(30))
    assert goal.status in (ActionlibStatus.PREEMPTED, Ros2Status.CANCELED)
    assert list(goal.result.sequence) == [9]


@BOTH
def test_cancel_all_reaches_goals_of_others(
    served: Served, client: ActionClient, graph: Graph, eventually: Any, ros_version: Any
) -> None:
    server = served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    client.send_goal({})
    mine = served.goal()
    handle = server.submit({})
    client.cancel_all()
    eventually(lambda: mine.is_cancel_requested and handle.status.is_canceling)


@BOTH
def test_goals_of_other_clients_are_not_looked_at(
    served: Served, client: ActionClient, other: Graph, ros_version: Any
) -> None:
    server = served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    stranger = ActionClient(client._node, "fibonacci", FIBONACCI)
    assert stranger.wait_for_server(stretched(10))
    first = stranger.send_goal({})
    served.goal().succeed({"sequence": [1]})
    assert first.wait(stretched(30))
    seen: list[Any] = []
    goal = client.send_goal({}, on_feedback=seen.append)
    served.goal(1)
    server.submit({})
    submitted = served.goal(2)
    submitted.publish_feedback({"sequence": [5]})
    submitted.succeed({"sequence": [6]})
    served.goal(1).succeed({"sequence": [2]})
    assert goal.wait(stretched(30))
    assert (seen, list(goal.result.sequence)) == ([], [2])


def test_waiting_for_a_result_does_not_block_other_requests(
    served: Served, client: ActionClient
) -> None:
    served.offer(2)
    assert client.wait_for_server(stretched(10))
    goals = [client.send_goal({"order": number}) for number in range(4)]
    last = {one.request.order: one for one in served.goals.wait_for(4)}
    for number in (3, 1, 0, 2):
        last[number].succeed({"sequence": [number]})
        assert goals[number].wait(stretched(30))
        assert list(goals[number].result.sequence) == [number]


def test_status_is_latched_for_late_listeners(served: Served, other: Graph, inbox: Any) -> None:
    served.offer(1, timing=ActionTiming(status_hz=0))
    assert served.server is not None
    served.server.submit({}, goal_id="mine")
    kind = message_type("actionlib_msgs/GoalStatusArray")
    other.create_node("late", rosout=False).create_subscription("/fibonacci/status", kind, inbox)
    assert [one.goal_id.id for one in inbox.wait_for(1)[0].status_list] == ["mine"]


def test_status_comes_five_times_a_second(served: Served, other: Graph, inbox: Any) -> None:
    kind = message_type("actionlib_msgs/GoalStatusArray")
    other.create_node("late", rosout=False).create_subscription("/fibonacci/status", kind, inbox)
    served.offer(1)
    stamps = [one.header.stamp for one in inbox.wait_for(4)]
    times = [one.sec + one.nanosec * 1e-9 for one in stamps]
    assert times[-1] - times[-2] == pytest.approx(0.2, abs=0.1)


def test_goal_that_the_server_forgot_is_lost(
    served: Served, client: ActionClient, eventually: Any, graph: Graph
) -> None:
    served.offer(1)
    assert client.wait_for_server(stretched(10))
    goal = client.send_goal({})
    served.goal()
    eventually(lambda: goal.comm_state is CommState.ACTIVE)
    kind = message_type("actionlib_msgs/GoalStatusArray")
    served.node.create_publisher("/fibonacci/status", kind).publish(kind())
    assert goal.wait(stretched(30))
    assert goal.status is ActionlibStatus.LOST


def test_goal_that_is_cancelled_at_once_is_not_lost(
    served: Served, client: ActionClient, make_inbox: Any
) -> None:
    """A list of goals from before the server had heard of it comes after its cancelling."""
    node, goals, cancels = served.node, make_inbox(), make_inbox()
    kinds = {"goal": "ActionGoal", "feedback": "ActionFeedback", "result": "ActionResult"}
    types = {
        one: message_type(f"actionlib_tutorials/Fibonacci{kind}") for one, kind in kinds.items()
    }
    node.create_subscription("/fibonacci/goal", types["goal"], goals)
    node.create_subscription("/fibonacci/cancel", "actionlib_msgs/GoalID", cancels)
    node.create_publisher("/fibonacci/feedback", types["feedback"])
    result = node.create_publisher("/fibonacci/result", types["result"])
    status = node.create_publisher("/fibonacci/status", "actionlib_msgs/GoalStatusArray")
    assert client.wait_for_server(stretched())
    goal = client.send_goal({})
    sent = goals.wait_for(1)[0]
    goal.cancel()
    cancels.wait_for(1)
    status.publish(status.message_class())
    told = types["result"]()
    told.status.goal_id = sent.goal_id
    told.status.status = ActionlibStatus.RECALLED
    result.publish(told)
    assert goal.wait(stretched())
    assert goal.status is ActionlibStatus.RECALLED


def test_ros2_goal_ends_when_its_server_goes(
    served: Served, client: ActionClient, eventually: Any
) -> None:
    server = served.offer(2)
    assert client.wait_for_server(stretched(10))
    goal = client.send_goal({})
    served.goal()
    eventually(lambda: goal.is_accepted)
    server.close()
    assert goal.wait(stretched(30))
    assert goal.status.is_terminal or goal.text


def test_missing_server_is_named_with_the_nearest(
    served: Served, other: Graph, client: ActionClient
) -> None:
    served.offer(2)
    assert client.wait_for_server(stretched(10))
    lost = ActionClient(client._node, "fibonaci", FIBONACCI)
    assert not lost.wait_for_server(0.05)
    with pytest.raises(NotFoundError, match="did you mean '/fibonacci'"):
        lost.send_goal({})


def test_server_of_another_type_is_told(served: Served, client: ActionClient) -> None:
    served.offer(2)
    assert client.wait_for_server(stretched(10))
    wrong = ActionClient(client._node, "fibonacci", "actionlib_tutorials/Averaging")
    with pytest.raises(
        GraphError,
        match="has type actionlib_tutorials/action/Fibonacci, the client wants "
        "actionlib_tutorials/action/Averaging",
    ):
        wrong.send_goal({})


@BOTH
def test_actions_are_listed_with_their_ends(
    served: Served, client: ActionClient, graph: Graph, eventually: Any, ros_version: Any
) -> None:
    served.offer(ros_version)
    assert client.wait_for_server(stretched(10))
    kind = "actionlib_tutorials/action/Fibonacci"
    expected = (ActionInfo("/fibonacci", kind, ros_version, ("/server",), ("/client",)),)
    eventually(lambda: graph.actions() == expected)
    assert actions_of(graph.entities()) == expected


def test_ros1_views_give_ros1_messages(served: Served, other: Graph) -> None:
    served.offer(1)
    kind = ros1_message_type("actionlib_tutorials/FibonacciAction")
    client = ActionClient(other.create_node("client", rosout=False), "fibonacci", kind)
    assert client.wait_for_server(stretched(10))
    goal = client.send_goal(ros1_message_type("actionlib_tutorials/FibonacciGoal")(order=2))
    served.goal().succeed({"sequence": [3]})
    assert goal.wait(stretched(30))
    assert goal.result._type == "actionlib_tutorials/FibonacciResult"
    assert goal.result.sequence == (3,)


CLIENT_ROWS = {
    "WAITING_FOR_GOAL_ACK": "P A PR P< PR AXR AR AR AX",
    "PENDING": "_ A R < <R AXR AR AR AX",
    "ACTIVE": "! _ ! ! ! XR R R X",
    "WAITING_FOR_RESULT": "! _ _ ! _ _ _ _ !",
    "WAITING_FOR_CANCEL_ACK": "_ _ R < <R XR XR XR X",
    "RECALLING": "! ! R _ R XR XR XR X",
    "PREEMPTING": "! ! ! ! ! R R R _",
    "DONE": "! ! _ ! _ _ _ _ !",
}
CLIENT_COLUMNS = (
    "PENDING", "ACTIVE", "REJECTED", "RECALLING", "RECALLED",
    "PREEMPTED", "SUCCEEDED", "ABORTED", "PREEMPTING",
)  # fmt: skip
LETTERS = {"P": "PENDING", "A": "ACTIVE", "R": "WAITING_FOR_RESULT", "<": "RECALLING"}
LETTERS["X"] = "PREEMPTING"


@pytest.mark.parametrize("state", CLIENT_ROWS)
def test_client_passes_the_states_of_actionlib(state: str) -> None:
    assert set(CLIENT_ROWS) == {one.name for one in TRANSITIONS}
    for column, text in zip(CLIENT_COLUMNS, CLIENT_ROWS[state].split(), strict=True):
        found = steps(CommState[state], ActionlibStatus[column])
        wanted = None if text == "!" else [LETTERS[one] for one in text if one != "_"]
        assert (None if found is None else [one.name for one in found]) == wanted, column
    assert steps(CommState.LOST, ActionlibStatus.ACTIVE) is None


@BOTH
def test_goals_arrive_in_the_order_in_which_they_were_sent(
    served: Served, client: ActionClient, ros_version: Any
) -> None:
    served.offer(ros_version)
    client.require_server(stretched())
    for order in range(_MANY):
        client.send_goal({"order": order})
    served.goal(_MANY - 1)
    assert [goal.request.order for goal in served.goals.items] == list(range(_MANY))


@BOTH
def test_goal_ends_quietly_when_its_node_has_gone(
    served: Served, client: ActionClient, ros_version: Any
) -> None:
    """Its thread ends it while the graph is left."""
    served.offer(ros_version)
    assert client.wait_for_server(stretched())
    client.send_goal({"order": 3})
    goal = served.goal()
    served.node.shutdown()
    goal.publish_feedback({"sequence": [0, 1]})
    goal.succeed()
    assert goal.status.name == "SUCCEEDED"
