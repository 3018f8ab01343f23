from __future__ import annotations

import math
import threading
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched
from tests.sets import few

from gazelle.interfaces import service_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Mode, Simulation, WorldServer

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]


def test_sensors_without_subscribers_are_not_computed(
    load: Load, cart_urdf: Callable[..., str]
) -> None:
    sim = load(cart_urdf())
    sim.run(seconds=1.0)
    assert sim.server.sensors.computed == 0


def test_a_subscriber_gets_the_very_next_frame_and_none_after_leaving(
    load: Load, cart_urdf: Callable[..., str]
) -> None:
    sim = load(cart_urdf())
    sim.run(seconds=0.55)
    scans: list[Any] = []
    subscription = sim.subscribe("/scan", scans.append)
    sim.run(seconds=0.1)
    assert [scan.header.stamp.nanosec for scan in scans] == [600_000_000]
    subscription.unregister()
    sim.run(seconds=0.5)
    assert sim.server.sensors.computed == 1


def test_clock_ticks_every_step_and_comes_first(load: Load, cart_urdf: Callable[..., str]) -> None:
    sim = load(cart_urdf(), services=True)
    order: list[str] = []
    for topic in ("/scan", "/joint_states", "/clock"):
        sim.subscribe(topic, lambda message, topic=topic: order.append(topic))
    sim.run(seconds=0.1)
    assert order.count("/clock") == 100
    assert order[-3:] == ["/clock", "/joint_states", "/scan"]


def test_all_runs_give_the_same_state_and_messages(
    load: Load, cart_urdf: Callable[..., str]
) -> None:
    noisy = cart_urdf().replace(
        "</ray>", "<noise><type>gaussian</type><stddev>0.01</stddev></noise></ray>"
    )

    def run() -> tuple[str, list[str]]:
        sim = load(noisy)
        seen: list[str] = []
        for topic in ("/odom", "/scan", "/tf", "/joint_states"):
            sim.subscribe(topic, lambda message: seen.append(repr(message)))
        sim.publish("/cmd_vel", twist_message((0.3, 0.0, 0.0), (0.0, 0.0, 0.4)))
        sim.run(seconds=0.3)
        return sim.state_hash(), seen

    first = run()
    assert len(first[1]) == 93
    for _ in range(few(5, 99)):
        assert run() == first


def test_a_reset_gives_the_same_messages_again(
    load: Load, cart_urdf: Callable[..., str], listen: Listen
) -> None:
    sim = load(cart_urdf())
    odometry = listen(sim, "/odom")
    sim.publish("/cmd_vel", twist_message((0.3, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(seconds=0.5)
    first = [repr(message) for message in odometry]
    odometry.clear()
    sim.reset()
    sim.publish("/cmd_vel", twist_message((0.3, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(seconds=0.5)
    assert [repr(message) for message in odometry] == first


def test_deleting_a_model_takes_its_topics_away(load: Load, cart_urdf: Callable[..., str]) -> None:
    sim = load(cart_urdf())
    assert "/scan" in sim.server.node.topics  # type: ignore[attr-defined]
    sim.delete("cart")
    assert sim.server.node.topics == {}  # type: ignore[attr-defined]
    sim.spawn(cart_urdf())
    sim.run(seconds=0.2)
    assert "/scan" in sim.server.node.topics  # type: ignore[attr-defined]


def test_a_new_step_size_keeps_the_rates(
    load: Load, cart_urdf: Callable[..., str], listen: Listen
) -> None:
    sim = load(cart_urdf())
    odometry = listen(sim, "/odom")
    sim.server.set_step(0.0005)
    sim.run(seconds=0.5)
    assert len(odometry) == 50


@pytest.fixture
def running(load: Load, cart_urdf: Callable[..., str]) -> Any:
    """A server that runs in a thread of its own, as gzserver does."""
    threads: list[tuple[WorldServer, threading.Thread]] = []

    def start(*, mode: Mode, paused: bool = False) -> Simulation:
        sim = load(cart_urdf(), services=True)
        sim.server.mode, sim.server.paused = mode, paused
        sim.server.pace.factor = 1.0 if mode is Mode.REAL_TIME else 0.0
        thread = threading.Thread(target=sim.server.run)
        thread.start()
        threads.append((sim.server, thread))
        return sim

    yield start
    for server, thread in threads:
        server.stop()
        thread.join(stretched(30.0))
        assert not thread.is_alive()


def wait_for_clock(sim: Simulation, count: int) -> list[int]:
    stamps: list[int] = []
    enough = threading.Event()

    def take(message: Any) -> None:
        stamps.append(message.clock.sec * 10**9 + message.clock.nanosec)
        if len(stamps) >= count:
            enough.set()

    subscription = sim.subscribe("/clock", take)
    assert enough.wait(stretched(30.0))
    subscription.unregister()
    return stamps


def test_real_time_is_kept(running: Any) -> None:
    import time

    sim = running(mode=Mode.REAL_TIME)
    wait_for_clock(sim, 1)

    def is_kept() -> bool:
        start = time.monotonic()
        stamps = wait_for_clock(sim, 300)
        simulated = (stamps[-1] - stamps[0]) * 1e-9
        return 0.8 * simulated < time.monotonic() - start < stretched(5 * simulated + 0.2)

    # A machine that was busy for a moment loses time, then makes up for it.
    assert any(is_kept() for _ in range(20))


def test_a_paused_server_takes_commands_and_starts_on_demand(running: Any) -> None:
    sim = running(mode=Mode.FAST, paused=True)
    node, empty = sim.server.node, service_type("std_srvs/Empty")
    kind = service_type("gazebo_msgs/GetPhysicsProperties")
    assert node.call("/gazebo/get_physics_properties", kind.Request()).pause
    assert sim.time_ns == 0
    node.call("/gazebo/unpause_physics", empty.Request())
    wait_for_clock(sim, 5)
    node.call("/gazebo/pause_physics", empty.Request())
    stopped = sim.time_ns
    assert node.call("/gazebo/get_physics_properties", kind.Request()).pause
    assert sim.time_ns == stopped


def test_a_paused_server_stops_though_a_command_comes_at_the_same_moment(
    load: Load, cart_urdf: Callable[..., str], monkeypatch: pytest.MonkeyPatch
) -> None:
    server = load(cart_urdf()).server
    server.paused = True
    apply, stopped = server.commands.apply, []

    def stop_just_before() -> None:
        # What a signal does between the loop's question and its taking of commands.
        if not stopped:
            stopped.append(True)
            server.stop()
            server.commands._queue.append(lambda: None)
        apply()

    monkeypatch.setattr(server.commands, "apply", stop_just_before)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()
    thread.join(stretched(30.0))
    assert not thread.is_alive()


def test_a_command_from_a_topic_reaches_a_running_server(running: Any) -> None:
    sim = running(mode=Mode.FAST)
    sim.publish("/cmd_vel", twist_message((0.5, 0.0, 0.0), (0.0, 0.0, 0.0)))
    moved = threading.Event()
    sim.subscribe("/odom", lambda message: message.twist.twist.linear.x > 0.4 and moved.set())
    assert moved.wait(stretched(20.0))


def test_a_mode_that_keeps_time_drops_late_frames_and_says_so(
    load: Load, bare_workspace: object, listen: Listen, monkeypatch: pytest.MonkeyPatch
) -> None:
    camera = """<robot name="eye"><link name="eye"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
      <gazebo reference="eye"><sensor name="camera" type="camera"><update_rate>100</update_rate>
      <camera><image><width>8</width><height>6</height></image></camera>
      <plugin name="p" filename="libgazebo_ros_camera.so"><cameraName>eye</cameraName>
      <frameName>eye</frameName></plugin></sensor></gazebo></robot>"""
    sim = load(camera, world=None)
    sim.server.mode = Mode.FAST
    gate = threading.Event()
    render = sim.server.sensors.render

    def slow(*args: Any, **options: Any) -> Any:
        assert gate.wait(stretched(30.0))
        return render(*args, **options)

    monkeypatch.setattr(sim.server.sensors, "render", slow)
    pictures = listen(sim, "/eye/image_raw")
    sim.run(seconds=0.05)
    gate.set()
    sim.server.frames.wait()
    assert len(pictures) == 1
    assert sim.server.frames.dropped == {"eye::eye::camera": 4}
    found = sim.diagnostics.by_code("simulator.frames-dropped")
    assert len(found) == 1
    assert "camera 'eye::eye::camera' is late for its 100 Hz" in found[0].message


def test_disturbances_are_told_with_the_worlds_time(
    load: Load, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    looks: list[tuple[float, float]] = []

    class Disturbed:
        def look(self, world_s: float, idle_s: float) -> list[str]:
            looks.append((world_s, idle_s))
            return ["nothing was computed"] if len(looks) == 2 else []

    server = load().server
    server.step(250)
    monkeypatch.setattr(server, "_disturbances", Disturbed())
    server.run(iterations=50)
    assert caplog.messages.count("nothing was computed") == 1
    # What was before the run is no standstill.
    assert looks == [(pytest.approx(0.25), math.inf), (pytest.approx(0.3), 0.0)]
