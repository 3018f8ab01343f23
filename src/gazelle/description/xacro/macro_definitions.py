"""What the xacro files of a run define, read again when an error is to be explained."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

from gazelle.description.xml import Tag, read_xml
from gazelle.diagnostics import Diagnostics, SourceSpan

__all__ = ["Definition", "definitions_in", "files_beside", "parameters_of"]

_PREFIX = "xacro:"
_MAX_FILES = 60


class Definition(NamedTuple):
    """A property, argument or macro that a file defines.

    Attributes:
        kind: ``property``, ``arg``, ``macro`` or ``parameter`` (of a macro).
        name: its name.
        span: the start tag.
        macro: the macro it stands in, empty outside of macros.
    """

    kind: str
    name: str
    span: SourceSpan
    macro: str = ""


def definitions_in(files: Iterable[str]) -> tuple[Definition, ...]:
    """Return what these files define, in document order; unreadable ones are passed over."""
    found: list[Definition] = []
    for file in dict.fromkeys(files):
        root = read_xml(Path(file), Diagnostics())
        if root is not None:
            found += _definitions(root, "")
    return tuple(found)


def parameters_of(text: str) -> list[str]:
    """Return the names in ``params="a b:=1 *block"``, without the stars."""
    from xacro import parse_macro_arg

    names: list[str] = []
    while text.strip():
        name, _, text = parse_macro_arg(text)
        names.append(name.lstrip("*"))
    return names


def files_beside(file: str, known: Iterable[str]) -> list[str]:
    """Return the xacro files in and below a file's folder that are not yet known."""
    seen = {Path(name).resolve() for name in known}
    folder = Path(file).resolve().parent
    near = sorted(folder.glob("*.xacro")) + sorted(folder.glob("*/*.xacro"))
    return [str(path) for path in near[:_MAX_FILES] if path not in seen]


def _definitions(tag: Tag, macro: str) -> Iterator[Definition]:
    for child in tag.children:
        kind = child.name.removeprefix(_PREFIX)
        name = child.attributes.get("name", "")
        if child.name.startswith(_PREFIX) and kind in {"property", "arg", "macro"}:
            yield Definition(kind, name, child.span, macro)
        inside = macro
        if child.name == f"{_PREFIX}macro":
            inside = name
            for parameter in parameters_of(child.attributes.get("params", "")):
                yield Definition("parameter", parameter, child.span, name)
        yield from _definitions(child, inside)
