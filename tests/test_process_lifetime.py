"""How a process ends."""

from __future__ import annotations

import signal
import subprocess
import sys
from contextlib import nullcontext
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.process_lifetime import interrupts_held

_POSIX = pytest.mark.skipif(
    not hasattr(signal, "pthread_sigmask"), reason="needs POSIX signal masks"
)
_HEAD = "import atexit, sys, threading, time\nfrom gazelle.process_lifetime import end_with\n"


@pytest.mark.parametrize(
    ("body", "code", "error"),
    [
        ("return 3", 3, ""),
        ("sys.exit(4)", 4, ""),
        ("sys.exit()", 0, ""),
        ("sys.exit('no such thing')", 1, "no such thing\n"),
        ("raise KeyboardInterrupt", 130, ""),
        ("raise RuntimeError('broken')", 1, "RuntimeError: broken\n"),
    ],
)
def test_code_and_words_are_those_python_ends_with(body: str, code: int, error: str) -> None:
    done = _run(f"def main():\n    print('out')\n    {body}\nend_with(main)\n")
    assert (done.returncode, done.stdout) == (code, "out\n")
    assert done.stderr.endswith(error)
    assert error or not done.stderr


def test_threads_and_exit_functions_finish_first() -> None:
    text = """
go = threading.Event()
def work():
    go.wait(30)
    print("worked", flush=True)
def main():
    threading.Thread(target=work).start()
    threading.Thread(target=threading.Event().wait, daemon=True).start()
    atexit.register(print, "left")
    go.set()
    return 0
end_with(main)
"""
    done = _run(text)
    assert (done.returncode, done.stdout, done.stderr) == (0, "worked\nleft\n", "")


def test_idle_pools_do_not_hold_the_process_up() -> None:
    text = """
from concurrent.futures import ThreadPoolExecutor
pool = ThreadPoolExecutor()
def main():
    return pool.submit(lambda: 5).result()
end_with(main)
"""
    done = _run(text)
    assert (done.returncode, done.stderr) == (5, "")


def test_reader_that_has_gone_is_no_error() -> None:
    text = "def main():\n    sys.stdout.close()\n    return 0\nend_with(main)\n"
    done = _run(text)
    assert (done.returncode, done.stderr) == (0, "")


def _run(text: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", _HEAD + text],
        capture_output=True,
        text=True,
        timeout=stretched(),
        check=False,
    )


@_POSIX
def test_stop_signal_is_heard_while_the_main_thread_cannot_hear_it() -> None:
    """As when the kernel hands it to a thread of the transport, which Python's handlers await."""
    text = """
import signal, threading, time
from gazelle.process_lifetime import at_stop_signal
threading.Thread(target=time.sleep, args=(30,), daemon=True).start()
stop = threading.Event()
at_stop_signal(stop.set)
signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
print("ready", flush=True)
print("heard" if stop.wait(20) else "slept on", flush=True)
"""
    with subprocess.Popen(
        [sys.executable, "-c", text], stdout=subprocess.PIPE, text=True
    ) as program:
        assert program.stdout is not None
        assert program.stdout.readline() == "ready\n"
        program.send_signal(signal.SIGTERM)
        assert program.stdout.readline() == "heard\n"


@_POSIX
def test_a_signal_is_heard_while_the_main_thread_holds_what_its_handler_needs() -> None:
    """As when a second one comes in the midst of ``Event.set``, which waited for itself."""
    text = """
import os, signal, threading
from gazelle.process_lifetime import at_stop_signal
lock, heard = threading.Lock(), threading.Event()
def stop():
    with lock:
        heard.set()
at_stop_signal(stop)
with lock:
    for _ in range(3):
        os.kill(os.getpid(), signal.SIGINT)
print(heard.wait(60))
"""
    program = [sys.executable, "-c", text]
    ended = subprocess.run(
        program, check=False, capture_output=True, text=True, timeout=stretched()
    )
    assert (ended.stdout, ended.stderr) == ("True\n", "")


def _interrupted(
    text: str, line: str, *, held: bool = False, folder: str | None = None
) -> tuple[int, str, str]:
    """Run a program, send SIGINT when it has written a line, let it read one; how it ended."""
    with interrupts_held() if held else nullcontext():
        program = subprocess.Popen(
            [sys.executable, "-c", text],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            cwd=folder,
        )
    with program:
        assert program.stdout is not None
        assert program.stdout.readline() == f"{line}\n"
        program.send_signal(signal.SIGINT)
        out, err = program.communicate("\n", timeout=stretched())
    return program.returncode, out, err


@_POSIX
def test_a_held_interrupt_ends_the_process_when_it_comes_to_itself() -> None:
    text = """
import sys
print("loading", flush=True)
sys.stdin.readline()
print("loaded", flush=True)
from gazelle.process_lifetime import end_at_interrupts
end_at_interrupts()
print("lived on", flush=True)
"""
    ended = _interrupted(text, "loading", held=True)
    assert ended == (-signal.SIGINT, "loaded\n", "")


@_POSIX
def test_an_interrupt_in_the_midst_of_an_import_says_nothing(tmp_path: Path) -> None:
    body = "import sys\nprint('importing', flush=True)\nsys.stdin.readline()\nsys.stdin.readline()"
    (tmp_path / "slow_one.py").write_text(body, encoding="utf-8")
    text = "from gazelle.process_lifetime import raise_interrupts\nraise_interrupts()\n"
    text += "import slow_one\n"
    ended = _interrupted(text, "importing", folder=str(tmp_path))
    assert ended == (-signal.SIGINT, "", "")


@_POSIX
def test_an_interrupt_in_a_librarys_callback_comes_again_when_that_is_done() -> None:
    text = """
import contextlib, sys, threading
from gazelle.process_lifetime import called_by_library, raise_interrupts
raise_interrupts()

@called_by_library
def callback():
    print("running", flush=True)
    sys.stdin.readline()

try:
    # As the transport does: what a callback raises is printed, and goes no further.
    with contextlib.suppress(BaseException):
        callback()
    threading.Event().wait(60)
except KeyboardInterrupt:
    print("caught", flush=True)
"""
    assert _interrupted(text, "running") == (0, "caught\n", "")


@_POSIX
def test_an_interrupt_elsewhere_is_the_programs_to_catch() -> None:
    text = """
import threading
from gazelle.process_lifetime import raise_interrupts
raise_interrupts()
try:
    print("running", flush=True)
    threading.Event().wait(60)
except KeyboardInterrupt:
    print("caught", flush=True)
"""
    assert _interrupted(text, "running") == (0, "caught\n", "")


_STOPPED = """
import threading
from gazelle.process_lifetime import StopEvent, at_stop_signal, end_with
def main():
    stop = StopEvent(patience_s=0.1)
    at_stop_signal(stop.request)
    {look}
    print("begun", flush=True)
    {wait}
    print("undone", flush=True)
    return 3
end_with(main)
"""


@_POSIX
@pytest.mark.parametrize(
    ("look", "wait", "expected"),
    [
        # It still loads, in the midst of a call that hears of nothing.
        ("pass", "threading.Event().wait(60)", (0, "", "")),
        ("stop.is_set()", "stop.wait(60)", (3, "undone\n", "")),
        # It has looked, and now is busy with something that takes too long.
        ("stop.is_set()", "threading.Event().wait(60)", (0, "", "")),
    ],
    ids=["loading", "listening", "busy"],
)
def test_a_program_told_to_stop_ends(look: str, wait: str, expected: tuple[int, str, str]) -> None:
    assert _interrupted(_STOPPED.format(look=look, wait=wait), "begun") == expected


@_POSIX
def test_a_second_interrupt_ends_a_process_that_ends() -> None:
    text = """
import atexit, threading
from gazelle.process_lifetime import end_with
def last():
    print("ending", flush=True)
    threading.Event().wait(60)
def main():
    atexit.register(last)
    return 0
end_with(main)
"""
    assert _interrupted(text, "ending") == (-signal.SIGINT, "", "")


@_POSIX
def test_interrupt_that_another_thread_was_given_ends_a_wait_without_a_limit() -> None:
    """As one that comes just as the main thread begins to wait."""
    text = """
import signal
from gazelle.process_lifetime import raise_interrupts
def interrupt():
    main = threading.main_thread().ident
    while sys._current_frames()[main].f_code.co_name != "wait":
        pass
    # Nothing tells when it has left Python to sleep; sooner it would have seen the signal.
    time.sleep(0.1)
    signal.pthread_kill(threading.get_ident(), signal.SIGINT)
def main():
    raise_interrupts()
    threading.Thread(target=interrupt, daemon=True).start()
    threading.Event().wait()
end_with(main)
"""
    done = _run(text)
    assert (done.returncode, done.stderr) == (130, "")
