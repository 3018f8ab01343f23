"""Every node that comes up on a graph has what its row says, and nothing else."""

from __future__ import annotations

import pty
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.node_specs.offered import GIVES, TAKES, Offered, offered_by_node, offered_by_row
from tests.patience import eventually, stretched

from gazelle.errors import NotFoundError
from gazelle.graph import Graph
from gazelle.interfaces import service_type
from gazelle.node_specs.registry import node_specs
from gazelle.node_specs.spec import ROS_2, NodeRole, NodeSpec
from gazelle.nodes.host import run_node

URDF = """<robot name="r"><link name="a"/><link name="b"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
<ros2_control name="s" type="system">
<hardware><plugin>mock_components/GenericSystem</plugin></hardware>
<joint name="j"><command_interface name="position"/><state_interface name="position"/></joint>
</ros2_control></robot>"""
SRDF = '<robot name="r"><group name="arm"><joint name="j"/></group></robot>'
TREE = (("map", "odom"), ("odom", "base_link"), ("base_link", "base_footprint"))
# What a node must be told to come up; MAP and URDF stand for what the test makes.
WORDS = {
    "map_server/map_server": "MAP",
    "nav2_map_server/map_server": "--ros-args -p yaml_filename:=MAP",
    "tf/static_transform_publisher": "0 0 0 0 0 0 a b 100",
    "tf2_ros/static_transform_publisher": "0 0 0 0 0 0 a b",
    "topic_tools/relay": "/in /out",
    "topic_tools/throttle": "messages /in 5 /out",
    "topic_tools/drop": "/in 1 2 /out",
    "topic_tools/mux": "/out /in1 /in2",
    "topic_tools/demux": "/in /out1 /out2",
    "nav2_lifecycle_manager/lifecycle_manager": "--ros-args -p node_names:=['a']",
    "turtlebot3_fake_node/turtlebot3_fake_node": "--ros-args -p wheels.separation:=0.16 "
    "-p wheels.radius:=0.033",
    "force_torque_sensor_broadcaster/wrench_transformer_node": "--ros-args "
    "-p target_frames:=['base_link']",
    "controller_manager/ros2_control_node": "--ros-args -p robot_description:=URDF",
}
# Topics that those words name.
BY_WORDS = {
    "force_torque_sensor_broadcaster/wrench_transformer_node": {
        (GIVES, "base_link/wrench", "geometry_msgs/msg/WrenchStamped")
    },
    **{f"topic_tools/{name}": {(TAKES, "/in", "")} for name in ("relay", "throttle", "drop")},
    "topic_tools/mux": {(TAKES, "/in1", ""), (TAKES, "/in2", "")},
    "topic_tools/demux": {(TAKES, "/in", "")},
}
# They do one thing and end, or do it with something that must be there: a bag, a world, messages.
NOT_ALONE = {
    "gazebo_ros/spawn_entity.py", "gazebo_ros/spawn_model", "ros_gz_sim/create",
    "ros_gz_sim/remove", "rosbag/play", "rosbag/record", "map_server/map_saver",
    "nav2_map_server/map_saver_cli", "joy/joy_enumerate_devices", "topic_tools/relay_field",
    "topic_tools/transform", "controller_manager/controller_manager", "controller_manager/spawner",
    "controller_manager/spawner.py", "controller_manager/unspawner",
    "controller_manager/unspawner.py", "controller_manager/hardware_spawner",
    "ros2_controllers_test_nodes/publisher_forward_position_controller",
    "ros2_controllers_test_nodes/publisher_joint_trajectory_controller",
}  # fmt: skip


def _key(spec: NodeSpec) -> str:
    return f"{spec.package}/{spec.executable}"


STARTED = [
    spec for spec in node_specs() if spec.role is not NodeRole.VIEW and _key(spec) not in NOT_ALONE
]
SIMULATORS = [spec for spec in STARTED if spec.role is NodeRole.SIMULATOR]


class Bench:
    """A graph with a robot, a tree of frames and a keyboard, on which nodes are started."""

    def __init__(self, graph: Graph, folder: Path) -> None:
        self.graph = graph
        self.node = graph.create_node("test", rosout=False)
        self._folder = folder

    @contextmanager
    def running(self, name: str, words: list[str]) -> Iterator[threading.Thread]:
        """Run a built-in node."""
        stop = threading.Event()
        request = {"node": name, "argv": words}
        thread = threading.Thread(
            target=run_node, args=(request, self.graph, stop), daemon=True, name=name
        )
        thread.start()
        try:
            yield thread
        finally:
            stop.set()
            thread.join(stretched())

    def words(self, spec: NodeSpec, namespace: str) -> list[str]:
        """Return the words of a node, which gets the name ``probe``."""
        texts = {"MAP": str(self._folder / "map.yaml"), "URDF": URDF}
        words = WORDS.get(_key(spec), "").split()
        for key, text in texts.items():
            words = [word.replace(key, text) for word in words]
        if spec.ros == ROS_2:
            start = [] if "--ros-args" in words else ["--ros-args"]
            return [*words, *start, "-r", "__node:=probe", "-r", f"__ns:={namespace}"]
        return [*words, "__name:=probe", f"__ns:={namespace}"]

    def give_robot(self, namespace: str) -> None:
        """Set a robot description where a node of a namespace finds it."""
        self.graph.parameters.set(f"{namespace}/robot_description", URDF)
        self.graph.parameters.set(f"{namespace}/robot_description_semantic", SRDF)

    def activate(self, node: str) -> None:
        """Bring a managed node up."""
        kind: Any = service_type("lifecycle_msgs/srv/ChangeState")
        client = self.node.create_client(f"{node}/change_state", kind)
        assert client.wait_for_service(stretched())
        for number in (1, 3):
            request = kind.Request()
            request.transition.id = number
            assert client.call(request, timeout_s=stretched()).success


@pytest.fixture(scope="module")
def keyboard() -> Iterator[None]:
    _keys, seen = pty.openpty()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdin", SimpleNamespace(fileno=lambda: seen, isatty=lambda: True))
        patch.setenv("GAZELLE_STUDIO", "0")
        yield


@pytest.fixture(scope="module")
def map_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("maps")
    (folder / "map.pgm").write_bytes(b"P5 40 40 255\n" + bytes([254] * 1600))
    (folder / "map.yaml").write_text(
        "image: map.pgm\nresolution: 0.1\norigin: [-2, -2, 0]\noccupied_thresh: 0.65\n"
        "free_thresh: 0.2\nnegate: 0\n"
    )
    return folder


@pytest.fixture(scope="module")
def module_bench(module_port: int, map_folder: Path, keyboard: None) -> Iterator[Bench]:
    with Graph.open(port=module_port, role="hub", environ={}) as graph:
        bench = Bench(graph, map_folder)
        frames = [
            bench.running(
                "tf2_ros/static_transform_publisher",
                [*["0"] * 6, parent, child, f"__name:=to_{child}"],
            )
            for parent, child in TREE
        ]
        with frames[0], frames[1], frames[2]:
            yield bench


@pytest.fixture
def bench(free_port: int, map_folder: Path, keyboard: None) -> Iterator[Bench]:
    with Graph.open(port=free_port, role="hub", environ={}) as graph:
        yield Bench(graph, map_folder)


@pytest.mark.parametrize("spec", [spec for spec in STARTED if spec not in SIMULATORS], ids=_key)
def test_a_node_has_what_its_row_says(module_bench: Bench, spec: NodeSpec) -> None:
    _compare(module_bench, spec, f"/n{STARTED.index(spec)}")


@pytest.mark.parametrize("spec", SIMULATORS, ids=_key)
def test_a_simulator_has_what_its_row_says(bench: Bench, spec: NodeSpec) -> None:
    """It brings simulated time, which nodes of the other graph would wait for."""
    _compare(bench, spec, "/here")


def test_only_named_nodes_are_not_started() -> None:
    assert {_key(spec) for spec in node_specs()} >= NOT_ALONE
    assert {_key(spec) for spec in STARTED} >= {*WORDS, *BY_WORDS}


def _compare(bench: Bench, spec: NodeSpec, namespace: str) -> None:
    expected, key = offered_by_row(spec), _key(spec)
    expected = expected._replace(topics=expected.topics | BY_WORDS.get(key, set()))
    bench.give_robot(namespace)
    with bench.running(key, bench.words(spec, namespace)) as thread:
        if any(one.name == "~change_state" for one in spec.services):
            bench.activate(f"{namespace}/probe")

        def seen() -> Offered | None:
            assert thread.is_alive(), f"{key} has ended"
            try:
                return offered_by_node(bench.graph.node_info(f"{namespace}/probe"), namespace)
            except NotFoundError:
                return None

        def lacks() -> list[str]:
            found = seen()
            return ["the node"] if found is None else expected.minus(found)

        eventually(lambda: not lacks(), why=lambda: f"{key} lacks {lacks()}")
        found = seen()
        assert found is not None
        assert found.minus(expected) == []
