"""launch_testing.asserts."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from typing import Any

from gazelle.launch.ros2.launch_testing.output_text import (
    build_text_match,
    remove_ansi_escape_sequences,
)
from gazelle.launch.ros2.launch_testing.proc_lookup import NO_CMD_ARGS, resolveProcesses

__all__ = [
    "EXIT_OK",
    "EXIT_SIGINT",
    "EXIT_SIGKILL",
    "EXIT_SIGQUIT",
    "EXIT_SIGSEGV",
    "NO_CMD_ARGS",
    "SequentialTextChecker",
    "assertDefaultStream",
    "assertExitCodes",
    "assertInStderr",
    "assertInStdout",
    "assertInStream",
    "assertSequentialStdout",
]

EXIT_OK = 0
EXIT_SIGINT = 130
EXIT_SIGQUIT = 131
EXIT_SIGKILL = 137
EXIT_SIGSEGV = 139
_NEARBY_LINES = 3


def assertExitCodes(
    proc_info: Any,
    allowable_exit_codes: Sequence[int] = (EXIT_OK,),
    process: Any = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None:
    """Check how processes ended; see `resolveProcesses` for which ones."""
    for code in allowable_exit_codes:
        assert isinstance(code, int), f"Provided exit code {code} is not an int"
    meant = resolveProcesses(
        proc_info, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    for event in [proc_info[action] for action in meant]:
        assert event.returncode in allowable_exit_codes, (
            f"Proc {event.process_name} exited with code {event.returncode}"
        )


def assertInStream(
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Any = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: str = "stderr",
) -> None:
    """Check that a process wrote something.

    Args:
        proc_output: knows the output of processes.
        expected_output: a text, a regular expression, or several in order.
        process: see `resolveProcesses`.
        cmd_args: see `resolveProcesses`.
        output_filter: changes the output before it is looked at.
        strict_proc_matching: see `resolveProcesses`.
        strip_ansi_escape_sequences: colours do not count.
        stream: ``stdout`` or ``stderr``.
    """
    meant = resolveProcesses(
        proc_output, process=process, cmd_args=cmd_args, strict_proc_matching=strict_proc_matching
    )
    if output_filter is not None and not callable(output_filter):
        raise ValueError("output_filter is not callable")
    if stream not in ("stdout", "stderr"):
        raise ValueError("Invalid value for stream; must be 'stdout' or 'stderr'")
    match = build_text_match(expected_output)
    for action in meant:
        events = [one for one in proc_output[action] if one.from_stdout == (stream == "stdout")]
        text = "".join(one.text.decode(errors="replace") for one in events)
        if strip_ansi_escape_sequences:
            text = remove_ansi_escape_sequences(text)
        if output_filter is not None:
            text = output_filter(text)
        if match(text) is not None:
            return
    names = ", ".join(sorted(action.process_details["name"] for action in meant))
    raise AssertionError(
        f"Did not find '{expected_output}' in output for any of the matching processes: {names}"
    )


def assertInStdout(
    proc_output: Any, expected_output: Any, process: Any, cmd_args: Any = None, **options: Any
) -> None:
    """Check that a process wrote something to standard output, see `assertInStream`."""
    assertInStream(proc_output, expected_output, process, cmd_args, stream="stdout", **options)


def assertInStderr(
    proc_output: Any, expected_output: Any, process: Any, cmd_args: Any = None, **options: Any
) -> None:
    """Check that a process wrote something to standard error, see `assertInStream`."""
    assertInStream(proc_output, expected_output, process, cmd_args, stream="stderr", **options)


def assertDefaultStream() -> str:
    """Return the stream that nodes log to."""
    return "stderr"


class SequentialTextChecker:
    """Checks that texts follow each other in pieces of output."""

    def __init__(self, output: Sequence[str]) -> None:
        self._text = "".join(output)
        self._at = 0

    def assertInText(self, msg: str) -> None:
        """Check that a text comes behind the one before."""
        self.assertInStdout(msg)

    def assertInStdout(self, msg: str) -> None:
        """Check that a text comes behind the one before."""
        found = self._text.find(msg, self._at)
        assert found >= 0, (
            f"'{msg}' not found in sequence after previous match.  "
            f"The output near the last matched line:\n{self.get_nearby_lines()}"
        )
        self._at = found + len(msg)

    def get_nearby_lines(self) -> str:
        """Return a few lines around the last text that was found."""
        lines = self._text.splitlines()
        line = self._text.count("\n", 0, self._at)
        return "\n".join(lines[max(0, line - _NEARBY_LINES) : line + _NEARBY_LINES])


@contextlib.contextmanager
def assertSequentialStdout(
    proc_output: Any, process: Any, cmd_args: Any = None
) -> Iterator[SequentialTextChecker]:
    """Give a checker of the order in which a process wrote texts."""
    (action,) = resolveProcesses(proc_output, process=process, cmd_args=cmd_args)
    yield SequentialTextChecker([one.text.decode() for one in proc_output[action]])
