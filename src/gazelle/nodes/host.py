"""Light nodes in one process: started and stopped by lines of JSON on standard input."""

from __future__ import annotations

import json
import os
import sys
import threading
import time
import traceback
from collections.abc import Callable
from dataclasses import replace
from typing import Any, TextIO

from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.node_specs.registry import node_spec
from gazelle.nodes.arguments import read_arguments

__all__ = ["host"]

_LAST_WORDS_S = 2.0
_END_S = 4.0


def host(status_fd: int, commands: TextIO) -> int:
    """Run nodes until the command stream ends.

    Args:
        status_fd: receives ``{"id": 3, "exit": 0}`` when a node has ended, and before that
            ``{"id": 3, "ready": true}`` when it says that others need not wait for it.
        commands: ``{"start": {"id", "node", "argv", "namespace", "output"}}`` or ``{"stop": 3}``.
    """
    status = os.fdopen(status_fd, "w", encoding="utf-8")
    nodes = _Nodes(status)
    with Graph.open() as graph:
        for line in commands:
            command = json.loads(line)
            if "start" in command:
                nodes.start(command["start"], graph)
            else:
                nodes.stop(command["stop"])
        hurry = threading.Timer(_END_S, os._exit, (0,))
        hurry.daemon = True
        hurry.start()
        nodes.tell_all_to_stop()
        # Nodes that sleep on a clock that stands still wake only by this.
        graph.clock.close()
        nodes.join()
    return 0


class _Nodes:
    def __init__(self, status: TextIO) -> None:
        self._status = status
        self._lock = threading.Lock()
        self._running: dict[int, tuple[threading.Event, threading.Thread]] = {}

    def start(self, request: dict[str, Any], graph: Graph) -> None:
        stop = threading.Event()
        thread = threading.Thread(
            target=self._run, args=(request, graph, stop), name=request["node"], daemon=True
        )
        self._running[request["id"]] = (stop, thread)
        thread.start()

    def stop(self, number: int) -> None:
        if number in self._running:
            self._running[number][0].set()

    def tell_all_to_stop(self) -> None:
        for stop, _ in self._running.values():
            stop.set()

    def join(self) -> None:
        """Give all of them together a moment to end; one that still loads cannot hear of it."""
        deadline_s = time.monotonic() + _LAST_WORDS_S
        for _, thread in self._running.values():
            thread.join(timeout=max(0.0, deadline_s - time.monotonic()))

    def _run(self, request: dict[str, Any], graph: Graph, stop: threading.Event) -> None:
        code = 1
        try:
            code = run_node(request, graph, stop, ready=lambda: self._ready(request["id"]))
        except GazelleError as error:
            sys.stderr.write(f"[{request['node']}] {error}\n")
        except Exception:  # noqa: BLE001 - one node's bug must not take the others along
            traceback.print_exc()
        self._tell({"id": request["id"], "exit": code})

    def _ready(self, number: int) -> None:
        self._tell({"id": number, "ready": True})

    def _tell(self, message: dict[str, Any]) -> None:
        with self._lock:
            self._status.write(json.dumps(message) + "\n")
            self._status.flush()


def _nobody_waits() -> None:
    """Nobody waits for a node that runs alone."""


def run_node(
    request: dict[str, Any],
    graph: Graph,
    stop: threading.Event,
    *,
    ready: Callable[[], None] = _nobody_waits,
) -> int:
    """Run one node in this thread and return its exit code; `ready` is for it to call.

    Raises:
        GazelleError: there is no such node, or it failed in a way it can explain.
    """
    package, _, type_name = request["node"].partition("/")
    node = node_spec(package, type_name)
    if node is None:
        raise GazelleError(f"'{request['node']}' is not a built-in node")
    arguments = read_arguments(
        request["argv"],
        node.default_name(type_name),
        namespace=request.get("namespace", "/"),
        output=request.get("output", "screen"),
        ready=ready,
    )
    return int(node.load()(replace(arguments, executable=type_name), graph, stop))
