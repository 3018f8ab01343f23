from __future__ import annotations

import contextlib
import math
import re
import threading
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.graph.errors import GraphError
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros import physics_parameters
from gazelle.simulator.gzserver_command_line import ServerOptions
from gazelle.simulator.gzserver_process import ros_version_of, serve
from gazelle.simulator.gzserver_ros_parameters import PARAMETERS
from gazelle.simulator.spawn_model import spawn_model


@dataclass(frozen=True)
class Arguments:
    rest: tuple[str, ...] = ()
    name: str = "gazebo"
    namespace: str = "/"
    remappings: Mapping[str, str] = field(default_factory=dict)
    params: Mapping[str, Any] = field(default_factory=dict)
    started_by: int = 0
    parameter_files: tuple[Path, ...] = ()


@pytest.fixture
def start(graph: Graph) -> Iterator[Callable[..., None]]:
    """Starts a server in a thread, as a launch starts it in a process."""
    stop = threading.Event()
    threads: list[threading.Thread] = []
    codes: list[int] = []

    def begin(*words: str, **arguments: Any) -> None:
        given = Arguments(words, **arguments)
        thread = threading.Thread(target=lambda: codes.append(serve(given, graph, stop)))
        thread.start()
        threads.append(thread)

    yield begin
    stop.set()
    for thread in threads:
        thread.join(stretched())
        assert not thread.is_alive()
    assert codes == [0] * len(threads)


def test_gazebo_of_ros2_offers_its_parameters(graph: Graph, start: Callable[..., None]) -> None:
    start("--pause", "-s", "libgazebo_ros_init.so", started_by=2, params={"publish_rate": 20.0})
    service = service_type("rcl_interfaces/GetParameters")
    assert graph.wait_for_service("/gazebo/get_parameters", stretched())
    client = graph.create_node("asks").create_client("/gazebo/get_parameters", service)
    asked = service.Request(names=["publish_rate", "use_sim_time"])
    rate, simulated = client.call(asked, timeout_s=stretched()).values
    assert (rate.double_value, simulated.bool_value) == (20.0, True)


@pytest.mark.parametrize("by_file", [True, False])
def test_publish_rate_of_gazebo_is_the_clocks(
    graph: Graph, start: Callable[..., None], tmp_path: Path, by_file: bool
) -> None:
    file = tmp_path / "gazebo.yaml"
    file.write_text("gazebo:\n  ros__parameters:\n    publish_rate: 20.0\n")
    files, params = ((file,), {}) if by_file else ((), {"publish_rate": 20.0})
    seen: list[int] = []
    came = threading.Event()
    listener = graph.create_node("listener", anonymous=True)

    def take(message: Any) -> None:
        seen.append(message.clock.nanosec // 1_000_000 % 1000)
        if len(seen) > 5:
            came.set()

    listener.create_subscription("/clock", message_type("rosgraph_msgs/Clock"), take)
    start("empty", name="gzserver", started_by=2, parameter_files=files, params=params)
    assert came.wait(stretched())
    assert {one % 50 for one in seen} == {0}


def test_a_world_says_what_stands_in_for_a_model_of_a_server_without_being_verbose(
    graph: Graph, start: Callable[..., None], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    world = tmp_path / "yard.sdf"
    world.write_text(
        """<sdf version="1.9"><world name="yard"><include><uri>
          https://fuel.gazebosim.org/1.0/OpenRobotics/models/Playground
        </uri></include></world></sdf>"""
    )
    start(str(world))
    call(graph, "/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties")
    said = capsys.readouterr().err
    assert said.count("plain shapes of Gazelle's own stand in for Fuel's model 'Playground'") == 1


@pytest.mark.parametrize(
    ("plugins", "started_by", "version"),
    [
        ((), 0, 0),
        ((), 1, 1),
        ((), 2, 2),
        (("libgazebo_ros_init.so",), 0, 2),
        (("libgazebo_ros_factory.so",), 2, 2),
        (("libgazebo_ros_api_plugin.so", "libgazebo_ros_paths_plugin.so"), 0, 1),
        (("libgazebo_ros_init.so",), 1, 0),
        (("libgazebo_ros_init.so", "libgazebo_ros_api_plugin.so"), 0, 0),
    ],
)
def test_launch_and_plug_ins_of_the_server_tell_the_version_of_ros(
    plugins: tuple[str, ...], started_by: int, version: int
) -> None:
    assert ros_version_of(ServerOptions(plugins=plugins), started_by) == version


def call(graph: Graph, name: str, kind: str, **fields: Any) -> Any:
    node = graph.create_node("caller", anonymous=True)
    client = node.create_client(name, service_type(kind))
    assert client.wait_for_service(stretched())
    return client.call(service_type(kind).Request(**fields), stretched())


def test_a_robot_is_spawned_driven_and_measured_over_the_graph(
    graph: Graph, start: Callable[..., None], cart_urdf: Callable[..., str]
) -> None:
    start("--fast", "empty")
    node = graph.create_node("tester")
    node.parameters.set("/robot_description", cart_urdf())
    argv = ["-urdf", "-param", "robot_description", "-model", "cart", "-x", "1.5"]
    assert spawn_model(argv, node, threading.Event()) == 0
    moved, scanned = threading.Event(), threading.Event()
    first: list[Any] = []

    def take(message: Any) -> None:
        first.append(message)
        if message.twist.twist.linear.x > 0.35:
            moved.set()

    node.create_subscription("/odom", message_type("nav_msgs/Odometry"), take)
    node.create_subscription(
        "/scan", message_type("sensor_msgs/LaserScan"), lambda message: scanned.set()
    )
    commands = node.create_publisher("/cmd_vel", message_type("geometry_msgs/Twist"))
    commands.publish(twist_message((0.4, 0.0, 0.0), (0.0, 0.0, 0.0)))
    assert moved.wait(stretched())
    assert scanned.wait(stretched())
    assert first[0].pose.pose.position.x == pytest.approx(1.5, abs=0.05)
    assert node.parameters.get("/use_sim_time") is True


def test_remappings_of_the_launch_reach_the_plug_ins(
    graph: Graph, start: Callable[..., None], cart_urdf: Callable[..., str]
) -> None:
    start("-u", remappings={"/scan": "/front/scan"})
    answer = call(
        graph,
        "/gazebo/spawn_urdf_model",
        "gazebo_msgs/SpawnModel",
        model_name="cart",
        model_xml=cart_urdf(),
    )
    assert answer.success
    assert "/front/scan" in dict(graph.topic_names_and_types())


def test_a_paused_world_stands_still_until_told(graph: Graph, start: Callable[..., None]) -> None:
    start("-u", "--fast")
    kind = "gazebo_msgs/GetWorldProperties"
    assert call(graph, "/gazebo/get_world_properties", kind).sim_time == 0.0
    ticked = threading.Event()
    node = graph.create_node("tester")
    node.create_subscription("/clock", message_type("rosgraph_msgs/Clock"), lambda m: ticked.set())
    call(graph, "/gazebo/unpause_physics", "std_srvs/Empty")
    assert ticked.wait(stretched())


def test_ros_2_names_are_offered_when_its_plug_ins_are_named(
    graph: Graph, start: Callable[..., None], cart_urdf: Callable[..., str], tmp_path: Path
) -> None:
    start("-u", "-s", "libgazebo_ros_init.so", "-s", "libgazebo_ros_factory.so")
    path = tmp_path / "cart.urdf"
    path.write_text(cart_urdf())
    node = graph.create_node("spawn_entity")
    argv = ["-entity", "cart", "-file", str(path), "-z", "0.5"]
    assert spawn_model(argv, node, threading.Event()) == 0
    found = call(graph, "/get_model_list", "gazebo_msgs/GetModelList")
    assert found.model_names == ["ground_plane", "cart"]


_API_LINES = ("Finished loading Gazebo ROS API Plugin.", "Physics dynamic reconfigure ready.")


@pytest.mark.parametrize(
    ("words", "started_by", "shows"),
    [
        ((), 1, True),
        ((), 0, True),
        ((), 2, False),
        (("-s", "libgazebo_ros_factory.so"), 0, False),
        (("--gz",), 0, False),
    ],
)
def test_only_ros_1_shows_the_names_and_lines_of_its_gazebo_ros(
    graph: Graph,
    start: Callable[..., None],
    words: tuple[str, ...],
    started_by: int,
    shows: bool,
) -> None:
    start("-u", *words, started_by=started_by)
    space = "/gazebo" if shows else "/_gazebo"
    kind = "gazebo_msgs/GetWorldProperties"
    assert call(graph, f"{space}/get_world_properties", kind).model_names == ["ground_plane"]
    call(graph, "/_gazelle/do", "gazelle_msgs/Do", request="{}")
    offered = [
        name
        for name in (*(one.name for one in graph.services()), *(one.name for one in graph.topics()))
        # Loggers and parameters belong to the node.
        if name.startswith("/gazebo/") and not re.search("logger|parameter", name)
    ]
    assert bool(offered) is shows, offered
    if shows:
        assert {"/gazebo/model_states", "/gazebo/pause_physics"} <= set(offered)


@pytest.mark.parametrize(("version", "told"), [(1, True), (2, False), (0, False)])
def test_lines_of_the_api_plug_in_are_ros_1s(
    graph: Graph, capfd: pytest.CaptureFixture[str], version: int, told: bool
) -> None:
    words = ("--iters", "1", *(() if version else ("--gz",)))
    assert serve(Arguments(words, started_by=version), graph, threading.Event()) == 0
    text = "".join(capfd.readouterr())
    assert [line in text for line in _API_LINES] == [told, told]


@pytest.mark.parametrize(
    ("plugin", "services"),
    [
        ("init", {"pause_physics", "unpause_physics", "reset_simulation", "reset_world"}),
        ("factory", {"spawn_entity", "delete_entity", "get_model_list"}),
        (
            "force_system",
            {
                "apply_link_wrench", "clear_link_wrenches", "apply_joint_effort",
                "clear_joint_efforts",
            },
        ),
    ],
)  # fmt: skip
def test_each_plug_in_of_ros_2_offers_its_own_services(
    graph: Graph, start: Callable[..., None], plugin: str, services: set[str]
) -> None:
    start("-u", "-s", f"libgazebo_ros_{plugin}.so", started_by=2)
    call(graph, "/_gazelle/do", "gazelle_msgs/Do", request="{}")
    root = {one.name[1:] for one in graph.services() if one.name.count("/") == 1}
    assert root == services


def test_refusals_name_the_caller(graph: Graph, start: Callable[..., None]) -> None:
    heard: list[str] = []
    graph.create_node("listener", rosout=False).create_subscription(
        "/rosout", message_type("rcl_interfaces/Log"), lambda message: heard.append(message.msg)
    )
    start("-u")
    state = message_type("gazebo_msgs/ModelState")(model_name="ground_plane")
    state.pose.position.x = math.nan
    fields: dict[str, Any]
    for service, kind, fields, words in (
        ("set_model_state", "SetModelState", {"model_state": state},
         "field 'model_state.pose.position.x' is nan"),
        ("set_physics_properties", "SetPhysicsProperties", {"time_step": -1.0},
         "field 'time_step' is -1"),
    ):  # fmt: skip
        answer = call(graph, f"/gazebo/{service}", f"gazebo_msgs/{kind}", **fields)
        assert not answer.success
        text = answer.status_message
        assert text.startswith(f"/gazebo/{service}: {words}")
        assert re.search(r"; nothing is changed \(called by /caller\w*\)$", text)
        eventually(lambda text=text: text in heard)


# A milligram that a motor of no limit drives.
_FEATHER = """<robot name="feather"><link name="world"/>
  <joint name="spin" type="prismatic"><parent link="world"/><child link="rim"/>
    <axis xyz="0 0 1"/><limit lower="-1e16" upper="1e16" effort="1e30" velocity="1e16"/></joint>
  <link name="rim"><inertial><mass value="1e-6"/>
    <inertia ixx="1e-9" ixy="0" ixz="0" iyy="1e-9" iyz="0" izz="1e-9"/></inertial></link></robot>"""


def _throw_feather(graph: Graph) -> None:
    named = {"model_name": "feather", "model_xml": _FEATHER}
    assert call(graph, "/gazebo/spawn_urdf_model", "gazebo_msgs/SpawnModel", **named).success
    lasting = message_type("builtin_interfaces/Duration")(sec=-1)
    effort = {"joint_name": "feather::spin", "effort": 1e6, "duration": lasting}
    kind = "gazebo_msgs/ApplyJointEffort"
    assert call(graph, "/gazebo/apply_joint_effort", kind, **effort).success


def _models(graph: Graph) -> list[str]:
    kind = "gazebo_msgs/GetWorldProperties"
    return list(call(graph, "/gazebo/get_world_properties", kind).model_names)


def test_model_that_diverges_is_taken_out_where_the_parameter_says_so(
    graph: Graph, start: Callable[..., None]
) -> None:
    graph.create_node("setter").parameters.set("/gazebo/on_divergence", "remove")
    start("empty", started_by=1)
    _throw_feather(graph)
    eventually(lambda: _models(graph) == ["ground_plane"])
    kind = "gazebo_msgs/GetPhysicsProperties"
    assert not call(graph, "/gazebo/get_physics_properties", kind).pause


def test_word_that_on_divergence_does_not_know_is_told_and_pauses(
    graph: Graph, start: Callable[..., None], capfd: pytest.CaptureFixture[str]
) -> None:
    graph.create_node("setter").parameters.set("/gazebo/on_divergence", "explode")
    start("empty", started_by=1)
    _throw_feather(graph)
    kind = "gazebo_msgs/GetPhysicsProperties"
    eventually(lambda: call(graph, "/gazebo/get_physics_properties", kind).pause)
    assert _models(graph) == ["ground_plane", "feather"]
    said = "".join(capfd.readouterr())
    assert "'on_divergence' is 'explode', none of ['pause', 'remove']; it is paused" in said


def test_ros_2_refuses_a_word_that_on_divergence_does_not_know(
    graph: Graph, start: Callable[..., None]
) -> None:
    start("--pause", "-s", "libgazebo_ros_init.so", started_by=2)
    assert graph.wait_for_service("/gazebo/set_parameters", stretched())
    service = service_type("rcl_interfaces/SetParameters")
    client = graph.create_node("asks").create_client("/gazebo/set_parameters", service)
    value, row = message_type("rcl_interfaces/ParameterValue"), "rcl_interfaces/Parameter"
    answers = [
        client.call(
            service.Request(
                parameters=[
                    message_type(row)(name="on_divergence", value=value(type=4, string_value=word))
                ]
            ),
            timeout_s=stretched(),
        ).results[0]
        for word in ("explode", "remove")
    ]
    assert [one.successful for one in answers] == [False, True]
    assert answers[0].reason == (
        "parameter 'on_divergence' is 'explode', none of ['pause', 'remove']"
    )


def test_world_that_diverges_as_fast_as_possible_ends_with_a_code_and_its_reason(
    graph: Graph, capfd: pytest.CaptureFixture[str]
) -> None:
    codes: list[int] = []
    words = Arguments(("--fast", "empty"))
    running = threading.Thread(target=lambda: codes.append(serve(words, graph, threading.Event())))
    running.start()
    with contextlib.suppress(GraphError):
        # It may have ended before it answers.
        _throw_feather(graph)
    running.join(stretched())
    assert codes == [1]
    said = "".join(capfd.readouterr())
    assert re.search(r"FATAL.*the simulation diverged in step \d+: link 'feather::rim'", said)


def test_iterations_end_the_server_by_itself(graph: Graph) -> None:
    assert serve(Arguments(("--iters", "50")), graph, threading.Event()) == 0


def test_help_and_version_are_printed(graph: Graph, capsys: pytest.CaptureFixture[str]) -> None:
    assert serve(Arguments(("--help",)), graph, threading.Event()) == 0
    assert "--lockstep" in capsys.readouterr().out
    assert serve(Arguments(("--version",)), graph, threading.Event()) == 0
    assert capsys.readouterr().out.startswith("Gazelle ")


def test_a_missing_world_is_told_and_the_empty_one_runs(
    graph: Graph, capfd: pytest.CaptureFixture[str]
) -> None:
    words = ("no_such.world", "--iters", "1")
    assert serve(Arguments(words), graph, threading.Event()) == 0
    text = "".join(capfd.readouterr())
    assert "Could not open file: world 'no_such.world' not found" in text
    assert "Falling back on worlds/empty.world" in text


def test_an_unknown_server_plug_in_is_reported(
    graph: Graph,
    capfd: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    words = ("--iters", "1", "-s", "libmine.so", "-s", "libgazebo_ros_init.so", "--verbose")
    assert serve(Arguments(words), graph, threading.Event()) == 0
    text = capfd.readouterr().err
    assert "server plug-in 'libmine.so' is compiled code" in text
    assert "part of Gazelle" not in text
    (log,) = tmp_path.glob("*.log")
    assert "server plug-in 'libgazebo_ros_init.so' is part of Gazelle" in log.read_text()


def test_unknown_parameters_of_gazebo_are_told(
    graph: Graph, start: Callable[..., None], capfd: pytest.CaptureFixture[str]
) -> None:
    graph.create_node("setter").parameters.set("/gazebo", {"time_stp": 0.1, "arm": {"p": 1}})
    start("empty", started_by=1, params={"pub_clock_frequency": "fast"})
    _models(graph)
    said = "".join(capfd.readouterr())
    assert "/gazebo: parameter 'time_stp' is not one of gazebo; it has no effect" in said
    assert "parameter 'pub_clock_frequency' is 'fast', not a number; 0.0 is used" in said
    assert "arm" not in said


def test_parameter_of_the_command_line_is_the_nodes_in_ros_1(
    graph: Graph, start: Callable[..., None]
) -> None:
    start("empty", started_by=1, params={"on_divergence": "remove"})
    _models(graph)
    assert graph.create_node("asks").parameters.get("/gazebo/on_divergence") == "remove"


def test_every_dynamic_parameter_of_physics_is_in_the_table() -> None:
    with Simulation() as sim:
        names = {row.name for row in physics_parameters._rows(sim.server)}
    assert names <= {row.key for row in PARAMETERS.rows}
