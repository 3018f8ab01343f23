from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, render
from gazelle.diagnostics.launch_journal import VARIABLE, begin, end


@pytest.fixture(autouse=True)
def own_state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.delenv(VARIABLE, raising=False)


def launched(port: int, *words: str, code: int | None = 0, found: Any = ()) -> None:
    path = begin(words, port)
    render(found)
    if code is None:
        os.environ.pop(VARIABLE)
    else:
        end(path, code)


def mistake(file: Path) -> Diagnostic:
    file.write_text("<robot>\n  <lnik/>\n</robot>\n")
    span = SourceSpan(str(file), 2, 4, 4)
    return Diagnostic("xml.unknown-tag", Severity.ERROR, "no such tag", span, "write <link>")


def test_a_launch_that_failed_before_the_page_was_open_is_told(page, graph, tmp_path):
    file = tmp_path / "bot.urdf"
    launched(graph.port, "roslaunch", "bot", "bot.launch", code=1, found=[mistake(file)])
    (launch,) = page.open("launch.findings").next()["launches"]
    assert launch["command"] == "gazelle roslaunch bot bot.launch"
    assert (launch["is_running"], launch["code"]) == (False, 1)
    (finding,) = launch["findings"]
    assert finding["place"].endswith("bot.urdf:2:4")
    assert finding["source"] == {"line": 2, "text": "  <lnik/>", "column": 4, "width": 4}
    assert (finding["severity"], finding["fix"]) == ("error", "write <link>")
    assert finding["why"]
    assert finding["link"].endswith("#xmlunknown-tag-warning") or not finding["link"]


def test_what_a_launch_tells_later_comes_by_itself(page, graph, tmp_path):
    stream = page.open("launch.findings")
    assert stream.next() == {"launches": []}
    path = begin(["roslaunch", "bot.launch"], graph.port)
    assert stream.until(lambda value: value["launches"])["launches"][0]["is_running"]
    render([mistake(tmp_path / "bot.urdf")])
    assert stream.until(lambda value: value["launches"][0]["findings"])
    end(path, 0)
    assert stream.until(lambda value: not value["launches"][0]["is_running"])


def test_launches_of_other_graphs_are_not_told(page, graph):
    launched(graph.port + 1, "roslaunch", "other.launch")
    assert page.open("launch.findings").next() == {"launches": []}


def test_of_ended_launches_the_last_is_told(page, graph):
    launched(graph.port, "roslaunch", "old.launch")
    launched(graph.port, "roslaunch", "running.launch", code=None)
    launched(graph.port, "roslaunch", "new.launch")
    found = page.open("launch.findings").next()["launches"]
    assert {each["command"] for each in found} == {
        "gazelle roslaunch new.launch",
        "gazelle roslaunch running.launch",
    }


def test_each_command_is_recent_once_and_can_be_copied(page, graph, tmp_path, monkeypatch):
    folder = tmp_path / "my ws"
    folder.mkdir()
    monkeypatch.chdir(folder)
    launched(graph.port, "roslaunch", "bot", "bot.launch", "x:=a b")
    launched(graph.port + 9, "demo", "scout", code=1, found=[mistake(tmp_path / "a.urdf")])
    launched(graph.port, "roslaunch", "bot", "bot.launch", "x:=a b")
    first, second = page.call("launch.recent")
    assert first["command"] == "gazelle roslaunch bot bot.launch 'x:=a b'"
    assert first["copied"] == f"cd '{folder}' && {first['command']}"
    assert (first["errors"], first["demo"]) == (0, "")
    assert (second["errors"], second["demo"], second["code"]) == (1, "scout", 1)
