"""``gazelle studio``."""

from __future__ import annotations

import re
import signal
from collections.abc import Callable
from typing import Any

import pytest
from tests.studio.page import Page

from gazelle.cli.studio import main
from gazelle.graph import Graph

Run = Callable[..., Any]


def _port(line: str) -> int:
    return int(re.findall(r":(\d+)/", line)[0])


def test_the_command_prints_its_url_and_ends_on_request(gazelle: Run) -> None:
    """It opens a graph of its own where there is none; launches that come later join it."""
    for number in (signal.SIGTERM, signal.SIGINT):
        running = gazelle("studio", "--port", "0", "--no-browser")
        line = running.wait_for_line(r"Studio: http://127\.0\.0\.1:\d+/\?token=\w+$")
        page = Page(_port(line))
        names = [one["name"] for one in page.call("graph.get")["nodes"]]
        assert names == [page.hello["node"]]
        assert page.hello["graph"]["port"] == running.port
        page.close()
        assert running.stop(number) == 0
        assert "Traceback" not in running.text
        assert "everybody" not in running.text


def test_address_that_others_reach_is_told(gazelle: Run) -> None:
    running = gazelle("studio", "--port", "0", "--no-browser", "--host", "0.0.0.0")
    running.wait_for_line(
        "studio: everybody who reaches 0.0.0.0 and has this address steers the graph, and it goes "
        "through the network unencrypted"
    )
    assert running.stop() == 0


def test_killing_its_node_ends_it(gazelle: Run) -> None:
    running = gazelle("studio", "--port", "0", "--no-browser")
    line = running.wait_for_line("Studio: http")
    page = Page(_port(line))
    with Graph.open(port=running.port, role="client", environ={}) as graph:
        assert graph.kill_node(page.hello["node"])
        assert running.wait() == 0
    page.close()


def test_a_port_that_is_taken_is_an_error(gazelle: Run) -> None:
    first = gazelle("studio", "--port", "0", "--no-browser")
    port = str(_port(first.wait_for_line("Studio: http")))
    second = gazelle("studio", "--port", port, "--no-browser")
    assert second.wait() == 1
    assert f"studio: cannot listen on 127.0.0.1, port {port}" in second.text
    assert "fix: choose another one with --port" in second.text


def test_a_folder_that_is_not_there_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["--folder", "/nowhere/bags"])
    assert caught.value.code == 2
    assert "argument --folder: there is no folder /nowhere/bags" in capsys.readouterr().err


def test_a_graph_has_one_page_whoever_is_asked_for_it(gazelle: Run) -> None:
    first = gazelle("rqt_graph", GAZELLE_STUDIO="1")
    url = first.wait_for_line("rqt_graph: http").removeprefix("rqt_graph: ").strip()
    assert _port(url) == 8090 + first.port - 7447
    second = gazelle("studio", "--no-browser", port=first.port)
    assert second.wait_for_line("Studio: http").strip() == f"Studio: {url}"
    assert first.stop() == 0
    # It serves the page from now on.
    third = gazelle("rqt_plot", port=first.port, GAZELLE_STUDIO="1")
    assert third.wait_for_line("rqt_plot: http").strip() == f"rqt_plot: {url}"
    Page(_port(url)).close()
    assert second.stop() == 0
    assert third.stop() == 0


def test_the_command_takes_the_address_that_windows_take(gazelle: Run) -> None:
    running = gazelle("studio", "--no-browser")
    assert _port(running.wait_for_line("Studio: http")) == 8090 + running.port - 7447
    assert running.stop() == 0
