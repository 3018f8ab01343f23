"""The process: opens ROS, tells what it found, carries until the other half ends."""

from __future__ import annotations

import importlib.util
import os
import signal
import sys
import threading
import traceback
from collections import deque
from importlib import import_module
from typing import Any

from .endpoints import Endpoints
from .graph_watch import Watch
from .pipes import Frame, FrameKind, Pipes

__all__ = ["main"]

_BRIDGE = "ros2_bridge"
_CHECK_S = 1.0
_GOODBYE_S = 2.0


def main() -> None:
    """Run until standard input ends."""
    pipes = _take_pipes()
    # Ctrl-C in the terminal reaches both halves; the other one says when to end.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        _stay_on_this_machine()
        node = _open_ros()
    except BaseException as error:  # noqa: BLE001 - a broken install may raise anything
        pipes.send_control(report="failed", error=_last_line(error))
        _leave(1)
        return
    try:
        _carry(pipes, node)
    except BaseException:  # noqa: BLE001 - told before the process ends
        traceback.print_exc()
        _leave(1)


class _Inbox:
    """Reads frames: messages are published at once, all else waits for the executor's thread."""

    def __init__(self, pipes: Pipes, node: Any, endpoints: Endpoints) -> None:
        """Read nothing yet."""
        self._pipes = pipes
        self._endpoints = endpoints
        self._waiting: deque[Frame] = deque()
        self._guard = node.create_guard_condition(self._work_off)

    def run(self) -> None:
        """Read until the other half has gone.

        Raises:
            EOFError: it has.
        """
        while True:
            frame = self._pipes.receive()
            if frame.kind == FrameKind.MESSAGE:
                self._endpoints.publish(frame.channel, frame.data)
            else:
                self._waiting.append(frame)
                self._guard.trigger()

    def _work_off(self) -> None:
        while self._waiting:
            try:
                self._handle(self._waiting.popleft())
            except Exception:  # noqa: BLE001 - told; one bad frame must not end the process
                traceback.print_exc()

    def _handle(self, frame: Frame) -> None:
        kind, channel, number, data = frame
        if kind == FrameKind.CONTROL:
            self._endpoints.obey(frame.control())
        elif kind == FrameKind.REQUEST:
            self._endpoints.call(channel, number, data)
        else:
            self._endpoints.answer(channel, number, None if kind == FrameKind.FAILURE else data)


def _carry(pipes: Pipes, node: Any) -> None:
    executor = import_module("rclpy.executors").SingleThreadedExecutor()
    executor.add_node(node)
    endpoints = Endpoints(pipes, node, executor)
    inbox = _Inbox(pipes, node, endpoints)
    watch = Watch(pipes, node, endpoints)
    pipes.send_control(report="ready", **_about())
    ended = threading.Event()

    def run(work: Any) -> None:
        """Run a thread without which the process is of no use."""
        try:
            work()
        except (EOFError, OSError):
            # The other half has gone.
            pass
        except BaseException:  # noqa: BLE001 - told before the process ends
            if not ended.is_set():
                traceback.print_exc()
        ended.set()
        executor.wake()

    for name, work in (("inbox", inbox.run), ("watch", watch.run)):
        threading.Thread(target=run, args=(work,), name=name, daemon=True).start()
    while not ended.is_set():
        executor.spin_once(timeout_sec=_CHECK_S)
    _say_goodbye(endpoints)


def _say_goodbye(endpoints: Endpoints) -> None:
    """Let the others in ROS know at once; they wait for 20 s for one that does not say so."""
    watchdog = threading.Timer(_GOODBYE_S, _leave, (0,))
    watchdog.daemon = True
    watchdog.start()
    endpoints.close()
    import_module("rclpy").shutdown()
    _leave(0)


def _open_ros() -> Any:
    rclpy = import_module("rclpy")
    if importlib.util.find_spec("rclpy.impl") is None:
        raise ImportError(f"{rclpy.__file__} is not the rclpy of ROS 2")
    signals = getattr(import_module("rclpy.signals"), "SignalHandlerOptions", None)
    rclpy.init(args=[], **({} if signals is None else {"signal_handler_options": signals.NO}))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    make_node = import_module("rclpy.node").Node
    return make_node(_BRIDGE, namespace="/", enable_rosout=False, start_parameter_services=False)


def _about() -> dict[str, Any]:
    rmw = import_module("rclpy.utilities").get_rmw_implementation_identifier()
    prefixes = [one for one in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if one]
    return {
        "rmw": rmw,
        "distro": os.environ.get("ROS_DISTRO", ""),
        "python": sys.executable,
        "pid": os.getpid(),
        "prefixes": [*prefixes, sys.prefix],
    }


def _stay_on_this_machine() -> None:
    """Keep to the loopback interface unless the user has said something else.

    ROS 2 Iron brought ``ROS_AUTOMATIC_DISCOVERY_RANGE``; before it there was
    ``ROS_LOCALHOST_ONLY``, which later versions complain about.
    """
    if "ROS_AUTOMATIC_DISCOVERY_RANGE" in os.environ or "ROS_LOCALHOST_ONLY" in os.environ:
        return
    is_new = importlib.util.find_spec("rclpy.event_handler") is not None
    if is_new:
        os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    else:
        os.environ["ROS_LOCALHOST_ONLY"] = "1"


def _take_pipes() -> Pipes:
    """Take standard input and output for frames; whoever prints does so on standard error."""
    reader, writer = os.dup(0), os.dup(1)
    os.dup2(2, 1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    sys.stdout = sys.stderr
    return Pipes(os.fdopen(reader, "rb", buffering=1 << 16), os.fdopen(writer, "wb", buffering=0))


def _last_line(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}".splitlines()[0]


def _leave(code: int) -> None:
    """End at once: nothing here outlives the process, and ROS may wait for its threads."""
    sys.stderr.flush()
    os._exit(code)
