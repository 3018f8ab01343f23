"""What xacro says, as diagnostics with a place, the macro stack and a remedy."""

from __future__ import annotations

import re
from dataclasses import replace
from types import ModuleType, TracebackType
from typing import Any
from xml.parsers.expat import ErrorString, ExpatError

from gazelle.description.xacro.dom import EntityRefusedError, node_in, place_of
from gazelle.description.xacro.session import Session, causes_of
from gazelle.diagnostics import Diagnostics, Severity, SourceSpan, did_you_mean
from gazelle.errors import NotFoundError
from gazelle.workspace import Workspace

__all__ = ["report_failure", "report_printed"]

_LOCATION = re.compile(
    r"(when instantiating macro|instantiated from|in file|when processing file|included from): "
)
# A stack of hundreds of recursive calls says no more than its innermost part.
_DEEPEST = 12
_NEEDS_DEFINITION = frozenset({"xacro.undefined-name", "xacro.unknown-macro"})
_NAME_ERROR = re.compile(r"name '(.+?)' is not defined")


def report_printed(session: Session, file: str, diagnostics: Diagnostics) -> None:
    """Report the warnings and messages that a run printed.

    Args:
        session: the run.
        file: its input file, the place of warnings that name no other.
        diagnostics: receives ``xacro.warning``, ``xacro.message``, ``xacro.include-left-out``.
    """
    for line, span in session.printed:
        if not line or _LOCATION.match(line):
            continue
        text, warned = re.subn(r"^(warning|error): ", "", line)
        code = "xacro.warning" if warned else "xacro.message"
        diagnostics.report(code, text, span or SourceSpan(file))
    for missing, span in session.left_out:
        message = f"package '{missing.name}' not found: this include is left out"
        diagnostics.report("xacro.include-left-out", message, span or SourceSpan(file))


def report_failure(
    error: Exception,
    library: ModuleType,
    session: Session,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
) -> None:
    """Report why a run failed, at the element that was being worked on.

    Args:
        error: what the library raised.
        library: the xacro module, for its stack of files.
        session: the run.
        workspace: names packages that are near a missing one.
        diagnostics: receives one error.
    """
    files = [str(name) for name in library.filestack or ["<xacro>"]]
    if isinstance(error, ExpatError):
        span = SourceSpan(files[-1], error.lineno, error.offset + 1, 0, session.tracker.via())
        message = f"not well-formed XML: {ErrorString(error.code)}"
        diagnostics.report("xml.malformed", message, span)
        return
    if isinstance(error, EntityRefusedError):
        span = SourceSpan(files[-1], error.line, error.column, 0, session.tracker.via())
        diagnostics.report("xml.entity", str(error), span)
        return
    node = _node_of(error.__traceback__)
    place = place_of(node) or SourceSpan(files[-1])
    here = replace(place, via=())
    via = tuple(call for call in session.tracker.via() if call != here)
    span = replace(place, via=(via or place.via)[:_DEEPEST])
    code, message, fix = _explain(error, node, workspace)
    if session.left_out and code in _NEEDS_DEFINITION:
        names = dict.fromkeys(missing.name for missing, _ in session.left_out)
        message += "; missing packages may define it: " + ", ".join(names)
    diagnostics.report(code, message, span, fix=fix, severity=Severity.ERROR)


def _node_of(traceback: TracebackType | None) -> Any:
    """Return the DOM node that the innermost function of the library was working on."""
    found = None
    while traceback is not None:
        found = node_in(traceback.tb_frame) or found
        traceback = traceback.tb_next
    return found


def _has_default_below(node: Any, name: str) -> bool:
    """Tell whether the document has a default for an argument that was missing at a node."""
    document = getattr(node, "ownerDocument", None)
    tags = [] if document is None else document.getElementsByTagName("xacro:arg")
    return any(tag.getAttribute("name") == name and tag.hasAttribute("default") for tag in tags)


def _explain(error: Exception, node: Any, workspace: Workspace | None) -> tuple[str, str, str]:
    """Return code, message and remedy for what the library raised."""
    causes = tuple(causes_of(error))
    text = _one_line(str(error) or repr(error))
    for cause in causes:
        if isinstance(cause, NotFoundError) or (
            isinstance(cause, LookupError) and "workspace" in str(cause)
        ):
            return "xacro.package-missing", _one_line(str(cause)), ""
        if type(cause).__name__ == "ArgException":
            name = str(cause)
            fix = f'pass {name}:=… or write <xacro:arg name="{name}" default="…"/>'
            if _has_default_below(node, name):
                fix = f"pass {name}:=…; its <xacro:arg> with the default comes after this use"
            return "xacro.argument-missing", f"$(arg {name}) has no value", fix
        if type(cause).__name__ == "SubstitutionException":
            return "xacro.failed", _one_line(str(cause)), ""
        if isinstance(cause, OSError):
            message = f"cannot read '{cause.filename}': {cause.strerror}"
            return "xacro.file-missing", message, ""
        if isinstance(cause, RecursionError):
            return "xacro.recursion", "macros or properties call each other without end", ""
        unknown = _NAME_ERROR.search(str(cause)) if isinstance(cause, NameError) else None
        if unknown is not None:
            fix = did_you_mean(unknown.group(1), _names_in(error.__traceback__))
            return "xacro.undefined-name", text, fix
    if "unknown macro name" in text:
        fix = did_you_mean(
            str(node.tagName).removeprefix("xacro:"), _macros_in(error.__traceback__)
        )
        return "xacro.unknown-macro", text, fix
    if any(isinstance(cause, SyntaxError) for cause in causes) or "evaluating expression" in text:
        return "xacro.bad-expression", text, ""
    return "xacro.failed", text, ""


def _names_in(traceback: TracebackType | None) -> tuple[str, ...]:
    """Return the properties known where an expression failed."""
    return _keys(traceback, "symbols")


def _macros_in(traceback: TracebackType | None) -> tuple[str, ...]:
    return _keys(traceback, "macros")


def _keys(traceback: TracebackType | None, variable: str) -> tuple[str, ...]:
    table: Any = None
    while traceback is not None:
        local = traceback.tb_frame.f_locals.get(variable)
        table = local if isinstance(local, dict) else table
        traceback = traceback.tb_next
    names: list[str] = []
    while isinstance(table, dict):
        names += [str(name) for name in dict.keys(table)]
        table = getattr(table, "parent", None)
    return tuple(dict.fromkeys(names))


def _one_line(text: str) -> str:
    return " ".join(text.split())
