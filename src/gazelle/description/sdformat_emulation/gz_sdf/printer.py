"""Elements as text, in the layout that sdformat prints."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.specification import Definition, specification
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["to_text"]

_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;"})
_QUOTED = str.maketrans({"&": "&amp;", "<": "&lt;", "'": "&apos;"})


def to_text(element: SdfElement, release: Release = Release.V12, indent: str = "") -> str:
    """Return an element as sdformat's ``Element::ToString`` prints it.

    Characters that would break the text (``&``, ``<`` and, in attributes, ``'``) are escaped;
    sdformat prints them bare, and nothing can read such a file.

    Args:
        element: normalised, as `read_document` returns it.
        release: its specification tells empty values from elements without value.
        indent: spaces before every line.
    """
    root = specification(release)
    definition = root if element.name == root.name else _find(root, element.name)
    return "".join(f"{line}\n" for line in _lines(element, definition, indent))


def _find(root: Definition, name: str) -> Definition | None:
    return root.book.get(name) or root.children.get(name)


def _lines(element: SdfElement, definition: Definition | None, indent: str) -> Iterator[str]:
    attributes = "".join(
        f" {name}='{value.translate(_QUOTED)}'" for name, value in element.attributes.items()
    )
    head = f"{indent}<{element.name}{attributes}"
    if element.children:
        yield f"{head}>"
        children = definition.resolved.children if definition else {}
        for child in element.children:
            yield from _lines(child, children.get(child.name), indent + "  ")
        yield f"{indent}</{element.name}>"
    elif element.text or (definition is not None and definition.resolved.value is not None):
        yield f"{head}>{element.text.translate(_ESCAPES)}</{element.name}>"
    else:
        yield f"{head}/>"
