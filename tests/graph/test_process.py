"""Real processes: how they end, and how the others notice."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.patience import at_most, stretched

from gazelle.graph import Graph, ServiceUnavailableError
from gazelle.interfaces import service_type

NODE = """
import sys, threading
from gazelle.graph import Graph
graph = Graph.open(port={port}, environ={{}})
node = graph.create_node("{name}")
node.create_publisher("chatter", "std_msgs/msg/String", latch=True)
node.create_subscription("chatter", None, print)
print("ready", graph.is_hub, flush=True)
{end}
"""

CUT_OFF = """
import os, socket, stat
from gazelle.interfaces import service_type
Trigger = service_type("std_srvs/srv/Trigger")
count = 0
def cut_off():
    for number in range(1024):
        try:
            if stat.S_ISSOCK(os.fstat(number).st_mode):
                with socket.socket(fileno=os.dup(number)) as own:
                    names = str(own.getpeername()), str(own.getsockname())
                    if any("{port}" in name for name in names) or not any(names):
                        continue
                    own.shutdown(socket.SHUT_RDWR)
        except OSError:
            pass
def handle(request):
    global count
    count += 1
    {does}
    return Trigger.Response(success=True, message=str(count))
node.create_service("work", Trigger, handle)
threading.Event().wait(60)
"""

Start = Callable[..., "subprocess.Popen[str]"]


@pytest.fixture
def start(port: int) -> Iterator[Start]:
    started: list[subprocess.Popen[str]] = []

    def run(name: str, end: str = "threading.Event().wait(60)") -> subprocess.Popen[str]:
        code = NODE.format(port=port, name=name, end=end)
        process = subprocess.Popen(
            [sys.executable, "-c", code],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, "PYTHONFAULTHANDLER": "1"},
        )
        started.append(process)
        assert process.stdout is not None
        assert process.stdout.readline().startswith("ready")
        return process

    yield run
    for process in started:
        process.kill()
        process.communicate(timeout=stretched(30))


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGTERM])
def test_dead_process_is_noticed_at_once(
    graph: Graph, start: Start, how: signal.Signals, eventually: Callable[..., Any]
) -> None:
    process = start("victim")
    eventually(graph.discovery.known)
    assert graph.node_names() == ("/victim",)
    # A fraction of a second on a machine with nothing else to do; ten where leases have to end.
    with at_most(5.0):
        process.send_signal(how)
        assert graph.discovery.wait_for(lambda known: not tuple(known), stretched(10))
    assert graph.entities() == ()


@pytest.mark.parametrize(
    "end", ["sys.exit(3)", "graph.close(); sys.exit(3)", "raise SystemExit(3)"]
)
def test_process_with_nodes_ends_at_once_and_honestly(start: Start, end: str) -> None:
    process = start("n", end)
    _, errors = process.communicate(timeout=stretched(30))
    assert (process.returncode, errors) == (3, "")


def test_killed_hub_is_replaced(
    port: int, start: Start, join: Callable[..., Graph], eventually: Callable[..., Any]
) -> None:
    hub = start("hub")
    member = join()
    member.create_node("member")
    assert not member.is_hub
    hub.kill()
    eventually(lambda: member.is_hub and member.connected)
    tool = join(role="client")
    eventually(lambda: tool.node_names() == ("/member",))


def test_stopped_subscriber_stalls_nobody_and_comes_back(
    graph: Graph, start: Start, eventually: Callable[..., Any]
) -> None:
    listener = start("listener")
    publisher = graph.create_node("talker").create_publisher("chatter", "std_msgs/msg/String")
    eventually(lambda: publisher.matched)
    listener.send_signal(signal.SIGSTOP)
    message = publisher.message_class(data="x" * 1_000_000)
    # A link that is full is waited for once, five seconds, and then given up.
    with at_most(10.0):
        for _ in range(50):
            publisher.publish(message)
    listener.send_signal(signal.SIGCONT)
    eventually(lambda: not publisher.matched)
    eventually(lambda: publisher.matched)
    eventually(lambda: graph.node_names() == ("/listener", "/talker"))


def test_call_outlives_the_loss_of_its_link_and_is_handled_once(
    graph: Graph, port: int, start: Start
) -> None:
    start("server", CUT_OFF.format(port=port, does="cut_off()"))
    kind = service_type("std_srvs/srv/Trigger")
    client = graph.create_node("caller").create_client("work", kind)
    for count in ("1", "2"):
        assert client.wait_for_service(stretched(30))
        assert client.call(kind.Request()).message == count


def test_call_ends_with_its_server(graph: Graph, port: int, start: Start) -> None:
    start("server", CUT_OFF.format(port=port, does="os._exit(1)"))
    kind = service_type("std_srvs/srv/Trigger")
    client = graph.create_node("caller").create_client("work", kind)
    assert client.wait_for_service(stretched(30))
    with pytest.raises(ServiceUnavailableError, match="work"):
        client.call(kind.Request())
