"""How a program of C++ lives and ends in a process that Python has started."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from tests.conftest import Launched
from tests.cpp.core.conftest import Probe

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="nodes of C++ run on Linux for now")


def test_the_exit_code_is_what_main_returns_and_destructors_run_in_order(probe: Probe) -> None:
    running = probe("code")
    assert running.wait() == 7
    assert _said(running) == ["destroyed local", "destroyed global"]


def test_exit_in_any_thread_ends_the_process_with_what_it_registered(probe: Probe) -> None:
    running = probe("exit")
    assert running.wait() == 5
    assert _said(running) == ["at exit", "destroyed global"]


def test_a_crash_names_signal_function_file_and_line_and_ends_by_the_signal(probe: Probe) -> None:
    running = probe("crash")
    assert running.wait() == -signal.SIGSEGV
    assert "SIGSEGV" in running.text
    assert "fall" in running.text
    assert "core_probe.cpp:" in running.text


def test_a_stack_that_runs_over_is_told_as_well(probe: Probe) -> None:
    running = probe("overflow")
    assert running.wait() == -signal.SIGSEGV
    assert "deeper" in running.text


def test_abort_and_uncaught_exceptions_end_by_sigabrt_with_nothing_unwound(probe: Probe) -> None:
    for word in ("abort", "throw"):
        running = probe(word)
        assert running.wait() == -signal.SIGABRT
        assert "destroyed" not in running.text
        assert "core_probe.cpp:" in running.text
    assert "nobody catches this" in running.text


def test_arguments_come_as_to_any_program(probe: Probe, probe_file: object) -> None:
    running = probe("arguments", "two words", "x:=y")
    assert running.wait() == 0
    assert _said(running)[:4] == [str(probe_file), "arguments", "two words", "x:=y"]


def test_standard_input_is_the_programs_own(probe: Probe) -> None:
    running = probe("read", stdin=subprocess.PIPE)
    assert running.popen.stdin is not None
    running.popen.stdin.write("first\n")
    running.popen.stdin.flush()
    running.wait_for_line("read 6 first")
    running.popen.stdin.write("second\n")
    running.popen.stdin.close()
    assert running.wait() == 0
    assert "cin second" in running.lines


def test_a_program_that_asks_for_no_signals_ends_by_them(probe: Probe) -> None:
    running = probe("wait")
    running.wait_for_line("waiting")
    assert running.stop(signal.SIGINT) == -signal.SIGINT


def test_a_handler_of_the_programs_own_counts(probe: Probe) -> None:
    running = probe("own-handler")
    running.wait_for_line("waiting")
    assert running.stop(signal.SIGINT) == 9
    assert "own handler" in running.lines


def test_a_file_that_cannot_be_loaded_is_named(tmp_path: Path) -> None:
    file = tmp_path / "broken"
    file.write_bytes(b"\x7fELF, but no more")
    outcome = subprocess.run(
        [sys.executable, "-m", "gazelle.cpp.host", str(file)],
        check=False,
        capture_output=True,
        text=True,
    )
    assert outcome.returncode == 127
    assert "[cpp.not-loaded]" in outcome.stderr


def _said(running: Launched) -> list[str]:
    """What the program said, without what Gazelle says of compiling its libraries."""
    return [line for line in running.lines if not line.startswith("gazelle:")]
