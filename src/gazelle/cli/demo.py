"""``gazelle demo [NAME]``: our own packages, with a world, a page and what to try next."""

from __future__ import annotations

import argparse
import contextlib
import os
import shlex
import signal
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING

from gazelle.demo import DEMOS, Demo, Panel, copy_demo, find_demo, panel_params, workspace_folder
from gazelle.errors import GazelleError
from gazelle.process_lifetime import PARENT_VARIABLE, at_stop_signal, interrupts_held

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.studio import Server

__all__ = ["main"]

_LOOK_S = 0.1
_LAST_LINES = 30
_FAILED = ("[ERROR]", "[FATAL]", "Traceback", "error:")
# Panels that complain of topics that are not there yet.
_LATE = frozenset({"rqt_plot"})
# After SIGINT, then after SIGTERM; a launch gives its nodes most of that.
_STOP_S, _KILL_S = 20.0, 3.0
_CLOCK = "/clock"


def main(argv: list[str]) -> int:
    """List the demos, run one until Ctrl-C, or write one as a workspace."""
    options = _parser().parse_args(argv)
    if options.name is None or options.list:
        print(_gallery())
        return 0
    demo = find_demo(options.name)
    if options.copy:
        print(_copied(demo, Path(options.copy)))
        return 0
    return _run(demo, options)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle demo",
        description="Run a demo until Ctrl-C: its world, its programs, and the page that shows it.",
    )
    add = parser.add_argument
    add("name", nargs="?", metavar="NAME", help="which one; without it all are listed")
    add("--list", action="store_true", help="list the demos")
    add("--copy", metavar="DIR", help="write the demo's packages as a workspace of yours")
    add("--no-browser", dest="browser", action="store_false", help="only print the page's address")
    add("-v", "--verbose", action="store_true", help="print what the launch and programs print")
    return parser


def _gallery() -> str:
    width = max(len(demo.name) for demo in DEMOS) + 2
    rows = [f"  {demo.name:<{width}}{demo.summary} (ROS {demo.ros_version})" for demo in DEMOS]
    hints = [
        "gazelle demo NAME             run one until Ctrl-C, with a page in the browser",
        "gazelle demo NAME --copy DIR  write its packages as a workspace, to change them",
    ]
    return "\n".join(["demos:", *rows, "", *hints])


def _copied(demo: Demo, folder: Path) -> str:
    packages = copy_demo(demo, folder)
    return "\n".join(
        [
            f"wrote {', '.join(str(path) for path in packages)}",
            "",
            "next:",
            f"  cd {shlex.quote(str(folder))}",
            f"  {_typed(demo.launch)}",
            *(f"  {_typed(program)}    # in another terminal" for program in demo.programs),
            "",
            "change a file and start it again; nothing has to be built. 'gazelle doctor' tells",
            "what would go wrong.",
        ]
    )


def _typed(argv: Sequence[str]) -> str:
    return shlex.join(["gazelle", *argv])


def _run(demo: Demo, options: argparse.Namespace) -> int:
    from gazelle.graph import Graph

    stop = threading.Event()
    at_stop_signal(stop.set)
    began = time.monotonic()
    with Graph.open(role="hub") as graph:
        if any(topic.name == _CLOCK and topic.publishers for topic in graph.topics()):
            raise GazelleError(_runs_already(demo, graph.port))
        print(f"{demo.title}: {demo.summary} (ROS {demo.ros_version})", flush=True)
        print(f"  started:  {_typed(demo.launch)}", flush=True)
        show = _Processes(demo, is_verbose=options.verbose)
        show.start(demo.launch)
        try:
            for program in demo.programs:
                show.start(program)
            with _page(graph) as server:
                if server is not None:
                    print(f"  page:     {server.url}", flush=True)
                    _show(server, demo, [one for one in demo.panels if one.kind not in _LATE])
                try:
                    if _waited(demo, graph, show, stop):
                        _begin(demo, server, began, with_browser=options.browser)
                    show.wait(stop)
                finally:
                    code = show.end()
                    _leave_soon(code)
        finally:
            code = show.end()
    return code


def _leave_soon(code: int) -> None:
    """End the process in some seconds: the page may be in the midst of a picture nobody awaits."""
    late = threading.Timer(_KILL_S, os._exit, (code,))
    late.daemon = True
    late.start()


def _runs_already(demo: Demo, port: int) -> str:
    return (
        "a world runs already on this graph; end it with Ctrl-C in its terminal, or start the "
        f"demo beside it: GAZELLE_PORT={port + 1} gazelle demo {demo.name} (and the same before "
        "what you type next)"
    )


@contextmanager
def _page(graph: Graph) -> Iterator[Server | None]:
    """Serve the page; whoever wants none (``GAZELLE_STUDIO=0``) has none."""
    from gazelle.studio.windows.page_owner import is_switched_off, offer, page_port

    if is_switched_off():
        yield None
        return
    from gazelle.studio import Server, Studio

    with Server(Studio(graph), port=page_port(graph)) as server:
        offer(server)
        yield server


def _show(server: Server, demo: Demo, panels: Sequence[Panel]) -> None:
    for panel in panels:
        server.studio.pages.show(panel.kind, panel_params(demo, panel))


def _waited(demo: Demo, graph: Graph, show: _Processes, stop: threading.Event) -> bool:
    """Wait for the demo's sign; False when it is over before."""
    while not any(topic.name == demo.sign and topic.publishers for topic in graph.topics()):
        if stop.wait(_LOOK_S) or show.is_over:
            return False
    return True


def _begin(demo: Demo, server: Server | None, began: float, *, with_browser: bool) -> None:
    """Show the panels whose topics are there now, and say what to do."""
    from gazelle.studio.windows.page_owner import open_browser

    print(f"  there after {time.monotonic() - began:.1f} s", flush=True)
    if server is not None:
        _show(server, demo, [one for one in demo.panels if one.kind in _LATE])
        if with_browser:
            open_browser(server.url)
    steps = [
        line for step in demo.try_next for line in (f"  {step.what}:", f"      {step.command}")
    ]
    lines = [
        "",
        *demo.seen,
        "",
        "Try next, in another terminal:",
        *steps,
        "  make it your own:",
        f"      gazelle demo {demo.name} --copy my_{demo.name}",
        "",
        "Ctrl-C ends it.",
    ]
    print("\n".join(lines), flush=True)


class _Processes:
    """The processes of a demo; the first one is the launch, and the show is over with it."""

    def __init__(self, demo: Demo, *, is_verbose: bool) -> None:
        self._environ = _environment(demo)
        self._is_verbose = is_verbose
        self._running: list[subprocess.Popen[str]] = []
        self._readers: list[threading.Thread] = []
        self._code = 0
        self._is_ending = False
        self._last: deque[str] = deque(maxlen=_LAST_LINES)

    @property
    def is_over(self) -> bool:
        """Tell whether the launch has ended."""
        return self._running[0].poll() is not None

    def start(self, argv: Sequence[str]) -> None:
        """Start a command of ours; what it prints is kept for the case that it fails."""
        heard = None if self._is_verbose else subprocess.PIPE
        with interrupts_held():
            process = subprocess.Popen(
                [sys.executable, "-m", "gazelle.cli", *argv],
                env=self._environ,
                stdin=subprocess.DEVNULL,
                stdout=heard,
                stderr=None if heard is None else subprocess.STDOUT,
                # Ctrl-C is for this process, which passes it on.
                start_new_session=True,
                text=True,
                errors="replace",
            )
        self._running.append(process)
        if process.stdout is not None:
            reader = threading.Thread(target=self._read, args=(process.stdout,), daemon=True)
            reader.start()
            self._readers.append(reader)

    def wait(self, stop: threading.Event) -> None:
        """Stay until told to stop, or until the launch ends by itself."""
        while not stop.wait(_LOOK_S) and not self.is_over:
            continue

    def end(self) -> int:
        """End what runs, the launch last; return 1 and tell why where it had failed by itself."""
        if not self._running:
            return self._code
        self._is_ending = True
        failed = self.is_over and self._running[0].returncode != 0
        for process in reversed(self._running):
            _end(process)
        for reader in self._readers:
            reader.join(_KILL_S)
        self._running.clear()
        if not failed:
            return 0
        self._code = 1
        print("the launch ended by itself; it printed at last:", file=sys.stderr)
        print("\n".join(self._last), file=sys.stderr)
        return self._code

    def _read(self, lines: IO[str]) -> None:
        from gazelle.kernels import COMPILING

        for line in lines:
            text = line.rstrip("\n")
            self._last.append(text)
            _, is_compiling, for_what = text.partition(COMPILING)
            if is_compiling:
                print(f"  {COMPILING}{for_what}", flush=True)
            if not self._is_ending and any(sign in text for sign in _FAILED):
                print(text, file=sys.stderr, flush=True)


def _environment(demo: Demo) -> Mapping[str, str]:
    """The demo runs from its own files, also where a copy of the user's would be found first."""
    own = str(workspace_folder(demo) / "src")
    path = os.pathsep.join(filter(None, (own, os.environ.get("ROS_PACKAGE_PATH", ""))))
    return {
        **os.environ,
        "ROS_PACKAGE_PATH": path,
        # This process serves the page.
        "GAZELLE_STUDIO": "0",
        PARENT_VARIABLE: str(os.getpid()),
    }


def _end(process: subprocess.Popen[str]) -> None:
    for number, patience_s in ((signal.SIGINT, _STOP_S), (signal.SIGTERM, _KILL_S)):
        if process.poll() is None:
            _tell(process, number)
            try:
                process.wait(patience_s)
            except subprocess.TimeoutExpired:
                continue
    if process.poll() is None:
        process.kill()
        process.wait()


def _tell(process: subprocess.Popen[str], number: int) -> None:
    """Send a signal to what a terminal would: ``ros2 run`` leaves it to its program to end."""
    if not hasattr(os, "killpg"):
        process.send_signal(number)
        return
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, number)
