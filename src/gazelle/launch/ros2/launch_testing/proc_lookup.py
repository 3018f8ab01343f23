"""launch_testing.util: which process a test means."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from gazelle.launch.ros2.actions import ExecuteLocal, ExecuteProcess

__all__ = ["NO_CMD_ARGS", "KeepAliveProc", "NoMatchingProcessException", "resolveProcesses"]

NO_CMD_ARGS: Any = object()
_SLEEP = """
import threading
try:
    threading.Event().wait()
except KeyboardInterrupt:
    pass
"""


class NoMatchingProcessException(Exception):  # noqa: N818 - the name users catch
    """No process of a launch is the one that is meant."""


def KeepAliveProc() -> ExecuteProcess:
    """Return a process that does nothing until it is ended."""
    return ExecuteProcess(cmd=[sys.executable, "-c", _SLEEP])


def resolveProcesses(
    info_obj: Any,
    *,
    process: Any = None,
    cmd_args: Any = None,
    strict_proc_matching: bool = True,
) -> list[Any]:
    """Return the processes that are meant.

    Args:
        info_obj: knows the launch's processes.
        process: an action, a part of a name, or None for all.
        cmd_args: a word or words of the command, or `NO_CMD_ARGS`, with a name.
        strict_proc_matching: several are an error.

    Raises:
        NoMatchingProcessException: there is none.
        Exception: there are several.
        TypeError: `process` is something else.
    """
    known = list(info_obj.processes())
    if process is None:
        if not known:
            raise NoMatchingProcessException("No data recorded for any process")
        return known
    if isinstance(process, ExecuteLocal):
        if process not in known:
            raise NoMatchingProcessException(f"No data recorded for proc {_described(process)}")
        return [process]
    if not isinstance(process, str):
        raise TypeError(f"proc argument must be 'ExecuteProcess' or 'str' not {type(process)}")
    words = [cmd_args] if isinstance(cmd_args, str) else cmd_args
    found = [one for one in known if _is_meant(one, process, words)]
    names = ", ".join(sorted(_described(one) for one in known))
    if not found:
        raise NoMatchingProcessException(
            f"Did not find any processes matching name '{process}' and args '{cmd_args}'. "
            f"Procs: {names}"
        )
    if strict_proc_matching and len(found) > 1:
        raise Exception(
            f"Found multiple processes matching name '{process}' and cmd_args '{cmd_args}'. "
            f"Procs: {names}"
        )
    return found


def _is_meant(action: Any, name: str, words: Sequence[str] | None) -> bool:
    details = action.process_details
    if name not in details["name"]:
        return False
    if words is None:
        return True
    if words is NO_CMD_ARGS:
        return len(details["cmd"]) == 1
    return all(word in details["cmd"][1:] for word in words)


def _described(action: Any) -> str:
    details = action.process_details
    if details is None:
        return "Unknown - Process not launched yet"
    return " ".join([details["name"], *details["cmd"][1:]])
