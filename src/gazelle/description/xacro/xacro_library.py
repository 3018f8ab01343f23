"""One run of the official xacro library with our package look-up, parser and messages in it.

The library keeps its state in module variables, so there is one run at a time, and everything
replaced is put back at its end.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from types import CodeType, FrameType, ModuleType
from typing import Any

from gazelle.description.xacro.dom import Tracker, node_in, span_of
from gazelle.description.xacro.error_recovery import UNKNOWN, UNKNOWN_NAME, RerunPatches
from gazelle.description.xacro.expansion_limits import ExpansionBudget, ExpansionLimitError
from gazelle.description.xacro.unprefixed_tags import (
    add_prefixes,
    takes_unprefixed,
    with_old_calls,
)
from gazelle.description.xml.reader import too_much_in
from gazelle.diagnostics import SourceSpan
from gazelle.documents import TEXT_BYTES, compile_limited, names_in_code, read_limited
from gazelle.documents.files import exists
from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace
from gazelle.workspace.installed_files import installed_source

__all__ = ["Console", "LibraryRun", "causes_of", "run_library"]

_LOCK = threading.RLock()
Console = Callable[[str], None]
"""Takes what the official program prints to standard error, piece by piece."""


class RequestedFiles(dict[str, str]):
    """Values of arguments that note which names the files ask for."""

    def __init__(self, values: dict[str, str]) -> None:
        super().__init__(values)
        self.names: set[object] = set()

    def __getitem__(self, name: str) -> str:
        self.names.add(name)
        return super().__getitem__(name)

    def __contains__(self, name: object) -> bool:
        self.names.add(name)
        return super().__contains__(name)


@dataclass
class LibraryRun:
    """What a run collects besides its result.

    Attributes:
        tracker: places of elements, and the calls being worked on.
        arguments: values given to ``<xacro:arg>``.
        printed: lines that the library and ``xacro.message`` would have printed, with the
            place that was being worked on.
        left_out: the missing packages of includes that were left out, with the includes' places.
        properties: last place of each property by name, and by name and text of its value.
        macros: last place of each macro by name.
        addresses: what ``xmlns:xacro`` is in the root elements, with their places.
        budget: what the run has used up.
        unprefixed: xacro's tags without the prefix that were taken, with their places; None where
            they are not.
    """

    tracker: Tracker
    arguments: RequestedFiles
    printed: list[tuple[str, SourceSpan | None]] = field(default_factory=list)
    left_out: list[tuple[NotFoundError, SourceSpan | None]] = field(default_factory=list)
    properties: dict[str | tuple[str, str], SourceSpan] = field(default_factory=dict)
    macros: dict[str, SourceSpan] = field(default_factory=dict)
    addresses: dict[str, SourceSpan] = field(default_factory=dict)
    budget: ExpansionBudget = field(default_factory=ExpansionBudget)
    unprefixed: list[tuple[str, SourceSpan | None]] | None = None


@contextmanager
def run_library(
    workspace: Workspace | None,
    *,
    arguments: dict[str, str],
    root_dir: str = "",
    verbosity: int = 1,
    console: Console | None = None,
    patches: RerunPatches | None = None,
) -> Iterator[tuple[ModuleType, LibraryRun]]:
    """Lend the library, prepared for one run, and the session that listens to it.

    Args:
        workspace: finds packages for ``$(find)``; None finds none.
        arguments: values of ``<xacro:arg>``.
        root_dir: folder that relative paths and ``$(cwd)`` mean, the current one when empty.
        verbosity: 0 to 4, as the program's ``--verbosity``.
        console: receives what the library prints, in colour where standard error is a terminal.
        patches: what is taken out of the files.
    """
    import xacro
    from xacro import color, substitution_args

    patches = patches or RerunPatches()
    library_run = LibraryRun(Tracker(patches), RequestedFiles(arguments))
    library_run.unprefixed = [] if takes_unprefixed(os.environ) else None
    find = _finder(workspace)
    table: Any = substitution_args._eval_dict
    with _LOCK:
        changes = _replacements(xacro, library_run, root_dir, verbosity)
        print_ = _printer(library_run, console)
        changes += [(xacro, "print", print_), (color, "print", print_)]
        changes += [(substitution_args, "_eval_find", find)]
        changes += [(substitution_args, "eval", library_run.budget.eval)]
        if console is None:
            changes.append((color, "is_tty", lambda _stream: False))
        symbols: Any = xacro._global_symbols
        unknown = dict.fromkeys([UNKNOWN_NAME, *patches.names], UNKNOWN)
        finding = _swapped_items(table, {"find": find})
        naming = _swapped_items(symbols, unknown)
        with _swapped(changes), finding, naming, _deeper_recursion():
            yield xacro, library_run


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


def _replacements(
    library: Any, library_run: LibraryRun, root_dir: str, verbosity: int
) -> list[tuple[Any, str, Any]]:
    tracker, budget = library_run.tracker, library_run.budget
    tracker.on_copy = budget.copied
    return [
        (library, "parse", _parser(library, library_run)),
        (library, "safe_eval", _remembering_evaluator(library, budget)),
        (library, "eval_text", budget.texts(library.eval_text)),
        (library, "open", budget.open),
        (
            library,
            "handle_macro_call",
            _macro_calls(library, library_run),
        ),
        (library, "process_include", _tracked(budget.counted(library.process_include), tracker)),
        (library, "grab_property", _noting(library.grab_property, _note_property, library_run)),
        (library, "grab_macro", _noting(library.grab_macro, _note_macro, library_run)),
        (library, "get_include_files", _lenient(library.get_include_files, library_run)),
        (library, "abs_filename_spec", _found_source(library.abs_filename_spec)),
        (library, "root_dir", root_dir or os.curdir),
        (library, "verbosity", verbosity),
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
def _swapped_items(table: Any, items: dict[str, Any]) -> Iterator[None]:
    before = {key: table[key] for key in items if key in table}
    table.update(items)
    try:
        yield
    finally:
        for key in items:
            del table[key]
        table.update(before)


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
        return str(workspace.package(name).share)

    return find


def _parser(library: Any, library_run: LibraryRun) -> Callable[..., Any]:
    tracker = library_run.tracker

    def parse(inp: Any, filename: str | None = None) -> Any:
        if inp is not None:
            return tracker.parse(inp, filename or "<xacro>") if isinstance(inp, str) else inp
        path = os.path.join(library.root_dir, str(filename))  # noqa: PTH118
        try:
            # The error shall name the file as the library's would: with "./".
            data = read_limited(path, TEXT_BYTES)
        except OSError as error:
            # As the library does: the missing file is not "the file being worked on".
            library.filestack.pop()
            raise library.XacroException(f"{error.strerror}: {path}", exc=error) from error
        if reason := too_much_in(data):
            raise ExpansionLimitError(f"'{filename}': {reason}")
        document = tracker.parse(data, str(filename))
        root: Any = document.documentElement
        if library_run.unprefixed is not None:
            add_prefixes(root, library_run.unprefixed)
        address, span = root.getAttribute("xmlns:xacro"), span_of(root)
        if address and span is not None:
            library_run.addresses.setdefault(address, span)
        return document

    return parse


def _remembering_evaluator(library: Any, budget: ExpansionBudget) -> Callable[..., Any]:
    """Evaluate as the library does, but compile each expression once.

    Most expressions of a robot stand in macros that are called many times.
    """

    @lru_cache(maxsize=4096)
    def compiled(text: str) -> tuple[CodeType, list[str]]:
        code = compile_limited(text)
        return code, [name for name in names_in_code(code) if name.startswith("__")]

    def safe_eval(expr: str, symbols: Any, locals_: Any = None) -> Any:
        code, invalid_names = compiled(expr.strip())
        if invalid_names:
            raise library.XacroException("Use of invalid name(s): ", ", ".join(invalid_names))
        symbols.update(__builtins__=budget.expressions.names)
        # This is what xacro is: expressions of the file, without builtins.
        return budget.expressions.checked(eval(code, symbols, locals_))  # noqa: S307

    return safe_eval


def _tracked(function: Callable[..., Any], tracker: Tracker) -> Callable[..., Any]:
    """Keep a call's place on the tracker's stack while it runs; after an error it stays there."""

    def call(element: Any, *rest: Any) -> Any:
        # Most elements are no macro calls, of which the library's function would only say so.
        if not element.tagName.startswith("xacro:"):
            return False
        span = span_of(element)
        if span is None:
            return function(element, *rest)
        # Without its own way there: the stack below holds that already.
        tracker.enter(replace(span, via=()))
        result = function(element, *rest)
        tracker.leave()
        return result

    return call


def _macro_calls(library: Any, library_run: LibraryRun) -> Callable[..., Any]:
    call = _tracked(library_run.budget.counted(library.handle_macro_call), library_run.tracker)
    if library_run.unprefixed is None:
        return call
    return with_old_calls(call, library, library_run.unprefixed)


def _noting(
    function: Callable[..., Any], note: Callable[[Any, LibraryRun], None], library_run: LibraryRun
) -> Callable[..., Any]:
    """Note where a property or macro stands when the library has read it."""

    def grab(element: Any, table: Any) -> None:
        function(element, table)
        note(element, library_run)

    return grab


def _note_property(element: Any, library_run: LibraryRun) -> None:
    span = span_of(element)
    if span is not None:
        name = element.getAttribute("name")
        library_run.properties[name] = span
        for attribute in ("value", "default"):
            if element.hasAttribute(attribute):
                library_run.properties[name, element.getAttribute(attribute)] = span


def _note_macro(element: Any, library_run: LibraryRun) -> None:
    span = span_of(element)
    if span is not None:
        library_run.macros[element.getAttribute("name")] = span


def _found_source(function: Callable[[str], str]) -> Callable[[str], str]:
    """Find files of source packages where they lie before they are installed."""

    def absolute(filename: str) -> str:
        name = function(filename)
        path = Path(name)
        source = None if exists(path) else installed_source(path.absolute())
        return name if source is None else str(source)

    return absolute


def _lenient(function: Callable[..., Any], library_run: LibraryRun) -> Callable[..., Any]:
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
            calls = library_run.tracker.via()
            span = replace(calls[0], via=calls[1:]) if calls else None
            library_run.left_out.append((missing, span))
            return []

    return files


def _printer(library_run: LibraryRun, console: Console | None) -> Callable[..., None]:
    def print_(*values: Any, **_options: Any) -> None:
        line = " ".join(str(value) for value in values)
        if console is not None:
            console(f"{line}\n")
        library_run.printed.append((line, _place_below(sys._getframe(1))))

    return print_


def _place_below(frame: FrameType | None) -> SourceSpan | None:
    """Return the place of the node that the nearest caller works on."""
    while frame is not None:
        node = node_in(frame)
        if node is not None:
            return span_of(node)
        frame = frame.f_back
    return None
