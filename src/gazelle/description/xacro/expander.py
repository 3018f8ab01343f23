"""xacro to plain XML, byte for byte what the official program prints."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from gazelle.description.xacro.dom import place_of
from gazelle.description.xacro.problems import report_failure, report_printed
from gazelle.description.xacro.session import run_session
from gazelle.description.xml import Tag, parse_xml
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.workspace import Workspace

__all__ = ["Expanded", "expand_xacro"]


@dataclass(frozen=True, slots=True)
class Expanded:
    """An expanded xacro file.

    Attributes:
        text: the result, as ``xacro`` prints it.
        file: the input file, as it was named.
        source_map: line of `text`, from 1, on which an element starts → the place in the xacro
            files where it was written; `SourceSpan.via` holds the macro calls and includes that
            brought it there, innermost first. The banner's lines have no entry.
        dependencies: the other files read, in the order they were read.
    """

    text: str
    file: str
    source_map: Mapping[int, SourceSpan] = field(default_factory=dict, repr=False)
    dependencies: tuple[str, ...] = ()

    def tag(self, diagnostics: Diagnostics) -> Tag | None:
        """Return the result as elements whose places are those of the xacro files."""
        root = parse_xml(self.text, self.file, diagnostics)
        return None if root is None else self._placed(root)

    def _placed(self, tag: Tag) -> Tag:
        children = tuple(self._placed(child) for child in tag.children)
        span = self.source_map.get(tag.span.line, tag.span)
        return Tag(tag.name, span, tag.attributes, children, tag.text)


def expand_xacro(
    path: str | Path,
    *,
    mappings: Mapping[str, str] | None = None,
    workspace: Workspace | None,
    diagnostics: Diagnostics,
    root_dir: str = "",
) -> Expanded | None:
    """Expand a xacro file in this process with the official library.

    Args:
        path: the file; stands in the result's banner as it is written here.
        mappings: values of ``<xacro:arg>`` by name.
        workspace: finds packages for ``$(find)``.
        diagnostics: receives errors, and the warnings that xacro prints.
        root_dir: folder that a relative `path` and ``$(cwd)`` start from, empty for the
            current one.

    Returns:
        The result; None when xacro fails, with the reason reported at its place.
    """
    file = str(path)
    values = {str(name): str(value) for name, value in (mappings or {}).items()}
    with run_session(workspace, root_dir) as (library, session):
        try:
            document: Any = library.process_file(file, mappings=values)
            text = document.toprettyxml(indent="  ")
        # The library evaluates expressions of the file: anything can be raised in there.
        except Exception as error:  # noqa: BLE001
            report_printed(session, file, diagnostics)
            report_failure(error, library, session, workspace, diagnostics)
            return None
        report_printed(session, file, diagnostics)
        dependencies = tuple(dict.fromkeys(str(item) for item in library.all_includes))
    return Expanded(text, file, _source_map(document, text, file), dependencies)


def _source_map(document: Any, text: str, file: str) -> dict[int, SourceSpan]:
    """Pair the elements of the document with those of the text: both are in document order."""
    root = parse_xml(text, file, Diagnostics())
    if root is None:
        return {}
    places: dict[int, SourceSpan] = {}
    for element, tag in zip(_elements(document.documentElement), root.walk(), strict=False):
        place = place_of(element)
        if place is not None:
            places.setdefault(tag.span.line, place)
    return places


def _elements(element: Any) -> Iterator[Any]:
    yield element
    for child in element.childNodes:
        if child.nodeType == child.ELEMENT_NODE:
            yield from _elements(child)
