"""A world that diverges goes back to its last finite state and says who did what."""

from __future__ import annotations

import json
import threading
from collections.abc import Callable, Iterator
from fractions import Fraction

import pytest
from tests.patience import eventually, stretched

from gazelle.errors import SimulationDivergedError
from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type
from gazelle.simulator import Mode, Simulation
from gazelle.simulator.divergence_recovery import OnDivergence
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.simulator.scheduler import Task
from gazelle.simulator.world_server import WorldServer

# A milligram on a rail without an end: what is far too light for its efforts.
FEATHER = """<robot name="feather"><link name="world"/>
  <joint name="spin" type="prismatic"><parent link="world"/><child link="rim"/>
    <axis xyz="0 0 1"/><limit lower="-1e16" upper="1e16" effort="1e30" velocity="1e16"/></joint>
  <link name="rim"><inertial><mass value="1e-6"/>
    <inertia ixx="1e-9" ixy="0" ixz="0" iyy="1e-9" iyz="0" izz="1e-9"/></inertial></link></robot>"""
STONE = FEATHER.replace("feather", "stone").replace("1e-6", "1").replace("1e-9", "0.1")


@pytest.fixture
def sim(load: Callable[..., Simulation]) -> Iterator[Simulation]:
    """A world with something light and something heavy, in real time."""
    sim = load(world="empty", services=True)
    sim.spawn(FEATHER, name="feather")
    sim.spawn(STONE, name="stone")
    yield sim


def _push(sim: Simulation, effort: float = 1e6) -> None:
    request = service_type("gazebo_msgs/ApplyJointEffort").Request(
        joint_name="feather::spin", effort=effort
    )
    request.duration.sec = -1
    assert sim.server.node.call("/gazebo/apply_joint_effort", request).success


def _run_in_real_time(server: WorldServer) -> threading.Thread:
    server.mode = Mode.REAL_TIME
    thread = threading.Thread(target=server.run)
    thread.start()
    return thread


def test_diverging_leaves_the_engine_at_its_last_finite_state(sim: Simulation) -> None:
    engine = sim.server.engine
    _push(sim)
    with pytest.raises(SimulationDivergedError, match="link 'feather::rim'") as caught:
        for _ in range(10_000):
            before, at_ns = engine.state_hash(), engine.time_ns
            sim.step()
    assert caught.value.link == "feather::rim"
    assert (engine.state_hash(), engine.time_ns) == (before, at_ns)


def test_world_in_real_time_pauses_says_who_did_it_and_goes_on(
    sim: Simulation, caplog: pytest.LogCaptureFixture
) -> None:
    server = sim.server
    thread = _run_in_real_time(server)
    try:
        _push(sim)
        eventually(lambda: caplog.records)
        assert server.paused
        (record,) = caplog.records
        assert record.levelname == "ERROR"
        assert "the simulation diverged in step" in record.message
        assert "link 'feather::rim'" in record.message
        assert "efforts at work: 1e+06 at 'spin'" in record.message
        assert "last commands: /gazebo/apply_joint_effort" in record.message
        assert "paused; 'feather' is at rest and free of efforts and wrenches" in record.message
        joint = server.engine.joint("feather::spin")
        assert (joint.velocity, joint.effort) == (0.0, 0.0)
        at_ns = server.time_ns
        server.unpause()
        eventually(lambda: server.time_ns > at_ns + 20_000_000)
        assert not server.paused
    finally:
        server.stop()
        thread.join(stretched())


def test_world_goes_on_without_the_model_where_that_is_wanted(
    sim: Simulation, caplog: pytest.LogCaptureFixture
) -> None:
    server = sim.server
    server.on_divergence = lambda: OnDivergence.REMOVE
    thread = _run_in_real_time(server)
    try:
        _push(sim)
        eventually(lambda: server.engine.world.model("feather") is None)
        at_ns = server.time_ns
        eventually(lambda: server.time_ns > at_ns + 20_000_000)
        assert server.engine.world.model("stone") is not None
        assert "'feather' is taken out of the world, which goes on" in caplog.text
    finally:
        server.stop()
        thread.join(stretched())


def test_what_diverges_soon_again_pauses_each_time_and_is_said_to_do_so(
    sim: Simulation, caplog: pytest.LogCaptureFixture
) -> None:
    """Something that the recovery does not know of throws it each time."""
    server = sim.server

    def throw() -> None:
        if server.engine.world.model("feather") is not None:
            server.engine.joint("feather::spin").set_effort(1e6)

    server.scheduler.add(Task("throw", Fraction(1), throw))
    thread = _run_in_real_time(server)
    try:
        for count in (1, 2, 3):
            eventually(lambda count=count: len(caplog.records) == count and server.paused)
            server.unpause()
        eventually(lambda: len(caplog.records) == 4 and server.paused)
        assert "mend what is named here, then unpause" in caplog.records[0].message
        for record in caplog.records[1:]:
            assert "'feather' is at rest, as it was before: something drives it" in record.message
            assert "stop what drives it, put it elsewhere, delete it" in record.message
        server.commands.call(lambda: server.delete("feather"))
        at_ns = server.time_ns
        server.unpause()
        eventually(lambda: server.time_ns > at_ns + 20_000_000)
    finally:
        server.stop()
        thread.join(stretched())


def test_effort_that_made_a_model_diverge_does_not_come_back_with_the_next_one(
    sim: Simulation,
) -> None:
    server = sim.server
    thread = _run_in_real_time(server)
    try:
        _push(sim)
        eventually(lambda: server.paused)
        _push(sim, effort=1e-9)
        assert server.commands.call(lambda: server.engine.joint("feather::spin").effort) == 1e-9
    finally:
        server.stop()
        thread.join(stretched())


def test_target_of_a_page_that_made_a_model_diverge_ends(sim: Simulation) -> None:
    server = sim.server
    offer_views(server)
    request = {"op": "joint", "model": "feather", "joint": "spin", "position": 1e6, "p": 1e12}
    thread = _run_in_real_time(server)
    try:
        kind = service_type("gazelle_msgs/Do")
        server.node.call("/_gazelle/do", kind.Request(request=json.dumps(request)))
        eventually(lambda: server.paused)
        at_ns = server.time_ns
        server.unpause()
        eventually(lambda: server.time_ns > at_ns + 20_000_000)
        assert not server.paused
    finally:
        server.close()
        thread.join(stretched())


def test_world_in_real_time_outlives_what_a_task_raises_and_tells_it_once(
    sim: Simulation, caplog: pytest.LogCaptureFixture
) -> None:
    server, ran = sim.server, []
    server.scheduler.add(Task("faulty", Fraction(1), lambda: ran.append(1 / 0)))
    thread = _run_in_real_time(server)
    try:
        eventually(lambda: server.time_ns > 20_000_000)
        (record,) = caplog.records
        assert "'faulty' failed at 0.001 s; the world goes on" in record.message
        assert "ZeroDivisionError" in record.message
    finally:
        server.stop()
        thread.join(stretched())


def test_recovery_names_the_node_that_sent_the_command_on_rosout(graph: Graph) -> None:
    node, sender = graph.create_node("gazebo"), graph.create_node("pusher")
    heard: list[str] = []
    listener = graph.create_node("listener", rosout=False)
    listener.create_subscription(
        "/rosout", message_type("rcl_interfaces/Log"), lambda message: heard.append(message.msg)
    )
    sim = Simulation.load(world="empty", node=node)
    server = sim.server
    offer_gazebo_ros(server)
    sim.spawn(FEATHER, name="feather")
    thread = _run_in_real_time(server)
    try:
        client = sender.create_client(
            "/gazebo/apply_joint_effort", service_type("gazebo_msgs/ApplyJointEffort")
        )
        assert client.wait_for_service(stretched())
        request = client.service_class.Request(joint_name="feather::spin", effort=1e6)
        request.duration.sec = -1
        assert client.call(request, stretched()).success
        wanted = "last commands: /gazebo/apply_joint_effort (by /pusher)"
        eventually(lambda: any(wanted in text for text in heard))
    finally:
        server.close()
        thread.join(stretched())


def test_run_as_fast_as_possible_ends(sim: Simulation) -> None:
    sim.server.mode = Mode.FAST
    _push(sim)
    with pytest.raises(SimulationDivergedError):
        sim.server.run(iterations=100_000)
