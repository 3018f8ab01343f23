"""Nodes with a window beside: who gets sliders."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from gazelle.graph import Graph
from gazelle.nodes import joint_state_publisher
from gazelle.nodes.arguments import NodeArguments
from gazelle.studio.windows import gui_nodes

_ROBOT = """<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous">
  <parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"""


@pytest.fixture
def asked(free_port: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., list[str]]]:
    """Runs a joint_state_publisher for a moment; returns the panels that it asks for."""
    panels: list[str] = []

    def present(_node: Any, request: Any, _stop: threading.Event, _say: Any) -> None:
        panels.append(request.panel)

    monkeypatch.setattr(gui_nodes, "present", present)
    monkeypatch.setattr(gui_nodes, "is_switched_off", lambda: False)
    monkeypatch.setattr(gui_nodes, "_OTHERS_FIRST_S", 0.0)
    with Graph.open(port=free_port, environ={}, role="hub") as graph:
        graph.parameters.set("/robot_description", _ROBOT)

        def run(parameters: dict[str, Any], **arguments: Any) -> list[str]:
            for name, value in parameters.items():
                graph.parameters.set(name, value)
            stop = threading.Event()
            node = NodeArguments("joint_state_publisher", "/robot", **arguments)
            stop.set()
            gui_nodes.joint_state_publisher(node, graph, stop)
            for thread in threading.enumerate():
                if thread.name == "panel":
                    thread.join()
            return panels

        yield run


@pytest.mark.parametrize("name", ["/robot/use_gui", "/robot/joint_state_publisher/use_gui"])
def test_use_gui_shows_the_sliders(asked: Callable[..., list[str]], name: str) -> None:
    assert asked({name: True}) == ["joint_state_publisher_gui"]


def test_use_gui_of_the_command_line_comes_first(asked: Callable[..., list[str]]) -> None:
    assert asked({"/robot/use_gui": True}, params={"use_gui": False}) == []


def test_a_text_that_says_false_shows_no_sliders(asked: Callable[..., list[str]]) -> None:
    assert asked({"/robot/use_gui": "false"}) == []


@pytest.mark.parametrize("given", ["/arm/joint_states", ["/arm/joint_states"]])
def test_sliders_come_beside_the_sources_of_the_store(
    asked: Callable[..., list[str]], monkeypatch: pytest.MonkeyPatch, given: Any
) -> None:
    sources: list[str] = []
    monkeypatch.setattr(
        joint_state_publisher, "run", lambda own, *_: sources.extend(own.params["source_list"])
    )
    names = {"use_gui": True, "source_list": given}
    asked({f"/robot/joint_state_publisher/{name}": value for name, value in names.items()})
    assert sources == ["/arm/joint_states", "/_gazelle/sliders/joint_state_publisher"]


def test_publisher_without_use_gui_has_no_window(asked: Callable[..., list[str]]) -> None:
    assert asked({"/use_gui": True}) == []
