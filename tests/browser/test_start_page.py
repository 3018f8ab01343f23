"""The page while nothing runs: demos, last launches, robot files, what a launch found wrong."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.browser.axe import check_page

from gazelle.diagnostics import Diagnostic, Severity, SourceSpan, render
from gazelle.diagnostics.launch_journal import VARIABLE, begin, end
from gazelle.graph import Graph
from gazelle.studio import Server, Studio

MISTAKE = "<robot name='bot'>\n  <lnik name='base'/>\n</robot>\n"
ROBOT = (
    "<robot name='bot'><link name='base'><visual><geometry><box size='2 1 0.5'/></geometry>"
    "</visual></link></robot>"
)


@pytest.fixture
def idle(free_port: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Server]:
    """A page on a graph where nothing runs."""
    for name in ("CONFIG", "STATE"):
        monkeypatch.setenv(f"XDG_{name}_HOME", str(tmp_path / name))
    monkeypatch.delenv(VARIABLE, raising=False)
    with (
        Graph.open(port=free_port, role="hub", environ={}) as graph,
        Server(Studio(graph, tmp_path), port=0) as server,
    ):
        yield server


def test_while_nothing_runs_there_are_demos_last_launches_and_a_place_for_files(
    idle: Server, look: Any
) -> None:
    end(begin(["roslaunch", "bot", "bot.launch"], 7000), 1)
    seen = look(idle.url)
    start = seen.panel("start")
    start.get_by_text("gazelle demo scout").wait_for()
    assert start.get_by_role("button", name="Start: A robot with").is_visible()
    row = start.locator(".recent-launch")
    assert "gazelle roslaunch bot bot.launch" in row.inner_text()
    assert "failed with code 1" in row.inner_text()
    seen.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    row.get_by_role("button", name="Copy").click()
    copied = seen.page.evaluate("navigator.clipboard.readText()")
    assert copied == f"cd {Path.cwd()} && gazelle roslaunch bot bot.launch"
    check_page(seen.page, "start page, dark")
    seen.page.keyboard.press("l")
    check_page(seen.page, "start page, light")


def test_what_a_failed_launch_found_is_counted_above_and_told_with_line_and_fix(
    idle: Server, look: Any, tmp_path: Path
) -> None:
    file = tmp_path / "bot.urdf"
    file.write_text(MISTAKE)
    journal = begin(["roslaunch", "bot", "bot.launch"], idle.studio.node.graph.port)
    span = SourceSpan(str(file), 2, 4, 4)
    render([Diagnostic("urdf.no-links", Severity.ERROR, "no such tag", span, "write <link>")])
    end(journal, 1)
    seen = look(idle.url)
    seen.page.get_by_role("button", name="Findings: 1 error").click()
    card = seen.panel("findings").locator(".finding")
    card.get_by_text("bot.urdf:2:4").wait_for()
    assert "<lnik name='base'/>" in card.locator(".finding-source").inner_text()
    assert "Fix: write <link>" in card.inner_text()
    assert card.locator(".carets").text_content() == "\n   ^^^^"
    assert "urdf.no-links" in card.inner_text()
    check_page(seen.page, "findings, dark")
    seen.page.keyboard.press("l")
    check_page(seen.page, "findings, light")
    # What comes now comes by itself, on a page that is open.
    journal = begin(["roslaunch", "bot", "other.launch"], idle.studio.node.graph.port)
    render([Diagnostic("urdf.no-links", Severity.WARNING, "careful")])
    end(journal, 0)
    seen.page.get_by_role("button", name="Findings: 1 warning").wait_for()


def test_a_robot_file_is_shown_and_its_mistakes_with_line_and_fix(
    idle: Server, look: Any, tmp_path: Path
) -> None:
    good, bad = tmp_path / "good.urdf", tmp_path / "bad.urdf"
    good.write_text(ROBOT)
    bad.write_text(MISTAKE.replace("</robot>", "</robt>"))
    seen = look(idle.url)
    seen.panel("start").get_by_label("Robot files").set_input_files([good])
    panel = seen.panel("robot_file")
    panel.get_by_text("1 model, 1 link").wait_for()
    assert seen.page.get_by_role("tab", name="good.urdf").is_visible()
    check_page(seen.page, "robot file")
    seen.page.locator(".dv-tab").filter(has_text="Start").click()
    seen.panel("start").get_by_label("Robot files").set_input_files([bad])
    card = seen.panel("robot_file").last.locator(".finding[data-severity=error]").first
    card.get_by_text("bad.urdf:").wait_for()
    assert "Fix:" in card.inner_text()
    check_page(seen.page, "a robot file with a mistake")


def test_a_demo_is_started_by_its_button_and_the_page_shows_it(
    idle: Server, look: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[Any] = []
    runner = type(idle.studio.demos)
    monkeypatch.setattr(runner, "start", lambda _self, demo: started.append(demo.name))
    seen = look(idle.url)
    seen.panel("start").get_by_role("button", name="Start: A robot with").click()
    assert "is starting" in seen.toast()
    assert started == ["scout"]
    idle.studio.pages.show("rqt_console")
    seen.panel("rqt_console").wait_for()
    assert seen.panel("start").count() == 0


def test_when_something_runs_the_start_page_gives_way(idle: Server, look: Any) -> None:
    seen = look(idle.url)
    seen.panel("start").wait_for()
    node = idle.studio.node.graph.create_node("robot")
    seen.panel("rqt_topic").wait_for()
    assert seen.panel("start").count() == 0
    seen.page.get_by_role("button", name="Start page").click()
    seen.panel("start").get_by_text("A node runs").wait_for()
    node.shutdown()


def test_narrow_pages_can_be_used(idle: Server, look: Any) -> None:
    seen = look(idle.url, size=(380, 700))
    seen.panel("start").get_by_text("gazelle demo scout").wait_for()
    assert seen.page.evaluate("document.documentElement.scrollWidth") == 380
    seen.page.get_by_role("button", name="Panels").click()
    box = seen.page.get_by_role("menu").bounding_box()
    assert box["x"] >= 0
    assert box["x"] + box["width"] <= 380
    assert box["y"] + box["height"] <= 700
