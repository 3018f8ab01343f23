from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import pytest
from tests.graph.conftest import sleep_in_thread
from tests.patience import stretched

from gazelle.graph import Graph, Node, TimeJumpError
from gazelle.interfaces import message_type

ClockMessage = message_type("rosgraph_msgs/msg/Clock")
Wait = Callable[..., Any]
S = 1_000_000_000


@pytest.fixture
def simulated(graph: Graph) -> Graph:
    graph.parameters.set("/use_sim_time", True)
    return graph


class _Simulator:
    def __init__(self, node: Node) -> None:
        self._publisher = node.create_publisher("/clock", ClockMessage)

    def show(self, now_ns: int) -> None:
        message = ClockMessage()
        message.clock.sec, message.clock.nanosec = divmod(now_ns, S)
        self._publisher.publish(message)


def test_wall_time_is_the_default(graph: Graph) -> None:
    clock = graph.create_node("a").clock
    before = time.time_ns()
    assert before <= clock.now_ns() <= time.time_ns()
    assert not clock.use_sim_time
    assert "/clock" not in dict(graph.topic_names_and_types())
    target = clock.now_ns() + 2_000_000
    assert clock.sleep_until(target)
    assert clock.now_ns() >= target


def test_simulated_time_follows_clock(simulated: Graph) -> None:
    node = simulated.create_node("a")
    assert node.clock.use_sim_time
    assert node.clock.now_ns() == 0
    _Simulator(node).show(5 * S + 7)
    assert node.clock.now_ns() == 5 * S + 7


def test_simulated_time_reaches_other_processes(
    simulated: Graph, join: Callable[..., Graph], eventually: Wait
) -> None:
    member = join().create_node("b")
    simulator = _Simulator(simulated.create_node("a"))
    eventually(lambda: simulator._publisher.subscription_count == 2)

    def shown() -> bool:
        simulator.show(3 * S)
        return member.clock.now_ns() == 3 * S

    eventually(shown)


def test_use_sim_time_may_be_set_later(graph: Graph, eventually: Wait) -> None:
    node = graph.create_node("a")
    graph.parameters.set("/use_sim_time", True)
    eventually(lambda: node.clock.use_sim_time)
    graph.parameters.set("/use_sim_time", False)
    eventually(lambda: not node.clock.use_sim_time)
    eventually(lambda: "/clock" not in dict(graph.topic_names_and_types()))


def test_one_node_of_a_process_carries_the_clock(simulated: Graph, eventually: Wait) -> None:
    first, second = simulated.create_node("a"), simulated.create_node("b")
    assert len(simulated.subscriptions_info("/clock")) == 1
    first.shutdown()
    eventually(lambda: [one.node for one in simulated.subscriptions_info("/clock")] == ["/b"])
    _Simulator(second).show(2 * S)
    assert second.clock.now_ns() == 2 * S


def test_sleep_ends_with_simulated_time(simulated: Graph) -> None:
    node = simulated.create_node("a")
    simulator = _Simulator(node)
    simulator.show(1 * S)
    thread, outcome = sleep_in_thread(lambda: node.clock.sleep_until(3 * S))
    simulator.show(2 * S)
    assert not outcome
    simulator.show(3 * S)
    thread.join(stretched(30))
    assert outcome == [True]


def test_sleep_waits_for_the_first_clock(simulated: Graph, eventually: Wait) -> None:
    node = simulated.create_node("a")
    thread, outcome = sleep_in_thread(lambda: node.clock.sleep(S))
    simulator = _Simulator(node)
    now_ns = 100 * S

    def over() -> bool:
        nonlocal now_ns
        now_ns += S // 4
        simulator.show(now_ns)
        return bool(outcome)

    eventually(over)
    thread.join(stretched(30))
    assert outcome == [True]
    assert now_ns >= 101 * S


def test_jump_back_wakes_sleepers_and_tells_listeners(simulated: Graph) -> None:
    node = simulated.create_node("a")
    simulator = _Simulator(node)
    simulator.show(10 * S)
    jumps: list[int] = []
    node.clock.on_jump(jumps.append)
    asleep = threading.Event()

    def sleep() -> bool:
        asleep.set()
        return node.clock.sleep_until(20 * S)

    thread, outcome = sleep_in_thread(sleep)
    assert asleep.wait(stretched(30))
    with node.clock._lock:
        simulator_jump = threading.Thread(target=simulator.show, args=(1 * S,))
        simulator_jump.start()
    simulator_jump.join(stretched(30))
    simulator.show(30 * S)
    thread.join(stretched(30))
    assert jumps == [-9 * S]
    assert len(outcome) == 1
    if outcome != [True]:  # asleep before the jump, as nearly always
        assert str(outcome[0]) == "time moved backwards by 9.000000000 s"
        assert outcome[0].delta_ns == -9 * S


def test_change_to_simulated_time_is_a_jump_back_for_sleepers(
    graph: Graph, eventually: Wait
) -> None:
    clock = graph.create_node("a").clock
    jumps = clock.jumps
    target_ns = clock.now_ns() + 3600 * S
    thread, outcome = sleep_in_thread(lambda: clock.sleep_until(target_ns, since=jumps))
    graph.parameters.set("/use_sim_time", True)
    thread.join(stretched(30))
    assert clock.use_sim_time
    assert clock.jumps == jumps + 1
    assert [type(one) for one in outcome] == [TimeJumpError]


def test_sleep_begins_anew_when_the_time_becomes_simulated(graph: Graph, eventually: Wait) -> None:
    node = graph.create_node("a")
    thread, outcome = sleep_in_thread(lambda: node.clock.sleep(3600 * S))
    eventually(lambda: bool(node.clock._sleepers))
    graph.parameters.set("/use_sim_time", True)
    eventually(lambda: node.clock.use_sim_time)
    simulator = _Simulator(node)
    simulator.show(1 * S)
    eventually(lambda: [one[0] for one in node.clock._sleepers] == [3601 * S])
    simulator.show(3601 * S)
    thread.join(stretched(30))
    assert outcome == [True]


def test_closing_wakes_sleepers(simulated: Graph) -> None:
    node = simulated.create_node("a")
    thread, outcome = sleep_in_thread(lambda: node.clock.sleep(S))
    simulated.close()
    thread.join(stretched(30))
    assert outcome == [False]


def test_a_node_that_ends_is_not_asked_to_carry_the_clock(simulated: Graph) -> None:
    ending, staying = simulated.create_node("ending"), simulated.create_node("staying")

    def look_again(_reason: str) -> None:
        # As when a parameter changes in another thread at this very moment.
        simulated.clock.use(False)
        simulated.clock.use(True)

    ending.on_shutdown(look_again)
    for node in simulated.nodes:
        if node is not staying and node is not ending:
            node.shutdown()
    ending.shutdown()
    owners = [one.node for one in simulated.entities() if one.name == "/clock"]
    assert staying.name in owners
    assert ending.name not in owners


def test_stop_ends_a_sleep_while_simulated_time_stands_still(simulated: Graph) -> None:
    clock, stop = simulated.create_node("a").clock, threading.Event()
    slept: list[bool] = []
    thread = threading.Thread(target=lambda: slept.append(clock.sleep_until(S, stop)))
    thread.start()
    stop.set()
    thread.join(stretched(10))
    assert slept == [False]


def test_only_those_whose_time_has_come_wake(simulated: Graph) -> None:
    node = simulated.create_node("a")
    simulator = _Simulator(node)
    simulator.show(1 * S)
    early, first = sleep_in_thread(lambda: node.clock.sleep_until(2 * S))
    late, second = sleep_in_thread(lambda: node.clock.sleep_until(9 * S))
    while len(node.clock._sleepers) < 2:
        early.join(0.001)
    simulator.show(3 * S)
    early.join(stretched(30))
    assert first == [True]
    assert [target_ns for target_ns, _, _ in node.clock._sleepers] == [9 * S]
    assert late.is_alive() and not second
    simulator.show(9 * S)
    late.join(stretched(30))
    assert second == [True] and not node.clock._sleepers


def test_a_sleep_ended_early_leaves_nothing_behind(simulated: Graph) -> None:
    node = simulated.create_node("a")
    stop = threading.Event()
    thread, outcome = sleep_in_thread(lambda: node.clock.sleep_until(9 * S, stop))
    while not node.clock._sleepers:
        thread.join(0.001)
    stop.set()
    thread.join(stretched(30))
    assert outcome == [False] and not node.clock._sleepers
