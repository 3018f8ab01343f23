"""What the words of windows' commands mean to the page."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually, stretched

from gazelle.graph import Graph
from gazelle.node_specs.guis import WINDOWS
from gazelle.node_specs.registry import node_spec
from gazelle.nodes.arguments import read_arguments
from gazelle.studio.windows import window_nodes


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return the panel and parameters that a command asks for."""
    seen: list[tuple[str, dict[str, Any]]] = []

    def run_view(panel: str, params: dict[str, Any], *_rest: object) -> int:
        seen.append((panel, params))
        return 0

    monkeypatch.setattr(window_nodes, "run_view", run_view)

    def ask(package: str, name: str, *words: str) -> tuple[str, dict[str, Any]]:
        node = node_spec(package, name)
        assert node is not None
        function: Any = node.load()
        function(read_arguments(words, name), None, threading.Event())
        return seen[-1]

    return ask


def test_rviz_opens_its_file_in_the_callers_folder(
    asked: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert asked("rviz", "rviz", "-d", "a.rviz", "-f", "odom") == (
        "rviz",
        {"file": str(tmp_path / "a.rviz"), "frame": "odom"},
    )
    assert asked("rviz2", "rviz2") == ("rviz", {})


def test_plot_takes_fields_apart(asked: Any) -> None:
    panel, params = asked("rqt_plot", "rqt_plot", "/turtle1/pose/x:y", "odom/twist/")
    assert panel == "rqt_plot"
    assert params == {"curves": ["/turtle1/pose/x", "/turtle1/pose/y", "/odom/twist/"]}


def test_image_view_knows_its_topic_by_word_and_by_remapping(asked: Any) -> None:
    assert asked("rqt_image_view", "rqt_image_view", "cam/image")[1] == {"topic": "/cam/image"}
    assert asked("image_view", "image_view", "image:=/a")[1] == {"topic": "/a"}


@pytest.mark.parametrize(
    ("plugin", "panel"),
    [("rqt_plot", "rqt_plot"), ("rqt_graph.ros_graph.RosGraph", "rqt_graph")],
)
def test_rqt_opens_one_plugin_by_its_class_or_package(asked: Any, plugin: str, panel: str) -> None:
    assert asked("rqt_gui", "rqt_gui", "--standalone", plugin)[0] == panel
    assert asked("rqt_gui", "rqt_gui")[0] == "rqt_gui"


def test_every_view_can_be_loaded_and_runs_in_a_process_of_its_own() -> None:
    windows = [node for node in WINDOWS if node.entry.startswith("gazelle.studio.windows.")]
    assert len(windows) == len(WINDOWS)
    beside = {("turtlesim", "turtlesim_node"), ("joint_state_publisher_gui",) * 2}
    windows += [node for name in beside if (node := node_spec(*name))]
    assert len(windows) == len(WINDOWS) + len(beside)
    assert all(callable(node.load()) and not node.is_light for node in windows)


def test_a_window_does_not_follow_the_time_of_a_simulator(
    free_port: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    started, stop = threading.Event(), threading.Event()
    monkeypatch.setattr(window_nodes, "is_switched_off", lambda: started.set() or True)
    with Graph.open(port=free_port, environ={}) as graph:
        graph.parameters.set("/use_sim_time", True)
        arguments = read_arguments((), "gzclient")
        view = threading.Thread(target=window_nodes.gzclient, args=(arguments, graph, stop))
        view.start()
        try:
            assert started.wait(stretched())
            eventually(lambda: not graph.subscription_count("/clock"))
        finally:
            stop.set()
            view.join(stretched())
