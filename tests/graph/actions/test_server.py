from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from gazelle.errors import GraphError, InterfaceError, NotFoundError
from gazelle.graph.actions import (
    ActionlibStatus,
    ActionServer,
    ActionTiming,
    GoalStateError,
    Ros2Status,
    ServerGoal,
)
from gazelle.graph.errors import ServiceRefusedError
from gazelle.interfaces import message_type, service_type
from gazelle.simulator.intra_process_node import LocalNode

FIBONACCI = "actionlib_tutorials/Fibonacci"
GOAL = message_type("actionlib_tutorials/FibonacciActionGoal")
GOAL_ID = message_type("actionlib_msgs/GoalID")
TIME = message_type("builtin_interfaces/msg/Time")
CANCEL = service_type("action_msgs/srv/CancelGoal")
S = 1_000_000_000


class Owner:
    """Takes goals and keeps them."""

    def __init__(self) -> None:
        self.goals: list[ServerGoal] = []
        self.cancelled: list[ServerGoal] = []
        self.agrees = True
        self.accepts = True

    def on_goal(self, goal: ServerGoal) -> None:
        self.goals.append(goal)
        if self.accepts:
            goal.accept()

    def on_cancel(self, goal: ServerGoal) -> bool:
        self.cancelled.append(goal)
        return self.agrees


class World:
    """A node without a graph, a clock that the test sets, and everything published."""

    def __init__(self) -> None:
        self.node = LocalNode()
        self.owner = Owner()
        self.now_ns = S
        self.seen: dict[str, list[Any]] = {}

    def serve(self, ros_version: Any = 1, **options: Any) -> ActionServer:
        return ActionServer(
            self.node,
            "fibonacci",
            FIBONACCI,
            on_goal=self.owner.on_goal,
            on_cancel=self.owner.on_cancel,
            ros_version=ros_version,
            timing=ActionTiming(now_ns=lambda: self.now_ns),
            **options,
        )

    def listen(self, topic: str) -> list[Any]:
        got = self.seen.setdefault(topic, [])
        self.node.create_subscription(f"/fibonacci/{topic}", None, got.append)
        return got

    def publish(self, topic: str, message: Any) -> None:
        self.node.create_publisher(f"/fibonacci/{topic}", type(message)).publish(message)

    def send(self, goal_id: str, sec: int = 0) -> None:
        message = GOAL()
        message.goal_id.id = goal_id
        message.goal_id.stamp.sec = sec
        message.goal.order = 5
        self.publish("goal", message)

    def cancel(self, goal_id: str = "", sec: int = 0) -> None:
        self.publish("cancel", GOAL_ID(id=goal_id, stamp=TIME(sec=sec)))

    def statuses(self) -> dict[str, int]:
        return {one.goal_id.id: one.status for one in self.listen("status")[-1].status_list}


@pytest.fixture
def world() -> World:
    return World()


def test_goal_by_topic_is_accepted_and_its_result_carries_status_and_text(world: World) -> None:
    world.serve()
    results, statuses = world.listen("result"), world.listen("status")
    world.send("one")
    assert [one.status for one in statuses[-1].status_list] == [ActionlibStatus.ACTIVE]
    goal = world.owner.goals[0]
    assert (goal.goal_id, goal.request.order) == ("one", 5)
    goal.succeed({"sequence": [0, 1, 1]}, "well done")
    assert results[0].status.goal_id.id == "one"
    assert (results[0].status.status, results[0].status.text) == (3, "well done")
    assert list(results[0].result.sequence) == [0, 1, 1]
    assert statuses[-1].status_list[0].status == 3


def test_goal_that_comes_while_the_action_is_offered_is_taken(world: World) -> None:
    message = GOAL()
    message.goal_id.id = "one"
    world.node.create_publisher("/fibonacci/goal", GOAL, latch=True).publish(message)
    world.serve()
    assert world.owner.goals[0].status is ActionlibStatus.ACTIVE
    # Nothing that was told later says that there is no goal.
    assert world.statuses() == {"one": ActionlibStatus.ACTIVE}


def test_request_that_comes_while_the_services_are_offered_is_answered(
    world: World, monkeypatch: pytest.MonkeyPatch
) -> None:
    def create_service(name: str, kind: Any, handler: Callable[[Any], Any]) -> Any:
        if name.endswith("/send_goal"):
            answers.append(handler(kind.Request()))
        return offer(name, kind, handler)

    answers: list[Any] = []
    offer = world.node.create_service
    monkeypatch.setattr(world.node, "create_service", create_service)
    world.serve(2)
    assert [one.accepted for one in answers] == [True]
    assert len(world.listen("_action/status")[-1].status_list) == 1


def test_goal_without_id_and_stamp_gets_both(world: World) -> None:
    world.serve()
    world.now_ns = 12 * S + 345
    world.send("")
    goal = world.owner.goals[0]
    assert goal.goal_id == "/gazelle-1-12.345"
    assert goal.stamp_ns == 12 * S + 345


def test_goal_that_is_known_already_is_not_taken_twice(world: World) -> None:
    world.serve()
    world.send("one")
    world.send("one")
    assert len(world.owner.goals) == 1


def test_feedback_carries_the_goal_and_is_not_built_for_nobody(world: World) -> None:
    world.serve()
    world.send("one")
    goal = world.owner.goals[0]
    assert not goal.is_feedback_wanted
    feedback = world.listen("feedback")
    assert goal.is_feedback_wanted
    goal.publish_feedback({"sequence": [0, 1]})
    assert feedback[0].status.goal_id.id == "one"
    assert list(feedback[0].feedback.sequence) == [0, 1]


@pytest.mark.parametrize(
    ("goal_id", "sec", "hit"),
    [
        ("", 0, ["a", "b", "c"]),
        ("b", 0, ["b"]),
        ("", 2, ["a", "b"]),
        ("c", 1, ["a", "c"]),
        ("other", 0, []),
    ],
)
def test_cancel_matches_id_stamp_or_all(
    world: World, goal_id: str, sec: int, hit: list[str]
) -> None:
    world.serve()
    for number, name in enumerate("abc", 1):
        world.send(name, number)
    world.cancel(goal_id, sec)
    assert [goal.goal_id for goal in world.owner.cancelled] == hit
    expected = {name: 6 if name in hit else 1 for name in "abc"}
    assert world.statuses() == expected


def test_cancel_before_its_goal_recalls_it(world: World) -> None:
    world.serve()
    results = world.listen("result")
    world.cancel("late")
    world.send("late")
    assert not world.owner.goals
    assert results[0].status.status == ActionlibStatus.RECALLED


def test_goal_older_than_the_last_cancel_by_stamp_is_recalled(world: World) -> None:
    world.serve()
    results = world.listen("result")
    world.cancel(sec=5)
    world.send("old", 4)
    world.send("new", 6)
    assert [goal.goal_id for goal in world.owner.goals] == ["new"]
    assert "before the timestamp of the last cancel request" in results[0].status.text


def test_goal_cancelled_while_pending_goes_by_recalling(world: World) -> None:
    world.owner.accepts = False
    world.serve()
    world.send("one")
    world.cancel("one")
    goal = world.owner.goals[0]
    assert goal.status is ActionlibStatus.RECALLING
    goal.accept()
    assert goal.status is ActionlibStatus.PREEMPTING
    goal.cancel()
    assert goal.status is ActionlibStatus.PREEMPTED


def test_status_is_latched_periodic_by_tick_and_forgets_after_five_seconds(world: World) -> None:
    server = world.serve()
    world.send("one")
    world.owner.goals[0].succeed()
    statuses = world.listen("status")
    assert [one.status for one in statuses[0].status_list] == [3]
    for _ in range(1000):
        world.now_ns += S // 1000
        server.tick()
    assert len(statuses) == 1 + 5
    world.now_ns += 5 * S
    server.tick()
    assert not statuses[-1].status_list
    assert statuses[-1].header.stamp.sec == 7


def test_submit_gives_a_handle_without_any_transport(world: World) -> None:
    server = world.serve()
    seen: list[Any] = []
    handle = server.submit(
        {"order": 3}, on_feedback=seen.append, on_done=lambda one: seen.append(one.status)
    )
    goal = world.owner.goals[0]
    goal.publish_feedback({"sequence": [7]})
    assert list(handle.feedback.sequence) == [7]
    assert (handle.is_done, handle.result) == (False, None)
    handle.cancel()
    assert handle.status is ActionlibStatus.PREEMPTING
    goal.cancel({"sequence": [1]}, "stopped")
    assert handle.wait(0)
    assert (handle.status.name, handle.text) == ("PREEMPTED", "stopped")
    assert list(handle.result.sequence) == [1]
    assert seen[1] is ActionlibStatus.PREEMPTED


def test_submit_names_the_field_that_does_not_exist(world: World) -> None:
    server = world.serve()
    with pytest.raises(InterfaceError, match="ordr"):
        server.submit({"ordr": 3})


@pytest.mark.parametrize("ros_version", [1, 2])
def test_calls_wait_for_the_owners_thread(world: World, ros_version: Any) -> None:
    todo: list[Callable[[], None]] = []
    server = world.serve(ros_version, run=todo.append)
    handle = server.submit({"order": 3})
    assert not world.owner.goals
    todo.pop()()
    assert world.owner.goals[0].is_active
    assert handle.status.is_executing


def test_callback_that_raises_rejects_the_goal_and_is_logged(
    world: World, caplog: pytest.LogCaptureFixture
) -> None:
    server = world.serve()
    world.owner.goals = None  # type: ignore[assignment]
    handle = server.submit({})
    assert handle.status is ActionlibStatus.REJECTED
    assert "'NoneType' object has no attribute 'append'" in caplog.text


def test_close_aborts_what_runs_and_refuses_more(world: World) -> None:
    server = world.serve()
    results = world.listen("result")
    handle = server.submit({})
    server.close()
    server.close()
    assert handle.status is ActionlibStatus.ABORTED
    assert results[0].status.text == "the action server was closed"
    with pytest.raises(GraphError, match="action server /fibonacci is closed"):
        server.submit({})


def test_error_of_an_impossible_step_has_the_words_of_ros(world: World) -> None:
    server = world.serve()
    server.submit({})
    goal = world.owner.goals[0]
    goal.succeed()
    with pytest.raises(GoalStateError, match="it is currently in state: 3"):
        goal.abort()
    server = world.serve(2)
    server.submit({})
    goal = world.owner.goals[1]
    with pytest.raises(
        GoalStateError, match="invalid transition from state EXECUTING with event CANCEL"
    ):
        goal.cancel()


def test_unknown_action_names_the_nearest(world: World) -> None:
    with pytest.raises(NotFoundError, match="actionlib_tutorials/"):
        ActionServer(world.node, "x", "actionlib_tutorials/Fibonaci", on_goal=world.owner.on_goal)


def test_a_class_that_is_no_action_is_refused(world: World) -> None:
    with pytest.raises(GraphError, match="Type is not an action spec"):
        ActionServer(world.node, "x", GOAL_ID, on_goal=world.owner.on_goal)


class Ros2:
    """Calls the services of a ROS 2 action server without a graph."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.server = world.serve(2)
        self.types = self.server.types

    def send(self, number: int) -> Any:
        request = self.types.SendGoal.Request()
        request.goal_id.uuid = bytes([number] * 16)
        request.goal.order = number
        return self.world.node.call("/fibonacci/_action/send_goal", request)

    def cancel(self, number: int = 0, sec: int = 0) -> tuple[int, list[int]]:
        request = CANCEL.Request()
        request.goal_info.goal_id.uuid = bytes([number] * 16)
        request.goal_info.stamp.sec = sec
        answer = self.world.node.call("/fibonacci/_action/cancel_goal", request)
        return answer.return_code, [int(one.goal_id.uuid[0]) for one in answer.goals_canceling]

    def result(self, number: int) -> Any:
        request = self.types.GetResult.Request()
        request.goal_id.uuid = bytes([number] * 16)
        return self.world.node.call("/fibonacci/_action/get_result", request)


@pytest.fixture
def ros2(world: World) -> Ros2:
    return Ros2(world)


def test_ros2_goal_is_answered_with_its_decision_and_stamp(world: World, ros2: Ros2) -> None:
    answer = ros2.send(1)
    assert (answer.accepted, answer.stamp.sec) == (True, 1)
    assert world.owner.goals[0].status is Ros2Status.EXECUTING
    world.owner.on_goal = lambda goal: goal.reject()  # type: ignore[method-assign]
    server = world.serve(2)
    assert server.submit({}).status is Ros2Status.REJECTED


def test_ros2_goal_id_is_taken_once(ros2: Ros2) -> None:
    assert ros2.send(1).accepted
    assert not ros2.send(1).accepted


def test_ros2_status_lists_goals_in_the_numbers_of_action_msgs(world: World, ros2: Ros2) -> None:
    statuses: list[Any] = []
    world.node.create_subscription("/fibonacci/_action/status", None, statuses.append)
    ros2.send(1)
    ros2.send(2)
    world.owner.goals[0].succeed()
    assert [one.status for one in statuses[-1].status_list] == [4, 2]
    assert [one.status for one in statuses[0].status_list] == []


def test_ros2_feedback_carries_the_uuid(world: World, ros2: Ros2) -> None:
    got: list[Any] = []
    ros2.send(9)
    world.node.create_subscription("/fibonacci/_action/feedback", None, got.append)
    world.owner.goals[0].publish_feedback({"sequence": [3]})
    assert bytes(got[0].goal_id.uuid) == bytes([9] * 16)
    assert list(got[0].feedback.sequence) == [3]


def test_ros2_result_waits_for_the_end_and_is_kept_for_fifteen_minutes(
    world: World, ros2: Ros2
) -> None:
    ros2.send(1)
    with pytest.raises(ServiceRefusedError, match="not over yet; step the world first"):
        ros2.result(1)
    world.owner.goals[0].abort({"sequence": [4]})
    assert (ros2.result(1).status, list(ros2.result(1).result.sequence)) == (6, [4])
    world.now_ns += 900 * S
    assert ros2.result(1).status == 6
    world.now_ns += 1
    assert ros2.result(1).status == 0


def test_ros2_cancel_answers_with_the_codes_of_action_msgs(world: World, ros2: Ros2) -> None:
    for number in (1, 2, 3, 4):
        world.now_ns = number * S
        ros2.send(number)
    assert ros2.cancel(9) == (2, [])
    assert ros2.cancel(3) == (0, [3])
    assert world.owner.goals[2].status is Ros2Status.CANCELING
    assert ros2.cancel(3) == (3, [])
    world.owner.goals[2].cancel()
    assert ros2.cancel(3) == (3, [])
    assert ros2.cancel(0, sec=1) == (0, [1])
    world.owner.agrees = False
    assert ros2.cancel(2) == (1, [])
    assert world.owner.goals[1].status is Ros2Status.EXECUTING
    assert ros2.cancel() == (1, [])
    world.owner.agrees = True
    assert ros2.cancel() == (0, [2, 4])
    for goal in world.owner.goals:
        if goal.is_active:
            goal.cancel()
    assert ros2.cancel() == (0, [])


def test_ros2_owner_may_end_the_goal_while_it_is_asked_to_cancel(world: World) -> None:
    def on_cancel(goal: ServerGoal) -> bool:
        goal.cancel({"sequence": [1]})
        return True

    world.owner.on_cancel = on_cancel  # type: ignore[method-assign]
    ros2 = Ros2(world)
    ros2.send(1)
    assert ros2.cancel(1) == (0, [1])
    assert ros2.result(1).status == Ros2Status.CANCELED


def test_ros2_deferred_goal_is_accepted_until_executed(world: World, ros2: Ros2) -> None:
    world.owner.on_goal = lambda goal: goal.accept_deferred()  # type: ignore[method-assign]
    server = world.serve(2)
    handle = server.submit({})
    assert handle.status is Ros2Status.ACCEPTED
    server.goals[0].execute()
    assert handle.status is Ros2Status.EXECUTING
