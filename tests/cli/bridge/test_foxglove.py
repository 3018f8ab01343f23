"""``gazelle bridge foxglove`` as a program."""

from __future__ import annotations

import socket
from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.cli.bridge import main

Run = Callable[..., Any]


@pytest.fixture
def needs_sdk() -> None:
    pytest.importorskip("foxglove", reason="needs pip install 'gazelle-sim[foxglove]'")


def test_bridge_says_where_it_listens(needs_sdk: None, gazelle: Run) -> None:
    run = gazelle("bridge", "foxglove", "--port", "0")
    port = int(run.wait_for_line(r"^the bridge listens at ws://127\.0\.0\.1:\d+$").split(":")[-1])
    run.wait_for_line("in Foxglove: Open connection, Foxglove WebSocket, this address")
    run.wait_for_line("every user of this machine can look")
    socket.create_connection(("127.0.0.1", port), timeout=stretched()).close()
    assert run.stop() == 0
    assert "gazelle bridge foxglove:" not in run.text
    with pytest.raises(OSError):
        socket.create_connection(("127.0.0.1", port), timeout=stretched())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--allow", "publish,services"), "web pages open in a browser on this machine can use "),
        (("--host", "0.0.0.0"), "everybody who reaches 0.0.0.0 can see all topics; nobody"),
    ],
)
def test_what_others_may_do_is_told(
    needs_sdk: None, gazelle: Run, words: tuple[str, ...], said: str
) -> None:
    run = gazelle("bridge", "foxglove", "--port", "0", *words)
    run.wait_for_line(said)
    assert run.stop() == 0


def test_taken_port_ends_it(needs_sdk: None, gazelle: Run) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        run = gazelle("bridge", "foxglove", "--port", str(taken.getsockname()[1]))
        assert run.wait() == 1
    assert "cannot be had" in run.text
    assert "[bridge.foxglove-port-taken]" in run.text


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            ["--allow", "publish,everything"],
            "'everything' is none of publish, services, parameters",
        ),
        (["--port", "99999"], "'99999' is not a port number from 0 to 65535"),
    ],
)
def test_odd_words_are_told(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        main(["foxglove", *words])
    assert said in capsys.readouterr().err
