"""One run of the official xacro library with our package look-up, parser and messages in it.

The library keeps its state in module variables, so there is one run at a time, and everything
replaced is put back at its end.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any

from gazelle.description.xacro.dom import Tracker, node_in, place_of
from gazelle.diagnostics import SourceSpan
from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace
from gazelle.workspace.installed import installed_source

__all__ = ["Session", "causes_of", "run_session"]

_LOCK = threading.RLock()


@dataclass
class Session:
    """What a run collects besides its result.

    Attributes:
        tracker: places of elements, and the calls being worked on.
        printed: lines that the library and ``xacro.message`` would have printed, with the
            place that was being worked on.
        left_out: the missing packages of includes that were left out, with the includes' places.
    """

    tracker: Tracker = field(default_factory=Tracker)
    printed: list[tuple[str, SourceSpan | None]] = field(default_factory=list)
    left_out: list[tuple[NotFoundError, SourceSpan | None]] = field(default_factory=list)


@contextmanager
def run_session(workspace: Workspace | None, root_dir: str) -> Iterator[tuple[ModuleType, Session]]:
    """Lend the library, prepared for one run, and the session that listens to it.

    Args:
        workspace: finds packages for ``$(find)``; None finds none.
        root_dir: folder that relative paths and ``$(cwd)`` mean.
    """
    import xacro
    from xacro import color, substitution_args

    session = Session()
    find = _finder(workspace)
    table: Any = substitution_args._eval_dict
    with _LOCK:
        changes = _replacements(xacro, session, root_dir)
        changes += [(color, "print", _printer(session)), (color, "is_tty", lambda _stream: False)]
        changes += [(substitution_args, "_eval_find", find)]
        with _swapped(changes), _swapped_item(table, "find", find), _deeper_recursion():
            yield xacro, session


def _replacements(library: Any, session: Session, root_dir: str) -> list[tuple[Any, str, Any]]:
    tracker = session.tracker
    return [
        (library, "parse", _parser(library, tracker)),
        (library, "handle_macro_call", _tracked(library.handle_macro_call, tracker)),
        (library, "process_include", _tracked(library.process_include, tracker)),
        (library, "get_include_files", _lenient(library.get_include_files, session)),
        (library, "abs_filename_spec", _found_source(library.abs_filename_spec)),
        (library, "print", _printer(session)),
        (library, "root_dir", root_dir or "."),
        (library, "verbosity", 1),
        (library, "all_includes", []),
    ]


@contextmanager
def _swapped(changes: list[tuple[Any, str, Any]]) -> Iterator[None]:
    missing = object()
    before = [(owner, name, getattr(owner, name, missing)) for owner, name, _ in changes]
    for owner, name, value in changes:
        setattr(owner, name, value)
    try:
        yield
    finally:
        for owner, name, value in before:
            if value is missing:
                delattr(owner, name)
            else:
                setattr(owner, name, value)


@contextmanager
def _swapped_item(table: Any, key: str, value: Any) -> Iterator[None]:
    before = table[key]
    table[key] = value
    try:
        yield
    finally:
        table[key] = before


@contextmanager
def _deeper_recursion() -> Iterator[None]:
    """Make up for our frames between those of the library: macros may nest as deep as there."""
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(before * 2)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


def _finder(workspace: Workspace | None) -> Callable[[str], str]:
    def find(name: str) -> str:
        if workspace is None:
            raise LookupError(f"package '{name}' not found: there is no workspace to look in")
        return str(workspace.package(name).path)

    return find


def _parser(library: Any, tracker: Tracker) -> Callable[..., Any]:
    def parse(inp: Any, filename: str | None = None) -> Any:
        if inp is not None:
            return tracker.parse_text(inp, filename or "<xacro>") if isinstance(inp, str) else inp
        path = Path(library.root_dir, str(filename))
        try:
            stream = path.open("rb")
        except OSError as error:
            # As the library does: the missing file is not "the file being worked on".
            library.filestack.pop()
            raise library.XacroException(f"{error.strerror}: {path}", exc=error) from error
        with stream:
            return tracker.parse_file(stream, str(filename))

    return parse


def _tracked(function: Callable[..., Any], tracker: Tracker) -> Callable[..., Any]:
    """Keep a call's place on the tracker's stack while it runs; after an error it stays there."""

    def call(element: Any, *rest: Any) -> Any:
        place = place_of(element)
        if place is None:
            return function(element, *rest)
        # Without its own way there: the stack below holds that already.
        tracker.calls.append(replace(place, via=()))
        result = function(element, *rest)
        tracker.calls.pop()
        return result

    return call


def _found_source(function: Callable[[str], str]) -> Callable[[str], str]:
    """Find files of source packages where they lie before they are installed."""

    def absolute(filename: str) -> str:
        path = Path(function(filename))
        source = None if path.exists() else installed_source(path.absolute())
        return str(path if source is None else source)

    return absolute


def _lenient(function: Callable[..., Any], session: Session) -> Callable[..., Any]:
    """Leave out includes of files in packages that are not there.

    Robots include the macros of every sensor they can carry and use those that an argument
    asks for. A name that stays undefined because of it is an error where it is used.
    """

    def files(filename: str, symbols: Any) -> list[str]:
        try:
            return list(function(filename, symbols))
        except Exception as error:
            missing = next(
                (item for item in causes_of(error) if isinstance(item, NotFoundError)), None
            )
            if missing is None:
                raise
            calls = session.tracker.via()
            place = replace(calls[0], via=calls[1:]) if calls else None
            session.left_out.append((missing, place))
            return []

    return files


def causes_of(error: BaseException) -> Iterator[BaseException]:
    """Yield an error and what it wraps, outermost first."""
    seen: set[int] = set()
    queue: list[Any] = [error]
    while queue:
        item = queue.pop(0)
        if isinstance(item, BaseException) and id(item) not in seen:
            seen.add(id(item))
            yield item
            queue += [getattr(item, "exc", None), item.__cause__, item.__context__]


def _printer(session: Session) -> Callable[..., None]:
    def print_(*words: Any, **_options: Any) -> None:
        line = " ".join(str(word) for word in words)
        session.printed.append((line, _place_below(sys._getframe(1))))

    return print_


def _place_below(frame: FrameType | None) -> SourceSpan | None:
    """Return the place of the node that the nearest caller works on."""
    while frame is not None:
        node = node_in(frame)
        if node is not None:
            return place_of(node)
        frame = frame.f_back
    return None
