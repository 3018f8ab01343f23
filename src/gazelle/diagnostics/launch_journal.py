"""What launches have said of the user's files, kept for who looks later: Studio's page.

A command that launches begins a journal, a file of JSON lines in the user's folder of state, and
its processes inherit the file's path. What any of them prints of findings goes there, too: what was
told before a page was open, and by a launch that failed before there was a world. The journals
are also the list of the commands that were run last.
"""

from __future__ import annotations

import contextlib
import json
import os
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle.diagnostics.diagnostic import Diagnostic, Severity, SourceSpan
from gazelle.diagnostics.source_lines import Excerpt, SourceLines, excerpt
from gazelle.user_folders import lives, state_folder

__all__ = ["VARIABLE", "Journal", "Told", "begin", "end", "journals", "keep", "keep_error", "read"]

VARIABLE = "GAZELLE_LAUNCH_JOURNAL"
"""Environment variable with the path of the journal of the launch that a process belongs to."""

_FOLDER = "launches"
_SUFFIX = ".jsonl"
_MOST_JOURNALS = 40
_MOST_BYTES = 1 << 20
_MOST_FINDINGS = 500
_MOST_TEXT = 4000


@dataclass(frozen=True, slots=True)
class Told:
    """A finding as it was told.

    Attributes:
        item: the finding; its code is empty where an error has none.
        source: the line that it is about, as it was then.
    """

    item: Diagnostic
    source: Excerpt | None = None


@dataclass(frozen=True, slots=True)
class Journal:
    """What is known of a command that launched.

    Attributes:
        name: the journal's own.
        words: of the command line, without ``gazelle``.
        folder: in which it was run.
        port: of the graph; 0 where that is not known.
        started_s: when, in seconds since 1970.
        is_running: whether it still runs.
        code: the exit code; None while it runs, and where it was killed.
        told: what it said, in that order, each once.
    """

    name: str
    words: tuple[str, ...]
    folder: str
    port: int
    started_s: float
    is_running: bool
    code: int | None
    told: tuple[Told, ...]


def begin(words: Sequence[str], port: int) -> Path | None:
    """Begin the journal of this process and of what it starts.

    Args:
        words: of the command line, without ``gazelle``.
        port: of the graph.

    Returns:
        Its file; None where this process belongs to a launch, or no file can be written.
    """
    if os.environ.get(VARIABLE):
        return None
    now_s = time.time()
    first = {
        "words": list(words),
        "folder": str(Path.cwd()),
        "port": port,
        "pid": os.getpid(),
        "started_s": now_s,
    }
    try:
        folder = _folder()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        name = f"{int(now_s * 1e6):016d}-{os.getpid()}-{os.urandom(2).hex()}{_SUFFIX}"
        path = folder / name
        _append(path, {"launch": first}, is_new=True)
        for old in _files(folder)[_MOST_JOURNALS:]:
            old.unlink(missing_ok=True)
    except (OSError, RuntimeError):
        # Nobody's launch fails for that.
        return None
    os.environ[VARIABLE] = str(path)
    return path


def end(path: Path | None, code: int) -> None:
    """End the journal that `begin` gave, with an exit code."""
    if path is None:
        return
    os.environ.pop(VARIABLE, None)
    with contextlib.suppress(OSError):
        _append(path, {"ended": code})


def keep(found: Iterable[Diagnostic], lines: SourceLines) -> None:
    """Add findings to the journal of the launch that this process belongs to, if it has one."""
    named = os.environ.get(VARIABLE)
    if not named:
        return
    with contextlib.suppress(OSError):
        for item in found:
            shown = excerpt(item.span, lines) if item.span else None
            _append(Path(named), {"finding": _finding_value(item, shown)})


def keep_error(text: str) -> None:
    """Add an error that is no finding about a file, with its fix on lines of its own."""
    message, _, rest = text.partition("\n  fix: ")
    keep([Diagnostic("", Severity.ERROR, message.strip(), None, rest.strip())], SourceLines())


def journals() -> tuple[Path, ...]:
    """Return the files of all journals, the newest first."""
    try:
        return tuple(_files(_folder()))
    except (OSError, RuntimeError):
        return ()


def read(path: Path) -> Journal | None:
    """Read a journal; None where it is none, or has gone."""
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            text = file.read(_MOST_BYTES * 2)
    except OSError:
        return None
    values = list(_values(text))
    first = next((each["launch"] for each in values if "launch" in each), None)
    if not isinstance(first, dict):
        return None
    told = (_told(each["finding"]) for each in values if "finding" in each)
    ended = [each["ended"] for each in values if isinstance(each.get("ended"), int)]
    try:
        return Journal(
            name=path.name.removesuffix(_SUFFIX),
            words=tuple(map(str, first["words"])),
            folder=str(first["folder"]),
            port=int(first["port"]),
            started_s=float(first["started_s"]),
            is_running=not ended and lives(int(first["pid"])),
            code=ended[-1] if ended else None,
            told=tuple(dict.fromkeys(each for each in told if each is not None))[:_MOST_FINDINGS],
        )
    except (KeyError, TypeError, ValueError):
        return None


def _folder() -> Path:
    return state_folder() / _FOLDER


def _files(folder: Path) -> list[Path]:
    return sorted(folder.glob(f"*{_SUFFIX}"), reverse=True)


def _append(path: Path, value: Mapping[str, Any], *, is_new: bool = False) -> None:
    """Add a line, in one piece: several processes write."""
    mode = os.O_WRONLY | os.O_APPEND | (os.O_CREAT | os.O_EXCL if is_new else 0)
    number = os.open(path, mode, 0o600)
    try:
        if os.fstat(number).st_size < _MOST_BYTES:
            os.write(number, (json.dumps(value) + "\n").encode())
    finally:
        os.close(number)


def _values(text: str) -> Iterator[dict[str, Any]]:
    for line in text.splitlines():
        # The last one may be half there.
        with contextlib.suppress(ValueError):
            value = json.loads(line)
            if isinstance(value, dict):
                yield value


def _finding_value(item: Diagnostic, shown: Excerpt | None) -> dict[str, Any]:
    return {
        "code": item.code,
        "severity": item.severity.name,
        "message": item.message[:_MOST_TEXT],
        "fix": item.fix[:_MOST_TEXT],
        "phrase": item.phrase[:_MOST_TEXT],
        "span": _span_value(item.span) if item.span else None,
        "via": [_span_value(span) for span in (item.span.via if item.span else ())],
        "source": list(shown) if shown else None,
    }


def _span_value(span: SourceSpan) -> list[Any]:
    return [span.file, span.line, span.column, span.length]


def _span(value: Sequence[Any], via: tuple[SourceSpan, ...] = ()) -> SourceSpan:
    file, line, column, length = value
    return SourceSpan(str(file), int(line), int(column), int(length), via)


def _told(value: Mapping[str, Any]) -> Told | None:
    try:
        via = tuple(_span(one) for one in value["via"])
        span = _span(value["span"], via) if value["span"] else None
        severity = Severity[value["severity"]]
        texts = (str(value[name]) for name in ("fix", "phrase"))
        item = Diagnostic(str(value["code"]), severity, str(value["message"]), span, *texts)
        return Told(item, Excerpt(*value["source"]) if value["source"] else None)
    except (KeyError, TypeError, ValueError):
        return None
