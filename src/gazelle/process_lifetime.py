"""How a process of ours starts, hears that it is to end, and ends, also with its launcher."""

from __future__ import annotations

import atexit
import gc
import os
import select
import signal
import stat
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import CodeType, FrameType
from typing import TYPE_CHECKING, Any, NoReturn, TextIO, TypeVar

if TYPE_CHECKING:
    import socket

__all__ = [
    "PARENT_VARIABLE",
    "StopEvent",
    "at_stop_signal",
    "called_by_library",
    "collect_garbage_rarely",
    "drop_output",
    "end_at_interrupts",
    "end_with",
    "end_with_parent",
    "interrupts_held",
    "raise_interrupts",
    "raise_or_end",
    "start_deaf_thread",
    "want_one_blas_thread",
    "when_nobody_reads",
]


_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_IMPORTING = "<frozen importlib._bootstrap>"
_AGAIN_S = 0.05
# Nobody sends it to programs, and without a handler it does nothing.
_ROUSING = getattr(signal, "SIGURG", None)
_ROUSE_AFTER_S = (0.05, 0.2, 1.0)
_called_by_libraries: set[CodeType] = set()
Callback = TypeVar("Callback", bound=Callable[..., Any])
PARENT_VARIABLE = "GAZELLE_PARENT_PID"
_PR_SET_PDEATHSIG = 1
_CHECK_PERIOD_S = 0.5
_YOUNG, _MIDDLE, _OLD = 10_000, 20, 20


class StopEvent(threading.Event):
    """Set when a program is to end; it knows whether the program has come to look at it.

    Attributes:
        was_looked_at: False while the program still loads.
    """

    def __init__(self, patience_s: float | None = None) -> None:
        """Be not set.

        Args:
            patience_s: how long the process may go on after `request`; None for as long as it
                takes, for programs that write files at their end.
        """
        super().__init__()
        self.was_looked_at = False
        self._patience_s = patience_s

    def is_set(self) -> bool:
        """Tell whether the program is to end."""
        self.was_looked_at = True
        return super().is_set()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until the program is to end."""
        self.was_looked_at = True
        return super().wait(timeout)

    def request(self) -> None:
        """Ask the program to end; one that still loads has nothing to undo and ends at once."""
        if not self.was_looked_at:
            os._exit(0)
        if self._patience_s is not None and not super().is_set():
            late = threading.Timer(self._patience_s, os._exit, (0,))
            late.daemon = True
            late.start()
        self.set()


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Let processes that are started now hear SIGINT when they call `end_at_interrupts`.

    Python makes an exception of SIGINT before it has loaded what would catch it: a launch that is
    ended early would print the insides of every interpreter. For programs of Gazelle only, as any
    other would never hear the signal.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def end_at_interrupts() -> None:
    """Let SIGINT end the process at once and without a word: it has nothing to undo so far."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def raise_interrupts() -> None:
    """Let SIGINT raise `KeyboardInterrupt`, but end the process while it imports a module.

    No program catches what is raised in the midst of an import, and it may come from anywhere
    there. Shells without job control start programs behind ``&`` with SIGINT ignored, and Python
    leaves it at that; rospy, rclpy and roslaunch do not, so scripts rely on ``kill -INT``.
    """
    signal.signal(signal.SIGINT, raise_or_end)
    _rouse_main_thread()


def called_by_library(function: Callback) -> Callback:
    """Mark a function that a library in C calls back, which prints exceptions and goes on.

    It may do so in the main thread, within a call of ours: an interrupt that is raised there would
    be lost, and the program never end.
    """
    _called_by_libraries.add(function.__code__)
    return function


def raise_or_end(number: int, frame: FrameType | None) -> None:
    """Be the handler that `raise_interrupts` sets."""
    one = frame
    while one is not None:
        if one.f_code in _called_by_libraries:
            # What is raised here goes no further than to the library: once more, when it is done.
            again = threading.Timer(_AGAIN_S, os.kill, (os.getpid(), number))
            again.daemon = True
            again.start()
            return
        if one.f_code.co_filename == _IMPORTING:
            end_at_interrupts()
            os.kill(os.getpid(), signal.SIGINT)
        one = one.f_back
    signal.default_int_handler(number, frame)


def end_with(main: Callable[[], int]) -> NoReturn:
    """Run a program's main function and end the process with what it returns.

    Everything Python does at its end is done but the last: it does not take itself apart. A
    thread of the transport that called in at that very moment would be ended by force, its frames
    cannot be, and the process would abort with the work long done.
    """
    code = _code_of(main)
    if threading.current_thread() is threading.main_thread():
        # Who asks once more does not want to wait for what is left to do.
        end_at_interrupts()
    # Also tells the pools of concurrent.futures to end, whose threads wait for ever otherwise.
    threading._shutdown()  # type: ignore[attr-defined]
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            # Its reader has gone, or the program closed it.
            continue
    os._exit(code)


def at_stop_signal(stop: Callable[[], object]) -> None:
    """Call something on SIGINT and SIGTERM, at once whatever the main thread is doing.

    Python's own handlers run in the main thread when it next wakes: one that begins to wait just
    as the signal comes, or whose signal the kernel gave to another thread, sleeps on. And what a
    handler calls must not wait for a lock that the main thread has just taken, as ``Event.set``
    does in the midst of ``Event.wait`` or of itself: it would wait for ever. So a thread is woken
    by the signal's number and calls it; it must not mind being called twice.
    """
    for number in _SIGNALS:
        signal.signal(number, _do_nothing)
    _at_each_signal(stop)


def start_deaf_thread(act: Callable[..., object], *arguments: object) -> None:
    """Start a daemon thread that the system gives no signals to.

    A signal to a process goes to any thread that does not block it. A program that blocks one to
    wait for it (``sigwait``) knows its own threads only, and would be ended by one of ours.
    """
    thread = threading.Thread(target=act, args=arguments, daemon=True)
    if not hasattr(signal, "pthread_sigmask"):
        thread.start()
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, signal.valid_signals())
    try:
        thread.start()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def when_nobody_reads(stream: TextIO, act: Callable[[], object]) -> None:
    """Call something when the reader of a stream goes, as in ``roslaunch … | head -3``.

    It is called in a thread; a stream that is no pipe always has a reader. Who seldom writes hears
    nothing of it otherwise, and would run on for nobody.
    """
    try:
        descriptor = stream.fileno()
        is_pipe = stat.S_ISFIFO(os.fstat(descriptor).st_mode)
    except (OSError, ValueError):
        # A test's stand-in for the terminal, or a stream that is closed.
        return
    if is_pipe:
        # One of its own: `drop_output` may put something else in its place meanwhile.
        own = os.dup(descriptor)
        start_deaf_thread(_await_end, own, act)


def drop_output(stream: TextIO) -> None:
    """Let what is written from now on go nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


def end_with_parent() -> None:
    """Send this process SIGTERM when its launcher dies.

    Does nothing unless the launcher named itself in the environment, so a node that a person
    starts by hand outlives the shell as usual. The kernel does it on Linux (prctl(2)), but may
    give the signal to a thread other than Python's main one, which then does not hear of it
    before it wakes; so a thread looks at the parent's number too, everywhere.
    """
    parent = os.environ.pop(PARENT_VARIABLE, "")
    if not parent.isdigit():
        return
    if sys.platform == "linux":
        # Only who was launched needs it.
        import ctypes

        ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_PDEATHSIG, signal.SIGTERM, 0, 0, 0)
    if os.getppid() != int(parent):
        os.kill(os.getpid(), signal.SIGTERM)
    start_deaf_thread(_watch, int(parent))


def collect_garbage_rarely() -> None:
    """Look for reference cycles after ten thousand new objects instead of 700 (2,000 in 3.12).

    Importing makes many objects and hardly any cycles: about a sixth of a simulator's start.
    """
    gc.set_threshold(_YOUNG, _MIDDLE, _OLD)


def want_one_blas_thread() -> None:
    """Keep NumPy's OpenBLAS from starting a thread per processor, before NumPy is imported.

    A node's matrices are small. The threads cost a tenth of a second of computing at the start,
    and how many there are would change the last digits of sums from machine to machine. Who sets
    the variable is obeyed.
    """
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")


def _rouse_main_thread() -> None:
    """Let no signal be slept through.

    Python's handlers run in the main thread when it next wakes. One that begins to wait just as
    the signal comes, or whose signal the kernel gave to another thread, would sleep on, for ever
    where it waits without a limit. So a thread that is woken by the signal's number rouses it.
    """
    if _ROUSING is None or threading.current_thread() is not threading.main_thread():
        return
    if signal.getsignal(_ROUSING) in (signal.SIG_DFL, None):
        signal.signal(_ROUSING, _do_nothing)
    _at_each_signal(_rouse)


def _rouse() -> None:
    main = threading.main_thread().ident
    assert main is not None and _ROUSING is not None
    for after_s in _ROUSE_AFTER_S:
        time.sleep(after_s)
        signal.pthread_kill(main, _ROUSING)


def _do_nothing(_number: int, _frame: FrameType | None) -> None:
    """Be a handler: a signal that has none wakes nobody."""


def _at_each_signal(act: Callable[[], object]) -> None:
    """Let a thread call something whenever a signal to end comes, beside its handler.

    Python writes the signal's number into the socket before any handler runs.
    """
    import socket

    near, far = socket.socketpair()
    far.setblocking(False)
    signal.set_wakeup_fd(far.fileno(), warn_on_full_buffer=False)
    # It must live as long as the process: so the thread holds both ends.
    start_deaf_thread(_listen, near, far, act)


def _await_end(descriptor: int, act: Callable[[], object]) -> None:
    # Nothing is asked for: a poll tells of the other end's closing all the same.
    other_end = select.poll()
    other_end.register(descriptor, 0)
    if other_end.poll():
        act()


def _listen(near: socket.socket, _far: socket.socket, act: Callable[[], object]) -> None:
    while numbers := near.recv(16):
        if any(number in numbers for number in _SIGNALS):
            act()


def _code_of(main: Callable[[], int]) -> int:
    try:
        return main()
    except SystemExit as stop:
        if isinstance(stop.code, str):
            sys.stderr.write(f"{stop.code}\n")
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except KeyboardInterrupt:
        return 130
    except BaseException:  # noqa: BLE001 - told as Python tells it
        sys.excepthook(*sys.exc_info())
        return 1


def _watch(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_CHECK_PERIOD_S)
    signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGTERM)
