"""``gz service``."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.graph import Graph
from gazelle.interfaces import service_type
from gazelle.simulator import Simulation
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros

Run = Callable[..., Any]
CONTROL = ("--reqtype", "gz.msgs.WorldControl", "--reptype", "gz.msgs.Boolean", "--timeout", "3000")
BALL = """<sdf version="1.9"><model name="ball"><link name="body">
  <inertial><mass>1</mass></inertial></link></model></sdf>"""


def test_services_are_listed_and_told(world: Simulation, gz: Run) -> None:
    names = gz("service", "-l").out.splitlines()
    assert "/gazebo/pause_physics" in names
    assert {f"/world/default/{one}" for one in ("control", "create", "remove", "set_pose")} <= {
        *names
    }
    told = gz("service", "-i", "-s", "/world/default/control").out
    assert told.endswith("  /gazebo, gz.msgs.WorldControl, gz.msgs.Boolean\n")
    told = gz("service", "-i", "-s", "/gazebo/pause_physics").out
    assert "/gazebo, std_srvs/srv/Empty_Request, std_srvs/srv/Empty_Response\n" in told


def is_paused(world: Simulation) -> bool:
    return world.server.paused


def test_world_takes_steps_and_runs(world: Simulation, gz: Run) -> None:
    def control(request: str) -> Any:
        return gz("service", "-s", "/world/hall/control", *CONTROL, "--req", request)

    before = world.time_ns
    assert control("pause: true multi_step: 5") == (0, "data: true\n\n", "")
    assert world.time_ns - before == 5_000_000
    assert is_paused(world)
    # A message that does not say pause says pause: false.
    assert control("multi_step: 5").err.startswith("gazelle: without pause: true the world runs on")
    assert not is_paused(world)
    assert control("pause: true").code == 0
    assert is_paused(world)
    assert control("pause: true reset: {all: true}").code == 0
    assert world.time_ns == 0
    assert is_paused(world)
    assert control("").code == 0
    assert not is_paused(world)
    assert "time alone is not reset" in control("reset: {time_only: true}").err
    assert "seed of WorldControl is not here" in control("seed: 3").err


def test_model_is_created_moved_and_removed(world: Simulation, gz: Run, tmp_path: Path) -> None:
    def ask(service: str, kind: str, request: str) -> Any:
        words = ("-s", f"/world/hall/{service}", "--reqtype", f"gz.msgs.{kind}", "--req", request)
        return gz("service", *words)

    file = tmp_path / "ball.sdf"
    file.write_text(BALL, encoding="utf-8")
    made = ask(
        "create", "EntityFactory", f"sdf_filename: '{file}' name: 'b' pose: {{position: {{z: 2}}}}"
    )
    assert made == (0, "data: true\n\n", "")
    assert gz("model", "-m", "b", "-p").out.startswith("0 0 2 ")
    text = BALL.replace('"', '\\"')
    assert ask("create", "EntityFactory", f'sdf: "{text}" name: "b" allow_renaming: true').code == 0
    assert "    - b_1\n" in gz("model", "--list").out
    assert ask("set_pose", "Pose", "name: 'b' position: {x: 1 z: 3}").code == 0
    assert gz("model", "-m", "b", "-p").out.startswith("1 0 3 ")
    assert ask("remove", "Entity", "name: 'b' type: MODEL").code == 0
    assert "    - b\n" not in gz("model", "--list").out
    assert "it is not in the world" in ask("remove", "Entity", "name: 'b' type: MODEL").err
    assert "there are no ids" in ask("remove", "Entity", "id: 4").err
    assert "a model to create" in ask("create", "EntityFactory", "name: 'c'").err
    assert "the request is a gz.msgs.Pose, not a gz.msgs.Twist" in ask("set_pose", "Twist", "").err


def test_any_service_of_the_graph_is_called(graph: Graph, gz: Run) -> None:
    kind = service_type("std_srvs/srv/SetBool")

    def switch(request: Any) -> Any:
        return kind.Response(success=request.data, message="on")

    graph.create_node("lamp", rosout=False).create_service("/lamp", kind, switch)
    assert gz("service", "-s", "/lamp", "--req", "data: true").out == (
        'success: true\nmessage: "on"\n\n'
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("-s", "/lamp"), "-i or --req says what to do with the service"),
        (("-s", "/lmap", "-i"), "no service providers on service [/lmap]; did you mean '/lamp'?"),
        (("-s", "/world/x/light_config", "--req", ""), "of a world's services there are control,"),
        (("-s", "/lamp", "--req", "dat: true"), "this is no std_srvs/srv/SetBool_Request"),
    ],
)
def test_what_cannot_be_done_is_told(
    graph: Graph, gz: Run, words: tuple[str, ...], said: str
) -> None:
    node = graph.create_node("lamp", rosout=False)
    node.create_service("/lamp", service_type("std_srvs/srv/SetBool"), print)
    found = gz("service", *words)
    assert found.code == 255
    assert said in found.err


def test_world_of_gz_lists_no_names_of_ros_1_and_answers(graph: Graph, gz: Run) -> None:
    with Simulation.load(world="empty", node=graph.create_node("gazebo", rosout=False)) as sim:
        offer_gazebo_ros(sim.server, is_gz=True)
        names = gz("service", "-l").out.splitlines()
        assert "/world/default/control" in names
        topics = gz("topic", "-l").out.splitlines()
        assert [one for one in (*names, *topics) if "gazebo/" in one] == []
        loop = threading.Thread(target=sim.server.run)
        loop.start()
        assert gz("model", "--list").out == "Available models:\n    - ground_plane\n"
        told = gz("service", "-s", "/world/default/control", *CONTROL, "--req", "pause: true")
        assert told == (0, "data: true\n\n", "")
        assert sim.server.paused
        sim.server.stop()
        loop.join()
