"""Two graphs of one test process stand for two processes; one test kills a real one."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.graph.conftest import sleep_in_thread
from tests.patience import stretched

from gazelle.graph import Graph, Node, Publisher, clock, shared_clock_discovery, shared_memory_clock
from gazelle.graph.shared_clock_discovery import SharedClock, share_clock
from gazelle.interfaces import message_type

ClockMessage = message_type("rosgraph_msgs/msg/Clock")
Wait = Callable[..., Any]
S = 1_000_000_000


class _Simulator:
    """Shows a time as the simulator does: on the page first, then to whoever wants messages."""

    def __init__(self, node: Node, *, shares: bool = True) -> None:
        self.publisher: Publisher = node.create_publisher("/clock", ClockMessage)
        shared = share_clock(self.publisher) if shares else None
        assert shared is not None or not shares
        self._shared = shared

    @property
    def shared(self) -> SharedClock:
        assert self._shared is not None
        return self._shared

    def show(self, now_ns: int) -> None:
        if self._shared is not None and self._shared.is_on:
            self._shared.show(now_ns)
        if self.publisher.matched:
            message = ClockMessage()
            message.clock.sec, message.clock.nanosec = divmod(now_ns, S)
            self.publisher.publish(message)

    def close(self) -> None:
        if self._shared is not None:
            self._shared.close()
        self.publisher.unregister()


@pytest.fixture
def world(graph: Graph) -> Graph:
    """Where clocks are published; it goes by wall time itself."""
    graph.clock.use(False)
    graph.parameters.set("/use_sim_time", True)
    return graph


@pytest.fixture
def simulator(world: Graph) -> Iterator[_Simulator]:
    made = _Simulator(world.create_node("simulator"))
    yield made
    made.close()


@pytest.fixture
def node(world: Graph, join: Callable[..., Graph]) -> Node:
    return join().create_node("robot")


@pytest.fixture
def reader(simulator: _Simulator, node: Node, eventually: Wait) -> Node:
    """A node that has found the simulator's page, at 5 s."""
    eventually(lambda: simulator.shared.is_used)
    simulator.show(5 * S)
    eventually(lambda: _reads_page(node) and not simulator.publisher.matched)
    return node


def _reads_page(node: Node) -> bool:
    return node.clock._page is not None


def _follows(node: Node, simulator: _Simulator, from_ns: int) -> Callable[[], bool]:
    """Show one time after the other until the node sees one."""
    now_ns = [from_ns]

    def follows() -> bool:
        now_ns[0] += S
        simulator.show(now_ns[0])
        return node.clock.now_ns() >= from_ns + S

    return follows


def test_a_node_reads_the_page_and_lets_no_messages_come(
    simulator: _Simulator, reader: Node
) -> None:
    assert reader.clock.now_ns() == 5 * S
    simulator.show(6 * S)
    assert reader.clock.now_ns() == 6 * S
    assert not simulator.publisher.matched


def test_others_see_the_subscription_all_the_while(
    simulator: _Simulator, reader: Node, world: Graph
) -> None:
    assert [one.node for one in world.subscriptions_info("/clock")] == ["/robot"]
    assert simulator.publisher.subscription_count == 1


def test_before_anything_is_shown_time_is_zero(simulator: _Simulator, node: Node) -> None:
    assert node.clock.use_sim_time
    assert node.clock.now_ns() == 0


def test_sleepers_look_at_the_page(simulator: _Simulator, reader: Node, eventually: Wait) -> None:
    thread, outcome = sleep_in_thread(lambda: reader.clock.sleep_until(7 * S))
    eventually(lambda: bool(reader.clock._sleepers))
    simulator.show(6 * S)
    assert not outcome
    simulator.show(7 * S)
    thread.join(stretched(30))
    assert outcome == [True]


def test_sleepers_hear_of_time_that_goes_on_after_a_pause(
    simulator: _Simulator, reader: Node, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clock, "_STILL_LOOKS", 1)
    monkeypatch.setattr(clock, "_LONG_STILL_S", 3600.0)
    looks = [0]
    still = reader.clock._waits.still

    def count(number: int) -> float:
        looks[0] = number
        return still(number)

    monkeypatch.setattr(reader.clock._waits, "still", count)
    thread, outcome = sleep_in_thread(lambda: reader.clock.sleep_until(6 * S))
    eventually(lambda: looks[0] > 1)
    monkeypatch.setattr(shared_clock_discovery, "_STILL_S", 0.0)
    simulator.show(6 * S)
    thread.join(stretched(30))
    assert outcome == [True]


def test_who_sleeps_for_moments_hears_each_step(
    simulator: _Simulator, reader: Node, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clock, "_MANY", 1)
    for from_s, length_ns in ((5, 1_000_000), (1000, S)):
        thread, outcome = sleep_in_thread(lambda ns=length_ns: reader.clock.sleep(ns))
        eventually(lambda: bool(reader.clock._sleepers))
        is_short = length_ns < S
        eventually(lambda wanted=not is_short: _reads_page(reader) is wanted)
        eventually(lambda: simulator.publisher.matched is is_short)  # noqa: B023 - at once
        eventually(_follows(reader, simulator, from_s * S))
        last_ns = from_s * S + 500 * S
        simulator.show(last_ns)
        thread.join(stretched(30))
        assert outcome == [True]
        # A message that is still on its way would end the next sleep.
        eventually(lambda wanted=last_ns: reader.clock.now_ns() == wanted)


def test_a_stop_ends_a_sleep_on_the_page(reader: Node, eventually: Wait) -> None:
    stop = threading.Event()
    thread, outcome = sleep_in_thread(lambda: reader.clock.sleep_until(9 * S, stop))
    eventually(lambda: bool(reader.clock._sleepers))
    stop.set()
    thread.join(stretched(30))
    assert outcome == [False] and not reader.clock._sleepers


def test_a_jump_back_wakes_sleepers_and_tells_listeners(
    simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    told: list[int] = []
    reader.clock.on_jump(told.append)
    jumps = reader.clock.jumps
    thread, outcome = sleep_in_thread(lambda: reader.clock.sleep_until(20 * S, since=jumps))
    eventually(lambda: bool(reader.clock._sleepers))
    simulator.show(10 * S)
    simulator.show(1 * S)
    thread.join(stretched(30))
    assert str(outcome[0]) == "time moved backwards by 9.000000000 s"
    eventually(lambda: told)
    assert told == [-9 * S]
    assert reader.clock.jumps == jumps + 1
    assert reader.clock.now_ns() == 1 * S


def test_listeners_hear_of_a_jump_that_nobody_asked_for(
    simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    told: list[int] = []
    reader.clock.on_jump(told.append)
    simulator.show(1 * S)
    eventually(lambda: told)
    assert told == [-4 * S]


def test_who_sees_a_jump_first_counts_it(
    simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    told: list[int] = []
    reader.clock.on_jump(told.append)
    jumps = reader.clock.jumps
    # As when the word of it is still on its way.
    simulator.shared._page.show(2 * S)
    assert reader.clock.jumps == jumps + 1
    assert reader.clock.now_ns() == 2 * S
    eventually(lambda: told)
    assert told == [-3 * S]
    assert reader.clock.jumps == jumps + 1


def test_two_clocks_are_heard_by_messages(
    world: Graph, simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    second = _Simulator(world.create_node("second"), shares=False)
    eventually(lambda: not _reads_page(reader) and second.publisher.matched)
    assert reader.clock.now_ns() == 5 * S
    eventually(_follows(reader, second, 10 * S))
    eventually(_follows(reader, simulator, 100 * S))
    second.close()
    eventually(lambda: _reads_page(reader))
    simulator.show(1000 * S)
    assert reader.clock.now_ns() == 1000 * S


def test_two_pages_are_not_looked_at_either(
    world: Graph, simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    second = _Simulator(world.create_node("second"))
    second.show(7 * S)
    eventually(lambda: not _reads_page(reader) and second.publisher.matched)
    simulator.close()
    eventually(lambda: _reads_page(reader))
    second.show(8 * S)
    assert reader.clock.now_ns() == 8 * S
    second.close()


def test_a_new_simulator_begins_a_new_time(
    world: Graph, simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    told: list[int] = []
    reader.clock.on_jump(told.append)
    simulator.close()
    eventually(lambda: not _reads_page(reader))
    assert reader.clock.now_ns() == 5 * S
    second = _Simulator(world.create_node("second"))
    eventually(lambda: second.publisher.matched)
    second.show(1 * S)
    eventually(lambda: told)
    assert told == [-4 * S]
    assert reader.clock.now_ns() == 1 * S
    eventually(lambda: _reads_page(reader))
    second.close()


def test_a_sleep_goes_on_when_the_page_goes(
    world: Graph, simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    thread, outcome = sleep_in_thread(lambda: reader.clock.sleep_until(9 * S))
    eventually(lambda: bool(reader.clock._sleepers))
    simulator.close()
    second = _Simulator(world.create_node("second"), shares=False)
    now_ns = [5 * S]

    def over() -> bool:
        now_ns[0] += S
        second.show(now_ns[0])
        return bool(outcome)

    eventually(over)
    thread.join(stretched(30))
    assert outcome == [True]


_KILLED = """
import sys, threading
from gazelle.graph import Graph
from gazelle.graph.shared_clock_discovery import share_clock
from gazelle.interfaces import message_type
graph = Graph.open(role="hub")
graph.clock.use(False)
publisher = graph.create_node("killed").create_publisher(
    "/clock", message_type("rosgraph_msgs/msg/Clock")
)
shared = share_clock(publisher)
print(shared._page.path, flush=True)
now_ns = 50_000_000_000
while True:
    now_ns += 1_000_000
    shared.show(now_ns)
    threading.Event().wait(0.001)
"""


def test_the_page_of_a_killed_simulator_stops_nobody(
    world: Graph, node: Node, eventually: Wait, port: int
) -> None:
    words = [sys.executable, "-c", _KILLED]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, text=True, env={**os.environ, "GAZELLE_PORT": str(port)}
    ) as killed:
        assert killed.stdout is not None
        path = Path(killed.stdout.readline().strip())
        eventually(lambda: _reads_page(node))
        eventually(lambda: node.clock.now_ns() > 50 * S)
        killed.kill()
        killed.wait()
    assert node.clock.now_ns() > 50 * S
    eventually(lambda: not _reads_page(node))
    following = _Simulator(world.create_node("following"))
    eventually(lambda: (following.show(3 * S), node.clock.now_ns() == 3 * S)[1])
    assert os.name != "posix" or not path.exists()
    following.close()


def test_another_machine_goes_by_messages(
    simulator: _Simulator, node: Node, eventually: Wait, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_clock_discovery, "machine_name", lambda: "00" * 16)
    eventually(_follows(node, simulator, 5 * S))
    finder = node.clock._finder
    assert finder is not None
    eventually(lambda: finder._offers)
    eventually(_follows(node, simulator, 1000 * S))
    assert not _reads_page(node)
    assert simulator.publisher.matched


@pytest.mark.parametrize("why", ["removed", "another user's"])
def test_who_cannot_open_the_page_goes_by_messages(
    simulator: _Simulator,
    node: Node,
    eventually: Wait,
    monkeypatch: pytest.MonkeyPatch,
    why: str,
) -> None:
    tried = threading.Event()

    def refuse(path: str, secret: bytes) -> Any:
        tried.set()
        if why == "removed":
            Path(path).unlink(missing_ok=True)
            return shared_memory_clock.PageView(path, secret)
        raise PermissionError(path)

    monkeypatch.setattr(shared_clock_discovery, "PageView", refuse)
    eventually(_follows(node, simulator, 5 * S))
    assert tried.wait(stretched(30))
    eventually(_follows(node, simulator, 1000 * S))
    assert not _reads_page(node)
    assert simulator.publisher.matched


def test_where_no_page_can_be_made_messages_do(
    world: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(shared_memory_clock, "_folders", list)
    publisher = world.create_node("simulator").create_publisher("/clock", ClockMessage)
    assert share_clock(publisher) is None


def test_nodes_of_the_publishing_process_take_its_messages(
    world: Graph, simulator: _Simulator
) -> None:
    world.clock.use(True)
    simulator.show(5 * S)
    assert world.clock.now_ns() == 5 * S
    world.create_node("beside")
    simulator.show(6 * S)
    assert world.clock.now_ns() == 6 * S
    assert world.clock._page is None


def test_a_clock_that_is_switched_off_sends_messages(
    simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    simulator.shared.turn(on=False)
    eventually(lambda: not _reads_page(reader) and simulator.publisher.matched)
    eventually(_follows(reader, simulator, 6 * S))
    simulator.shared.turn(on=True)
    simulator.show(1000 * S)
    eventually(lambda: _reads_page(reader))
    assert reader.clock.now_ns() == 1000 * S


def test_a_clock_is_used_while_another_process_follows_it(
    simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    reader.clock.use(False)
    eventually(lambda: not simulator.shared.is_used)
    assert not _reads_page(reader)
    reader.clock.use(True)
    eventually(lambda: simulator.shared.is_used)
    eventually(lambda: _reads_page(reader))


def test_the_next_node_of_a_process_goes_on_with_the_page(
    simulator: _Simulator, reader: Node, eventually: Wait
) -> None:
    jumps = reader.clock.jumps
    second = reader.graph.create_node("second")
    reader.shutdown()
    assert second.clock.now_ns() == 5 * S
    eventually(lambda: _reads_page(second) and not simulator.publisher.matched)
    simulator.show(6 * S)
    assert second.clock.now_ns() == 6 * S
    assert second.clock.jumps == jumps


def test_a_listener_may_end_its_node(simulator: _Simulator, reader: Node, eventually: Wait) -> None:
    reader.clock.on_jump(lambda _delta_ns: reader.shutdown())
    simulator.show(1 * S)
    eventually(lambda: reader.closed and not simulator.shared.is_used)


def test_what_was_on_its_way_changes_nothing(reader: Node) -> None:
    jumps = reader.clock.jumps
    message = ClockMessage()
    message.clock.sec = 4
    reader.clock._on_clock(message)
    assert reader.clock.now_ns() == 5 * S
    assert reader.clock.jumps == jumps


def test_a_clock_under_another_name_is_read_too(
    world: Graph, join: Callable[..., Graph], eventually: Wait
) -> None:
    simulated = world.create_node("simulator", remappings={"/clock": "/sim/clock"})
    node = join().create_node("robot", remappings={"/clock": "/sim/clock"})
    simulator = _Simulator(simulated)
    eventually(_follows(node, simulator, 5 * S))
    eventually(lambda: _reads_page(node))
    simulator.close()
