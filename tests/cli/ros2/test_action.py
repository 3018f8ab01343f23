"""ros2 action."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from gazelle.cli.ros2 import action
from gazelle.graph import Node
from gazelle.graph.actions import ActionServer, ServerGoal

KIND = "example_interfaces/action/Fibonacci"


def _on_goal(goal: ServerGoal) -> None:
    if goal.request.order < 0:
        goal.reject()
        return
    goal.accept()
    if goal.request.order < 9:
        goal.publish_feedback({"sequence": [0, 1]})
        goal.succeed({"sequence": [0, 1, 1]})


def _on_cancel(goal: ServerGoal) -> bool:
    goal.cancel()
    return True


@pytest.fixture(params=[2])
def server(robot: Node, request: pytest.FixtureRequest) -> Iterator[ActionServer]:
    one = ActionServer(
        robot,
        "fibonacci",
        "actionlib_tutorials/Fibonacci" if request.param == 1 else KIND,
        on_goal=_on_goal,
        on_cancel=_on_cancel,
        ros_version=request.param,
    )
    yield one
    one.close()


@pytest.fixture
def ros2_action(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    """Runs ``ros2 action …``."""

    def run(*words: str) -> tuple[int, str, str]:
        capsys.readouterr()
        code = action.main(list(words))
        return code, *capsys.readouterr()

    return run


def test_list_type_find_and_info(server: ActionServer, robot: Node, ros2_action: Any) -> None:
    assert ros2_action("list") == (0, "/fibonacci\n", "")
    assert ros2_action("list", "-t")[1] == f"/fibonacci [{KIND}]\n"
    assert ros2_action("list", "-c")[1] == "1\n"
    assert ros2_action("type", "/fibonacci") == (0, f"{KIND}\n", "")
    assert ros2_action("find", KIND)[1] == "/fibonacci\n"
    text = f"Action: /fibonacci\nAction clients: 0\nAction servers: 1\n    {robot.name}"
    assert ros2_action("info", "/fibonacci") == (0, f"{text}\n", "")
    assert ros2_action("info", "-t", "/fibonacci")[1] == f"{text} [{KIND}]\n"
    code, _, error = ros2_action("type", "/fibonaci")
    assert (code, error) == (1, "there is no action /fibonaci; did you mean '/fibonacci'?\n")


@pytest.mark.parametrize("server", [1, 2], indirect=True)
def test_send_goal_prints_feedback_result_and_status(
    server: ActionServer, ros2_action: Any
) -> None:
    kind = server.types.name
    code, text, error = ros2_action("send_goal", "-f", "/fibonacci", kind, "{order: 5}")
    assert (code, error) == (0, "")
    head, _, rest = text.partition("Goal accepted with ID: ")
    assert head == (
        "Waiting for an action server to become available...\nSending goal:\n     order: 5\n\n"
    )
    feedback = "Feedback:\n    sequence:\n- 0\n- 1\n\n"
    result = "Result:\n    sequence:\n- 0\n- 1\n- 1\n\nGoal finished with status: SUCCEEDED\n"
    assert rest.count(feedback) == 1
    assert rest.replace(feedback, "").endswith(f"\n\n{result}")


def test_send_goal_shows_long_texts_in_one_line(robot: Node, ros2_action: Any) -> None:
    reason = "the hand did not come to where it was sent; " * 4 + "it stands"

    def abort(goal: ServerGoal) -> None:
        goal.accept()
        goal.abort({"error_code": -4, "error_string": reason})

    kind = "control_msgs/action/FollowJointTrajectory"
    one = ActionServer(robot, "follow", kind, on_goal=abort, ros_version=2)
    _, text, _ = ros2_action("send_goal", "follow", kind, "{}")
    one.close()
    assert f"Result:\n    error_code: -4\nerror_string: {reason}\n" in text


def test_send_goal_tells_rejection_and_wrong_fields(server: ActionServer, ros2_action: Any) -> None:
    assert ros2_action("send_goal", "fibonacci", KIND, "{order: -1}")[1].endswith(
        "Goal was rejected.\n"
    )
    code, _, error = ros2_action("send_goal", "fibonacci", KIND, "{odrer: 1}")
    assert code == 1
    assert error.startswith("Failed to populate message fields: ")
    code, _, error = ros2_action("send_goal", "fibonacci", "example_interfaces/action/Fibo")
    assert code == 1
    assert "did you mean 'example_interfaces/action/Fibonacci'" in error


def test_ctrl_c_cancels_the_goal(
    server: ActionServer, gazelle: Callable[..., Any], robot: Node
) -> None:
    port = robot.graph.port
    running = gazelle("ros2", "action", "send_goal", "fibonacci", KIND, "{order: 9}", port=port)
    running.wait_for_line("Goal accepted with ID")
    assert running.stop(signal.SIGINT) == 0
    assert running.lines[-2:] == ["Canceling goal...", "Goal canceled."]
    assert server.goals[0].status.name == "CANCELED"


def test_send_goal_waits_and_says_what_there_is(
    server: ActionServer, gazelle: Callable[..., Any], robot: Node
) -> None:
    port = robot.graph.port
    running = gazelle("ros2", "action", "send_goal", "fibonaci", KIND, port=port)
    running.wait_for_line("action server '/fibonaci' not found; did you mean '/fibonacci'")
    running.stop(signal.SIGINT)
