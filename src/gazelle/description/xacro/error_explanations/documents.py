"""Documents that are no XML, or no XML that may be read."""

from __future__ import annotations

from xml.parsers.expat import ErrorString, ExpatError, errors

from gazelle.description.xacro.dom import EntityRefusedError
from gazelle.description.xacro.error_explanations.finding import Finding
from gazelle.description.xacro.failure import Failure
from gazelle.diagnostics import SourceSpan
from gazelle.documents import TEXT_BYTES, read_limited

__all__ = ["NAMESPACE", "explain_document"]

NAMESPACE = "http://www.ros.org/wiki/xacro"
_UNBOUND = errors.codes[errors.XML_ERROR_UNBOUND_PREFIX]


def explain_document(failure: Failure) -> Finding | None:
    """Explain what the XML parser says; None for other failures."""
    error, via = failure.error, failure.session.tracker.via()
    if isinstance(error, EntityRefusedError):
        span = SourceSpan(failure.files[-1], error.line, error.column, 0, via)
        return Finding("xml.entity", str(error), span)
    if not isinstance(error, ExpatError):
        return None
    span = SourceSpan(failure.files[-1], error.lineno, error.offset + 1, 0, via)
    if error.code == _UNBOUND:
        return _unbound(span)
    return Finding("xml.malformed", f"not well-formed XML: {ErrorString(error.code)}", span)


def _unbound(span: SourceSpan) -> Finding:
    prefix = _prefix_at(span)
    if prefix in {"", "xacro"}:
        message = "<xacro:…> is used here, and no element around it declares xmlns:xacro"
        fix = f'write xmlns:xacro="{NAMESPACE}" into the outermost element'
        return Finding("xacro.no-namespace", message, span, fix)
    message = f"not well-formed XML: unbound prefix '{prefix}:'"
    fix = f'declare it in the outermost element: xmlns:{prefix}="…"'
    return Finding("xml.malformed", message, span, fix)


def _prefix_at(span: SourceSpan) -> str:
    try:
        data = read_limited(span.file, TEXT_BYTES)
        lines = data.decode("utf-8", errors="replace").split("\n")
        tag = lines[span.line - 1][span.column :]
    except (OSError, IndexError):
        return ""
    name, colon, _ = tag.partition(":")
    return name if colon and name.isidentifier() else ""
