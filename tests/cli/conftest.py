"""A graph on a free port, and the ROS-named commands run against it in this process."""

from __future__ import annotations

import io
import itertools
import re
import threading
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from tests.patience import eventually

from gazelle.cli import ros2, rosmsg, rosnode, rosparam, rosservice, rostopic, tf_echo, tf_monitor
from gazelle.graph import Entity, Graph, Kind, Node
from gazelle.graph.hub import hub_knows

_PACE_S = 0.005
_COMMAND_NODES = ("/rostopic_", "/tf_echo_", "/tf_monitor_", "/_ros2cli/")
_MAINS: dict[str, Callable[[list[str]], int]] = {
    "ros2": ros2.main,
    "rosmsg": lambda words: rosmsg.main(["rosmsg", *words]),
    "rosnode": rosnode.main,
    "rosparam": rosparam.main,
    "rosservice": rosservice.main,
    "rossrv": lambda words: rosmsg.main(["rossrv", *words]),
    "rostopic": rostopic.main,
    "tf_echo": tf_echo.main,
    "tf_monitor": tf_monitor.main,
}


class Result(NamedTuple):
    """What a command left."""

    code: int
    out: str
    err: str


class _Watched(io.StringIO):
    """Standard output that calls back once when a text was written."""

    def __init__(self, text: str, then: Callable[[], None]) -> None:
        super().__init__()
        self._text = text
        self._then = then
        self._seen = False

    def write(self, text: str) -> int:
        count = super().write(text)
        if not self._seen and self._text in self.getvalue():
            self._seen = True
            threading.Thread(target=self._then, daemon=True).start()
        return count


@pytest.fixture
def port(monkeypatch: pytest.MonkeyPatch, free_port: int) -> int:
    """A free port, which the environment names."""
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    for name in ("ROS_NAMESPACE", "ROS_DOMAIN_ID", "ROS_MASTER_URI"):
        monkeypatch.delenv(name, raising=False)
    return free_port


@pytest.fixture
def graph(port: int) -> Iterator[Graph]:
    """The graph of "the launch"; commands join it as clients."""
    with Graph.open(port=port, environ={}) as opened:
        yield opened


@pytest.fixture
def robot(graph: Graph) -> Node:
    """A node on the graph, without /rosout."""
    return graph.create_node("robot", rosout=False)


@pytest.fixture
def when_announced(request: pytest.FixtureRequest) -> Callable[[], None]:
    """Waits until those who join hear of all that the graph has announced so far."""
    if "graph" not in request.fixturenames:
        return lambda: None
    graph: Graph = request.getfixturevalue("graph")
    numbers = itertools.count()

    def wait() -> None:
        if not graph.connected:
            return
        # What one session announces comes to the hub in order.
        key = f"last/{next(numbers)}"
        last = graph.session.liveliness().declare_token(key)
        eventually(lambda: hub_knows(graph.port, key))
        last.undeclare()

    return wait


@pytest.fixture
def run(
    capsys: pytest.CaptureFixture[str], when_announced: Callable[[], None]
) -> Callable[..., Result]:
    """Runs a command: ``run("rostopic", "list", "-v")``."""

    def call(tool: str, *words: str) -> Result:
        when_announced()
        capsys.readouterr()
        code = _MAINS[tool](list(words))
        return Result(code, *capsys.readouterr())

    return call


@pytest.fixture
def end_commands(graph: Graph) -> Callable[[], None]:
    """Ends the commands that go on: kills their nodes."""

    def end() -> None:
        for name in graph.node_names(include_hidden=True):
            if name.startswith(_COMMAND_NODES):
                graph.kill_node(name)

    return end


@pytest.fixture
def run_until(end_commands: Callable[[], None]) -> Callable[..., str]:
    """Runs a command that goes on until a text was printed."""

    def call(text: str, tool: str, *words: str) -> str:
        stream = _Watched(text, end_commands)
        with redirect_stdout(stream):
            assert _MAINS[tool](list(words)) == 0
        return stream.getvalue()

    return call


@pytest.fixture
def when_heard(graph: Graph) -> Iterator[Callable[[str, Callable[[], Any]], None]]:
    """Calls a function once somebody subscribes a topic; it ends before the test does."""
    threads: list[threading.Thread] = []

    def add(topic: str, action: Callable[[], Any]) -> None:
        def listen(entity: Entity, is_there: bool) -> None:
            if is_there and entity.kind is Kind.SUBSCRIPTION and entity.name == topic:
                thread = threading.Thread(target=action, daemon=True)
                threads.append(thread)
                thread.start()

        graph.discovery.listen(listen)

    yield add
    for thread in threads:
        thread.join()


@pytest.fixture
def pump() -> Iterator[Callable[[Callable[[], Any]], None]]:
    """Calls a function again and again until the test is over."""
    over = threading.Event()
    threads: list[threading.Thread] = []

    def start(action: Callable[[], Any]) -> None:
        def go() -> None:
            while not over.wait(_PACE_S):
                action()

        threads.append(threading.Thread(target=go))
        threads[-1].start()

    yield start
    over.set()
    for one in threads:
        one.join()


@pytest.fixture
def ros1_dir(own_workspaces_dir: Path) -> Path:
    """What real commands of ROS 1 printed, and two bags that they recorded."""
    return own_workspaces_dir / "recorded" / "ros1"


@pytest.fixture
def recorded(ros1_dir: Path) -> Callable[[str], Result]:
    """What the real command printed: ``recorded("topic_list")``."""

    def read(name: str) -> Result:
        text = (ros1_dir / f"{name}.txt").read_text(encoding="utf-8")
        match = re.fullmatch(
            r"\$ [^\n]*\n\[exit (\d+)\]\n\[stdout\]\n(.*?)\[stderr\]\n?(.*)", text, re.DOTALL
        )
        assert match is not None, name
        return Result(int(match[1]), match[2], match[3])

    return read
