"""create of ros_gz_sim, into a world in this process."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import message_type, service_type
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros

_CREATE = "ros_gz_sim/create"
_BOX = '<sdf version="1.6"><model name="box"><link name="link"/></model></sdf>'


@pytest.fixture
def sim(bench: Any) -> Simulation:
    made = Simulation.load(world="empty", node=bench.graph.create_node("gazebo"))
    offer_gazebo_ros(made.server)
    return made


def _run(bench: Any, *words: str) -> list[int]:
    bench.start(_CREATE, *words)
    return bench.wait()  # type: ignore[no-any-return]


@pytest.mark.parametrize("way", ["file", "folder", "string", "param", "topic"])
def test_model_comes_from_everywhere(bench: Any, sim: Simulation, tmp_path: Path, way: str) -> None:
    (tmp_path / "model.sdf").write_text(_BOX)
    words = {
        "file": ["-file", str(tmp_path / "model.sdf")],
        "folder": ["-file", str(tmp_path)],
        "string": ["-string", _BOX],
        "param": ["-param", "model", "--ros-args", "--params-file", str(tmp_path / "p.yaml")],
        "topic": ["-topic", "robot_description"],
    }[way]
    (tmp_path / "p.yaml").write_text(f"/**: {{ros__parameters: {{model: '{_BOX}'}}}}")
    kind: Any = message_type("std_msgs/msg/String")
    bench.node.create_publisher("/robot_description", kind, latch=True).publish(kind(data=_BOX))
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    assert _run(bench, "-name", "crate", "-x", "1", "-z", "2.5", "-Y", "1.5", *words) == [0]
    pose: Pose = sim.model("crate").pose
    assert (pose.position_m[0], pose.position_m[2]) == (1.0, 2.5)
    assert pose.rpy_rad[2] == pytest.approx(1.5)
    bench.eventually(lambda: any(one.msg == "Entity creation successful." for one in said))


def test_parameters_do_what_flags_do_and_names_are_kept_apart(bench: Any, sim: Simulation) -> None:
    words = ["--ros-args", "-p", f"string:='{_BOX}'", "-p", "name:=crate", "-p", "x:=2.0"]
    assert _run(bench, *words) == [0]
    # Parameters end with their node.
    assert sim.model("crate").pose.position_m[0] == 2.0
    flags = ["-name", "crate", "-string", _BOX]
    assert _run(bench, *flags, "--ros-args") == [0, 1]
    assert _run(bench, *flags, "-allow_renaming", "true", "--ros-args") == [0, 1, 0]
    assert sim.model("crate_1").pose.position_m[0] == 0.0


@pytest.mark.parametrize("flag", ["-allow-renaming", "--allow_renaming=true", "--allow-renaming=1"])
def test_renaming_is_allowed_in_every_spelling_of_gflags(
    bench: Any, sim: Simulation, flag: str
) -> None:
    assert _run(bench, "-name", "crate", "-string", _BOX) == [0]
    assert _run(bench, "-name", "crate", "-string", _BOX, flag) == [0, 0]
    assert sim.model("crate_1").name == "crate_1"


def test_a_text_that_says_false_allows_no_renaming(bench: Any, sim: Simulation) -> None:
    assert _run(bench, "-name", "crate", "-string", _BOX) == [0]
    flags = ["-name", "crate", "-string", _BOX, "--ros-args", "-p", "allow_renaming:='false'"]
    assert _run(bench, *flags) == [0, 1]
    assert not any(model.name == "crate_1" for model in sim.server.engine.world.models)


def test_parameters_are_told_by_name_where_they_are_unknown_or_no_numbers(
    bench: Any, sim: Simulation
) -> None:
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    assert _run(bench, "-string", _BOX, "--ros-args", "-p", "x:=east") == [1]
    words = ["-string", _BOX, "--ros-args", "-p", "nam:=crate", "-p", "y:=''"]
    assert _run(bench, *words) == [1, 0]
    expected = [
        "the parameter 'x' is no number: 'east'",
        "parameter 'nam' is not one of create; it has no effect",
    ]
    bench.eventually(lambda: all(any(text in one.msg for one in said) for text in expected))
    assert [model.name for model in sim.server.engine.world.models] == ["ground_plane", "box"]
    assert not any("parameter 'y'" in one.msg for one in said)


def test_remove_takes_a_model_out_of_the_world(bench: Any, sim: Simulation) -> None:
    assert _run(bench, "-name", "crate", "-string", _BOX) == [0]
    bench.start("ros_gz_sim/remove", "--ros-args", "-p", "entity_name:=crate")
    assert bench.wait() == [0, 0]
    assert [model.name for model in sim.server.engine.world.models] == ["ground_plane"]
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    bench.start("ros_gz_sim/remove", "--ros-args")
    assert bench.wait() == [0, 0, 255]
    text = "Entity to remove name is not provided, entity will not be removed."
    bench.eventually(lambda: any(one.msg == text for one in said))


def test_what_is_wrong_is_said(bench: Any, sim: Simulation, tmp_path: Path) -> None:
    said = bench.listen("/rosout", "rcl_interfaces/msg/Log")
    assert _run(bench, "-name", "x") == [1]
    assert _run(bench, "-file", str(tmp_path / "none.sdf")) == [1, 1]
    assert _run(bench, "-param", "nobody") == [1, 1, 1]
    assert _run(bench, "-x", "east", "-string", _BOX) == [1, 1, 1, 1]
    expected = [
        "Must specify either -file, -param, -string or -topic",
        "none.sdf' not found",
        "Failed to get XML from param [nobody].",
        "illegal value 'east' specified for double flag 'x'",
    ]
    bench.eventually(lambda: all(any(t in one.msg for one in said) for t in expected))
    assert len(sim.server.engine.world.models) == 1


def test_services_of_a_world_may_come_one_after_the_other(bench: Any) -> None:
    world = bench.graph.create_node("gazebo")
    spawn, properties = (
        service_type(f"gazebo_msgs/{one}") for one in ("SpawnModel", "GetWorldProperties")
    )
    named: list[str] = []

    def put(request: Any) -> Any:
        named.append(request.model_name)
        return spawn.Response(success=True)

    world.create_service("/gazebo/spawn_sdf_model", spawn, put)
    bench.start(_CREATE, "-name", "crate", "-string", _BOX, "-allow_renaming")
    asked = "/gazebo/get_world_properties"
    bench.eventually(lambda: any(one.name == asked for one in bench.graph.entities()))
    assert named == []
    told = properties.Response(model_names=["crate"], success=True)
    world.create_service(asked, properties, lambda _request: told)
    assert bench.wait() == [0]
    assert named == ["crate_1"]
