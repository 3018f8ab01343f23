"""spawn_model against a world in this process: its arguments and its messages."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import ROS2_PLUGINS, offer_gazebo_ros
from gazelle.simulator.spawn_model import spawn_model

BOX = """<?xml version="1.0"?>
<sdf version="1.6"><model name="box"><link name="link"/>
<joint name="j" type="revolute"><parent>world</parent><child>link</child>
<axis><xyz>0 0 1</xyz></axis></joint></model></sdf>"""


class Console:
    """A node that also keeps what was said."""

    def __init__(self, graph: Graph) -> None:
        self._node = graph.create_node("spawner")
        self.said: list[str] = []

    def __getattr__(self, name: str) -> Any:
        return getattr(self._node, name)

    def log(self, level: Any, text: str, **options: Any) -> None:
        self.said.append(f"{level}: {text}")


@pytest.fixture
def console(graph: Graph) -> Console:
    return Console(graph)


@pytest.fixture
def sim(load: Callable[..., Simulation], graph: Graph) -> Simulation:
    made = load(world="empty", node=graph.create_node("gazebo"))
    offer_gazebo_ros(made.server, ros2=ROS2_PLUGINS)
    return made


@pytest.fixture
def box(tmp_path: Path) -> str:
    path = tmp_path / "box.sdf"
    path.write_text(BOX)
    return str(path)


def test_it_says_what_the_original_says(sim: Simulation, console: Console, box: str) -> None:
    argv = ["-sdf", "-file", box, "-model", "crate", "-x", "1", "-Y", "1.57", "-J", "j", "0.5"]
    assert spawn_model(argv, console, threading.Event()) == 0
    assert console.said == [
        f"info: Loading model XML from file {box}",
        "info: Waiting for service /gazebo/spawn_sdf_model",
        "info: Calling service /gazebo/spawn_sdf_model",
        "info: Spawn status: SpawnModel: Successfully spawned entity",
    ]
    pose = sim.model("crate").pose
    assert pose.position_m[0] == 1.0
    assert sim.joint("crate::j").position == 0.5


def test_a_name_that_is_taken_fails(sim: Simulation, console: Console, box: str) -> None:
    argv = ["-sdf", "-file", box, "-model", "ground_plane"]
    assert spawn_model(argv, console, threading.Event()) == 1
    assert console.said[-2:] == [
        "info: Spawn status: SpawnModel: Failure - entity already exists.",
        "error: Spawn service failed. Exiting.",
    ]


def test_unpausing_and_joints_that_are_not_there(
    sim: Simulation, console: Console, box: str
) -> None:
    sim.pause()
    assert spawn_model(["-sdf", "-file", box, "-model", "a", "-unpause"], console,
                       threading.Event()) == 0  # fmt: skip
    assert console.said[-1] == "info: Unpausing physics"
    assert not sim.server.paused
    argv = ["-sdf", "-file", box, "-model", "b", "-J", "k", "1"]
    assert spawn_model(argv, console, threading.Event()) == 0


def test_the_ros_2_script_says_what_it_says(sim: Simulation, console: Console, box: str) -> None:
    argv = ["-entity", "crate", "-file", box, "-timeout", "5"]
    assert spawn_model(argv, console, threading.Event()) == 0
    assert console.said == [
        "info: Spawn Entity started",
        f"info: Loading model XML from file {box}",
        "info: Waiting for service /spawn_entity, timeout = 5",
        "info: Calling service /spawn_entity",
        "info: Spawn status: SpawnEntity: Successfully spawned entity [crate]",
    ]


def test_a_latched_topic_is_a_source(sim: Simulation, console: Console, graph: Graph) -> None:
    from gazelle.interfaces import message_type

    string = message_type("std_msgs/String")
    publisher = graph.create_node("rsp").create_publisher("/robot_description", string, latch=True)
    publisher.publish(string(data=BOX))
    argv = ["-entity", "crate", "-topic", "robot_description"]
    assert spawn_model(argv, console, threading.Event()) == 0
    assert sim.model("crate").links == ("link",)


def test_a_model_of_the_database_is_a_known_model(sim: Simulation, console: Console) -> None:
    argv = ["-sdf", "-database", "no_such_model", "-model", "x"]
    assert spawn_model(argv, console, threading.Event()) == 1
    assert "no_such_model" in " ".join(console.said)


def test_a_bond_deletes_the_model_at_the_end(sim: Simulation, console: Console, box: str) -> None:
    stop = threading.Event()
    done: list[int] = []
    argv = ["-sdf", "-file", box, "-model", "crate", "-b"]
    thread = threading.Thread(target=lambda: done.append(spawn_model(argv, console, stop)))
    thread.start()
    waiting = threading.Event()
    while "Waiting for shutdown" not in " ".join(console.said):
        waiting.wait(0.01)
    assert sim.model("crate").links == ("link",)
    stop.set()
    thread.join(stretched(30.0))
    assert done == [0]
    assert "crate" not in [model.name for model in sim.world.models]


@pytest.mark.parametrize(
    ("argv", "text"),
    [
        (["-model", "a", "-file", "f"], "one of the arguments -urdf -sdf -gazebo is required"),
        (["-urdf", "-model", "a"], "one of the arguments -file -param -topic -database -stdin"),
        (["-urdf", "-param", "p"], "the following arguments are required: -model"),
        (["-urdf", "-param", "p", "-model", "m", "-x", "one"], "argument -x: invalid float value"),
        (["-urdf", "-param", "p", "-model", "m", "-J", "j", "up"], "-J j needs a number, not 'up'"),
    ],
)
def test_wrong_arguments_are_explained(console: Console, argv: list[str], text: str) -> None:
    assert spawn_model(argv, console, threading.Event()) == 2
    assert text in console.said[0]


@pytest.mark.parametrize(
    ("content", "text"),
    [
        (None, "does not exist"),
        ("", "is empty"),
        ("<sdf><model>", "Invalid XML: "),
    ],
)
def test_unusable_files_are_explained(
    console: Console, tmp_path: Path, content: str | None, text: str
) -> None:
    path = tmp_path / "model.sdf"
    if content is not None:
        path.write_text(content)
    argv = ["-sdf", "-file", str(path), "-model", "m"]
    assert spawn_model(argv, console, threading.Event()) == 1
    assert text in console.said[-1]


def test_a_missing_parameter_names_it(console: Console) -> None:
    argv = ["-urdf", "-param", "robot_descriptoin", "-model", "m"]
    assert spawn_model(argv, console, threading.Event()) == 1
    assert console.said[-1] == (
        "error: Error: param does not exist or is empty; the parameter is '/robot_descriptoin'"
    )


_SPAWN_ENTITY = ["-entity", "box", "-timeout", "0.1"]


def test_the_ros_2_script_gives_up_without_a_simulator(console: Console, box: str) -> None:
    assert spawn_model([*_SPAWN_ENTITY, "-file", box], console, threading.Event()) == 1
    assert console.said[-1] == (
        "error: Service /spawn_entity unavailable. Was Gazebo started with GazeboRosFactory?"
    )


def test_a_simulator_that_loads_its_world_is_waited_for(
    graph: Graph, console: Console, box: str
) -> None:
    simulator = graph.create_node("gazebo")
    codes: list[int] = []
    stop = threading.Event()
    words = [*_SPAWN_ENTITY, "-file", box]
    thread = threading.Thread(target=lambda: codes.append(spawn_model(words, console, stop)))
    thread.start()
    thread.join(0.5)
    assert thread.is_alive()
    simulator.create_publisher("/clock", message_type("rosgraph_msgs/Clock"))
    thread.join(stretched(30.0))
    assert codes == [1]


def test_told_to_stop_it_ends(console: Console, box: str) -> None:
    stop = threading.Event()
    stop.set()
    assert spawn_model(["-sdf", "-file", box, "-model", "m"], console, stop) == 0
    assert spawn_model(["-sdf", "-file", box, "-model", "m", "-wait", "x"], console, stop) == 0


def test_package_uris_become_model_uris(
    sim: Simulation, console: Console, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(
        '<robot name="r"><link name="l"><visual><geometry>'
        '<mesh filename="package://pkg/m.stl"/></geometry></visual></link></robot>'
    )
    argv = ["-urdf", "-file", str(path), "-model", "r", "-package_to_model"]
    assert spawn_model(argv, console, threading.Event()) == 0
    link = sim.model("r").description.links[0]
    assert link.visuals[0].shape.uri == "model://pkg/m.stl"  # type: ignore[union-attr]
