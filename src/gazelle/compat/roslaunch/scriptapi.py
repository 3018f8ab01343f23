"""Single nodes from Python (roslaunch.scriptapi)."""

from __future__ import annotations

import atexit
import time

from gazelle.compat.roslaunch.core import Node, Process, RLException, start_launch
from gazelle.compat.roslaunch.parent import ROSLaunchParent
from gazelle.diagnostics import Diagnostics
from gazelle.launch.node_commands import find_executable
from gazelle.workspace import Workspace

__all__ = ["ROSLaunch"]

_PAUSE_S = 0.1


class ROSLaunch:
    """Starts nodes one by one, and launch files that were loaded."""

    def __init__(self) -> None:
        self._files: list[str] = []
        self._texts: list[str] = []
        self._parent: ROSLaunchParent | None = None
        self._nodes: list[Process] = []
        self._is_started = False

    def load(self, f: str) -> None:
        """Add a launch file, for `start`."""
        self._files.append(f)

    def load_str(self, s: str) -> None:
        """Add a launch file as text, for `start`."""
        self._texts.append(s)

    def start(self) -> None:
        """Start what was loaded; nodes can be launched from now on.

        Raises:
            RLException: a file does not exist or has errors.
        """
        if self._files or self._texts:
            files: list[tuple[str, list[str]]] = [(path, []) for path in self._files]
            self._parent = ROSLaunchParent("", files, roslaunch_strs=self._texts)
            self._parent.start()
        self._is_started = True
        atexit.register(self.stop)

    def launch(self, node: Node) -> Process:
        """Start a node.

        Raises:
            RLException: it was not started, or nothing has the node's package and type.
        """
        if not self._is_started:
            raise RLException("please call start() first")
        diagnostics = Diagnostics()
        workspace = Workspace.discover()
        found = find_executable(
            node.package, node.node_type, workspace=workspace, diagnostics=diagnostics
        )
        if found is None:
            text = "; ".join(str(one.message) for one in diagnostics)
            raise RLException(f"unable to launch [{node.package}/{node.node_type}]: {text}")
        name = f"{node.namespace.rstrip('/')}/{node.own_name}"
        argv = ["--no-summary", "-"]
        made = start_launch(name, argv, package=node.package, text=node.to_xml())
        self._nodes.append(made)
        return made

    def spin_once(self) -> bool:
        """Tell whether something runs still."""
        self._nodes = [one for one in self._nodes if one.is_alive()]
        return bool(self._nodes) or (self._parent is not None and self._parent.spin_once())

    def spin(self) -> None:
        """Wait until everything has ended."""
        while self.spin_once():
            time.sleep(_PAUSE_S)

    def stop(self) -> None:
        """End everything; twice does nothing."""
        atexit.unregister(self.stop)
        for one in self._nodes:
            one.stop()
        if self._parent is not None:
            self._parent.shutdown()
        self._nodes, self._parent, self._is_started = [], None, False
