"""The one node that a rospy program is."""

from __future__ import annotations

import atexit
import os
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Sequence
from types import CodeType, FrameType
from typing import Any

from gazelle.compat.rospy.exceptions import ROSException, ROSInitException, ROSInterruptException
from gazelle.errors import GazelleError
from gazelle.graph import Graph, Level, Node, offer_loggers
from gazelle.graph.log_output import keep_log
from gazelle.graph.names import CommandLine, parse_command_line, resolve
from gazelle.process_lifetime import raise_or_end

__all__ = ["STATE", "NodeState"]

_LAST_CHANCE_S = 2.0
# So long a program may go on after Ctrl-C without asking whether the node is shut down. A loop that
# never asks, or a wait that nothing ends, must not outlive its launch.
_PATIENCE_S = 3.0
# So long the main thread waits for the node's shutdown when a signal comes.
_SHUTDOWN_S = 5.0
# Where Python waits for threads when a program is done.
_JOINING: CodeType = threading._shutdown.__code__  # type: ignore[attr-defined]
_PLAIN_HANDLERS = (
    signal.default_int_handler,
    raise_or_end,
    signal.SIG_DFL,
    signal.SIG_IGN,
    None,
)
_LEVELS = {1: Level.DEBUG, 2: Level.INFO, 4: Level.WARN, 8: Level.ERROR, 16: Level.FATAL}


class NodeState:
    """What rospy's functions share: the node, its shutdown, its command line."""

    def __init__(self) -> None:
        self.graph: Graph | None = None
        self.node: Node | None = None
        self.line: CommandLine = parse_command_line(sys.argv[1:])
        self.argv: Sequence[str] | None = None
        self.requested = threading.Event()
        self.stopping = threading.Event()
        self._aware: set[int] = set()
        self._cut_short: set[int] = set()
        self._asked_twice = False
        self._finished = threading.Event()
        self.reason = ""
        self._hooks: list[Callable[[], Any]] = []
        self._preshutdown: list[Callable[[str], Any]] = []
        self._waiting: list[Callable[[Node], Any]] = []
        self._lock = threading.RLock()
        # Apart from the other one, which `init` holds when a signal comes in its middle.
        self._ending = threading.Lock()
        self._previous_sigint: Any = None

    def open_graph(self) -> Graph:
        """Return the graph; parameters work before `init_node` too.

        Raises:
            ROSException: the graph cannot be joined.
        """
        with self._lock:
            if self.graph is None:
                try:
                    self.graph = Graph.open()
                except GazelleError as error:
                    raise ROSException(str(error)) from error
                # After the graph's own hook, so that it runs before: user hooks still publish.
                atexit.register(self._finish)
            return self.graph

    def require(self, what: str = "rospy") -> Node:
        """Return the node.

        Raises:
            ROSInitException: `init_node` has not been called.
            ROSException: the node is shut down.
        """
        if self.node is None:
            raise ROSInitException(f"{what}: call rospy.init_node('name') first")
        return self.node

    def init(
        self,
        name: str,
        argv: Sequence[str] | None,
        *,
        anonymous: bool,
        log_level: int | None,
        disable_rostime: bool,
        disable_rosout: bool,
        disable_signals: bool,
    ) -> None:
        """Make the node (see `rospy.init_node`)."""
        with self._lock:
            if self.node is not None:
                self._check_repeated_init(name)
                return
            self.line = parse_command_line(sys.argv[1:] if argv is None else argv)
            self.argv = argv
            if not disable_signals:
                self._take_signals()
            graph = self.open_graph()
            try:
                self.node = graph.create_node(
                    self.line.name or name,
                    namespace=self.line.namespace,
                    remappings=self.line.remappings,
                    anonymous=anonymous and self.line.name is None,
                    rosout=not disable_rosout,
                )
            except GazelleError as error:
                raise ROSException(str(error)) from error
            self.node.outlives = True
        if disable_rostime:
            graph.clock.use(False)
        keep_log(self.node, self.line.special.get("__log", ""))
        self.node.log_level = _LEVELS.get(log_level or 2, Level.INFO)
        offer_loggers(self.node, "rosout")
        for key, value in self.line.params.items():
            self.node.parameters.set(f"~{key}", value)
        self.node.on_shutdown(self._on_node_shutdown)
        if self.stopping.is_set():
            self.node.shutdown(self.reason)
            return
        waiting, self._waiting = self._waiting, []
        for command in waiting:
            command(self.node)
        self._wait_for_clock()

    def when_ready(self, command: Callable[[Node], Any]) -> None:
        """Do something with the node: now, or as soon as `init_node` made it."""
        if self.node is None:
            self._waiting.append(command)
        else:
            command(self.node)

    def shut_down(self, reason: str) -> None:
        """Stop the node: hooks run once, sleeps end, the graph is left.

        As in rospy the user's hooks come first, while everything still works, then
        ``is_shutdown()`` turns true.
        """
        with self._ending:
            if self.requested.is_set():
                return
            self.reason = reason
            self.requested.set()
        try:
            self._stop(reason)
        finally:
            self._finished.set()

    def _stop(self, reason: str) -> None:
        for hook in tuple(self._hooks):
            self._call(hook)
        self.stopping.set()
        if self.graph is not None:
            # Sleeps on a clock that stands still wake only by this.
            self.graph.clock.close()
        for listener in tuple(self._preshutdown):
            listener(reason)
        if self.node is not None and not self.node.closed:
            # The graph itself is left at the end of Python: this may be one of its own threads.
            self.node.shutdown(reason)

    def _finish(self) -> None:
        """Shut down, or let a shutdown in another thread come to its end, before Python ends."""
        self.shut_down("atexit")
        self._finished.wait(_LAST_CHANCE_S)
        if self.graph is not None:
            self.graph.close()

    def add_hook(self, hook: Callable[[], Any]) -> None:
        """Run something at shutdown; at once when that is over."""
        if self.stopping.is_set():
            self._call(hook)
        else:
            self._hooks.append(hook)

    def add_early_hook(self, listener: Callable[[str], Any]) -> None:
        """Run something as soon as `is_shutdown` is true, before the graph is left."""
        self._preshutdown.append(listener)

    def resolved(self, name: str) -> str:
        """Return a global name, before `init_node` too."""
        if self.node is not None:
            return self.node.resolve_name(name)
        return resolve(name, self.line.namespace or "/")

    def is_over(self) -> bool:
        """Tell a program whether the node is shut down; one that knows is left to its end."""
        over = self.stopping.is_set()
        if over:
            self._aware.add(threading.get_ident())
        return over

    def sleep(self, seconds: float) -> None:
        """Sleep in wall time; the shutdown cuts one sleep short in each thread, or its first after.

        A thread that knows of the shutdown sleeps in full, and so does a loop that never asks.
        """
        thread = threading.get_ident()
        if thread in self._aware or thread in self._cut_short:
            time.sleep(seconds)
        elif self.stopping.wait(seconds):
            self._cut_short.add(thread)

    def check_running(self) -> None:
        """Raise when the node is shut down.

        Raises:
            ROSInterruptException: it is.
        """
        if self.is_over():
            raise ROSInterruptException("rospy shutdown")

    def _check_repeated_init(self, name: str) -> None:
        assert self.node is not None
        own = self.node.name.rsplit("/", 1)[-1]
        if own != name and not own.startswith(f"{name}_"):
            raise ROSException(
                f"rospy.init_node() has already been called with different arguments: "
                f"('{own}', …), now '{name}'"
            )

    def _call(self, hook: Callable[[], Any]) -> None:
        try:
            hook()
        except Exception:  # noqa: BLE001 - a user's hook may raise anything
            traceback.print_exc()

    def _take_signals(self) -> None:
        if threading.current_thread() is not threading.main_thread():
            return
        self._previous_sigint = signal.getsignal(signal.SIGINT)
        signal.signal(signal.SIGINT, self._on_signal)
        signal.signal(signal.SIGTERM, self._on_signal)

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        if number == signal.SIGINT and self.stopping.is_set():
            # Who asks once more does not want to wait.
            self._asked_twice = True
            signal.default_int_handler(number, frame)
        if number == signal.SIGINT:
            threading.Thread(target=self._interrupt_waiting_threads, daemon=True).start()
        # Hooks publish and wait; that must not happen inside the handler of a held lock.
        thread = threading.Thread(target=self.shut_down, args=(f"signal-{number}",), daemon=True)
        thread.start()
        thread.join(_SHUTDOWN_S)
        if number == signal.SIGTERM:
            # A loop that never asks is_shutdown() must not outlive its launch.
            last = threading.Timer(_LAST_CHANCE_S, os._exit, (128 + number,))
            last.daemon = True
            last.start()
        elif self._previous_sigint not in _PLAIN_HANDLERS and callable(self._previous_sigint):
            self._previous_sigint(number, frame)

    def _interrupt_waiting_threads(self) -> None:
        """Interrupt the main thread, or leave the others, if they do not know of the shutdown.

        Python goes on waiting when a signal comes, so a program may wait for ever.
        """
        self.stopping.wait()
        # Until then it waits in the signal's handler and cannot ask.
        self._finished.wait(_SHUTDOWN_S)
        main = threading.main_thread().ident
        assert main is not None
        time.sleep(_PATIENCE_S)
        while not _has_code(sys._current_frames().get(main), _JOINING):
            # One that was interrupted already may be busy with its own end.
            if main in self._aware or self._asked_twice:
                return
            signal.pthread_kill(main, signal.SIGINT)
            # Then it may come to wait for its threads.
            time.sleep(_PATIENCE_S)
        others = [one for one in threading.enumerate() if one.ident != main and not one.daemon]
        if any(one.ident not in self._aware for one in others):
            sys.stdout.flush()
            os._exit(128 + signal.SIGINT)

    def _on_node_shutdown(self, reason: str) -> None:
        if not self.stopping.is_set():
            threading.Thread(target=self.shut_down, args=(reason,), daemon=True).start()

    def _wait_for_clock(self) -> None:
        """Let the first /clock message come, as rospy's own init does not return time 0."""
        assert self.node is not None
        if self.node.clock.use_sim_time and self.node.graph.publisher_count("/clock"):
            deadline = threading.Event()
            for _ in range(100):
                if self.node.clock.now_ns():
                    return
                deadline.wait(0.01)


def _has_code(frame: FrameType | None, code: CodeType) -> bool:
    while frame is not None and frame.f_code is not code:
        frame = frame.f_back
    return frame is not None


STATE = NodeState()
