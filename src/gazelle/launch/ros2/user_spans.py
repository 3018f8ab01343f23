"""Which line of the user's made something or raised something, and what is told of an error."""

from __future__ import annotations

import contextlib
import sys
import sysconfig
import traceback
from collections.abc import Iterator
from contextvars import ContextVar
from pathlib import Path
from types import FrameType

from gazelle.diagnostics import SourceSpan

__all__ = [
    "calling_span",
    "is_the_users",
    "keep_explanation",
    "keep_span",
    "kept_explanation",
    "kept_span",
    "raising_span",
    "written_at",
]

_EXPLANATION = "_gazelle_explanation"
_OURS = str(Path(__file__).parents[2])
# Also the folder of commands such as gazelle.
_NOT_THE_USERS = (
    _OURS,
    *(sysconfig.get_path(name) for name in ("stdlib", "purelib", "scripts")),
    "<frozen",
)
_ATTRIBUTE = "_gazelle_place"
_element: ContextVar[SourceSpan | None] = ContextVar("element", default=None)


def keep_explanation(error: BaseException, message: str = "", fix: str = "") -> None:
    """Remember with an error a shorter or fuller message, and what to do."""
    setattr(error, _EXPLANATION, (message, fix))


def kept_explanation(error: BaseException) -> tuple[str, str]:
    """Return what was remembered: message and what to do, each empty without."""
    found: tuple[str, str] = getattr(error, _EXPLANATION, ("", ""))
    return found


@contextlib.contextmanager
def written_at(span: SourceSpan | None) -> Iterator[None]:
    """Let `calling_span` return the place of an element of XML or YAML."""
    token = _element.set(span or _element.get())
    try:
        yield
    finally:
        _element.reset(token)


def calling_span() -> SourceSpan | None:
    """Return the line of the user's own file that is being executed, None outside of any."""
    element = _element.get()
    if element is not None:
        return element
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        if is_the_users(frame.f_code.co_filename):
            return SourceSpan(frame.f_code.co_filename, frame.f_lineno)
        frame = frame.f_back
    return None


def raising_span(error: BaseException) -> SourceSpan | None:
    """Return the innermost line of the user's own files in a traceback."""
    if isinstance(error, SyntaxError) and error.filename and error.lineno:
        span = SourceSpan(error.filename, error.lineno, error.offset or 0)
        # That of a text, such as an expression, has the line of whoever gave the text.
        return span if is_the_users(error.filename) else None
    frames = [
        (frame.f_code.co_filename, line) for frame, line in traceback.walk_tb(error.__traceback__)
    ]
    for file, line in reversed(frames):
        if is_the_users(file):
            return SourceSpan(file, line)
    return None


def keep_span(error: BaseException, span: SourceSpan | None) -> None:
    """Remember with an error what it is about; the first place that is told counts."""
    if span is not None and getattr(error, _ATTRIBUTE, None) is None:
        setattr(error, _ATTRIBUTE, span)


def kept_span(error: BaseException) -> SourceSpan | None:
    """Return the place that was remembered with an error."""
    span: SourceSpan | None = getattr(error, _ATTRIBUTE, None)
    return span


def is_the_users(file: str) -> bool:
    """Return whether code is the user's, not Gazelle's nor a library's."""
    return not file.startswith(_NOT_THE_USERS) and not file.startswith("<")
