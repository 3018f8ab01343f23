"""Reading and changing elements the way parser_urdf does."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.xml import Tag

__all__ = ["copied", "element_of", "found_or_added", "remove", "set_value", "value_of"]


def element_of(tag: Tag, release: Release) -> SdfElement:
    """Return a tag as an element.

    White space in its texts is kept for sdformat 12, which prints it; sdformat 9 makes one space
    of all that is between two words.
    """
    element = _bare(tag, release)
    waiting = [(tag, element)]
    while waiting:
        source, target = waiting.pop()
        for child in source.children:
            made = _bare(child, release)
            target.children.append(made)
            waiting.append((child, made))
    return element


def copied(element: SdfElement) -> SdfElement:
    """Return an element that shares nothing with the original."""
    top = _without_children(element)
    waiting = [(element, top)]
    while waiting:
        source, target = waiting.pop()
        for child in source.children:
            made = _without_children(child)
            target.children.append(made)
            waiting.append((child, made))
    return top


def value_of(element: SdfElement, console: Console) -> str:
    """Return the attribute ``value`` of an element, its text when it has none."""
    is_v9 = console.release is Release.V9
    value = element.attributes.get("value")
    if value is None:
        value = element.text
        if not value and element.children:
            if is_v9:
                # What a node is called in TinyXML, whether it is a text or an element.
                return element.children[0].name
            console.warning("no text", "Attribute value string not set")
    return value if is_v9 else value.strip(" \t\n")


def set_value(owner: SdfElement, name: str, text: str, console: Console) -> SdfElement:
    """Append a child with a text; the first one of that name goes, with a remark if it differs."""
    old = owner.find(name)
    if old is not None:
        before = value_of(old, console)
        if before != text:
            console.warning(
                "overwritten",
                f"multiple inconsistent <{name}> exists due to fixed joint reduction "
                f"overwriting previous value [{before}] with [{text}].",
            )
        remove(owner, old)
    return owner.add(name, text)


def remove(owner: SdfElement, child: SdfElement) -> None:
    """Take a child out, that very one and not one that equals it."""
    owner.children[:] = [item for item in owner.children if item is not child]


def found_or_added(owner: SdfElement, name: str) -> SdfElement:
    """Return the first child of a name, made at the end when there is none."""
    return owner.find(name) or owner.add(name)


def _bare(tag: Tag, release: Release) -> SdfElement:
    text = tag.text
    if release is Release.V9:
        text = " ".join(text.split())
    elif text and not tag.children:
        text = tag.raw_text or text
    return SdfElement(tag.name, dict(tag.attributes), text, [], tag.span.line)


def _without_children(element: SdfElement) -> SdfElement:
    return SdfElement(element.name, dict(element.attributes), element.text, [], element.line)
