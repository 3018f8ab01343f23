"""Who can reach a graph: its sockets are files of its user."""

from __future__ import annotations

import os
import shutil
import socket
import stat
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import GraphError
from gazelle.graph import Graph, PortTakenError, locators
from gazelle.interfaces import message_type

Wait = Callable[..., Any]
Join = Callable[..., Graph]
String = message_type("std_msgs/msg/String")

pytestmark = pytest.mark.skipif(
    not locators._HAS_SOCKET_FILES, reason="this system has no sockets that are files"
)
_NOBODY = 65534
_AS_NOBODY = """
import os, sys
from gazelle.graph import Graph
# All that is loaded on the way, as this user may not be let into the folders of the other one.
with Graph.open(port=int(sys.argv[2]), role="hub") as graph:
    graph.create_node("own", rosout=False).create_publisher("/topic", "std_msgs/msg/String")
    graph.node_names()
os.setgroups([])
os.setgid(65534)
os.setuid(65534)
os.environ["HOME"] = "/nonexistent"
try:
    with Graph.open(port=int(sys.argv[1]), role="client") as graph:
        print(*graph.node_names())
except Exception as error:
    print(type(error).__name__)
with Graph.open(port=int(sys.argv[1])) as graph:
    print("carries", graph.is_hub, *graph.node_names(), flush=True)
    graph.create_node("own", rosout=False).create_publisher("/topic", "std_msgs/msg/String")
    print(sys.stdin.readline(), end="")
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sockets in a folder that was named on purpose; its path is short enough."""
    path = Path(f"/tmp/gz-{os.getpid()}-{tmp_path.name[-12:]}")
    path.mkdir(mode=0o755)
    monkeypatch.setenv(locators.VARIABLE, str(path))
    yield path
    shutil.rmtree(path)


def test_sockets_are_in_a_folder_of_their_user(graph: Graph) -> None:
    place = Path(locators.name_of_hub(graph.port))
    assert place.parent == Path(f"/tmp/gazelle-{os.getuid()}")
    assert place.is_socket()
    info = place.parent.stat()
    assert (info.st_uid, stat.S_IMODE(info.st_mode)) == (os.getuid(), 0o700)
    assert locators.somebody_listens(graph.port)
    graph.close()
    assert not locators.somebody_listens(graph.port)


@pytest.mark.skipif(locators._HAS_SOCKET_FILES and os.getuid() != 0, reason="needs two users")
def test_another_user_of_the_machine_has_a_graph_of_their_own(
    join: Join, port: int, next_port: Callable[[], int]
) -> None:
    """Sees nothing, is not seen, and takes nothing: neither the hub nor the number of the port."""
    graph = join(role="hub")
    graph.create_node("secret", rosout=False)
    with subprocess.Popen(
        [sys.executable, "-c", _AS_NOBODY, str(port), str(next_port())],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd="/",
    ) as nobody:  # fmt: skip
        assert nobody.stdout is not None
        assert nobody.stdout.readline() == "NoGraphError\n"
        assert nobody.stdout.readline() == "carries True\n"
        assert graph.node_names() == ("/secret",)
        assert graph.topics() == ()
        assert nobody.communicate("bye\n", timeout=stretched())[0] == "bye\n"
    theirs = Path(f"/tmp/gazelle-{_NOBODY}")
    assert stat.S_IMODE(theirs.stat().st_mode) == 0o700
    shutil.rmtree(theirs)


def test_folder_that_was_named_is_shared_by_whom_it_lets_in(folder: Path, join: Join) -> None:
    first, second = join(), join()
    assert (first.is_hub, second.is_hub) == (True, False)
    sockets = [one for one in folder.iterdir() if one.is_socket()]
    assert len(sockets) == 3
    assert {stat.S_IMODE(one.stat().st_mode) for one in sockets} == {0o666}
    assert stat.S_IMODE(folder.stat().st_mode) == 0o755


def test_folder_of_somebody_else_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    number = os.getuid() + 12345
    monkeypatch.setattr(os, "getuid", lambda: number)
    path = Path(f"/tmp/gazelle-{number}")
    path.mkdir()
    with pytest.raises(GraphError) as caught:
        locators.hub_endpoint(7447)
    path.rmdir()
    assert str(caught.value) == (
        f"{path}, for the graph's sockets, cannot be used: it is not a folder of yours"
        f" (user {number - 12345} made it)\n"
        "  fix: name a folder of your own: export GAZELLE_GRAPH_FOLDER=/path/to/folder"
    )


def test_folder_that_others_can_enter_is_closed_to_them() -> None:
    path = Path(locators.name_of_hub(7447)).parent
    path.chmod(0o755)
    locators.own_endpoint()
    assert stat.S_IMODE(path.stat().st_mode) == 0o700


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("x" * 90, "too long for a socket's name, by 8 bytes"),
        ("a?b", "no name of a socket: the transport reads ? itself"),
    ],
)
def test_folder_that_no_socket_can_be_in_is_refused(
    name: str, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = Path("/tmp") / name
    monkeypatch.setenv(locators.VARIABLE, str(path))
    with pytest.raises(GraphError) as caught:
        locators.hub_endpoint(12345)
    path.rmdir()
    assert f"{path}/12345.sock is {why}\n  fix: name another folder: " in str(caught.value)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("/proc/none", "No such file or directory"),
        ("{tmp_path}/broken", "it leads to {tmp_path}/gone, which is not there"),
        ("{tmp_path}/file", "it is a file"),
    ],
)
def test_folder_that_cannot_be_made_is_told(
    name: str, reason: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "broken").symlink_to(tmp_path / "gone")
    (tmp_path / "file").touch()
    path = name.format(tmp_path=tmp_path)
    monkeypatch.setenv(locators.VARIABLE, path)
    with pytest.raises(GraphError) as caught:
        locators.own_endpoint()
    reason = reason.format(tmp_path=tmp_path)
    text = f"{path}, for the graph's sockets, cannot be used: {reason}\n  fix: name a folder"
    assert str(caught.value).startswith(text)


def test_sockets_of_killed_processes_are_removed(folder: Path, join: Join) -> None:
    (folder / "peer-4194305-ab.sock").touch()
    (folder / "peer-4194305-ab.sock.lock").touch()
    (folder / f"peer-{os.getpid()}-ab.sock").touch()
    join(role="hub")
    left = {one.name for one in folder.glob("peer-*-ab.sock*")}
    assert left == {f"peer-{os.getpid()}-ab.sock"}


def test_hub_is_claimed_until_its_files_are_gone(
    graph: Graph, join: Join, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The transport unlocks them before it removes them, which may be another one's by then."""
    assert locators.claim_hub(graph.port) is None
    place = Path(locators.name_of_hub(graph.port))
    graph.close()
    release = locators.claim_hub(graph.port)
    assert release is not None
    assert not place.exists()
    monkeypatch.setattr("gazelle.graph.graph._HUB_S", 0.2)
    with pytest.raises(PortTakenError):
        # Nobody else may carry it, and nobody does.
        join()
    release()
    assert join().is_hub


def test_files_of_a_killed_hub_are_removed_by_the_next_one(folder: Path, join: Join) -> None:
    port = join(role="hub").port
    other = port + 1
    for name in (f"{other}.sock", f"{other}.sock.lock", f"{other}.hub"):
        (folder / name).touch()
    with Graph.open(port=other, environ={}) as graph:
        assert graph.is_hub


def test_graph_on_ports_is_the_same_graph(
    join: Join, monkeypatch: pytest.MonkeyPatch, eventually: Wait, inbox: Any
) -> None:
    """As on Windows: the hub, two processes, a tool, and the hub's loss."""
    monkeypatch.setattr(locators, "_HAS_SOCKET_FILES", False)
    first, second = join(role="hub"), join()
    assert locators.somebody_listens(first.port)
    assert locators.name_of_hub(first.port) == f"127.0.0.1:{first.port}"
    with socket.socket() as probe:
        assert probe.connect_ex(("127.0.0.1", first.port)) == 0
    second.create_node("listener", rosout=False).create_subscription("/word", String, inbox)
    publisher = first.create_node("talker", rosout=False).create_publisher("/word", String)
    eventually(lambda: publisher.matched)
    publisher.publish(String(data="heard"))
    assert inbox.wait_for(1)[0].data == "heard"
    assert join(role="client").node_names() == ("/listener", "/talker")
    first.close()
    eventually(lambda: second.is_hub)
    tool = join(role="client")
    eventually(lambda: tool.node_names() == ("/listener",))
