"""Starting the nodes of a launch and keeping them until it ends."""

from __future__ import annotations

import contextlib
import itertools
import os
import queue
import signal
import subprocess
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Self

from gazelle.launch.console import Console
from gazelle.launch.launch_config import NodeTag
from gazelle.launch.light_nodes import HostEnded, NodeEnded, NodeHost, NodeReady
from gazelle.launch.node_commands import Executable
from gazelle.launch.node_process import (
    LaunchedProcess,
    StoppedProcess,
    code_text,
    end_text,
    node_argv,
    start_process,
)
from gazelle.launch.watchdog import Watchdog

__all__ = ["StopTimes", "Supervisor"]

_RULE = "=" * 80
_ALL_DIED = "all processes on machine have died, roslaunch will exit"
_HOST_DEATHS = 3
_OFTEN_S = 60.0
_WAIT_S = 1.0


class StopTimes:
    """How long a process may take to end before the next stronger signal (roslaunch's)."""

    def __init__(self, sigint_s: float = 15.0, sigterm_s: float = 2.0) -> None:
        self.sigint_s = sigint_s
        self.sigterm_s = sigterm_s


class _ProcessEnded:
    def __init__(self, process: LaunchedProcess, code: int) -> None:
        self.process = process
        self.code = code


class _Respawn:
    def __init__(self, process: LaunchedProcess) -> None:
        self.process = process


class _Shutdown:
    pass


class Supervisor:
    """Owns every process of a launch; when it ends, all of them end.

    Events (ends, respawns, signals) come through one queue and are handled in the thread that
    calls `run`, so nothing here needs a lock. Signals count as soon as it is entered (``with``), so
    that one that comes while processes are being started ends those that are there.
    """

    def __init__(
        self,
        environment: Mapping[str, str],
        log_folder: Path,
        cwd: Path,
        *,
        console: Console,
        stop_times: StopTimes | None = None,
        on_end: Callable[[NodeTag], None] | None = None,
        on_ready: Callable[[NodeTag], None] | None = None,
    ) -> None:
        """Prepare; nothing runs yet.

        Args:
            environment: of all processes.
            log_folder: where their logs go.
            cwd: where they run, unless the file says otherwise.
            console: the terminal.
            stop_times: patience at the end.
            on_end: hears of every node that has ended and is not started again.
            on_ready: hears of hosted nodes that stay and say that nobody need wait for them.
        """
        self._environment = environment
        self._log_folder = log_folder
        self._cwd = cwd
        self._console = console
        self._stop_times = stop_times or StopTimes()
        self._on_end = on_end
        self._on_ready = on_ready
        self._events: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._running: list[LaunchedProcess] = []
        self._leftovers: set[int] = set()
        self._stopped: dict[int, StoppedProcess] = {}
        self._executables: dict[str, Executable] = {}
        self._core: set[str] = set()
        self._count = 0
        self._respawning = 0
        self._guard: Watchdog | None = None
        self._host: NodeHost | None = None
        self._host_ids = itertools.count(1)
        self._host_deaths: deque[float] = deque(maxlen=_HOST_DEATHS)
        self._exit_code = 0
        self._is_stopping = False
        self._is_over = False
        self._previous: dict[int, Any] = {}

    def __enter__(self) -> Self:
        """Listen to the signals that end a launch."""
        for number in (signal.SIGINT, signal.SIGTERM):
            self._previous[number] = signal.signal(number, self._on_signal)
        return self

    def __exit__(self, *_exc_info: object) -> None:
        """End what still runs, and leave signals as they were."""
        if self._running and not self._is_over:
            self.shutdown()
        for number, handler in self._previous.items():
            signal.signal(number, handler)

    def _on_signal(self, *_args: object) -> None:
        self._is_stopping = True
        self._events.put(_Shutdown())

    def start(self, spec: NodeTag, executable: Executable, *, core: bool = False) -> bool:
        """Start a node; False (and a line on the terminal) when that is impossible.

        None is started any more, without a line, once the launch is to end.

        Args:
            spec: what to start.
            executable: its command.
            core: the launch does not go on for its sake alone, as for rosout.
        """
        if self._is_stopping:
            return False
        self._count += 1
        label = f"{spec.full_name.strip('/').replace('/', '-')}-{self._count}"
        self._executables[label] = executable
        if core:
            self._core.add(label)
        return self._start(label, spec)

    def runs(self, spec: NodeTag) -> bool:
        """Return whether a node that was started in a process of its own has not ended.

        None counts any more once the launch is to end: nobody need wait for it.
        """
        if self._is_stopping:
            return False
        started = [item.popen for item in self._running if item.spec is spec]
        return any(popen is not None and popen.poll() is None for popen in started)

    def _start(self, label: str, spec: NodeTag) -> bool:
        try:
            process = self._begin(label, spec)
        except (OSError, ValueError) as error:
            self._console.error(f"cannot start [{label}]: {error}")
            self._exit_code = 1
            self._tell_end(spec)
            return False
        self._running.append(process)
        self._console.bold(f"process[{label}]: started with pid [{process.pid}]")
        return True

    def _begin(self, label: str, spec: NodeTag) -> LaunchedProcess:
        """Start a process, or a node in the host.

        Raises:
            OSError: the command cannot be started.
            ValueError: its arguments have an open quotation mark.
        """
        executable = self._executables[label]
        stem = self._log_folder / label
        argv = executable.command
        if executable.takes_ros_args:
            argv = (*argv, *node_argv(spec), f"__log:={stem}.log")
        process = LaunchedProcess(label, spec, argv, stem)
        builtin = executable.builtin
        if builtin is not None and builtin.is_light and not spec.env and not spec.launch_prefix:
            self._start_hosted(process, f"{builtin.package}/{builtin.executable}")
            return process
        start_process(process, executable, self._environment, self._cwd)
        self._watch(process.popen)
        threading.Thread(target=self._wait_for, args=(process,), daemon=True).start()
        return process

    def run(self) -> int:
        """Handle events until every process has ended or a shutdown is asked for.

        With nothing but core nodes from the start, it stays until it is told to end. That nobody
        reads its lines any more ends it too, as in ``roslaunch … | head``.

        Returns:
            0 when all went well, 1 when a required process died or a start failed.
        """
        try:
            self._console.when_nobody_reads(lambda: self._events.put(_Shutdown()))
            only_core = self._count == len(self._core)
            while self._running or self._respawning:
                if not only_core and not self._has_work():
                    self._console.bold(_ALL_DIED)
                    break
                if not self._handle(self._next_event()):
                    break
        finally:
            self.shutdown()
        return self._exit_code

    def _next_event(self) -> Any:
        """Return the next event.

        A signal that comes just before the wait begins does not end it, so the wait is cut up.
        """
        while True:
            self._tell_stopped()
            with contextlib.suppress(queue.Empty):
                return self._events.get(timeout=_WAIT_S)

    def _has_work(self) -> bool:
        """Return whether a node other than the core's runs or is about to."""
        return bool(self._respawning) or any(one.label not in self._core for one in self._running)

    def shutdown(self) -> None:
        """End all processes: SIGINT, then SIGTERM, then SIGKILL."""
        self._is_over = True
        for process in reversed(self._running):
            self._console.plain(f"[{process.label}] killing on exit")
            self._signal(process, signal.SIGINT)
        self._close_host()
        self._wait_until(time.monotonic() + self._stop_times.sigint_s)
        self._escalate(signal.SIGTERM, self._stop_times.sigterm_s)
        self._escalate(signal.SIGKILL, self._stop_times.sigterm_s)
        for group in self._leftovers:
            _signal_group(group, signal.SIGKILL)
        if self._guard is not None:
            self._guard.close()
        self._console.plain("shutting down processing monitor...")
        self._console.plain("... shutting down processing monitor complete")

    def _start_hosted(self, process: LaunchedProcess, node: str) -> None:
        if self._host is None:
            self._host = NodeHost(self._environment, self._cwd, self._events)
            self._watch(self._host.popen)
        process.host_id = next(self._host_ids)
        process.popen = self._host.popen
        self._host.start(process.host_id, node, process.spec, f"{process.log_stem}.log")

    def _watch(self, popen: subprocess.Popen[bytes] | None) -> None:
        """Let the guard end a process, and what it starts, should this one be killed."""
        assert popen is not None
        if self._guard is None:
            self._guard = Watchdog()
        self._guard.begun(popen.pid)

    def _tell_stopped(self) -> None:
        """Say which processes a signal has stopped, or lets go on."""
        labels: dict[int, list[str]] = {}
        for process in self._running:
            if process.popen is not None:
                labels.setdefault(process.popen.pid, []).append(process.label)
        self._stopped = {pid: self._stopped.get(pid) or StoppedProcess(pid) for pid in labels}
        for pid, one in self._stopped.items():
            if news := one.news():
                self._console.warning(f"[{', '.join(labels[pid])}] {news}")

    def _wait_for(self, process: LaunchedProcess) -> None:
        assert process.popen is not None
        self._events.put(_ProcessEnded(process, process.popen.wait()))

    def _handle(self, event: Any) -> bool:
        """Handle one event; False means that the launch is over."""
        if isinstance(event, _Shutdown):
            return False
        if isinstance(event, _Respawn):
            self._respawning -= 1
            self._start(event.process.label, event.process.spec)
            return True
        if isinstance(event, NodeReady):
            self._tell_ready(event.host_id)
            return True
        if isinstance(event, HostEnded) and self._revive_host(event):
            return True
        ended = [self._ended(process, code) for process, code in self._ends(event)]
        return all(ended)

    def _ends(self, event: Any) -> list[tuple[LaunchedProcess, int]]:
        if isinstance(event, _ProcessEnded):
            return [(event.process, event.code)]
        if isinstance(event, NodeEnded):
            hosted = [item for item in self._running if item.host_id == event.host_id]
            return [(item, event.code) for item in hosted]
        assert isinstance(event, HostEnded)
        self._host = None
        hosted = [item for item in self._running if item.host_id is not None]
        return [(item, event.code) for item in hosted]

    def _ended(self, process: LaunchedProcess, code: int) -> bool:
        if process not in self._running:
            return True
        self._running.remove(process)
        if process.host_id is None:
            self._end_leftovers(process.pid)
        text = end_text(process, code)
        if process.spec.required:
            head = f"REQUIRED process [{process.label}] has died!"
            self._console.error(f"{_RULE}{head}\n{text}\nInitiating shutdown!\n{_RULE}")
            self._exit_code = 1 if code else self._exit_code
            return False
        show = self._console.plain if code == 0 else self._console.error
        show(f"[{process.label}] {text}")
        if process.spec.respawn:
            self._respawn(process)
        else:
            self._tell_end(process.spec)
        return True

    def _tell_end(self, spec: NodeTag) -> None:
        if self._on_end is not None:
            self._on_end(spec)

    def _tell_ready(self, host_id: int) -> None:
        for item in self._running:
            if item.host_id == host_id and self._on_ready is not None:
                self._on_ready(item.spec)

    def _end_leftovers(self, group: int) -> None:
        """End what a process has started and left behind."""
        if _signal_group(group, signal.SIGTERM):
            self._leftovers.add(group)
        elif self._guard is not None:
            self._guard.ended(group)

    def _revive_host(self, event: HostEnded) -> bool:
        """Start the nodes of a host that died in a new one; False when that happens too often."""
        hosted = [item for item in self._running if item.host_id is not None]
        now = time.monotonic()
        often = len(self._host_deaths) == _HOST_DEATHS and now - self._host_deaths[0] < _OFTEN_S
        if often or not hosted or self._host is None:
            return False
        self._host_deaths.append(now)
        self._console.error(
            f"the process of the built-in nodes [pid {self._host.popen.pid}] has died "
            f"({code_text(event.code)}); its nodes are started again"
        )
        self._host = None
        for item in hosted:
            self._running.remove(item)
            self._start(item.label, item.spec)
        return True

    def _respawn(self, process: LaunchedProcess) -> None:
        self._console.plain(f"[{process.label}] restarting process")
        self._respawning += 1
        event = _Respawn(process)
        if process.spec.respawn_delay_s > 0:
            timer = threading.Timer(process.spec.respawn_delay_s, self._events.put, (event,))
            timer.daemon = True
            timer.start()
        else:
            self._events.put(event)

    def _signal(self, process: LaunchedProcess, number: signal.Signals) -> None:
        process.stopping = True
        if process.host_id is not None:
            if self._host is not None:
                self._host.stop(process.host_id)
        elif process.popen is not None and process.popen.poll() is None:
            _signal_group(process.popen.pid, number)

    def _close_host(self) -> None:
        if self._host is not None and self._host.popen.stdin is not None:
            with contextlib.suppress(BrokenPipeError):
                self._host.popen.stdin.close()

    def _wait_until(self, deadline: float) -> None:
        for popen in self._alive():
            try:
                popen.wait(max(0.0, deadline - time.monotonic()))
            except subprocess.TimeoutExpired:
                continue

    def _escalate(self, number: signal.Signals, seconds: float) -> None:
        for popen in self._alive():
            label = next((item.label for item in self._running if item.popen is popen), "nodes")
            self._console.warning(f"[{label}] escalating to {number.name}")
            _signal_group(popen.pid, number)
        self._wait_until(time.monotonic() + seconds)

    def _alive(self) -> list[subprocess.Popen[bytes]]:
        own = [item.popen for item in self._running if item.popen is not None]
        hosts = [self._host.popen] if self._host is not None else []
        return [popen for popen in dict.fromkeys([*own, *hosts]) if popen.poll() is None]


def _signal_group(group: int, number: signal.Signals) -> bool:
    """Signal a process and what it started: each leads a group; False when nothing is left."""
    try:
        os.killpg(group, number)
    except (ProcessLookupError, PermissionError):
        return False
    return True
