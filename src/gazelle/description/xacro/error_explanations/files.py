"""Files that cannot be found, documents that are no XML or YAML, and runs without end."""

from __future__ import annotations

import os
import re
from dataclasses import replace
from pathlib import Path
from xml.parsers.expat import ErrorString, ExpatError, errors

from gazelle.description.xacro.dom import EntityRefusedError
from gazelle.description.xacro.expansion_limits import ExpansionLimitError
from gazelle.description.xacro.failure import Explanation, Failure, one_line
from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.documents import TEXT_BYTES, LimitError, read_limited
from gazelle.documents.files import exists, is_folder
from gazelle.documents.malformed_xml import malformed_xml
from gazelle.documents.yaml import ProblemKind, PyYamlError, problem_of
from gazelle.errors import NotFoundError

__all__ = ["NAMESPACE", "explain_document", "explain_file", "explain_limit"]

NAMESPACE = "http://www.ros.org/wiki/xacro"
_UNBOUND = errors.codes[errors.XML_ERROR_UNBOUND_PREFIX]
_MAX_LENGTH = 80
# Behind comments and what stands in <? ?> and <! >.
_FIRST_TAG = re.compile(r"\A(?:<!--.*?-->|<[?!][^>]*>|[^<])*(<)(?=\w)", re.DOTALL)


def explain_document(failure: Failure) -> Explanation | None:
    """Explain what the XML parser says; None for other failures."""
    error, via = failure.error, failure.library_run.tracker.via()
    if isinstance(error, EntityRefusedError):
        span = SourceSpan(failure.files[-1], error.line, error.column, 0, via)
        return Explanation("xml.entity", str(error), span)
    if not isinstance(error, ExpatError):
        return None
    span = SourceSpan(failure.files[-1], error.lineno, error.offset + 1, 0, via)
    if error.code == _UNBOUND:
        return _unbound(span)
    return _malformed(error, span)


def explain_limit(failure: Failure) -> Explanation | None:
    """Explain that a limit was reached; None for other failures."""
    error = failure.cause(LimitError)
    if error is None:
        return None
    if isinstance(error, ExpansionLimitError):
        message = f"the file expands to too much: {error}"
        return Explanation("limits.expansion", message, failure.span)
    shown = one_line(failure.expression or failure.part)
    shown = shown if len(shown) <= _MAX_LENGTH else f"{shown[:_MAX_LENGTH]}…"
    message = f"{error}, when evaluating expression '{shown}'"
    return Explanation("limits.expression", message, failure.span)


def explain_file(failure: Failure) -> Explanation | None:
    """Explain a missing package or file, or broken YAML; None for other failures."""
    missing = failure.cause(NotFoundError)
    lookup = failure.cause(LookupError)
    if missing is None and lookup is not None and "workspace" in str(lookup):
        missing = lookup
    if missing is not None:
        return Explanation("xacro.package-missing", one_line(str(missing)), failure.span)
    broken = failure.cause(PyYamlError)
    if broken is not None:
        return _broken_yaml(broken, failure)
    error = failure.cause(OSError)
    return None if error is None else _unreadable(error, failure)


def _malformed(error: ExpatError, span: SourceSpan) -> Explanation:
    try:
        found = malformed_xml(read_limited(span.file, TEXT_BYTES), error)
    except (OSError, LimitError):
        return Explanation("xml.malformed", f"not well-formed XML: {ErrorString(error.code)}", span)
    place = replace(span, line=found.line, column=found.column)
    return Explanation("xml.malformed", found.message, place, found.fix)


def _unbound(span: SourceSpan) -> Explanation:
    prefix = _prefix_at(span)
    if prefix in {"", "xacro"}:
        message = "<xacro:…> is used here, and no element around it declares xmlns:xacro"
        fix = f'write xmlns:xacro="{NAMESPACE}" into the outermost element'
        return Explanation("xacro.no-namespace", message, _outermost(span), fix)
    message = f"not well-formed XML: unbound prefix '{prefix}:'"
    fix = f'declare it in the outermost element: xmlns:{prefix}="…"'
    return Explanation("xml.malformed", message, span, fix)


def _outermost(span: SourceSpan) -> SourceSpan:
    """Return the place of the outermost element of the file that a place is in."""
    try:
        text = read_limited(span.file, TEXT_BYTES).decode("utf-8", errors="replace")
    except (OSError, LimitError):
        return span
    found = _FIRST_TAG.search(text)
    if found is None:
        return span
    begin = found.start(1)
    line = text.count("\n", 0, begin) + 1
    return replace(span, line=line, column=begin - text.rfind("\n", 0, begin), length=0)


def _prefix_at(span: SourceSpan) -> str:
    try:
        data = read_limited(span.file, TEXT_BYTES)
        lines = data.decode("utf-8", errors="replace").split("\n")
        tag = lines[span.line - 1][span.column :]
    except (OSError, IndexError):
        return ""
    name, colon, _ = tag.partition(":")
    return name if colon and name.isidentifier() else ""


def _unreadable(error: OSError, failure: Failure) -> Explanation:
    name = str(error.filename)
    path = Path(name)
    message = f"cannot read '{os.path.normpath(name)}': {error.strerror}"
    written = str(failure.locals.get("load_yaml", {}).get("filename", ""))
    if not path.is_absolute() and not exists(path):
        message += f"; looked for it at '{path.absolute()}'"
    if failure.element is None:
        return Explanation(
            "xacro.file-missing", message, failure.span, _near(path, failure.files), name
        )
    if not written and failure.node is not None and failure.node.hasAttribute("filename"):
        span = failure.attribute_place("filename")
    else:
        span = failure.span
    return Explanation("xacro.file-missing", message, span, _near(path, failure.files), name)


def _near(path: Path, files: tuple[str, ...]) -> str:
    folder = path.parent
    readers = [Path(name).name for name in files]
    if not is_folder(folder):
        return f"there is no folder '{folder}'"
    names = (item.name for item in folder.iterdir() if item.suffix == path.suffix)
    return did_you_mean(path.name, (name for name in names if name not in readers))


def _broken_yaml(error: Exception, failure: Failure) -> Explanation:
    file = str(failure.locals.get("load_yaml", {}).get("filename", ""))
    problem = problem_of(error, file)
    context = f"{problem.context}: " if problem.context else ""
    message = f"not YAML: {context}{one_line(problem.what)}"
    if not file or not problem.has_place:
        return Explanation("xacro.bad-yaml", message, failure.span)
    calls = (replace(failure.span, via=()), *failure.via)
    span = replace(problem.span, length=1, via=calls)
    is_tab = problem.kind in {ProblemKind.TAB, ProblemKind.TAB_INDENT}
    return Explanation("xacro.bad-yaml", message, span, problem.fix if is_tab else "", file)
