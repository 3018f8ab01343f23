"""``demo.list``, ``demo.start``, ``demo.stop``: Gazelle's own demos, and nothing else, by name."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from contextlib import suppress
from typing import TypedDict

from gazelle.demo import DEMOS, Demo, find_demo, panel_params, picture
from gazelle.diagnostics.launch_journal import VARIABLE
from gazelle.process_lifetime import PARENT_VARIABLE
from gazelle.studio.errors import StudioError
from gazelle.studio.http_answers import Answer
from gazelle.studio.pages import Pages
from gazelle.studio.request_params import Params

__all__ = [
    "DemoCard",
    "DemoRunner",
    "DemoStep",
    "DemosValue",
    "demo_picture",
    "list_demos",
    "start_demo",
    "stop_demo",
]

_END_S = 30.0


class DemoStep(TypedDict):
    """Something to try while a demo runs: one line of what it does, and what is typed."""

    what: str
    command: str


class DemoCard(TypedDict):
    """A demo.

    Attributes:
        ros_version: whose commands it shows.
        command: starts it in a terminal.
        picture: path of its picture; empty for none.
        seen: what there is to see.
        steps: what to try when it runs.
    """

    name: str
    title: str
    summary: str
    ros_version: int
    command: str
    picture: str
    seen: str
    steps: list[DemoStep]


class DemosValue(TypedDict):
    """The gallery.

    Attributes:
        running: the demo that was started here and runs; empty for none.
        may_start: whether the page may start one.
    """

    demos: list[DemoCard]
    running: str
    may_start: bool


class DemoRunner:
    """Starts demos on a graph, one at a time, and shows them; the last one ends with it.

    Attributes:
        may_start: whether pages may; a server that the network reaches says no.
    """

    def __init__(self, port: int, pages: Pages) -> None:
        """Start nothing yet.

        Args:
            port: the graph's.
            pages: where the panels of a demo are shown.
        """
        self.may_start = False
        self._port = port
        self._pages = pages
        self._lock = threading.Lock()
        self._running: tuple[str, subprocess.Popen[bytes]] | None = None

    @property
    def running(self) -> str:
        """The demo that runs, empty for none."""
        running = self._running
        return running[0] if running is not None and running[1].poll() is None else ""

    def start(self, demo: Demo) -> None:
        """Start a demo and show its panels.

        Raises:
            StudioError: pages may not, or one runs already.
        """
        with self._lock:
            if not self.may_start:
                raise StudioError(
                    "this page may start nothing: the network reaches its server",
                    hint=f"in a terminal: {_command(demo)}",
                )
            if self.running:
                raise StudioError(f"the demo '{self.running}' runs", hint="stop it first")
            process = subprocess.Popen(
                [sys.executable, "-m", "gazelle.cli", "demo", demo.name],
                env=self._environ(),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                # Ctrl-C is for this process, which ends the demo.
                start_new_session=True,
            )
            self._running = demo.name, process
        for panel in demo.panels:
            self._pages.show(panel.kind, panel_params(demo, panel))

    def stop(self) -> None:
        """End the demo that runs, if there is one."""
        with self._lock:
            running, self._running = self._running, None
        if running is None:
            return
        process = running[1]
        process.terminate()
        with suppress(subprocess.TimeoutExpired):
            process.wait(_END_S)
            return
        process.kill()
        process.wait()

    def close(self) -> None:
        """End what runs."""
        self.stop()

    def _environ(self) -> dict[str, str]:
        environ = {
            **os.environ,
            "GAZELLE_PORT": str(self._port),
            # This page shows it.
            "GAZELLE_STUDIO": "0",
            PARENT_VARIABLE: str(os.getpid()),
        }
        # It is a launch of its own.
        environ.pop(VARIABLE, None)
        return environ


def list_demos(runner: DemoRunner, params: Params) -> DemosValue:
    """``demo.list``: the gallery."""
    cards = [_card(demo) for demo in DEMOS]
    return {"demos": cards, "running": runner.running, "may_start": runner.may_start}


def start_demo(runner: DemoRunner, params: Params) -> DemosValue:
    """``demo.start``: `name` is one of the table's, and nothing else is started."""
    runner.start(find_demo(params.text("name")))
    return list_demos(runner, params)


def stop_demo(runner: DemoRunner, params: Params) -> DemosValue:
    """``demo.stop``: end what ``demo.start`` has started."""
    runner.stop()
    return list_demos(runner, params)


def demo_picture(_whole: object, name: str) -> Answer | None:
    """``/demo/<name>``: a demo's picture."""
    files = (picture(demo) for demo in DEMOS if demo.name == name)
    file = next(files, None)
    return None if file is None else Answer(file.read_bytes(), "image/webp", packed=False)


def _card(demo: Demo) -> DemoCard:
    return {
        "name": demo.name,
        "title": demo.title,
        "summary": demo.summary,
        "ros_version": demo.ros_version,
        "command": _command(demo),
        "picture": f"demo/{demo.name}" if picture(demo) else "",
        "seen": " ".join(demo.seen),
        "steps": [{"what": step.what, "command": step.command} for step in demo.try_next],
    }


def _command(demo: Demo) -> str:
    return f"gazelle demo {demo.name}"
