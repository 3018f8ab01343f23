"""controller_manager.test_utils: what tests of launches ask of controllers, their nodes and joints.

Each check waits, and fails with an `AssertionError` that names what it has not seen in time.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

from gazelle.compat.launch_ros.launch_testing_ros import WaitForTopics
from gazelle.compat.rclpy.executors import SingleThreadedExecutor
from gazelle.interfaces import message_type, service_type

__all__ = ["check_controllers_running", "check_if_js_published", "check_node_running"]

_POLL_S = 0.1
_ANSWER_S = 5.0
_JOINTS_S = 20.0


def check_node_running(node: Any, node_name: str, timeout: float = 5.0) -> None:
    """Wait for a node of any namespace.

    Args:
        node: looks for it.
        node_name: without namespace.
        timeout: in seconds.

    Raises:
        AssertionError: there is none in time.
    """
    there = _wait(lambda: node_name in node.get_node_names(), timeout)
    assert there, f"{node_name} not found! There are {sorted(node.get_node_names())}"


def check_controllers_running(
    node: Any,
    cnames: Sequence[str],
    namespace: str = "",
    state: str = "active",
    timeout: float = 10.0,
) -> None:
    """Wait until controllers are in a state, all of them at once.

    Their controller manager tells; here controllers have no nodes of their own to wait for.

    Args:
        node: looks for them.
        cnames: their names.
        namespace: of their controller manager, with or without a slash at its end.
        state: such as ``active`` or ``inactive``.
        timeout: in seconds.

    Raises:
        AssertionError: the manager does not answer or has no controllers, or a controller is not
            there or in another state.
    """
    # Without a namespace, the manager is that of the node's own.
    manager = f"{namespace.rstrip('/')}/controller_manager" if namespace else "controller_manager"
    client = node.create_client(
        service_type("controller_manager_msgs/srv/ListControllers"), f"{manager}/list_controllers"
    )
    states: dict[str, str] = {}

    def are_in_state() -> bool:
        states.clear()
        states.update(_states(node, client, manager))
        return all(states.get(name) == state for name in cnames)

    try:
        reached = _wait(are_in_state, timeout)
    finally:
        node.destroy_client(client)
    assert states, "No controllers found!"
    others = [f"{one} ({states.get(one, 'none')})" for one in cnames if states.get(one) != state]
    assert reached, f"Controller(s) not found or not {state}: {', '.join(others)}"


def check_if_js_published(topic: str, joint_names: Sequence[str]) -> None:
    """Wait for a ``sensor_msgs/JointState``, which has these joints and no others, in any order.

    Raises:
        AssertionError: none comes in time, or it has other joints.
    """
    kind: Any = message_type("sensor_msgs/msg/JointState")
    waiting = WaitForTopics([(topic, kind)], timeout=_JOINTS_S)
    try:
        assert waiting.wait(), f"Topic '{topic}' not found!"
        names = list(waiting.received_messages(topic)[0].name)
    finally:
        waiting.shutdown()
    said = f"{names} instead of {list(joint_names)}"
    assert len(names) == len(joint_names), f"Wrong number of joints in message: {said}"
    assert set(names) == set(joint_names), f"Wrong joint names: {said}"


def _wait(seen: Callable[[], bool], timeout_s: float) -> bool:
    deadline_s = time.monotonic() + timeout_s
    while not seen():
        if time.monotonic() >= deadline_s:
            return False
        time.sleep(_POLL_S)
    return True


def _states(node: Any, client: Any, manager: str) -> dict[str, str]:
    """Return the states of a manager's controllers by name."""
    there = client.wait_for_service(timeout_sec=_ANSWER_S)
    assert there, f"Could not contact service {manager}/list_controllers"
    future = client.call_async(client.srv_type.Request())
    if node.executor is None or node not in node.executor.get_nodes():
        executor = SingleThreadedExecutor(context=node.context)
        executor.add_node(node)
        executor.spin_until_future_complete(future, timeout_sec=_ANSWER_S)
        executor.remove_node(node)
    else:
        # Somebody spins it; nodes have one executor.
        done = threading.Event()
        future.add_done_callback(lambda _future: done.set())
        done.wait(_ANSWER_S)
    assert future.done(), f"{manager}/list_controllers does not answer"
    return {one.name: one.state for one in future.result().controller}
