"""``nav2_lifecycle_manager lifecycle_manager``: brings managed nodes up and down, in order."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterable
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.graph.errors import ServiceCallError
from gazelle.interfaces import service_type
from gazelle.nodes.arguments import ABSENT_NODES, NodeArguments
from gazelle.nodes.nav2.parameters import LIFECYCLE_MANAGER
from gazelle.nodes.parameters import log_findings, node_reader, offer_parameters, start_ros2_node

__all__ = ["run"]

_SERVICE_S = 0.5
_CALL_S = 60.0
_WATCH_S = 0.5
_UP, _DOWN = ("configure", "activate"), ("deactivate", "cleanup")
# nav2_msgs/srv/ManageLifecycleNodes
_COMMANDS = {
    0: ("STARTUP", ("configure", "activate")),
    1: ("PAUSE", ("deactivate",)),
    2: ("RESUME", ("activate",)),
    3: ("RESET", ("deactivate", "cleanup")),
    4: ("SHUTDOWN", ("deactivate", "cleanup", "shutdown")),
    5: ("CONFIGURE", ("configure",)),
    6: ("CLEANUP", ("cleanup",)),
}
_WORDS = {
    "configure": "Configuring", "activate": "Activating", "deactivate": "Deactivating",
    "cleanup": "Cleaning up", "shutdown": "Shutting down",
}  # fmt: skip
_REVERSED = frozenset({1, 3, 4, 6})


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Manage until told to stop."""
    node, tree = start_ros2_node(arguments, graph)
    manager = _Manager(node, tree, stop)
    arguments.ready()
    manager.watch()
    node.shutdown()
    return 0


class _Manager:
    def __init__(self, node: Node, tree: dict[str, Any], stop: threading.Event) -> None:
        diagnostics = Diagnostics()
        settings = node_reader(LIFECYCLE_MANAGER, tree, node.name, diagnostics)
        self._node, self._stop = node, stop
        self._names = self._present(settings.texts("node_names"))
        self._away_s = settings.number("bond_timeout")
        self._comes_back = settings.flag("attempt_respawn_reconnection")
        self._lock = threading.RLock()
        self._active = False
        self._parameters = offer_parameters(node, tree)
        settings.report_unknown()
        log_findings(node, diagnostics)
        kind = service_type("nav2_msgs/srv/ManageLifecycleNodes")
        node.create_service("~/manage_nodes", kind, self._on_manage)
        node.create_service("~/is_active", service_type("std_srvs/srv/Trigger"), self._on_active)
        if settings.flag("autostart"):
            threading.Thread(target=lambda: self.do(0), name="autostart", daemon=True).start()

    def _present(self, names: Iterable[str]) -> list[str]:
        """Leave out nodes that the launch could not start: nobody else could be waited for."""
        absent = os.environ.get(ABSENT_NODES, "").split()
        missing = [name for name in names if self._node.resolve_name(name) in absent]
        for name in missing:
            text = f"{name} was not started by the launch and is left out; ROS 2 would wait for it"
            self._node.log("warn", text)
        return [name for name in names if name not in missing]

    def do(self, command: int) -> bool:
        """Do what a command says to all nodes; tells whether all of it went well."""
        found = _COMMANDS.get(command)
        if found is None:
            self._node.log("error", f"command {command} is none of {sorted(_COMMANDS)}")
            return False
        word, transitions = found
        names = self._names[::-1] if command in _REVERSED else self._names
        with self._lock:
            self._node.log("info", f"{word.capitalize()} managed nodes...")
            for transition in transitions:
                for name in names:
                    if not self._change(name, transition):
                        why = f"{name} did not {transition}. Aborting bringup."
                        text = f"Failed to bring up all requested nodes: {why}"
                        self._node.log("error", text)
                        return False
            self._active = command in (0, 2)
        if self._active:
            self._node.log("info", "Managed nodes are active")
        return True

    def watch(self) -> None:
        """See whether nodes go away, and come back."""
        away_since: dict[str, float] = {}
        while not self._stop.wait(_WATCH_S) and not self._node.closed:
            if not self._active or self._away_s <= 0:
                continue
            there = {entity.node for entity in self._node.graph.entities()}
            now = time.monotonic()
            for name in self._names:
                full = self._node.resolve_name(name)
                if full in there:
                    if away_since.pop(name, None) is not None and self._comes_back:
                        self._come_back(name)
                    continue
                since = away_since.setdefault(name, now)
                if 0 <= now - since - self._away_s < 2 * _WATCH_S:
                    text = f"CRITICAL FAILURE: SERVER {name} IS DOWN after not receiving a "
                    self._node.log("error", text + "heartbeat. Shutting down related nodes.")
                    others = [one for one in self._names if one != name]
                    for other in reversed(others):
                        self._change(other, "deactivate")

    def _come_back(self, name: str) -> None:
        self._node.log("info", f"Successfully re-established connections from server respawns: "
                       f"{name}")  # fmt: skip
        for one in self._names:
            for transition in _UP:
                self._change(one, transition, quiet=True)

    def _change(self, name: str, transition: str, *, quiet: bool = False) -> bool:
        """Let a node take a transition; one that it has behind it counts as done."""
        goal = {"configure": 2, "activate": 3, "deactivate": 2, "cleanup": 1, "shutdown": 4}
        state = self._state(name)
        if state is None:
            return False
        if state == goal[transition] or (transition == "configure" and state == 3):
            return True
        if transition in _DOWN and state == 1:
            return True
        if not quiet:
            self._node.log("info", f"{_WORDS[transition]} {name}")
        kind = service_type("lifecycle_msgs/srv/ChangeState")
        request = kind.Request()
        request.transition.label = transition
        answer = self._call(f"{name}/change_state", kind, request)
        return answer is not None and bool(answer.success)

    def _state(self, name: str) -> int | None:
        kind = service_type("lifecycle_msgs/srv/GetState")
        answer = self._call(f"{name}/get_state", kind, kind.Request())
        return None if answer is None else int(answer.current_state.id)

    def _call(self, name: str, kind: Any, request: Any) -> Any:
        client = self._node.create_client(name, kind)
        waited = 0
        while not client.wait_for_service(_SERVICE_S):
            waited += 1
            if self._stop.is_set() or self._node.closed:
                return None
            if waited % 10 == 0:
                self._node.log("info", f"Waiting for service {name}...")
        try:
            return client.call(request, timeout_s=_CALL_S)
        except ServiceCallError as error:
            self._node.log("error", f"{name}: {error}")
            return None
        finally:
            client.unregister()

    def _on_manage(self, request: Any) -> Any:
        kind = service_type("nav2_msgs/srv/ManageLifecycleNodes")
        return kind.Response(success=self.do(int(request.command)))

    def _on_active(self, _request: Any) -> Any:
        kind = service_type("std_srvs/srv/Trigger")
        return kind.Response(success=self._active)
