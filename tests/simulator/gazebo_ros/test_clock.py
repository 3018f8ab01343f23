"""Whether other processes read a world's time from its page; another graph stands for one."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from tests.patience import eventually

from gazelle.graph import Graph, Node
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.wall_clock import Mode


@pytest.fixture
def simulator(free_port: int) -> Iterator[Graph]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield graph


@pytest.fixture
def node(simulator: Graph, free_port: int) -> Iterator[Node]:
    simulator.parameters.set("/use_sim_time", True)
    with Graph.open(port=free_port, environ={}) as graph:
        yield graph.create_node("robot")


@pytest.fixture
def world(simulator: Graph) -> Iterator[Callable[[Mode], Simulation]]:
    made: list[Simulation] = []

    def start(mode: Mode) -> Simulation:
        sim = Simulation.load(world="empty", node=simulator.create_node("gazebo"))
        made.append(sim)
        sim.server.mode = mode
        sim.server.pace.factor = 1.0 if mode is Mode.REAL_TIME else 0.0
        offer_gazebo_ros(sim.server)
        return sim

    yield start
    for sim in made:
        sim.server.close()


def _reads_page(sim: Simulation, node: Node) -> bool:
    sim.server.step()
    return node.clock._page is not None


def _hears(sim: Simulation, node: Node) -> bool:
    sim.server.step()
    return node.clock._page is None and 0 < sim.server.time_ns - node.clock.now_ns() < 50_000_000


def test_a_world_in_real_time_shows_each_step(
    world: Callable[[Mode], Simulation], node: Node
) -> None:
    sim = world(Mode.REAL_TIME)
    eventually(lambda: _reads_page(sim, node))
    for _ in range(3):
        sim.server.step()
        assert node.clock.now_ns() == sim.server.time_ns


def test_a_reset_takes_time_back(world: Callable[[Mode], Simulation], node: Node) -> None:
    sim = world(Mode.REAL_TIME)
    eventually(lambda: _reads_page(sim, node))
    told: list[int] = []
    node.clock.on_jump(told.append)
    sim.server.step(10)
    before_ns = sim.server.time_ns
    sim.server.reset()
    sim.server.step()
    assert node.clock.now_ns() == sim.server.time_ns == 1_000_000
    eventually(lambda: told)
    assert told == [1_000_000 - before_ns]


@pytest.mark.parametrize("mode", [Mode.FAST, Mode.LOCKSTEP])
def test_a_world_that_waits_for_its_readers_sends_messages(
    world: Callable[[Mode], Simulation], node: Node, mode: Mode
) -> None:
    sim = world(mode)
    sim.server.step()
    eventually(lambda: node.graph.publisher_count("/clock") and _hears(sim, node))
    assert node.clock._finder is not None and not node.clock._finder._offers


def test_a_world_that_is_told_to_run_as_fast_as_possible_goes_over_to_messages(
    world: Callable[[Mode], Simulation], node: Node
) -> None:
    sim = world(Mode.REAL_TIME)
    eventually(lambda: _reads_page(sim, node))
    sim.server.set_update_rate(0.0)
    eventually(lambda: _hears(sim, node))
    sim.server.set_update_rate(1000.0)
    eventually(lambda: _reads_page(sim, node))
    assert node.clock.now_ns() == sim.server.time_ns


def test_a_world_that_goes_leaves_its_nodes_the_last_time(
    world: Callable[[Mode], Simulation], node: Node
) -> None:
    sim = world(Mode.REAL_TIME)
    eventually(lambda: _reads_page(sim, node))
    sim.server.step()
    sim.server.close()
    eventually(lambda: node.clock._page is None)
    assert node.clock.now_ns() == sim.server.time_ns
