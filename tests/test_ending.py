"""How a process ends."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

_HEAD = "import atexit, sys, threading, time\nfrom gazelle.ending import end_with\n"


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
        timeout=30,
        check=False,
    )


@pytest.mark.skipif(not hasattr(signal, "pthread_sigmask"), reason="needs POSIX signal masks")
def test_stop_signal_is_heard_while_the_main_thread_cannot_hear_it() -> None:
    """As when the kernel hands it to a thread of the transport, which Python's handlers await."""
    text = """
import signal, threading
from gazelle.ending import at_stop_signal
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
