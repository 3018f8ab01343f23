"""Names that siblings share."""

from __future__ import annotations

from collections import Counter

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.gz_sdf.specification import Definition

__all__ = ["counted_names", "shared_names"]


def counted_names(element: SdfElement, definition: Definition | None) -> Counter[str]:
    """Return how often each name occurs among an element's children; plug-ins do not count.

    A child that may have a name and has none counts under the specification's default.
    """
    names: Counter[str] = Counter()
    for child in element.children:
        if child.name == "plugin":
            continue
        name = child.attributes.get("name")
        if name is None:
            name = _default_name(child, definition)
        if name is not None:
            names[name] += 1
    return names


def shared_names(element: SdfElement, definition: Definition | None) -> list[SdfElement]:
    """Return the elements, depth first, among whose children two share a name.

    Plug-ins and elements of other namespaces are not looked into.
    """
    if element.name == "plugin" or ":" in element.name:
        return []
    found = [element] if any(n > 1 for n in counted_names(element, definition).values()) else []
    children = definition.resolved.children if definition is not None else {}
    for child in element.children:
        found += shared_names(child, children.get(child.name))
    return found


def _default_name(child: SdfElement, definition: Definition | None) -> str | None:
    known = definition.resolved.children.get(child.name) if definition is not None else None
    attribute = known.resolved.attribute("name") if known is not None else None
    return attribute.default if attribute is not None else None
