"""One object of a user's class at work: its node, its widgets' values, its timers."""

from __future__ import annotations

import importlib
import re
import sys
import threading
import time
from collections.abc import Callable, Iterable, Mapping
from types import ModuleType
from typing import Any

from gazelle.compat.import_hooks import install as make_messages_importable
from gazelle.control.python_controllers.adapter import located
from gazelle.diagnostics import did_you_mean
from gazelle.graph import Graph
from gazelle.studio.errors import StudioError
from gazelle.studio.plugins.panel import Panel
from gazelle.studio.plugins.panel_node import PanelNode
from gazelle.studio.plugins.panel_sources import Source
from gazelle.studio.plugins.panel_state import State, checked_layout, handler_of
from gazelle.studio.plugins.widget_values import check_sendable, chosen
from gazelle.workspace.python_files import import_python_file

__all__ = ["RunningPanel"]

_BUSY_S = 5.0
_MIN_DURATION_S = 0.005
_CLIENTS = ("rospy", "rclpy")
_Tell = Callable[[str, str, Any], None]


class RunningPanel:
    """From ``start`` to ``stop`` of a panel; its mistakes are told and end nothing.

    Attributes:
        state: what it shows, None until the class could be read.
    """

    def __init__(self, graph: Graph, source: Source, tell: _Tell) -> None:
        """Prepare; `begin` runs the user's code.

        Args:
            graph: where its node is.
            source: what to run.
            tell: told of every change, and ``error`` with an error in words.
        """
        self.state: State | None = None
        self._graph = graph
        self._source = source
        self._tell = tell
        self._panel: Panel | None = None
        self._node: PanelNode | None = None
        self._turn = threading.RLock()
        self._over = threading.Event()
        self._running = ("", 0.0)
        self._logged = ""

    def begin(self, *, again: bool) -> None:
        """Import the file, make the object and call ``start``.

        Args:
            again: a module that is imported already is read anew.
        """
        self._guarded("start", lambda: self._start(again))

    def end(self) -> None:
        """Call ``stop`` and take the node off the graph."""
        panel = self._panel
        if panel is not None:
            try:
                self._guarded("stop", panel.stop, _BUSY_S)
            except StudioError as error:
                self._tell("error", "", {"text": str(error), "trace": ""})
        self._over.set()
        if self._node is not None:
            self._node.node.shutdown("the panel was closed")

    def event(self, name: str, value: Any) -> None:
        """Do what a person's act means; an empty name is a value of the ES module.

        Raises:
            StudioError: the panel is not there, has no such widget, or its code is busy.
        """
        panel, state = self._panel, self.state
        if panel is None or state is None:
            raise StudioError("the panel's code could not be started", hint="see the panel")
        if not name:
            self._guarded("on_message", lambda: panel.on_message(value), _BUSY_S)
            return
        try:
            widget = state.widget(name)
            fitting = chosen(widget, value)
            if not widget.enabled:
                raise ValueError(f"'{name}' is not enabled now")
        except (LookupError, TypeError, ValueError) as error:
            raise StudioError(str(error)) from None
        has_value = state.values[name] is not None
        if has_value:
            state.set(name, fitting)
        handler = handler_of(panel, widget)
        if handler is not None:
            arguments = (fitting,) if has_value else ()
            self._guarded(f"on_{name}", lambda: handler(*arguments), _BUSY_S)

    def value(self, name: str) -> Any:
        """Return a widget's value."""
        return self._shown().value(name)

    def set(self, name: str, value: Any) -> None:
        """Show a value."""
        self._shown().set(name, value)

    def add(self, name: str, values: Iterable[float], time_s: float | None) -> None:
        """Add to a plot."""
        now_s = self._graph.clock.now_ns() * 1e-9 if time_s is None else float(time_s)
        self._shown().add(name, values, now_s)

    def change(self, name: str, properties: Mapping[str, Any]) -> None:
        """Change a widget."""
        self._shown().change(name, properties)

    def send(self, value: Any) -> None:
        """Hand a value to the ES module."""
        check_sendable(value)
        self._tell("message", "", value)

    def every(self, period_s: float, callback: Callable[[], Any]) -> None:
        """Call something again and again."""
        if not period_s >= _MIN_DURATION_S:
            raise ValueError(f"every({period_s}, …): the shortest period is {_MIN_DURATION_S} s")

        def run() -> None:
            while not self._over.wait(period_s):
                self._guarded("every()", callback)

        threading.Thread(target=run, name=f"panel {self._source.name}", daemon=True).start()

    def _start(self, again: bool) -> None:
        made = self._class(again)
        layout = checked_layout(made)
        self.state = State(layout, self._tell)
        panel = made()
        panel._link = self
        name = re.sub(r"\W+", "_", f"panel_{self._source.name}").lower()
        node = self._graph.create_node(name, anonymous=True, is_ros2=True)
        self._node = PanelNode(node, lambda action: self._guarded("a callback", action))
        self._panel = panel
        panel.start(self._node)

    def _class(self, again: bool) -> type[Panel]:
        name = self._source.class_name
        module = self._module(again)
        found = getattr(module, name, None)
        if not isinstance(found, type) or not issubclass(found, Panel):
            nearest = did_you_mean(name, vars(module))
            text = f"{self._source.file} has no class '{name}' that derives from Panel"
            raise StudioError(f"{text}; {nearest}" if nearest else text)
        return found

    def _module(self, again: bool) -> ModuleType:
        source = self._source
        make_messages_importable()
        if source.module_name:
            known = sys.modules.get(source.module_name)
            if known is not None and again:
                return importlib.reload(known)
            return importlib.import_module(source.module_name)
        name = f"gazelle_user_panels.{source.file.stem}_{source.file.stat().st_mtime_ns}"
        return import_python_file(source.file, name, folders=source.folders)

    def _shown(self) -> State:
        assert self.state is not None
        return self.state

    def _guarded(self, what: str, action: Callable[[], Any], patience_s: float = -1) -> bool:
        """Run the panel's code, one piece at a time; False when it raised."""
        if not self._turn.acquire(timeout=patience_s):
            running, since = self._running
            seconds = time.monotonic() - since
            text = f"the panel is busy: {running} has been running for {seconds:.0f} s"
            hint = "long work belongs into a thread of its own, or into small steps with every()"
            raise StudioError(text, hint=hint)
        try:
            if self._over.is_set():
                return False
            self._running = (what, time.monotonic())
            action()
        except (Exception, SystemExit) as error:  # noqa: BLE001 - a user's code raises what it likes
            self._report(error)
            return False
        finally:
            self._turn.release()
        return True

    def _report(self, error: BaseException) -> None:
        """Tell the pages, and the log what it was not told just before."""
        text = located(error, self._source.file.parent)
        if str(self._source.file.parent) not in text:
            text = f"{self._source.file}:{self._source.line}: {text}"
        if isinstance(error, ImportError) and error.name in _CLIENTS:
            text += "; a panel is given its node in start(self, node) and imports none"
        if self._node is not None and text != self._logged:
            self._node.log_error(text)
        self._logged = text
        self._tell("error", "", {"text": text, "trace": _trace(error)})


def _trace(error: BaseException) -> str:
    import traceback

    return "".join(traceback.format_exception(error)).rstrip()
