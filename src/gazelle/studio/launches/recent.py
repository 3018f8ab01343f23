"""``launch.recent``: the commands that launched something last, of every graph."""

from __future__ import annotations

import shlex
from typing import TypedDict

from gazelle.diagnostics import Severity
from gazelle.diagnostics.launch_journal import journals, read
from gazelle.studio.launches.findings import command_line, launch_value
from gazelle.studio.request_params import Params

__all__ = ["RecentLaunch", "recent_launches"]

_MOST = 8


class RecentLaunch(TypedDict):
    """A command that launched.

    Attributes:
        copied: the command with the change to its folder, for a terminal.
        demo: the demo that it starts, empty for none.
        errors: how many it told of.
        code: the exit code; null while it runs, and where it was killed.
    """

    name: str
    command: str
    copied: str
    folder: str
    started_s: float
    is_running: bool
    code: int | None
    errors: int
    demo: str


def recent_launches(params: Params) -> list[RecentLaunch]:
    """``launch.recent``: each command once, the newest first."""
    found: dict[tuple[str, str], RecentLaunch] = {}
    for path in journals():
        journal = read(path)
        if journal is None:
            continue
        command = command_line(journal)
        value = launch_value(journal)
        errors = sum(told.item.severity is Severity.ERROR for told in journal.told)
        found.setdefault(
            (command, journal.folder),
            {
                "name": journal.name,
                "command": command,
                "copied": f"cd {shlex.quote(journal.folder)} && {command}",
                "folder": value["folder"],
                "started_s": journal.started_s,
                "is_running": journal.is_running,
                "code": journal.code,
                "errors": errors,
                "demo": _demo(journal.words),
            },
        )
        if len(found) >= _MOST:
            break
    return list(found.values())


def _demo(words: tuple[str, ...]) -> str:
    """Return the name of a demo that is started without more; nothing else is started anew."""
    return words[1] if len(words) == 2 and words[0] == "demo" else ""
