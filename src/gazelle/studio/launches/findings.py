"""``launch.findings``: what is wrong in the launches of this graph, as their journals have it."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import TypedDict

from gazelle.diagnostics.catalogue import Entry, all_entries
from gazelle.diagnostics.documentation import entry_address, pages_address
from gazelle.diagnostics.launch_journal import Journal, Told, journals, read
from gazelle.diagnostics.source_lines import Excerpt
from gazelle.studio.request_params import Params
from gazelle.studio.streams import Channel, OpenStream, every

__all__ = [
    "FoundIn",
    "LaunchFinding",
    "LaunchValue",
    "SourceLine",
    "command_line",
    "finding_values",
    "launch_value",
    "open_findings",
]

_LOOK_S = 0.7
# Older ones than these have long ended.
_MOST_READ = 12


class SourceLine(TypedDict):
    """A line of a user's file.

    Attributes:
        line: its number.
        column: where the caret stands in the text, from 1; 0 for none.
        width: characters under the caret.
    """

    line: int
    text: str
    column: int
    width: int


class LaunchFinding(TypedDict):
    """A finding about a user's file.

    Attributes:
        code: empty where an error has none.
        title: of the code.
        why: why that matters.
        fix: what to write instead.
        phrase: what ROS or Gazebo says in this case.
        place: file, line and column.
        via: the way there, innermost first.
        source: the line; null where it cannot be read.
        link: to the code's entry in the documentation; empty for none.
    """

    code: str
    severity: str
    title: str
    message: str
    why: str
    fix: str
    phrase: str
    place: str
    via: list[str]
    source: SourceLine | None
    link: str


class LaunchValue(TypedDict):
    """A command that launched.

    Attributes:
        command: as it is typed.
        folder: in which.
        code: the exit code; null while it runs, and where it was killed.
    """

    name: str
    command: str
    folder: str
    started_s: float
    is_running: bool
    code: int | None
    findings: list[LaunchFinding]


class FoundIn(TypedDict):
    """The launches of a graph, the newest first: those that run, and the last one."""

    launches: list[LaunchValue]


class _Look:
    """The journals of a graph, read again when they have grown."""

    def __init__(self, channel: Channel, port: int) -> None:
        self._channel = channel
        self._port = port
        self._seen: object = None

    def again(self) -> None:
        files = journals()[:_MOST_READ]
        sizes = tuple((path, _size(path)) for path in files)
        found = [journal for path in files if (journal := read(path)) is not None]
        shown = _shown(found, self._port)
        seen = sizes, tuple((each.name, each.is_running) for each in shown)
        if seen != self._seen:
            self._seen = seen
            self._channel.offer(lambda: FoundIn(launches=[launch_value(each) for each in shown]))


def open_findings(port: int, channel: Channel, params: Params) -> OpenStream:
    """Tell what the launches of a graph have found, and again when that has changed."""
    look = _Look(channel, port)
    every(channel, _LOOK_S, lambda: channel.work(look.again))
    return OpenStream(lambda: None)


def command_line(journal: Journal) -> str:
    """Return a command as it works in every shell, also where ROS's names are not set up."""
    return shlex.join(("gazelle", *journal.words))


def launch_value(journal: Journal) -> LaunchValue:
    """Return a launch as the page has it."""
    return {
        "name": journal.name,
        "command": command_line(journal),
        "folder": _at_home(journal.folder),
        "started_s": journal.started_s,
        "is_running": journal.is_running,
        "code": journal.code,
        "findings": finding_values(journal.told),
    }


def finding_values(told: Iterable[Told]) -> list[LaunchFinding]:
    """Return findings as the page has them, the worst first."""
    pages = pages_address()
    ordered = sorted(told, key=lambda each: -each.item.severity)
    return [_finding_value(each, pages) for each in ordered]


def _shown(found: list[Journal], port: int) -> list[Journal]:
    of_graph = [each for each in found if each.port == port]
    return [each for index, each in enumerate(of_graph) if each.is_running or index == 0]


def _finding_value(told: Told, pages: str) -> LaunchFinding:
    item, source = told.item, told.source
    entry: Entry | None = all_entries().get(item.code)
    return {
        "code": item.code,
        "severity": str(item.severity),
        "title": entry.title if entry else "",
        "message": item.message,
        "why": entry.why if entry else "",
        "fix": "" if item.fix == "see the message" else item.fix,
        "phrase": item.phrase,
        "place": _at_home(str(item.span)) if item.span else "",
        "via": [_at_home(str(span)) for span in (item.span.via if item.span else ())],
        "source": _source_line(source) if source else None,
        "link": entry_address(entry, pages) if entry else "",
    }


def _source_line(source: Excerpt) -> SourceLine:
    return {
        "line": source.line,
        "text": source.text,
        "column": source.column,
        "width": source.width,
    }


def _at_home(path: str) -> str:
    with suppress(RuntimeError):
        home = f"{Path.home()}{os.sep}"
        if len(home) > len("//") and path.startswith(home):
            return f"~{os.sep}{path[len(home) :]}"
    return path


def _size(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return -1
