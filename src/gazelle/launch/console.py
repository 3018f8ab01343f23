"""roslaunch's own lines on the terminal: colours where it is one, plain text elsewhere."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from datetime import datetime
from typing import Any, TextIO

from gazelle.documents.yaml import dump_yaml
from gazelle.launch.config import LaunchConfig
from gazelle.log_files import LogStream
from gazelle.parameters.trees import leaves_at
from gazelle.process_exit import drop_output, when_nobody_reads

__all__ = ["Console", "dump_text", "summary"]

_BOLD, _RED, _YELLOW, _RESET = "\x1b[1m", "\x1b[31m", "\x1b[33m", "\x1b[0m"
_MAX_VALUE = 20


class Console:
    """Writes lines as roslaunch does, to the terminal and to a log file."""

    def __init__(self, stream: TextIO | None = None) -> None:
        self._stream = stream or sys.stdout
        self._coloured = self._stream.isatty()
        self._log: LogStream | None = None
        self._is_read = True

    def when_nobody_reads(self, act: Callable[[], object]) -> None:
        """Call something, in any thread, when the terminal's lines have lost their reader."""
        if self._is_read:
            when_nobody_reads(self._stream, act)
        else:
            act()

    def keep(self, log: LogStream | None) -> None:
        """Write every line to an open file too, from now on; None ends that."""
        self._log = log

    def plain(self, text: str) -> None:
        """Write a line."""
        self._write(text, "")

    def bold(self, text: str) -> None:
        """Write a line that stands out."""
        self._write(text, _BOLD)

    def error(self, text: str) -> None:
        """Write a line about a failure."""
        self._write(text, _RED, "ERROR")

    def warning(self, text: str) -> None:
        """Write a line about something to look at."""
        self._write(text, _YELLOW, "WARNING")

    def _write(self, text: str, colour: str, level: str = "INFO") -> None:
        if self._log is not None:
            # The format of the original's log files.
            time_text = datetime.now().strftime("%Y-%m-%d %H:%M:%S,%f")[:-3]
            self._log.write(f"[roslaunch][{level}] {time_text}: {text}\n")
        shown = f"{colour}{text}{_RESET}" if colour and self._coloured else text
        try:
            self._stream.write(shown + "\n")
            self._stream.flush()
        except BrokenPipeError:
            self._is_read = False
            drop_output(self._stream)


def summary(config: LaunchConfig, params: Mapping[str, Any]) -> str:
    """Return the SUMMARY block: parameters with shortened values, nodes by namespace."""
    lines = ["", "SUMMARY", "========", "", "PARAMETERS"]
    lines += [f" * {name}: {_short(value)}" for name, value in sorted(params.items())]
    lines += ["", "NODES"]
    by_namespace: dict[str, list[str]] = {}
    for node in config.nodes:
        text = f"    {node.name} ({node.package}/{node.type})"
        by_namespace.setdefault(node.namespace, []).append(text)
    for namespace in sorted(by_namespace):
        lines += [f"  {namespace}", *sorted(by_namespace[namespace])]
    return "\n".join([*lines, ""])


def _short(value: Any) -> str:
    text = str(value)
    if len(text) > _MAX_VALUE:
        text = text[: _MAX_VALUE - 3] + "..."
    return text.replace("\n", " ")


def dump_text(config: LaunchConfig) -> str:
    """Return what ``roslaunch --dump-params`` prints."""
    leaves: dict[str, Any] = {}
    for name, value in config.params.items():
        leaves.update(leaves_at(name, value))
    return dump_yaml(leaves)
