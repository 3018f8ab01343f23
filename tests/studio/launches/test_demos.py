from __future__ import annotations

import sys
from typing import Any

import pytest
from tests.studio.page import RefusedError

from gazelle.demo import DEMOS
from gazelle.diagnostics.launch_journal import VARIABLE
from gazelle.studio.launches import demos


class Program:
    """A process that runs until it is ended."""

    def __init__(self, words: list[str], env: dict[str, str]) -> None:
        self.words, self.env, self.code = words, env, None

    def poll(self) -> int | None:
        return self.code

    def terminate(self) -> None:
        self.code = -15

    def wait(self, timeout: float = 0.0) -> int | None:
        return self.code


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[Program]:
    programs: list[Program] = []

    def start(words: list[str], *, env: dict[str, str], **_others: Any) -> Program:
        programs.append(Program(words, env))
        return programs[-1]

    monkeypatch.setattr(demos.subprocess, "Popen", start)
    return programs


def test_the_gallery_has_every_demo_with_its_command(page):
    value = page.call("demo.list")
    assert [card["name"] for card in value["demos"]] == [demo.name for demo in DEMOS]
    assert value["demos"][0]["command"] == f"gazelle demo {DEMOS[0].name}"
    assert value["demos"][0]["steps"]
    assert (value["running"], value["may_start"]) == ("", True)


def test_a_demo_is_started_on_the_graph_and_shown_on_the_page(page, graph, started, monkeypatch):
    monkeypatch.setenv(VARIABLE, "/somebody's")
    value = page.call("demo.start", name=DEMOS[0].name)
    (program,) = started
    assert program.words == [sys.executable, "-m", "gazelle.cli", "demo", DEMOS[0].name]
    assert program.env["GAZELLE_PORT"] == str(graph.port)
    assert program.env["GAZELLE_STUDIO"] == "0"
    assert VARIABLE not in program.env
    assert value["running"] == DEMOS[0].name
    with pytest.raises(RefusedError, match=f"the demo '{DEMOS[0].name}' runs"):
        page.call("demo.start", name=DEMOS[1].name)
    assert page.call("demo.stop")["running"] == ""
    assert program.code == -15


@pytest.mark.parametrize("name", ["", "rm", "../scout", "scout; ls", "--copy"])
def test_nothing_but_a_demo_is_started(page, started, name):
    with pytest.raises(RefusedError, match="demo"):
        page.call("demo.start", name=name)
    assert started == []


def test_a_server_that_the_network_reaches_starts_nothing(page, server, started):
    server.studio.demos.may_start = False
    with pytest.raises(RefusedError, match="the network reaches its server") as refused:
        page.call("demo.start", name=DEMOS[0].name)
    assert refused.value.error["hint"] == f"in a terminal: gazelle demo {DEMOS[0].name}"
    assert started == []


def test_a_demo_ends_with_its_studio(server, started):
    server.studio.demos.start(DEMOS[0])
    server.studio.demos.close()
    assert started[0].code == -15


def test_pictures_are_those_of_demos_alone(tmp_path, monkeypatch):
    file = tmp_path / "scout.webp"
    file.write_bytes(b"picture")
    monkeypatch.setattr(demos, "picture", lambda demo: file if demo is DEMOS[0] else None)
    found = demos.demo_picture(None, DEMOS[0].name)
    assert found is not None
    assert (found.body, found.content_type) == (b"picture", "image/webp")
    assert demos.demo_picture(None, DEMOS[1].name) is None
    assert demos.demo_picture(None, "../../secret") is None
