"""What was being worked on when the library failed, read from the error's frames.

`Explanation` is what is made of it, with the words that explanations share.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from types import FrameType, ModuleType, TracebackType
from typing import Any, NamedTuple

from gazelle.description.xacro.dom import node_in, span_of
from gazelle.description.xacro.error_recovery import UNKNOWN
from gazelle.description.xacro.xacro_library import LibraryRun, causes_of
from gazelle.description.xml import attribute_holding, attribute_span, text_span
from gazelle.diagnostics import SourceSpan

__all__ = [
    "Explanation",
    "Failure",
    "failure_of",
    "include_line",
    "is_below",
    "known_keys",
    "listed",
    "one_line",
    "short_location",
]

_MAX = 12
_MAX_DEPTH = 12


class Explanation(NamedTuple):
    """A failure in words.

    Attributes:
        code: of the catalogue.
        message: what is wrong.
        span: where.
        fix: what to do, the catalogue's remedy when empty.
        subject: the name, macro, argument or file it is about.
    """

    code: str
    message: str
    span: SourceSpan
    fix: str = ""
    subject: str = ""


@dataclass
class Failure:
    """A failed run.

    Attributes:
        error: what the library raised.
        causes: it and what it wraps, outermost first.
        library_run: the run.
        files: the files being read, outermost first.
        macro_stack: the innermost of the macros being expanded.
        node: the DOM node being worked on.
        element: place of the element being worked on, without the way there.
        text: the value or text whose evaluation failed, as it is written; empty when none.
        attribute: the attribute that holds `text`, empty for the text of the element.
        part: the piece of `text` that failed, ``${…}`` or ``$(…)``; empty when none.
        expression: what stood in the innermost ``${…}``, empty when none.
        symbols: names known to the expression.
        macros: macros known there.
        locals: variables of the innermost frames by name of the function.
    """

    error: Exception
    causes: tuple[BaseException, ...]
    library_run: LibraryRun
    files: tuple[str, ...]
    macro_stack: tuple[Any, ...]
    node: Any = None
    element: SourceSpan | None = None
    text: str = ""
    attribute: str = ""
    part: str = ""
    expression: str = ""
    symbols: Any = None
    macros: Any = None
    locals: dict[str, dict[str, Any]] = field(default_factory=dict)

    @property
    def via(self) -> tuple[SourceSpan, ...]:
        """The way to `element`, innermost first."""
        calls = tuple(call for call in self.library_run.tracker.via() if call != self.element)
        own = span_of(self.node)
        return calls or (own.via if own is not None else ())

    @property
    def span(self) -> SourceSpan:
        """The exact place: of the expression, of the attribute or text, or of the element."""
        if self.element is None:
            return SourceSpan(self.files[-1])
        found = replace(self.element, via=self.via)
        if self.text and self.attribute:
            return attribute_span(found, self.attribute, self.part)
        return text_span(found, self.part or self.text.strip()) if self.text else found

    def attribute_place(self, name: str, *, whole: bool = False) -> SourceSpan:
        """Return the place of an attribute of the element being worked on."""
        if self.element is None:
            return self.span
        return attribute_span(replace(self.element, via=self.via), name, whole=whole)

    def cause(self, *types: type[BaseException]) -> Any:
        """Return the first cause of these types, None when there is none."""
        return next((item for item in self.causes if isinstance(item, types)), None)


def one_line(text: str) -> str:
    """Return a text with all white space as single spaces."""
    return " ".join(text.split())


def listed(names: Iterable[str], nothing: str = "none") -> str:
    """Return names with commas; a long list ends with how many more there are."""
    found = list(dict.fromkeys(names))
    more = f" and {len(found) - _MAX} more" if len(found) > _MAX else ""
    return ", ".join(found[:_MAX]) + more if found else nothing


def short_location(span: SourceSpan) -> str:
    """Return ``file:line`` with the file's name alone."""
    return f"{os.path.basename(span.file)}:{span.line}"  # noqa: PTH119


def is_below(span: SourceSpan, other: SourceSpan) -> bool:
    """Tell whether a place comes after another one of the same file."""
    return span.file == other.file and (span.line, span.column) > (other.line, other.column)


def include_line(file: str, reader: str) -> str:
    """Return the element by which one file includes another."""
    folder = os.path.dirname(os.path.abspath(reader))  # noqa: PTH100, PTH120
    return f'<xacro:include filename="{os.path.relpath(file, folder)}"/>'


def known_keys(table: object) -> tuple[str, ...]:
    """Return the names in one of the library's tables and those around it, nearest first."""
    names: list[str] = []
    while isinstance(table, dict):
        names += [str(name) for name, value in dict.items(table) if value is not UNKNOWN]
        table = getattr(table, "parent", None)
    return tuple(dict.fromkeys(names))


def failure_of(
    error: Exception, library: ModuleType, library_run: LibraryRun, file: str
) -> Failure:
    """Read the frames of an error, while the library's stacks are still as they were then.

    Args:
        error: what the library raised.
        library: the xacro module.
        library_run: the run.
        file: the input file.
    """
    files = tuple(str(name) for name in library.filestack or [file])
    stack = tuple((library.macrostack or [])[-_MAX_DEPTH:])
    failure = Failure(error, tuple(causes_of(error)), library_run, files, stack)
    for frame in _frames(error, str(library.__file__)):
        _look_at(frame, failure)
    if failure.text and failure.element is not None and not failure.attribute:
        failure.attribute = attribute_holding(failure.element, failure.text)
    return failure


def _frames(error: Exception, file: str) -> Iterator[FrameType]:
    """Yield the library's frames, outermost first, on to those of the errors wrapped."""
    seen: set[int] = set()
    for item in causes_of(error):
        traceback: TracebackType | None = item.__traceback__
        while traceback is not None:
            frame = traceback.tb_frame
            if frame.f_code.co_filename == file and id(frame) not in seen:
                seen.add(id(frame))
                yield frame
            traceback = traceback.tb_next


def _look_at(frame: FrameType, failure: Failure) -> None:
    name, local = frame.f_code.co_name, frame.f_locals
    failure.locals[name] = local
    if isinstance(local.get("macros"), dict):
        failure.macros = local["macros"]
    if name == "eval_text":
        failure.text = failure.text or str(local.get("text", ""))
        failure.symbols = local.get("symbols")
    elif name in {"handle_expr", "handle_extension"}:
        _note_part(name, str(local.get("s", "")), failure)
    elif name == "_resolve_":
        _work_on_property(local, failure)
    elif name == "eval_default_arg":
        _work_on(local["macro"].body, failure)
        failure.attribute = "params"
    else:
        table = local.get("symbols", local.get("table"))
        failure.symbols = table if isinstance(table, dict) else failure.symbols
        if (node := node_in(frame)) is not None:
            _work_on(node, failure)


def _note_part(kind: str, inside: str, failure: Failure) -> None:
    is_expression = kind == "handle_expr"
    part = f"${{{inside}}}" if is_expression else f"$({inside})"
    if is_expression or not failure.expression:
        failure.expression = inside if is_expression else ""
    if not failure.part or part in failure.text:
        failure.part = part


def _work_on(node: Any, failure: Failure) -> None:
    failure.node = node
    span = span_of(node)
    failure.element = None if span is None else replace(span, via=())
    failure.text = failure.attribute = failure.part = failure.expression = ""


def _work_on_property(local: dict[str, Any], failure: Failure) -> None:
    """Turn to the place of a property whose value is evaluated at its first use."""
    key, table = local["key"], local["self"]
    value = dict.get(table, key)
    properties = failure.library_run.properties
    span = properties.get((key, value)) if isinstance(value, str) else None
    if span is not None:
        failure.element = replace(span, via=())
        failure.text = failure.attribute = failure.part = failure.expression = ""
