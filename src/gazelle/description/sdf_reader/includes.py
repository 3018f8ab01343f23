"""SDF ``<include>``: finding and parsing the file, on this machine only."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.model_config import model_file_in
from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.documents.files import is_folder
from gazelle.workspace.file_lookup import Resolved

__all__ = ["closes_circle", "included_file", "share_findings"]


def included_file(tag: Tag, context: ReadContext) -> Path | None:
    """Return the file that an ``<include>`` means; None (reported) when it is not here.

    A folder's ``model.config`` decides. An address of a model server is looked up by the model's
    name in local folders; nothing is downloaded.
    """
    place = tag.find("uri") or tag
    uri = tag.text_of("uri")
    if not uri:
        context.diagnostics.report("xml.missing-tag", "<include> has no <uri>", tag.span)
        return None
    found = context.resolve(uri)
    if found.path is None and "/" not in uri.strip():
        # A bare name means a model, too.
        found = context.resolve(f"model://{uri.strip()}")
    path = found.path
    file = model_file_in(path, context) if path is not None and is_folder(path) else path
    if file is None:
        _report_missing(uri, found, place, context)
    else:
        context.report_note(uri, found, place.span, "sdf.bad-value")
    return file


def closes_circle(file: Path, tag: Tag, context: ReadContext) -> bool:
    """Tell whether a file is being read already; report the chain of includes if so."""
    if file not in context.include_chain:
        return False
    start = context.include_chain.index(file)
    chain = [*context.include_chain[start:], file]
    message = "models include each other in a circle: " + " → ".join(map(_short, chain))
    context.diagnostics.report("sdf.include-cycle", message, tag.span)
    return True


def share_findings(inner: Diagnostics, tag: Tag, context: ReadContext) -> None:
    """Pass on what was found in an included file, with the include as the way there.

    In a world an error inside one included model does not stop the others; it becomes a warning.
    """
    for item in inner:
        span = item.span and replace(item.span, via=(*item.span.via, tag.span))
        severity = min(item.severity, Severity.WARNING) if context.in_world else item.severity
        context.diagnostics.add(replace(item, span=span, severity=severity))


def _short(path: Path) -> str:
    return "/".join(path.parts[-2:])


def _report_missing(uri: str, found: Resolved, place: Tag, context: ReadContext) -> None:
    where = found.explain(uri)
    if found.path is not None:
        where = (
            f"'{uri}' is the folder '{found.path}', which has neither model.config nor model.sdf"
        )
    message = f"included model {where}"
    severity = Severity.WARNING if context.in_world else Severity.ERROR
    message += "\n  the world goes on without it" if context.in_world else ""
    context.diagnostics.report("sdf.missing-model", message, place.span, severity=severity)
